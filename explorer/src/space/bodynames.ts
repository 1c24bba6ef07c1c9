/** Where the names of bodies stand in the picture: at their middles, below each other where they would overlap. */

import { halfOf } from "../names";
import type { Pair } from "../rows";
import { minus, type Vector } from "./algebra";

const LINE = 17; // pixels from name to name
const TRIED = [0, 1, -1, 2, -2, 3, -3]; // lines

/** A name that is centred at a place of the picture. */
export interface Name {
  text: string;
  at: Pair;
}

/** The names within a picture of a size, moved up or down until they overlap neither each other nor others; one that
 * has no room is left out. */
export function apart<Each extends Name>(names: Each[], others: Name[], [width, height]: Pair): Each[] {
  const taken = [...others];
  return names.flatMap((name) => {
    const {
      text,
      at: [px, py],
    } = name;
    const half = halfOf(text);
    const x = Math.min(Math.max(px, half + 4), width - half - 4);
    const isFree = (y: number) =>
      taken.every(
        ({ at: [u, v], text: other }) => Math.abs(y - v) >= LINE || Math.abs(x - u) > half + halfOf(other) + 4,
      );
    const tried = TRIED.map((lines) => Math.min(Math.max(py + lines * LINE, LINE), height - 4));
    const free = tried.find(isFree);
    if (free === undefined) return [];
    const placed: Each = { ...name, at: [x, free] };
    taken.push(placed);
    return placed;
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
export function nameOf(corners: Vector[], middle: Vector, away: number): Vector {
  let [best, least] = [middle, Infinity];
  for (const [k, corner] of corners.entries()) {
    const other = corners[k % 3 < 2 ? k + 1 : k - 2]!;
    const at = corner.map((part, n) => (part + other[n]!) / 2) as Vector;
    const far = Math.hypot(...minus(at, middle));
    if (far < least) [best, least] = [at, far];
  }
  return least < away ? middle : best;
}
