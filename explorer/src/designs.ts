/** The designs that the library found, as cards in an order; each plays when it is pointed at. */

import { DEGREE } from "./cycle";
import { h, menu, renew, thumbnail } from "./dom";
import { GOOD } from "./facts";
import type { Moving } from "./ghost";
import { angle, currentLanguage, fixed, number, spaced, t } from "./language";
import type { LinkageDocument } from "./model";
import { Plot } from "./plot";
import type { Pair } from "./rows";

/** A linkage that does what is asked. */
export interface Design extends Moving {
  document: LinkageDocument;
  picture: string;
  form: string;
  /** What a four-bar is called by Grashof's condition. */
  kind?: string | null;
  transmission: number | null;
  /** The same over all positions that it can take. */
  range?: number | null;
  /** How far targets move at most if all lengths are wrong by 0.1 %, in millimetres or radians. */
  shift?: number | null;
  /** Whether a better one is much like it. */
  variant?: boolean;
  /** By how much targets are missed at most, in the same unit; 0 but for rounding. */
  error: number | null;
  size: number;
  /** Of a function crank and output in each frame, in degrees as its pairs count them. */
  angles?: Pair[];
  /** Where it meets its pairs: drive and output in degrees, as they are in Motion. */
  pairs?: Pair[];
  /** Of more pairs than can be met exactly what is wanted less what is reached, in degrees, as stems: drives in
   * radians, values from zero to the error and back, and their ends. */
  stems?: [number[], number[], Pair[]];
  /** Of dead centres the places of the joints at both. */
  ends?: [Pair[], Pair[]];
  /** Of the links with two pins of a loop of four, the frame first, then the eccentricity of its slide. */
  lengths: number[];
  /** How far its point lies along the line of two pins of its link, and to the left of it. */
  point?: Pair | null;
  /** The names of all links, the frame first, by languages. */
  names: Record<string, string[]>;
}

export interface Found {
  total: number;
  /** Whether they do not meet all demands: those that come nearest to it. */
  nearest?: boolean;
  /** Whether linkages of any size do it. */
  relative?: boolean;
  items: Design[];
  /** What stands on the cards, explained. */
  words: string;
  /** How complete and how exact they are. */
  note: string;
}

/** By what designs are sorted; "balanced" is by the sum of their places by those in LEVEL. */
type Value = "error" | "size" | "transmission" | "range" | "shift";
type Order = Value | "balanced";
const LEVEL: Value[] = ["error", "range", "size", "shift"];
const ORDERS: Order[] = ["error", "range", "transmission", "size", "shift", "balanced"];

/** What a design is worth, the less the better. */
function worth({ error, range, shift, size, transmission }: Design, by: Value): number {
  const worths = {
    error: Math.abs(error ?? 0),
    size: +size.toPrecision(9), // all of one length, to rounding, are as large
    transmission: -(transmission ?? 0),
    range: -(range ?? transmission ?? 0),
    shift: shift ?? Infinity,
  };
  return worths[by];
}

export class DesignCards {
  readonly element = h("div.designs", {});
  /** That they answer another question than the one that is put now. */
  readonly #outdated = h("p.error", {});
  /** By how much the design that plays misses its pairs. */
  readonly #missed = new Plot("°", () => {});
  #found: Found | null = null;
  #order: Order = "error";
  /** The form of those that are shown; all if empty. */
  #form = "";
  /** What is shown in the plane. */
  #playing: Design | null = null;

  constructor(
    private readonly play: (design: Design) => void,
    private readonly open: (design: Design, title: string) => void,
  ) {}

  /** Show others, or none; returns that of the first card. */
  show(found: Found | null): Design | null {
    this.#found = found;
    this.#form = "";
    // by which they are numbered, those that are much like others last
    if (found) {
      const orders = this.#orders();
      this.#order =
        orders.find((by) => (found.nearest ? by === "transmission" : by === "error" || by === "balanced")) ??
        orders[0] ??
        "balanced";
      found.items = this.#sorted().sort((one, two) => +!!one.variant - +!!two.variant);
    }
    this.#playing = (found && this.#shown.find(({ variant }) => !variant)) ?? null;
    this.arrange();
    return this.#playing;
  }

