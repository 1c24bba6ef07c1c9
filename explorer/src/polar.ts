/** The plot of a vector over a range of the drive: its end, drawn from the middle. */

import { svg } from "./dom";
import { number, t } from "./language";
import { lineThrough, roundValues, valueAt } from "./plot";
import type { Pair } from "./rows";

/** A vector at values of the drive; NaN where it is not known. */
export interface Vectors {
  drives: Float64Array;
  x: Float64Array;
  y: Float64Array;
  /** The length of the longest. */
  most: number;
}

const RADIUS = 88;

export class Polar {
  readonly element = svg("svg.plot.polar", { viewBox: "-150 -100 300 200", role: "img" });
  readonly #here = svg("path.cursor", {});
  #vectors: Vectors | null = null;

  /** In a unit, and how much that is. */
  show(vectors: Vectors, [unit, factor]: [string, number]): void {
    this.#vectors = vectors;
    const { x, y } = vectors;
    const most = vectors.most / factor || 1;
    const scale = RADIUS / most;
    const rings = roundValues(0, most, 6).slice(1); // three to seven
    // the numbers stand where the curve is not
    const below = y.reduce((sum, one) => sum + (one || 0), 0) < 0 ? -1 : 1;
    const to = (radius: number) => (value: number) => (radius / (vectors.most || 1)) * value;
    this.element.setAttribute("aria-label", t("Largest {value}", { value: `${number(most)} ${unit}` }));
    this.element.replaceChildren(
      svg("path.mesh", { d: "M-140 0H140M0 -96V96" }),
      ...rings.map((value) => svg("circle.mesh", { fill: "none", r: scale * value })),
      svg("path.curve.force", { d: lineThrough(x.map(to(RADIUS)), y.map(to(-RADIUS))) }),
      ...rings.map((value, k) =>
        svg(
          "text",
          { y: 4 + below * scale * value, "text-anchor": "middle" },
          number(value) + (rings[k + 1] ? "" : ` ${unit}`),
        ),
      ),
      this.#here,
    );
  }

  at(drive: number): void {
    if (!this.#vectors) return;
    const [x, y] = vectorAt(this.#vectors, drive);
    this.#here.setAttribute("d", Number.isFinite(x + y) ? `M0 0L${RADIUS * x} ${-RADIUS * y}` : "");
  }
}

/** A vector at a value of the drive, against the longest. */
export function vectorAt({ drives, x, y, most }: Vectors, drive: number): Pair {
  return [valueAt(drives, x, drive) / (most || 1), valueAt(drives, y, drive) / (most || 1)];
}
