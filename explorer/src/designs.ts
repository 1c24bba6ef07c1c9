/** The designs that the library found, as cards in an order; each plays when it is pointed at. */

import { choice, h, renew, thumbnail } from "./dom";
import type { Moving } from "./ghost";
import { angle, number, t } from "./language";
import type { LinkageDocument } from "./model";

/** A linkage that does what is asked. */
export interface Design extends Moving {
  document: LinkageDocument;
  picture: string;
  form: string;
  transmission: number | null;
  error: number | null;
  size: number;
}

export interface Found {
  total: number;
  refused: number;
  items: Design[];
  /** How complete they are, where the page found them itself. */
  note?: string;
}

/** Whether what is asked for is met, to rounding. */
function exact(error: number | null): boolean {
  return Math.abs(error ?? 0) < 1e-9;
}

type Order = "error" | "size" | "transmission";

export class DesignCards {
  readonly element = h("div", {});
  #found: Found | null = null;
  #order: Order = "error";

  constructor(
    private readonly play: (design: Design) => void,
    private readonly open: (design: Design) => void,
  ) {}

  /** Show others, or none; returns the first. */
  show(found: Found | null): Design | null {
    this.#found = found;
    // exact ones do not differ in their deviation
    this.#order = found?.items.some(({ error }) => !exact(error)) ? "error" : "size";
    if (found) found.items = this.#sorted(); // by which they are numbered
    this.arrange();
    return found?.items[0] ?? null;
  }

  #sorted(): Design[] {
    const worth = ({ error, size, transmission }: Design) =>
      ({ error: exact(error) ? 0 : Math.abs(error!), size, transmission: -(transmission ?? 0) })[this.#order];
    return [...(this.#found?.items ?? [])].sort((one, two) => worth(one) - worth(two) || 0);
  }

  /** Write them, in the language of the page. */
  arrange(): void {
    const found = this.#found;
    if (!found) return renew(this.element);
    const orders: [Order, string][] = [
      ["error", t("by deviation")],
      ["size", t("by size")],
      ["transmission", t("by transmission angle")],
    ];
    renew(
      this.element,
      h("h2", {}, t("{count} designs", { count: found.total })),
      h("p.note", {}, found.note ?? ""),
      h("p.note", {}, found.refused ? t("{count} others do not meet what is asked.", { count: found.refused }) : ""),
      found.items.length > 1
        ? choice(t("Order"), orders, this.#order, (order) => {
            this.#order = order as Order;
            this.arrange();
          })
        : "",
      found.items.some((design) => lengthsOf(design).length)
        ? h("p.note", {}, t("Lengths in mm: crank · coupler · rocker · frame"))
        : "",
      h("div.cards.sorted", { "data-list": "designs" }, ...this.#sorted().map((design) => this.#card(design))),
    );
  }

  #card(design: Design): HTMLElement {
    const { form, transmission, error, size } = design;
    const value = error === null || exact(error) ? 0 : 100 * error;
    const deviation = value ? t("deviation {value} %", { value: number(value, 2) }) : t("met exactly");
    const title = `${form[0]!.toUpperCase()}${form.slice(1)} ${this.#found!.items.indexOf(design) + 1}`;
    const lengths = lengthsOf(design).map((one) => number(one, 3));
    const play = () => this.play(design);
    return h(
      "button.card",
      { onclick: () => this.open(design), onpointerenter: play, onfocus: play },
      thumbnail(design.picture, form),
      h("b", {}, title),
      h("span", {}, lengths.join(" · ")),
      h("span", {}, error === null ? "" : deviation),
      h(
        "span",
        {},
        transmission === null ? "" : t("on the way: μ ≥ {angle}", { angle: angle((transmission * Math.PI) / 180, 3) }),
      ),
      h("span", {}, t("size {value} mm", { value: number(size, 3) })),
    );
  }
}

/** The lengths of a four-bar, that of its frame last; none of what has other joints. */
function lengthsOf({ frames, joints, members }: Design): number[] {
  const pairs = members.map((own) => own.filter((k) => k < joints));
  pairs.push([...Array(joints).keys()].filter((k) => pairs.flat().indexOf(k) === pairs.flat().lastIndexOf(k)));
  const found = [0, frames.length >> 2].map((row) =>
    pairs.map(([one, two]) => {
      const [[x, y], [u, v]] = [frames[row]![one!] ?? [0, 0], frames[row]![two!] ?? [0, 0]];
      return Math.hypot(u! - x!, v! - y!);
    }),
  );
  const [first, later] = found as [number[], number[]];
  const stay = first.every((one, k) => one && Math.abs(one - later[k]!) < 1e-3 * Math.max(...first));
  return joints === 4 && pairs.every((one) => one.length === 2) && stay ? first : [];
}
