/** Four-bars of solutions: dyads in the position of one point, with Roberts' cognates; and as the page takes them. */

import type { LinkageDocument, Model } from "../model";
import { abs, add, angle, type Complex, conj, div, mul, scaled, sub } from "./complex";
import { numberAt } from "./homotopy";

/** A link that turns about a fixed pivot and carries the coupler. */
export interface Dyad {
  moving: Complex;
  fixed: Complex;
}

/** The dyad that is driven, then the other; the coupler point stands where its first one is. */
export type FourBar = readonly [Dyad, Dyad];

/** Lengths of crank, coupler, rocker and frame. */
export function lengthsOf([one, two]: FourBar): [number, number, number, number] {
  const length = (dyad: Dyad) => abs(sub(dyad.moving, dyad.fixed));
  return [length(one), abs(sub(one.moving, two.moving)), length(two), abs(sub(one.fixed, two.fixed))];
}

const ONE: Complex = [1, 0];
const COINCIDE = 1e-12;

/** The three cognates of a real solution, whose coupler point is at the origin. */
export function cognatesOf(z: Float64Array, row: number): FourBar[] {
  const [x, y, a, b] = [0, 2, 4, 6].map((at) =>
    scaled(0.5, add(numberAt(z, row, at), conj(numberAt(z, row, at + 1)))),
  ) as [Complex, Complex, Complex, Complex];
  const first: FourBar = [
    { moving: x, fixed: a },
    { moving: y, fixed: b },
  ];
  if (abs(sub(y, x)) < COINCIDE) return [first];
  // The coupler triangle: the point, at the origin, lies at the part k of the way from x to y.
  const k = div(scaled(-1, x), sub(y, x));
  const c = add(a, mul(k, sub(b, a)));
  return [
    first,
    [
      { moving: sub(a, x), fixed: a },
      { moving: mul(sub(a, x), sub(ONE, k)), fixed: c },
    ],
    [
      { moving: sub(b, y), fixed: b },
      { moving: mul(k, sub(b, y)), fixed: c },
    ],
  ];
}

/** In the place and the size of the task. */
export function moved(bar: FourBar, size: number, origin: Complex): FourBar {
  const put = (place: Complex) => add(scaled(size, place), origin);
  const [one, two] = bar.map(({ moving, fixed }) => ({ moving: put(moving), fixed: put(fixed) }));
  return [one!, two!];
}

/** The place in `lengthsOf` of the link that turns fully against all others; -1 if none does. */
function turningLink(bar: FourBar): number {
  const lengths = lengthsOf(bar);
  const sorted = [...lengths].sort((length, next) => length - next);
  return sorted[0]! + sorted[3]! < sorted[1]! + sorted[2]! ? lengths.indexOf(sorted[0]!) : -1;
}

/** Driven at each side, the one first that turns fully; of two that do not, each is tried. */
export function driven(bar: FourBar): FourBar[] {
  const turning = turningLink(bar);
  const other: FourBar = [bar[1], bar[0]];
  if (turning === 0) return [bar];
  if (turning === 2) return [other];
  return [bar, other];
}

/** By which turns the coupler comes from its first position to those in which the point is displaced so. */
export function couplerTurns([one, two]: FourBar, point: Complex, displaced: readonly Complex[]): Complex[] {
  return displaced.map((t) => {
    const s = conj(t);
    // A g + B h + C = 0 for both dyads, g + h + g h = 0: core/src/algebra/four_bar.hpp
    const [k, l] = [one, two].map(({ moving, fixed }) => {
      const [x, a] = [sub(moving, point), sub(fixed, point)];
      const [xc, ac] = [conj(x), conj(a)];
      const c = sub(add(mul(t, sub(ac, xc)), mul(s, sub(a, x))), mul(t, s));
      return [mul(x, sub(ac, s)), mul(xc, sub(a, t)), c] as const;
    }) as [readonly [Complex, Complex, Complex], readonly [Complex, Complex, Complex]];
    const bc = sub(mul(k[1], l[2]), mul(l[1], k[2]));
    const ab = sub(mul(k[0], l[1]), mul(l[0], k[1]));
    const turn = add(ONE, div(bc, ab));
    return scaled(1 / abs(turn), turn);
  });
}

