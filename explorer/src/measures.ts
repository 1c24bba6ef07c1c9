/** What is measured of a linkage: its output, dead centres, transmission angle, poles. */

import { principal, TURN, wrapped } from "./cycle";
import type { Rows } from "./kernel";
import type { Linkage } from "./linkage";
import type { Leg, Model, Place } from "./model";
import { direction, leastRoot, origin, type Pair, place, rate, speed, turn } from "./rows";
import type { Sizes } from "./sizes";

const STILL = 1e-9; // of the natural speed: an output that is never faster does not move
const NOISE = 1e-6; // radians, or sizes: what moves less does not move, as in the plots of Python
const CHANGE = 1e-5; // below this root, next to a change point, velocities have no sign
const SAME_ANGLE = 1e-8; // radians: of equal ones rounding chooses none
const THROUGHOUT = 1e-6; // radians: an angle that differs by less, as lengths of designs are rounded, is one
const GOLDEN = 0.6180339887498949;

export interface DeadCentre {
  value: number;
  output: number;
}

/** A transmission angle and the drive value there. */
interface Low {
  value: number;
  mu: number;
}

/** The smallest one, with the leg that pushes there; null if it is the same throughout. */
export interface Least extends Low {
  leg: Leg | null;
}

// --- the output ------------------------------------------------------------------------------------------------------

/** Whether the output is an angle, and not a way. */
export function isAngle({ model }: Linkage): boolean {
  return model.outputs[0]?.joint === null;
}

/** The output, or its first or second derivative by the drive, in a row. */
export function output({ model, sizes }: Linkage, rows: Rows, row: number, order = 0): number {
  const record = model.outputs[0];
  if (!record) return NaN;
  if (record.joint === null) {
    if (order) return rate(rows, row, record.link, order);
    const [c, s] = turn(rows, row, record.link);
    return Math.atan2(s, c);
  }
  const [line, other] = slideOf(model, sizes, record.joint);
  const { link } = sizes.element(line);
  const [lx, ly] = direction(rows, row, link, sizes.line(line));
  const gap = (k: number): Pair => {
    const [px, py] = place(rows, row, link, ...sizes.xy(line), k);
    const [qx, qy] = place(rows, row, sizes.element(other).link, ...sizes.xy(other), k);
    return [qx - px, qy - py];
  };
  const along = ([x, y]: Pair) => lx * x + ly * y;
  const across = ([x, y]: Pair) => lx * y - ly * x;
  const zeroth = gap(0);
  if (order === 0) return along(zeroth);
  const w = rate(rows, row, link, 1);
  const first = gap(1);
  if (order === 1) return along(first) + w * across(zeroth);
  const al = rate(rows, row, link, 2);
  return along(gap(2)) + 2 * w * across(first) + al * across(zeroth) - w * w * along(zeroth);
}

/** Of a slide the line along which its way is measured, and what goes along it. */
export function slideOf({ frame }: Model, sizes: Sizes, joint: number): [line: number, other: number] {
  const mine = sizes.elementsOf(joint);
  const line = mine.find((k) => sizes.element(k).link === frame) ?? mine[0]!;
  return [line, mine.find((k) => k !== line)!];
}

/** From where the way of the output is measured, and as far as it is; none of an angle. */
export function wayEnds(linkage: Linkage): Pair[] {
  const { model, pose, sizes } = linkage;
  const joint = model.outputs[0]?.joint;
  if (typeof joint !== "number") return [];
  const [line] = slideOf(model, sizes, joint);
  const [x, y] = linkage.elementAt(line);
  const [c, s] = direction(pose, 0, sizes.element(line).link, sizes.line(line));
  const way = output(linkage, pose, 0);
  return [
    [x, y],
    [x + way * c, y + way * s],
  ];
}

/** The rate below which the output does not move: what is less is rounding. */
export function stillRate(linkage: Linkage): number {
  const { drive, size } = linkage;
  return (STILL * (isAngle(linkage) ? 1 : size)) / (drive?.turning ? 1 : size);
}

/** The output, or a derivative by the drive, at rows of the cycle that follow one another. An angle has no jumps, and
 * lies between -180° and 180° where the cycle was found, as the library measures it from a reference pose. */
