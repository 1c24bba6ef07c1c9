/** What a design must do besides its targets, as fields. */

import { h, option } from "./dom";
import { t } from "./language";
import type { Pair } from "./rows";

/** So many times the extent of the targets a link is long at most where nothing is typed. */
const FAR = 10;
const LONGEST = "longest";

export class Demands {
  #crank = true;
  /** Places of the targets in the order, as they are typed. */
  order = "";
  /** As they are typed: degrees, how far fixed pivots may lie outside the places, how long a link may be. */
  readonly #typed: Record<string, string> = { least: "20" };
  /** The field of the longest link. */
  #length: HTMLInputElement | undefined;

  /** The corners of the region of fixed pivots, if one is typed; the field of the longest link shows what holds where
   * nothing is typed, as the library takes it. */
  region(points: readonly number[][], curve: number): Pair[] {
    const reach = +this.#typed.reach! || curve;
    const [low, high] = [Math.min, Math.max].map((far, k) =>
      [0, 1].map((axis) => far(...points.map((row) => row[axis]!)) + (k ? 1 : -1) * reach),
    ) as [Pair, Pair];
    const across = (this.#typed.reach || curve ? 1 : FAR) * Math.hypot(high[0] - low[0], high[1] - low[1]);
    this.#length?.setAttribute("placeholder", points[1] ? String(+across.toPrecision(3)) : t("any"));
    return this.#typed.reach && points.length ? [low, [high[0], low[1]], high, [low[0], high[1]]] : [];
  }

  /** The fields, in the language of the page; those of places if there are such; the angle is that on the way
   * from target to target, or that of all positions of a crank that turns fully in any case. A curve so large has its
   * own order, and pivots no farther off as long as nothing else is typed. */
  form(closed: HTMLElement | false, way: boolean, places: boolean, curve: number, changed: () => void): HTMLElement {
    /** A number between zero and a limit, with what it is and its unit. */
    const field = (key: string, text: string, unit: string, max: number, placeholder = "") => {
      const input: HTMLInputElement = h("input", {
        id: key,
        type: "number",
        min: 0,
        max,
        value: this.#typed[key],
        placeholder,
        "data-field": key,
        onchange: () => {
          this.#typed[key] = input.value &&= `${Math.min(max, Math.max(0, +input.value))}`;
          changed();
        },
      });
      return [h("label", { for: key }, text), input, unit] as const;
    };
    const longest = field(LONGEST, t("Maximum link length"), "mm", 1e9);
    this.#length = longest[1];
    const least = way ? t("Minimum transmission angle between targets") : t("Minimum transmission angle");
    const order = h("input", {
      value: this.order,
      "aria-label": t("Order of the targets"),
      placeholder: "1 2 3",
      "data-field": "order",
      onchange: () => {
        this.order = order.value;
        changed();
      },
    });
    const turns = (on: boolean) => {
      this.#crank = on;
      changed();
    };
    return h(
      "div",
      {},
      h("div.form", {}, closed, way && option(t("Crank turns fully"), this.#crank, turns, "crank")),
      h(
        "div.rows",
        {},
        ...field("least", least, "°", 90),
        ...(places
          ? [
              ...field(
                "reach",
                t("Margin around targets for fixed pivots"),
                "mm",
                1e9,
                curve ? String(curve) : t("any"),
              ),
              ...longest,
            ]
          : []),
      ),
      places &&
        (!curve || this.order) &&
        h(
          "details.words",
          { open: !!this.order },
          h("summary", {}, t("Order of the targets")),
          order,
          h("p.note", {}, t("When each target is passed: 1 first, then 2 …; equal numbers in any order, – anytime")),
        ),
    );
  }

  /** What the library is told of them; what is of places only of these. */
  asked(places: boolean, curve: number) {
    const { least, reach: typed, [LONGEST]: longest } = this.#typed;
    const reach = typed || curve; // "0" is a reach, 0 is none
    const ranks = places ? (this.order.match(/[^\s,;]+/g) ?? []) : [];
    return {
      reach: places && reach !== 0 ? +reach : null,
      longest_link: places && longest ? +longest : null,
      order: ranks.map((rank) => (/\d/.test(rank) ? +rank : null)),
      crank: this.#crank,
      transmission: +least!,
    };
  }
}