/** A pose of a four-bar: where its moving pins are. */
export interface Placed {
  crank: number;
  coupler: number;
  pins: readonly [Complex, Complex];
}

export function placed([one, two]: FourBar, from: Complex, to: Complex, turn: Complex): Placed {
  const pin = ({ moving }: Dyad) => add(to, mul(sub(moving, from), turn));
  const pins = [pin(one), pin(two)] as const;
  return { crank: angle(sub(pins[0], one.fixed)), coupler: angle(sub(pins[1], pins[0])), pins };
}

const DEGREE = Math.PI / 180;

/** The model of some four-bar whose coupler point is named P, and the names of links of a double crank. */
export interface Template extends Model {
  doubleCrank: Model["linkNames"];
}

/** A four-bar as the page takes it: that of the template with other sizes.
 *
 * The x axis of each moving link runs from its pin on the frame, else its first, to the other, as in the library. */
export function modelOf({ doubleCrank, ...template }: Template, bar: FourBar, point: Complex, pose: Placed): Model {
  const [crank, coupler, rocker] = lengthsOf(bar);
  const [a, b] = [bar[0].fixed, bar[1].fixed];
  const along = sub(bar[1].moving, bar[0].moving);
  const onCoupler = mul(sub(point, bar[0].moving), scaled(1 / coupler, conj(along)));
  const pair = ([x, y]: Complex): [number, number] => [x, y];
  // the pins of each link, by the numbers of their joints
  const pins: Record<string, Record<number, [number, number]>> = {
    frame: { 0: pair(a), 3: pair(b) },
    crank: { 0: [0, 0], 1: [crank, 0] },
    coupler: { 1: [0, 0], 2: [coupler, 0] },
    rocker: { 2: [rocker, 0], 3: [0, 0] },
  };
  const elements = template.elements.map((e) => ({ ...e, at: pins[template.links[e.link]!]![e.joint]! }));
  const points = template.sources.flatMap((source) => elements[source]!.at);
  const [from, to] = pose.pins;
  const side = cross(sub(b, from), sub(to, from)) < 0 ? -1 : 1;
  const outputs = template.outputs.map((output) => ({
    ...output,
    legs: output.legs.map((leg) => {
      const put = (place: typeof leg.from) => {
        const [link, , , lx, ly, e] = place;
        return [link, points[2 * e]!, points[2 * e + 1]!, lx, ly, e] as typeof place;
      };
      return {
        ...leg,
        from: put(leg.from),
        pin: put(leg.pin),
        guide: leg.guide && { ...leg.guide, at: put(leg.guide.at) },
      };
    }),
  }));
  const names = template.joints.map(({ name }) => name);
  const placesOf = (link: number) =>
    Object.fromEntries(elements.filter((e) => e.link === link).map((e) => [names[e.joint], e.at]));
  const document: LinkageDocument = {
    ...template.document,
    points: { P: { link: "coupler", at: pair(onCoupler) } },
    elements: Object.fromEntries(template.links.map((name, link) => [name, placesOf(link)])),
    reference_pose: {
      frame: [0, 0, 0],
      crank: [...a, pose.crank / DEGREE],
      coupler: [...from, pose.coupler / DEGREE],
      rocker: [...b, angle(sub(to, b)) / DEGREE],
    },
  };
  return {
    ...template,
    linkNames: turningLink(bar) === 3 ? doubleCrank : template.linkNames,
    document,
    elements,
    points: template.points.map((one) => ({ ...one, at: pair(onCoupler) })),
    program: { ...template.program, points, size: Math.max(...lengthsOf(bar)) },
    start: { drives: [pose.crank], signs: [side], unknowns: [] },
    outputs,
  };
}

const cross = ([a, b]: Complex, [c, d]: Complex) => a * d - b * c;
