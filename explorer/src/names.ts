/** Where the name of a link stands: in its body if that has room, else beside it. */

import { DEGREE } from "./cycle";
import { convexHull, away as distance, middleOf, sidesOf, toHull } from "./hull";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

const HALF_LETTER = 3.7; // pixels
const BODY = 9; // pixels from the line between two joints to a name: half the width of a bar, and some room
const ALONE = 24; // pixels from the only joint of a body, such as a block, to its name
const INK = 6; // half the height of a name, in pixels
const OUTSIDE = 8; // pixels from a rim to a name
const RIM_PLACES: readonly Pair[] = [135, 45, -135, -45].map((a) => [Math.cos(a * DEGREE), Math.sin(a * DEGREE)]);
const GOOD = 300; // of a place at which nothing is wrong
const ROOM = 15; // pixels between a name in a body and the lines between its joints

export interface NamePlace {
  /** In the coordinates of the link: of a name in its body all that have room, its middle first. */
  at: Pair[];
  /** Away from its body, of length 1; none for a name within it. */
  away: Pair | null;
  /** From there to the end of the side beside which it stands; a bar has its name on either side. */
  along?: Pair;
  bar?: boolean;
}

/** Half the width of a name, in pixels. */
export function halfOf(name: string): number {
  return HALF_LETTER * name.length;
}

/** The place of a name on a link with these joints and free points; it holds in every pose of the link.
 * Where the body has no room, the name stands beside the longest side of it between joints. */
export function namePlace(joints: readonly Pair[], points: readonly Pair[], name: string, scale: number): NamePlace {
  const hull = convexHull([...joints, ...points]);
  const mean = middleOf(hull);
  if (hull.length < 2) return { at: [mean], away: [0, 1] };
  const sides = sidesOf(hull);
  const room = (halfOf(name) + ROOM) / scale;
  const at = [0, 0.3, 0.6]
    .flatMap((part) => hull.map((one) => between(mean, one, part)))
    .filter((spot) => sides.every((one) => toHull(one, ...spot) > room));
  if (at[0]) return { at, away: null };
  const isJoint = (p: Pair) => joints.some((one) => one[0] === p[0] && one[1] === p[1]);
  const held = sides.filter((one) => one.every(isJoint));
  const long = ([p, q]: [Pair, Pair]) => distance(q, ...p);
  const side = (held.length ? held : sides).reduce((a, b) => (long(b) > 1.001 * long(a) ? b : a));
  const [[x, y], [u, v]] = side;
  return {
    at: [between(...side, 0.5)],
    away: [(v - y) / long(side), (x - u) / long(side)],
    along: [(u - x) / 2, (v - y) / 2],
    bar: hull.length === 2,
  };
}

/** A place on the way from one to another, or beyond. */
export function between([x, y]: Pair, [u, v]: Pair, part: number): Pair {
  return [x + part * (u - x), y + part * (v - y)];
}

/** The pixels where a name may stand, the first of them in the middle of its side. */
export function nameSpots(viewport: Viewport, { at, away, along = [0, 0], bar }: NamePlace, name: string): Pair[] {
  const spots = at.map((one) => viewport.screen(...one));
  const [x, y] = spots[0]!;
  if (!away) return spots.map(([left, top]) => [left, top + 4]);
  if (bar === undefined) {
    const side = ALONE + halfOf(name);
    return [
      [0, -ALONE],
      [0, ALONE],
      [side, 0],
      [-side, 0],
      // in a corner between its rail and a force
      [side, -ALONE],
      [-side, -ALONE],
      [side, ALONE],
      [-side, ALONE],
    ].map(([right, down]): Pair => [x + right!, y + 4 + down!]);
  }
  const [u, v] = away;
  const far = BODY + halfOf(name) * Math.abs(u) + INK * Math.abs(v);
  const [dx, dy] = along.map((value) => value * viewport.scale) as Pair;
  return [0, 0.4, -0.4, 0.7, -0.7].flatMap((part) =>
    (bar ? [far, -far] : [far]).map((off): Pair => [x + part * dx + off * u, y - part * dy - off * v + 4]),
  );
}

/** Where the name of a ring stands, outside its rim. */
export function rimSpots([x, y]: Pair, radius: number, name: string): Pair[] {
  const gap = radius + OUTSIDE;
  return RIM_PLACES.map(([c, s]): Pair => [x + c * gap + Math.sign(c) * halfOf(name), y - s * gap + 4]);
}

/** How much nearer a name is to its own body than to any other, in pixels. */
export function nearerBy(
  [x, y]: Pair,
  half: number,
  own: readonly Pair[],
  others: readonly (readonly Pair[])[],
): number {
  let least = Infinity;
  for (const d of [-half, 0, half]) {
    let gap = 1e3;
    for (const hull of others) gap = Math.min(gap, toHull(hull, x + d, y - 4));
    least = Math.min(least, gap - toHull(own, x + d, y - 4));
  }
  return least;
}

/** Which of its spots a name takes, so that it is nearer to its own body than to any other and touches no other name:
 * the one before if it still does, else the first that does, also clear of grounds if it can, else the one that is
 * least wrong. */
export function clearSpot(
  spots: readonly Pair[],
  name: string,
  [own, others]: [readonly Pair[], readonly (readonly Pair[])[]],
  free: (spot: Pair) => boolean,
  before = 0,
  clear = (_: Pair) => true,
): number {
  const score = (spot: Pair) => {
    let least = nearerBy(spot, halfOf(name), own, others);
    if (!free(spot)) least -= 1e4;
    const lost = clear(spot) ? 0 : 99;
    if (least > INK && !lost) return GOOD;
    return (least > 1 ? 200 : least) - lost;
  };
  if (spots[before] && score(spots[before]) === GOOD) return before;
  const scores = spots.map(score);
  const most = Math.max(...scores);
  return most < GOOD && scores[before]! > most - INK ? before : scores.indexOf(most);
}
