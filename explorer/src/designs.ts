/** The designs that the library found, as cards in an order; each plays when it is pointed at. */

import { h, menu, renew, thumbnail } from "./dom";
import type { Moving } from "./ghost";
import { angle, number, t } from "./language";
import type { LinkageDocument } from "./model";
import type { Pair } from "./rows";

/** A linkage that does what is asked. */
export interface Design extends Moving {
  document: LinkageDocument;
  picture: string;
  form: string;
  transmission: number | null;
  /** The same over all positions that it can take. */
  range?: number | null;
  /** How far targets move at most, as a part of the size of the task, if all lengths are wrong by 0.1 %. */
  shift?: number | null;
  /** Whether a better one is much like it. */
  variant?: boolean;
  error: number | null;
  size: number;
  /** Of a function crank and output in each frame, in degrees as its pairs count them. */
  angles?: Pair[];
  /** Where it meets its pairs: drive and output in degrees, as they are in Motion. */
  pairs?: Pair[];
  /** Of dead centres the places of the joints at both. */
  ends?: [Pair[], Pair[]];
  /** Of frame, crank, coupler and rocker; none of what has other joints. */
  lengths: number[];
}

export interface Found {
  total: number;
  refused: number;
  /** Whether linkages of any size do it. */
  relative?: boolean;
  items: Design[];
  /** How complete they are, where the page found them itself. */
  note?: string;
}

/** Whether what is asked for is met, to rounding. */
function exact(error: number | null): boolean {
  return Math.abs(error ?? 0) < 1e-9;
}

/** What a design is worth, the less the better; "balanced" is the sum of its places by those in LEVEL. */
type Order = "error" | "balanced" | "size" | "transmission" | "range" | "shift";
const LEVEL: Order[] = ["range", "size", "shift"];

export class DesignCards {
  readonly element = h("div.designs", {});
  #found: Found | null = null;
  #order: Order = "error";
  /** Exact ones do not differ in their deviation. */
  #exact = false;
  /** The form of those that are shown, at first the most frequent one; all if empty. */
  #form = "";

  constructor(
    private readonly play: (design: Design) => void,
    private readonly open: (design: Design) => void,
  ) {}

  /** Show others, or none; returns the first. */
  show(found: Found | null): Design | null {
    this.#found = found;
    this.#form = this.#forms()[0] ?? "";
    this.#exact = !!found?.items.every(({ error }) => exact(error));
    this.#order = this.#exact ? "balanced" : "error";
    // by which they are numbered, those that are much like others last
    if (found) found.items = this.#sorted().sort((one, two) => +!!one.variant - +!!two.variant);
    this.arrange();
    return this.#shown[0] ?? null;
  }

  #sorted(): Design[] {
    const items = this.#found?.items ?? [];
    // a place is how many are better, so that equal ones have the same
    const place = (design: Design, level: Order) =>
      items.filter((other) => worth(other, level) < worth(design, level)).length;
    const worth = (design: Design, by = this.#order): number =>
      by === "balanced"
        ? LEVEL.reduce((sum, level) => sum + place(design, level), 0)
        : {
            error: exact(design.error) ? 0 : Math.abs(design.error!),
            size: design.size,
            transmission: -(design.transmission ?? 0),
            range: -(design.range ?? design.transmission ?? 0),
            shift: design.shift ?? Infinity,
          }[by];
    return [...items].sort((one, two) => worth(one) - worth(two) || 0);
  }

