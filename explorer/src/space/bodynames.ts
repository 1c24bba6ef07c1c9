/** Where the names of bodies stand in the picture: at places of theirs where they overlap no other name. */

import { halfOf } from "../names";
import type { Pair } from "../rows";
import { minus, type Vector } from "./algebra";

const EDGE = 8; // pixels
const LINE = 20; // pixels from name to name

/** A name that is centred at a place of the picture. */
export interface Name {
  text: string;
  at: Pair;
}

/** Whether a name there, within a picture of a size, keeps clear of others. */
function isFree({ at: [x, y], text }: Name, others: Name[], [width, height]: Pair): boolean {
  const half = halfOf(text);
  return (
    Math.abs(x - width / 2) < width / 2 - half - EDGE &&
    Math.abs(y - height / 2) < height / 2 - 4 &&
    others.every(({ at: [u, v], text: other }) => Math.abs(y - v) >= LINE || Math.abs(x - u) > half + halfOf(other) + 6)
  );
}

/** Beside an edge of the picture, next to its place rather than about it. */
function within<Each extends Name>(name: Each, wide: number): Each {
  const [half, [x, y]] = [halfOf(name.text), name.at];
  const inside = Math.min(Math.max(x, half + EDGE + 1), wide - half - EDGE - 1);
  return { ...name, at: [Math.abs(inside - x) < half ? inside : x, y] };
}

/** The names at the first of their places that is free; one that has none is left out. */
export function apart<Each extends Name>(names: Each[][], others: Name[], size: Pair): Each[] {
  const taken = [...others];
  return names.flatMap((places) => {
    const free = places.map((name) => within(name, size[0])).find((name) => isFree(name, taken, size));
    if (free) taken.push(free);
    return free ?? [];
  });
}

/** The middle of the smallest box around places. */
export function middleOf(places: Vector[]): Vector {
  return [0, 1, 2].map((k) => {
    const all = places.map((place) => place[k]!);
    return (Math.min(...all) + Math.max(...all)) / 2;
  }) as Vector;
}

/** Where a body of triangles has its name: in its middle, or where it comes next to that if it keeps away from it. */
export function nameOf(corners: Float64Array, middle: Vector, away: number): Vector {
  let [best, least] = [middle, Infinity];
  for (let k = 0; k < corners.length; k += 3) {
    const other = k % 9 < 6 ? k + 3 : k - 6;
    const at = [0, 1, 2].map((n) => (corners[k + n]! + corners[other + n]!) / 2) as Vector;
    const far = Math.hypot(...minus(at, middle));
    if (far < least) [best, least] = [at, far];
  }
  return least < away ? middle : best;
}