export function outputAlong(linkage: Linkage, rows: readonly number[]): Float64Array {
  const { cycle } = linkage;
  const values = Float64Array.from(rows, (row) => output(linkage, cycle.rows, row));
  return isAngle(linkage) ? unwrapped(values, rows.indexOf(cycle.home)) : values;
}

/** Whether the output, whose values over the cycle are given, keeps its angle or its place, but for rounding. */
export function outputStandsStill(linkage: Linkage, values: Float64Array): boolean {
  const size = isAngle(linkage) ? 1 : linkage.sizes.unit;
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
  return high - low < NOISE * size;
}

/** Angles that follow one another without jumps; the one at `home` stays as it is. */
export function unwrapped(values: Float64Array, home: number): Float64Array {
  let turns = 0;
  const laps = values.map((value, k) => {
    if (k) turns -= Math.round((value - values[k - 1]!) / TURN);
    return turns;
  });
  const first = laps[home] ?? 0;
  return values.map((value, k) => value + (laps[k]! - first) * TURN);
}

// --- the transmission angle ------------------------------------------------------------------------------------------

/** The transmission angle, at most pi/2: of the legs on the way from the drive to the output the smallest one; NaN
 * where there is none. */
export function transmission(linkage: Linkage, rows: Rows, row: number): number {
  const angles = legsOf(linkage).map((leg) => between(forceAndWay(linkage, rows, row, leg)));
  return angles.length ? Math.min(...angles) : NaN;
}

function legsOf({ model }: Linkage): readonly Leg[] {
  return model.outputs[0]?.legs ?? [];
}

function between([real, imag]: Pair): number {
  return Math.atan2(Math.abs(real), Math.abs(imag));
}

/** Cosine and sine between the force of a leg and the way of the point on which it acts. */
function forceAndWay(linkage: Linkage, rows: Rows, row: number, leg: Leg): Pair {
  const { across, cam, guide, pushed } = leg;
  let pin = legPlace(linkage, rows, row, leg.pin);
  const force = across ? legLine(linkage, rows, row, leg.from) : legPlace(linkage, rows, row, leg.from);
  let [fx, fy] = across ? [-force[1], force[0]] : [pin[0] - force[0], pin[1] - force[1]];
  if (cam) {
    // normal to the way of the roller against the cam, or where the face slides on the cam along itself
    const [axis, on] = across ? [leg.pin, leg.from] : [leg.from, leg.pin];
    const at = legPlace(linkage, rows, row, on);
    const [u, v] = place(rows, row, on[0], ...legPoint(linkage, on), 1);
    const [cx, cy] = wayOf(linkage, rows, row, axis[0], at, on);
    if (across) {
      const z = (fx * (u - cx) + fy * (v - cy)) / (rate(rows, row, axis[0]) - rate(rows, row, on[0]));
      pin = [at[0] + z * force[0], at[1] + z * force[1]];
    } else [fx, fy] = [v - cy, cx - u];
  }
  let way: Pair;
  if (!guide) way = wayOf(linkage, rows, row, pushed, pin, leg.pin);
  else if (guide.slides) way = legLine(linkage, rows, row, guide.at);
  else {
    const held = legPlace(linkage, rows, row, guide.at);
    way = [held[1] - pin[1], pin[0] - held[0]];
  }
  const [wx, wy] = way;
  const length = Math.hypot(fx, fy) * Math.hypot(wx, wy);
  return [(fx * wx + fy * wy) / length, (fx * wy - fy * wx) / length];
}

/** Where an end of a leg lies. */
function legPlace(linkage: Linkage, rows: Rows, row: number, at: Place): Pair {
  const [px, py] = legPoint(linkage, at);
  return place(rows, row, at[0], px, py);
}

/** The direction of the line at an end of a leg. */
function legLine({ program: p }: Linkage, rows: Rows, row: number, [link, , , dx, dy, element]: Place): Pair {
  return direction(rows, row, link, element < 0 ? [dx, dy] : [p.lines[2 * element]!, p.lines[2 * element + 1]!]);
}