  get #shown(): Design[] {
    return this.#sorted().filter(({ form }) => [form, ""].includes(this.#form));
  }

  #of(wanted: string): Design[] {
    return this.#found!.items.filter(({ form }) => form === wanted);
  }

  /** The most frequent one first. */
  #forms(): string[] {
    const forms = new Set(this.#found?.items.map(({ form }) => form));
    return [...forms].sort((one, other) => this.#of(other).length - this.#of(one).length);
  }

  /** Write them, in the language of the page. */
  arrange(): void {
    const found = this.#found;
    if (!found) return renew(this.element);
    const { items, total } = found;
    const shown = items.length;
    const orders: [Order, string][] = [
      ["error", t("by deviation")],
      ["balanced", t("balanced")],
      ["transmission", t("by μ on the way")],
      ["range", t("by μ in all positions")],
      ["size", t("by size")],
      ["shift", t("by sensitivity")],
    ];
    if (this.#exact) orders.shift();
    const words = [
      this.#order === "balanced" && t("Balanced: transmission angle, size and sensitivity count alike."),
      found.items.some((one) => (one.range ?? Infinity) < one.transmission!) &&
        t("On the way: from the first target to the last."),
      found.relative && t("Of lengths only the ratios count; the longest is 100 mm."),
      found.items.some(({ shift }) => shift) &&
        t("Sensitivity: how far a target is off at most, if all lengths are 0.1 % wrong."),
    ];
    const joined = (texts: unknown[]) => texts.filter((text) => text).join(" ");
    const said = shown ? joined(words) : "";
    const refused = found.refused > 1 && t("{count} others do not meet what is asked.", { count: found.refused });
    const told = [
      found.note,
      shown < total && t("The best of {count}.", { count: total }),
      !total && t("None does: try a crank that need not turn fully, a smaller angle or other targets."),
      this.#exact && shown > 0 && t("All meet the targets exactly."),
      refused || (found.refused && t("One other does not meet what is asked.")),
    ];
    const mine = this.#shown.filter(({ variant }) => !variant);
    const more = this.#shown.filter(({ variant }) => variant);
    const forms = this.#forms();
    const kinds = forms.map((form): [string, string] => [form, `${form} · ${this.#of(form).length}`]);
    const several = forms.length > 1;
    kinds.unshift(["", t("All")]);
    const chosen = { "data-field": "form" };
    renew(
      this.element,
      h("h2", {}, (several || !shown ? "" : `${forms[0]}: `) + t("{count} designs", { count: shown })),
      h("p.note", {}, joined(told)),
      shown > 1
        ? h(
            "div.form",
            {},
            several &&
              menu(
                t("Kinds of machines"),
                kinds,
                this.#form,
                (form) => this.#choose(() => (this.#form = form)),
                chosen,
              ),
            menu(t("Order"), orders, this.#order, (order) => this.#choose(() => (this.#order = order as Order)), {
              "data-field": "sorted",
            }),
          )
        : "",
      said && h("details.words", {}, h("summary", {}, t("In words")), h("p.note", {}, said)),
      h("div.cards.sorted", { "data-list": "designs" }, ...mine.map((design) => this.#card(design))),
      more.length
        ? h(
            "details.words",
            {},
            h("summary", {}, t("Much like these: {count}", { count: more.length })),
            h("div.cards.sorted", { "data-list": "variants" }, ...more.map((design) => this.#card(design))),
          )
        : "",
    );
  }

  #choose(change: () => void): void {
    change();
    this.arrange();
  }

  #card(design: Design): HTMLElement {
    const { form, lengths, range, shift, transmission, error, size } = design;
    const degrees = (mu: number | null | undefined) => typeof mu === "number" && angle((mu * Math.PI) / 180, 3);
    const [way, all] = [transmission, range].map(degrees);
    const names = t("frame · crank · coupler · rocker").split(" · ");
    const value = error === null || exact(error) ? 0 : 100 * error;
    const deviation = value ? t("deviation {value} %", { value: number(value, 2) }) : t("met exactly");
    const title = `${form} ${this.#of(form).indexOf(design) + 1}`;
    const play = () => this.play(design);
    return h(
      "button.card",
      { onclick: () => this.open(design), onpointerenter: play, onfocus: play },
      thumbnail(design.picture, form),
      h("b", {}, title),
      h("span.lengths", {}, ...lengths.map((one, k) => h("span", {}, names[k]!, h("strong", {}, number(one, 3))))),
      h("span", {}, error === null || this.#exact ? "" : deviation),
      h(
        "span",
        {},
        way && way !== all
          ? t("μ ≥ {way} on the way", { way }) + (all ? t(", else {all}", { all }) : "")
          : all && t("μ ≥ {all} in all positions", { all }),
      ),
      h("span", {}, !lengths.length && t("size {value} mm", { value: number(size, 3) })),
      h("span", {}, !!shift && t("sensitivity {value} %", { value: number(100 * shift, 2) })),
    );
  }
}
