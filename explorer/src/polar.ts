/** The plot of a vector over a range of the drive: its end, drawn from the middle. */

import { put, svg } from "./dom";
import { gridStep } from "./grid";
import { number, t } from "./language";
import { lineThrough, valueAt } from "./plot";
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
  #scale = 1;
  readonly #to = (value: number): number => this.#scale * value;

  /** In a unit, and how much that is. */
  show(vectors: Vectors, [unit, factor]: [string, number]): void {
    this.#vectors = vectors;
    const { x, y } = vectors;
    const most = vectors.most / factor || 1;
    const step = gridStep(most / 5);
    const count = Math.ceil(most / step - 1e-9); // rings: three to five
    const apart = RADIUS / count;
    this.#scale = apart / step / factor;
    const rings = [1, 2, 3, 4, 5].slice(0, count);
    // the numbers stand where the curve is not
    const below = y.reduce((sum, one) => sum + (one || 0), 0) < 0 ? -1 : 1;
    put(this.element, { "aria-label": t("Largest {value}", { value: `${number(most)} ${unit}` }) });
    this.element.replaceChildren(
      svg("path.mesh", { d: "M-140 0H140M0 -96V96" }),
      svg("text", { "data-axis": "", x: 122, y: -5 }, "Fx"),
      svg("text", { "data-axis": "", x: below < 0 ? 28 : 5, y: -88 }, "Fy"),
      ...rings.map((k) => svg("circle.mesh", { fill: "none", r: apart * k })),
      svg("path.curve.force", {
        d: lineThrough(
          x.map(this.#to),
          y.map((one) => this.#to(-one)),
        ),
      }),
      ...rings.map((k) =>
        svg(
          "text",
          { y: 4 + below * apart * k, "text-anchor": "middle" },
          number(k * step) + (k < count ? "" : ` ${unit}`),
        ),
      ),
      this.#here,
    );
  }

  at(drive: number): void {
    if (!this.#vectors) return;
    const [x, y] = vectorAt(this.#vectors, drive);
    const [u, v] = [this.#to(x), this.#to(-y)];
    put(this.#here, { d: Number.isFinite(u + v) ? `M0 0L${u} ${v}m-2 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0` : "" });
  }
}

/** A vector at a value of the drive. */
export function vectorAt({ drives, x, y }: Vectors, drive: number): Pair {
  return [valueAt(drives, x, drive), valueAt(drives, y, drive)];
}