  /** Which of them plays, by its card; none. */
  mark(design: Design | null, card?: Element): void {
    this.#playing = design;
    for (const one of this.element.querySelectorAll(".card")) one.toggleAttribute("aria-current", one === card);
  }

  /** Say that they are of other demands; or nothing. */
  outdate(text: string): void {
    renew(this.#outdated, !!this.#found?.items.length && text);
  }

  #plot(): void {
    if (!this.#playing?.stems) return;
    const [drives, values, marks] = this.#playing.stems;
    const series = { title: t("Wanted − reached [°]"), colour: "--purple", values: Float64Array.from(values), marks };
    this.#missed.show(Float64Array.from(drives), series, [drives[0]!, drives.at(-1)!]);
  }

  /** How many are better by an order, of each design; equal ones have the same place. */
  #places(by: Order): number[] {
    const { items } = this.#found!;
    const levels = by === "balanced" ? LEVEL.map((level) => this.#places(level)) : [];
    const worths = items.map((one, k) =>
      by === "balanced" ? levels.reduce((sum, places) => sum + places[k]!, 0) : worth(one, by),
    );
    return worths.map((own) => worths.filter((other) => other < own).length);
  }

  /** The orders in which designs do not all have one place, and not the same places as in another one. */
  #orders(): Order[] {
    const known = new Set([this.#found!.items.map(() => 0).join()]);
    return ORDERS.filter((by) => {
      const places = this.#places(by).join();
      return !known.has(places) && known.add(places);
    });
  }

  #sorted(): Design[] {
    const { items } = this.#found!;
    const places = this.#places(this.#order);
    return [...items.keys()].sort((one, two) => places[one]! - places[two]!).map((k) => items[k]!);
  }

  get #shown(): Design[] {
    return this.#sorted().filter(({ form }) => [form, ""].includes(this.#form));
  }

