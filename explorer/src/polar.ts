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

  show(vectors: Vectors, unit: string): void {
    this.#vectors = vectors;
    const { x, y, most } = vectors;
    const scale = RADIUS / most;
    const rings = roundValues(0, most, 2).filter((value) => value > 0);
    const mean = [x, y].map((part) => part.reduce((sum, one) => sum + (one || 0), 0) / part.length) as Pair;
    // the numbers stand where the curve is not
    const off = Math.hypot(...mean);
    const away: Pair = off > 0.05 * most ? (mean.map((part) => part / off) as Pair) : [0, 1];
    const to = (factor: number) => (value: number) => factor * value;
    this.element.setAttribute("aria-label", t("Largest {value}", { value: `${number(most)} ${unit}` }));
    this.element.replaceChildren(
      svg("path.mesh", { d: "M-140 0H140M0 -96V96" }),
      ...rings.map((value) => svg("circle.mesh", { fill: "none", r: scale * value })),
      svg("path.curve.force", { d: lineThrough(x.map(to(scale)), y.map(to(-scale))) }),
      ...rings.map((value) => {
        const far = scale * value + 12;
        return svg(
          "text",
          { x: -far * away[0], y: 4 + far * away[1], "text-anchor": "middle" },
          `${number(value)} ${unit}`,
        );
      }),
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
  return [valueAt(drives, x, drive) / most, valueAt(drives, y, drive) / most];
}
