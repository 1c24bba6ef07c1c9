/** Names that have no place beside their bodies: near them, each with a short line to its body. */

import { away, middleOf, sidesOf, toHull } from "./hull";
import { between, nearerBy } from "./names";
import type { Pair } from "./rows";

const NEAREST = 16; // pixels from the place on its body to a name
const STEP = 8;
const NUMBER = 5; // the same of a number, whose line is short
const STEPS = 7;
const WAYS = 16;
const BAR = 15; // pixels from the middle of a bar to the middle of a name that stands beside it
const RIM = 9; // pixels from an outline of its own
const SAMPLE = 14; // pixels between places of a name that are compared with bodies
const CROSSED = 45; // pixels of a longer line that are better than one across another body
const ASTRAY = 60; // and than a name nearer to another body, or right below or above another one
const PARTS = [0.15, 0.3, 0.5, 0.7, 0.85];
const CLEAR = 10; // pixels from another body to where a line ends
const SEEN = 4; // pixels of a longer line that are better than an end one pixel nearer to another body
const ENDS = 4; // places of a body from which lines are tried

/** A name and its line, in pixels: where the name stands, and from its body to it; none if it lies in its body. */
export interface Leader {
  at: Pair;
  line: [Pair, Pair] | null;
  /** The number of its place. */
  chosen: number;
}

/** A body and the rectangle about it: left, right, top, bottom. */
export type Boxed = readonly [body: readonly Pair[], left: number, right: number, top: number, bottom: number];

export function boxed(body: readonly Pair[]): Boxed {
  let [left, right, top, bottom] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of body) {
    left = Math.min(left, x);
    right = Math.max(right, x);
    top = Math.min(top, y);
    bottom = Math.max(bottom, y);
  }
  return [body, left, right, top, bottom];
}

/** Whether a name, half its width and its middle given, keeps so clear of bodies; asked some thousand times. */
export function clearBy(room: number, bodies: readonly Boxed[], half: number, [x, y]: Pair): boolean {
  const count = Math.ceil((2 * half) / SAMPLE);
  for (const [body, left, right, top, bottom] of bodies) {
    if (x + half < left - room || x - half > right + room || y < top - room || y > bottom + room) continue;
    for (let k = 0; k <= count; k++) if (toHull(body, x - half + (2 * half * k) / count, y) < room) return false;
  }
  return true;
}

/** Where the line from a place to a name ends, half the width of the name and its middle given. */
export function endAt([u, v]: Pair, [x, y]: Pair, half: number): Pair {
  const end = (at: number, middle: number, room: number) => Math.max(middle - room, Math.min(middle + room, at));
  return [end(u, x, half + 3), end(v, y, 8)];
}

/** Finds the nearest free place about a body from which a line to it crosses as little as possible; of the one before,
 * whether it is still free. */
export function leaderOf(
  own: Boxed,
  /** The outline of its body, if it has one. */
  home: readonly Pair[],
  others: readonly Boxed[],
  half: number,
  free: (at: Pair) => boolean,
  lines: readonly [Pair, Pair][],
  names: readonly { x: number; y: number; half: number }[],
): (before?: number) => Leader | null {
  const places = home[0] ? placesIn(home) : placesOn(own[0]);
  const rim = sidesOf(home).map(boxed);
  const bodies = [own, ...others];
  const hulls = others.map(([body]) => body);
  const gaps: number[] = [];
  const gapOf = (spot: number) => {
    gaps[spot] ??= Math.min(CLEAR, ...others.map(([one]) => toHull(one, ...places[spot]!)));
    return gaps[spot];
  };
  let best: Leader | null;
  let least: number;
  const tried = (chosen: number) => {
    const spot = Math.floor(chosen / WAYS / STEPS);
    const from = places[spot];
    if (!from) return;
    const phi = ((chosen % WAYS) * 2 * Math.PI) / WAYS;
    const far = NEAREST + (half < STEP ? NUMBER : STEP) * (Math.floor(chosen / WAYS) % STEPS);
    const [c, s] = [Math.cos(phi), Math.sin(phi)];
    const [x, y] = [from[0] + (far + half) * c, from[1] - far * s];
    const to = endAt(from, [x, y], half);
    const inside = home[0] && !toHull(home, x, y);
    let cost = (inside ? 0 : away(from, ...to)) - SEEN * gapOf(spot);
    if (cost >= least || !free([x, y + 4]) || !clearBy(BAR, bodies, half, [x, y]) || !clearBy(RIM, rim, half, [x, y]))
      return;
    if (inside) {
      [best, least] = [{ at: [x, y + 4], line: null, chosen }, cost];
      return;
    }
    const way: [Pair, Pair] = [from, to];
    if (names.some((one) => hides(one.half, [one.x, one.y - 4], way))) return;
    if (lines.some((line) => meet(line, way) || hides(half, [x, y], line))) return;
    const stacked = names.some((one) => Math.abs(one.x - x) < half + one.half && Math.abs(one.y - 4 - y) < 2 * BAR);
    if (stacked || nearerBy([x, y + 4], half, own[0], hulls) < 1) cost += ASTRAY;
    cost +=
      CROSSED *
      others.filter(([body]) => PARTS.slice(1).some((part) => toHull(body, ...between(from, to, part)) < 5)).length;
    if (cost < least) [best, least] = [{ at: [x, y + 4], line: way, chosen }, cost];
  };
  return (before) => {
    [best, least] = [null, Infinity];
    if (before !== undefined) {
      tried(before);
      return best;
    }
    // from where the body is seen best
    const order = [...places.keys()].sort((one, other) => gapOf(other) - gapOf(one)).slice(0, ENDS);
    for (let k = 0; k < WAYS * STEPS; k++) for (const spot of order) tried(spot * WAYS * STEPS + k);
    return best;
  };
}

/** Places in an outline: its middle, and some near its rim, in the same directions however it is turned. */
function placesIn(home: readonly Pair[]): Pair[] {
  const [x, y] = middleOf(home);
  const towards = Array.from({ length: 12 }, (_, k): Pair => {
    const [c, s] = [Math.cos((k * Math.PI) / 6), Math.sin((k * Math.PI) / 6)];
    let far = 0;
    for (const [[px, py], [qx, qy]] of sidesOf(home)) {
      const [p, q] = [c * (py - y) - s * (px - x), c * (qy - y) - s * (qx - x)];
      if (p * q > 0 || p === q) continue;
      const part = p / (p - q);
      far = Math.max(far, c * (px + part * (qx - px) - x) + s * (py + part * (qy - py) - y));
    }
    return [x + 0.7 * far * c, y + 0.7 * far * s];
  });
  return [[x, y], ...towards];
}

/** Places of a body at which a line may end: its middle and places of its sides. */
function placesOn(own: readonly Pair[]): Pair[] {
  return [middleOf(own), ...sidesOf(own).flatMap((side) => PARTS.map((part) => between(...side, part)))];
}

/** Whether a name, half its width and its middle given, lies upon a line. */
function hides(half: number, [x, y]: Pair, line: [Pair, Pair]): boolean {
  return PARTS.some((part) => {
    const [u, v] = between(...line, part);
    return Math.abs(u - x) < half + 2 && Math.abs(v - y) < 9;
  });
}

/** Whether two lines meet. */
function meet([a, b]: [Pair, Pair], [c, d]: [Pair, Pair]): boolean {
  const side = (p: Pair, q: Pair, r: Pair) => (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}