/** The point of an end of a leg on its link. */
function legPoint({ program: p }: Linkage, at: Place): Pair {
  const element = at[5];
  return element < 0 ? [at[1], at[2]] : [p.points[2 * element]!, p.points[2 * element + 1]!];
}

/** The velocity of the place of a link where a point is; at rest the way in which it leaves. */
function wayOf(linkage: Linkage, rows: Rows, row: number, link: number, point: Pair, from: Place): Pair {
  const [x, y] = origin(rows, row, link);
  const [u, v] = origin(rows, row, link, 1);
  const dx = point[0] - x;
  const dy = point[1] - y;
  const w = rate(rows, row, link, 1);
  const vx = u - w * dy;
  const vy = v + w * dx;
  let fastest = 0;
  for (let k = 0; k < rows.links; k++) {
    fastest = Math.max(fastest, speed(rows, row, k), linkage.size * Math.abs(rate(rows, row, k)));
  }
  if (Math.hypot(vx, vy) >= 1e-7 * fastest) return [vx, vy];
  const [px, py] = place(rows, row, from[0], ...legPoint(linkage, from), 1);
  const rx = px - u;
  const ry = py - v;
  const a = rate(rows, row, link, 2);
  const [ax, ay] = origin(rows, row, link, 2);
  return [ax - a * dy - w * ry, ay + a * dx + w * rx];
}

// --- over the cycle --------------------------------------------------------------------------------------------------

/** Where the output turns back: zeros of its velocity, to 1e-9 of a radian or size. */
export function deadCentres(linkage: Linkage): DeadCentre[] {
  const { values } = linkage.cycle;
  const every = [...values.keys()];
  const speeds = every.map((row) => output(linkage, linkage.cycle.rows, row, 1));
  const usual = Math.max(0, ...speeds.map((v) => (Number.isFinite(v) ? Math.abs(v) : 0)));
  const out: DeadCentre[] = [];
  if (!(usual > stillRate(linkage))) return out;
  const still = 1e-9 * usual;
  const outputs = outputAlong(linkage, every);
  let last = -1;
  const end = values.length - 1;
  // a full cycle ends as it begins, perhaps where it turns back: then its second row comes after the last one
  if (linkage.cycle.full && !(Math.abs(speeds[end]!) > still)) every.push(end + 1);
  for (const row of every) {
    const at = row > end ? row - end : row;
    if (!(Math.abs(speeds[at]!) > still)) continue;
    if (last >= 0 && speeds[last]! * speeds[at]! < 0 && row - last <= 2) {
      const found = turningBack(linkage, values[last]!, values[at]! + values[row - at]! - values[0]!, last);
      if (found !== null) {
        // in the lap of the row beside it, so that the difference of two angles is how far the output goes
        if (isAngle(linkage)) found.output = outputs[last]! + principal(found.output - outputs[last]!);
        out.push(found);
      }
    }
    last = row;
  }
  return out;
}

/** Whether the output, whose values over the cycle are given, turns fully. */
export function goesRound({ cycle, model }: Linkage, along: Float64Array): boolean {
  return model.outputs[0]?.joint === null && cycle.full && Math.abs(along.at(-1)! - along[0]!) > TURN / 2;
}

/** How far the output goes, with its dead centres and the ends of the cycle; null where it goes round or is none. */
export function travelOf(linkage: Linkage, dead: readonly DeadCentre[]): number | null {
  const { cycle, model } = linkage;
  if (!model.outputs[0] || cycle.values.length < 2) return null;
  const turning = isAngle(linkage);
  const last = cycle.values.length - 1;
  const along = outputAlong(linkage, [...cycle.values.keys()]);
  if (goesRound(linkage, along)) return null;
  // the rows of a cycle end just before what ends it
  const ends = cycle.full ? [] : [linkage.from(0, cycle.low), linkage.from(last, cycle.high)];
  const far = ends.map((rows, k) => {
    const more = output(linkage, rows, 1) - output(linkage, rows, 0);
    return along[k * last]! + (turning ? principal(more) : more);
  });
  const all = Float64Array.from([...along, ...far, ...dead.map((one) => one.output)].filter(Number.isFinite));
  return outputStandsStill(linkage, all) ? 0 : Math.max(...all) - Math.min(...all);
}

