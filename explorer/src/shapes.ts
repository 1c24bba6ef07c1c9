/** Outlines that links have beside their bars: wheels, cams, belts. */

import { away } from "./hull";
import type { ShapeRecord } from "./model";
import type { Sizes } from "./sizes";

/** The lines of a shape on its link, as x and y in turn; those of a belt between the centres where they are now. */
export function linesOf(sizes: Sizes, shape: ShapeRecord): number[][] {
  const { lines = [], between } = shape;
  if (!between) return lines;
  const [ax, ay, bx, by] = between;
  const [cx, cy] = sizes.xy(pinThatWasAt(sizes, shape.link, ax, ay));
  const [dx, dy] = sizes.xy(pinThatWasAt(sizes, shape.link, bx, by));
  const wide = (bx - ax) ** 2 + (by - ay) ** 2;
  const c = ((bx - ax) * (dx - cx) + (by - ay) * (dy - cy)) / wide;
  const s = ((bx - ax) * (dy - cy) - (by - ay) * (dx - cx)) / wide;
  return lines.map((line) =>
    line.map((_, k) => {
      const u = line[k - (k % 2)]! - ax;
      const v = line[k - (k % 2) + 1]! - ay;
      return k % 2 ? cy + s * u + c * v : cx + c * u - s * v;
    }),
  );
}

/** The pin of a link that was nearest to a place in the linkage as it was given. */
function pinThatWasAt({ model }: Sizes, link: number, x: number, y: number): number {
  let [best, least] = [-1, Infinity];
  model.elements.forEach((e, k) => {
    if (e.link !== link || e.kind !== "pin") return;
    const off = away(e.at, x, y);
    if (off < least) [best, least] = [k, off];
  });
  return best;
}