  #of(wanted: string): Design[] {
    return this.#found!.items.filter(({ form }) => form === wanted);
  }

  /** That of the best one first. */
  #forms(): string[] {
    return [...new Set(this.#found!.items.map(({ form }) => form))];
  }

  /** What cards tell and are sorted by, in the language of the page. */
  get #names(): Record<Order, string> {
    return {
      error: t("deviation"),
      range: t("μ in all positions"),
      transmission: t("μ between targets"),
      size: t("longest link"),
      shift: t("sensitivity"),
      balanced: t("balanced"),
    };
  }

  /** Write them, in the language of the page. */
  arrange(): void {
    const found = this.#found;
    if (!found) return renew(this.element);
    this.#plot();
    const { items } = found;
    const orders = this.#orders().map((by): [Order, string] => [by, this.#names[by]]);
    const mine = this.#shown.filter(({ variant }) => !variant);
    const more = this.#shown.filter(({ variant }) => variant);
    const forms = this.#forms();
    const kinds = forms.map((form): [string, string] => [form, `${form} · ${this.#of(form).length}`]);
    kinds.unshift(["", t("All")]);
    const lines = (text: string) => text.split("\n").map((line) => h("p.note", {}, line));
    const list = (name: string, designs: Design[]) =>
      h("div.cards.sorted", { "data-list": name }, ...designs.map((design) => this.#card(design)));
    renew(
      this.element,
      h("h2", {}, items.length === 1 ? t("1 design") : t("{count} designs", { count: items.length })),
      this.#outdated,
      ...lines(items[0] ? found.note.replaceAll("\n", " ") : found.note),
      found.words && h("details.words", {}, h("summary", {}, t("What the values mean")), ...lines(found.words)),
      items[0]?.stems ? this.#missed.element : "",
      h(
        "div.form",
        {},
        forms.length > 1 &&
          menu(
            t("Kinds of machines"),
            kinds,
            this.#form,
            (form) => {
              this.#form = form;
              if (form) this.#playing = this.#shown[0]!;
              if (this.#playing) this.play(this.#playing);
              this.arrange();
            },
            { "data-field": "form" },
          ),
        orders.length > 0 &&
          h(
            "label",
            {},
            t("Order"),
            menu(
              t("Order"),
              orders,
              this.#order,
              (order) => {
                this.#order = order as Order;
                this.arrange();
              },
              { "data-field": "sorted" },
            ),
          ),
      ),
      list("designs", mine),
      more.length
        ? h(
            "details.words",
            {},
            h("summary", {}, t("{count} more, much like these", { count: more.length })),
            list("variants", more),
          )
        : "",
    );
  }

  /** A length with the places that four digits of the longest of the first design have, so that all fit together. */
  #length(length: number): string {
    const { lengths, size } = this.#found!.items[0]!;
    const places = Math.max(0, 3 - Math.floor(Math.log10(1.000001 * Math.max(...lengths, size))));
    return fixed(length, places);
  }

  /** What a design is worth, as it is read. */
  #told(design: Design, by: Value): string {
    const value = design[by];
    if (value == null) return "–";
    if (by === "transmission" || by === "range") return `≥ ${fixed(value, 1)}°`;
    if (by === "size") return `${this.#length(value)} mm`;
    return this.#found!.relative ? angle(value, 2) : `${number(value, 2)} mm`;
  }

  /** What tells designs apart or is known of them: the same in the same places of all cards. */
  get #facts(): Value[] {
    const { items, relative } = this.#found!;
    const alike = (one: Design) => this.#told(one, "transmission") === this.#told(one, "range");
    const needless = [relative && "size", items.every(alike) && "transmission", "balanced"];
    return ORDERS.filter((by): by is Value => !needless.includes(by) && items.some((one) => one[by as Value]));
  }

  #card(design: Design): HTMLElement {
    const { form, kind, lengths, names, pairs, point } = design;
    const { items } = this.#found!;
    const title = `${form} ${this.#of(form).indexOf(design) + 1}`;
    const extra: [string, string][] = [];
    if (point) extra.push([t("coupler point x | y"), point.map((one) => this.#length(one)).join("\u00a0|\u00a0")]);
    if (pairs) extra.push([t("first pair at"), pairs[0]!.map((one) => angle(one * DEGREE)).join("\u00a0|\u00a0")]);
    let touched = false; // by a finger, which only chooses it
    const play = () => {
      this.mark(design, card);
      this.play(design);
      this.#plot();
    };
    const card: HTMLElement = h(
      "button.card",
      {
        onpointerenter: (event: PointerEvent) => {
          if (event.pointerType === "mouse") play();
        },
        onpointerdown: () => {
          touched = design !== this.#playing;
        },
        onclick: () => {
          const opens = !touched;
          touched = false;
          play();
          if (opens) this.open(design, title);
        },
        onfocus: play,
        "aria-current": design === this.#playing,
      },
      h("small", {}, thumbnail(design.picture, form)),
      h("b", {}, title),
      kind && h("span", {}, kind),
      h(
        "span.lengths",
        {},
        ...lengths.map((one, k) =>
          h(
            "span",
            {},
            spaced(names[currentLanguage()]![k] ?? t("eccentricity")),
            h("i", {}, this.#length(one) + (k + 1 in lengths ? "" : "\u00a0mm")), // in all no room for it
          ),
        ),
      ),
      ...extra.map(([name, text]) => h("span", {}, name, h("i", {}, text))),
      ...this.#facts.map((by) => {
        // as it is read: 90° are 90°, whatever the last digit is; alike in all they are no merit
        const texts = items.map((one) => this.#told(one, by));
        const text = this.#told(design, by);
        const best = text === texts[this.#places(by).indexOf(0)] && texts.some((one) => one !== text);
        const poor = (by === "range" || by === "transmission") && design[by]! * DEGREE < GOOD;
        return h("span", {}, this.#names[by], h(best ? "strong" : "i", { class: poor ? "bad" : "" }, text));
      }),
      h("i.chip", {}, t("Open in Motion")),
    );
    return card;
  }
}