/** How far apart the places of the output's origin are; of a link that only travels, those of any of its points. */
export function shiftOf({ cycle, model, sizes }: Linkage): number {
  const at = Array.from(cycle.values, (_, row) => origin(cycle.rows, row, model.outputs[0]!.link));
  const apart = Math.max(...at.flatMap(([x, y]) => Math.max(...at.map(([u, v]) => Math.hypot(u - x, v - y)))));
  return apart > NOISE * sizes.unit ? apart : 0;
}

/** The drive value between two at which the output turns back, found from a row of the cycle. */
function turningBack(linkage: Linkage, from: number, to: number, row: number): DeadCentre | null {
  const speedAt = (drive: number) => {
    const rows = linkage.from(row, drive);
    return rows.reached < 2 ? NaN : output(linkage, rows, 1, 1);
  };
  const value = zero(speedAt, from, to, linkage.quick ? 1e-5 : undefined);
  if (value === null) return null;
  const rows = linkage.from(row, value);
  if (rows.reached < 2 || leastRoot(rows, 1) < CHANGE) return null;
  return { value, output: output(linkage, rows, 1) };
}

/** A zero of a function between two values at which it has different signs; null where it has no value. */
export function zero(f: (value: number) => number, from: number, to: number, fine = 1e-11): number | null {
  let [a, b] = [from, to];
  let [fa, fb] = [f(a), f(b)];
  for (let k = 0; k < 60 && Math.abs(b - a) > fine * (1 + Math.abs(a)); k++) {
    let middle = k % 3 === 2 ? (a + b) / 2 : a - (fa * (b - a)) / (fb - fa);
    if (!(middle > Math.min(a, b) && middle < Math.max(a, b))) middle = (a + b) / 2;
    const fm = f(middle);
    if (Number.isNaN(fm)) return null;
    if (fm === 0) return middle;
    if (fa * fm < 0) [b, fb] = [middle, fm];
    else [a, fa] = [middle, fm];
  }
  return (a + b) / 2;
}

/** The smallest transmission angle over the cycle and where it is first; at the ends of a range its limit counts. */
export function leastTransmission(linkage: Linkage): Least | null {
  const { cycle } = linkage;
  const all = legsOf(linkage).map((leg) =>
    Array.from(cycle.values, (_, row) => between(forceAndWay(linkage, cycle.rows, row, leg))),
  );
  const most = Math.min(...all.flat().filter(Number.isFinite));
  const found = legsOf(linkage).flatMap((leg, k) => lowsOf(linkage, leg, all[k]!, most));
  const least = Math.min(...found.map(({ mu }) => mu));
  const lowest = found.filter(({ mu }) => mu <= least + SAME_ANGLE);
  const first = Math.min(...lowest.map(({ value }) => wrapped(cycle, value)));
  const here = lowest.filter(({ value }) => wrapped(cycle, value) - first < 1e-6 * (cycle.high - cycle.low));
  const name = ({ leg }: Least) => leg?.links.map((link) => linkage.linkName(link)).join() ?? "";
  return here.sort((one, other) => (name(one) < name(other) ? -1 : 1))[0] ?? null; // of several the same as in words
}

/** The smallest angles of a leg, whose angles in the rows of the cycle are given; those that are larger than one that
 * is known already are left out. */
function lowsOf(linkage: Linkage, leg: Leg, angles: readonly number[], most: number): Least[] {
  const { values, full, low, high } = linkage.cycle;
  const known = angles.filter(Number.isFinite).sort(ascending);
  if (!known.length) return [];
  const median = known[known.length >> 1]!;
  const spread = known.map((one) => Math.abs(one - median)).sort(ascending);
  if (spread[Math.floor(0.9 * (spread.length - 1))]! <= THROUGHOUT)
    return [{ value: values[0]!, mu: median, leg: null }];
  const out: Least[] = [];
  angles.forEach((mu, row) => {
    const [one, other] = [Math.max(0, row - 1), Math.min(values.length - 1, row + 1)];
    const [before, after] = [angles[one]!, angles[other]!];
    // it can be less between the rows by what it differs from one to the other, at a corner
    if (before < mu || after < mu || !(mu - Math.max(before - mu || 0, after - mu || 0) <= most)) return;
    const angleAt = (value: number) => {
      const pose = linkage.from(row, value);
      return pose.reached < 2 ? Infinity : between(forceAndWay(linkage, pose, 1, leg));
    };
    const ends = smallest(angleAt, values[one]!, values[other]!, linkage.quick ? 14 : 40);
    for (const found of [{ value: values[row]!, mu }, ...ends]) out.push({ ...found, leg });
  });
  if (!full && values.length > 2)
    for (const upper of [false, true])
      out.push({ value: upper ? high : low, mu: transmissionAtEnd(linkage, upper, leg), leg });
  return out;
}

