/** Where the names of bodies stand in the picture: at their middles, below each other where they would overlap. */

import { halfOf } from "../names";
import type { Pair } from "../rows";
import type { Vector } from "./algebra";

const LINE = 17; // pixels from name to name
const TRIED = [0, 1, -1, 2, -2, 3, -3]; // lines

/** A name that is centred at a place of the picture. */
export interface Name {
  text: string;
  at: Pair;
}

/** The names within a picture of a size, moved up or down until they overlap neither each other nor others. */
export function apart(names: Name[], others: Name[], [width, height]: Pair): Name[] {
  const taken = [...others];
  return names.map(({ text, at: [px, py] }) => {
    const half = halfOf(text);
    const x = Math.min(Math.max(px, half + 4), width - half - 4);
    const isFree = (y: number) =>
      taken.every(
        ({ at: [u, v], text: other }) => Math.abs(y - v) >= LINE || Math.abs(x - u) > half + halfOf(other) + 4,
      );
    const tried = TRIED.map((lines) => Math.min(Math.max(py + lines * LINE, LINE), height - 4));
    const placed: Name = { text, at: [x, tried.find(isFree) ?? py] };
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