function ascending(a: number, b: number): number {
  return a - b;
}

/** The two places where a golden section search for the smallest value ends. */
function smallest(f: (value: number) => number, from: number, to: number, steps: number): [Low, Low] {
  let [low, high] = [from, to];
  let a = high - GOLDEN * (high - low);
  let b = low + GOLDEN * (high - low);
  let [fa, fb] = [f(a), f(b)];
  for (let k = 0; k < steps; k++) {
    if (fa <= fb) {
      [high, b, fb] = [b, a, fa];
      a = high - GOLDEN * (high - low);
      fa = f(a);
    } else {
      [low, a, fa] = [a, b, fb];
      b = low + GOLDEN * (high - low);
      fb = f(b);
    }
  }
  return [
    { value: a, mu: fa },
    { value: b, mu: fb },
  ];
}

/** The transmission angle at an end of the range, where poses are ill-conditioned: in t, with the drive at
 * middle - cos t times half the width, it is analytic and extrapolated from t up to 0.3 by a polynomial. */
function transmissionAtEnd(linkage: Linkage, upper: boolean, leg: Leg): number {
  const { values, low, high } = linkage.cycle;
  const half = (high - low) / 2;
  const nodes = 10;
  const row = upper ? values.length - 2 : 1;
  let [re, im] = [0, 0];
  for (let k = 0; k < nodes; k++) {
    const angle = ((2 * k + 1) * Math.PI) / (2 * nodes);
    const t = 0.15 * (1 - Math.cos(angle));
    const from = half * 2 * Math.sin(t / 2) ** 2;
    const rows = linkage.from(row, upper ? high - from : low + from);
    if (rows.reached < 2) return NaN;
    const weight = ((k % 2 ? -1 : 1) * Math.sin(angle)) / t;
    const [x, y] = forceAndWay(linkage, rows, 1, leg);
    re += weight * x;
    im += weight * y;
  }
  return between([re, im]);
}

// --- a link in the plane ---------------------------------------------------------------------------------------------

/** The pole of a link and the diameter of its inflection circle. */
export interface Pole {
  x: number;
  y: number;
  dx: number;
  dy: number;
}

/** The pole of a link in a row; null where it does not turn. */
export function pole({ size }: Linkage, rows: Rows, row: number, link: number): Pole | null {
  const w = rate(rows, row, link);
  const [vx, vy] = origin(rows, row, link, 1);
  if (Math.abs(w) * 1e4 * size <= Math.hypot(vx, vy) || !(Math.abs(w) > 1e-12)) return null;
  const [px, py] = [-vy / w, vx / w]; // from the link's origin
  const [ox, oy] = origin(rows, row, link);
  if (rows.order < 2) return { x: ox + px, y: oy + py, dx: 0, dy: 0 };
  const a = rate(rows, row, link, 2);
  const [bx, by] = origin(rows, row, link, 2);
  const ax = bx - w * w * px - a * py;
  const ay = by - w * w * py + a * px;
  return { x: ox + px, y: oy + py, dx: ax / (w * w), dy: ay / (w * w) };
}

/** The link whose poles are shown first: no neighbour of the frame, if there is one. */
export function floatingLink({ frame, joints, own }: Model): number {
  const near = new Set(joints.filter((j) => j.links.includes(frame)).flatMap((j) => j.links));
  for (let link = 0; link < own; link++) if (!near.has(link)) return link;
  return own - 1;
}
