/** Sizes and joints of a machine in space, typed: the server makes the machine with them, which can be undone. */

import { h, renew, withMinus } from "../dom";
import { currentLanguage, number, parsed, t } from "../language";
import { store, stored } from "../storing";
import { moment } from "../waiting";
import { asked } from "./asking";
import type { Model, Placed } from "./model";

/** Distance and angle of a link, null where it stays. */
type Size = [number | null, number | null];

interface Owner {
  shown(): Model;
  /** Show the machine with other sizes. */
  take(data: Model): void;
}

const DIGITS = 6;
const KEPT = "gruebler-space";
const MOST = 10; // changes

export class Resizing {
  readonly element = h("div", {});
  /** Where the joints are. */
  readonly joints = h("div", {});
  readonly #said = h("p.error", { role: "alert" });
  #past: Model[] = [];
  readonly #future: Model[] = [];
  /** What was typed and does not fit yet, by the numbers of the links. */
  #typed = new Map<number, Size>();
  #asked = 0;

  constructor(private readonly owner: Owner) {}

  /** The machine with the sizes that it had when the page was left, which can be undone. */
  recalled(data: Model): Model {
    const kept = stored<{ of: string; past: Model[]; shown: Model }>(KEPT);
    if (kept?.of !== location.pathname) return data;
    this.#past = kept.past;
    return kept.shown;
  }

  /** Show it with other sizes, and keep it for when the page is opened again. */
  #take(shown: Model): void {
    this.owner.take(shown);
    store(KEPT, { of: location.pathname, past: this.#past.slice(-MOST), shown });
  }

  /** Which can be undone. */
  get changed(): boolean {
    return this.#past.length > 0;
  }

  get redoable(): boolean {
    return this.#future.length > 0;
  }

  arrange(): void {
    const { sizes, texts, unit } = this.owner.shown();
    const { links, words } = texts[currentLanguage()];
    const named = (link: number, what = "") => h("span", {}, h("b", {}, links[link]!), what && `, ${what}`);
    const rows = sizes.flatMap(({ angle, distance, link }) => {
      const first = distance !== null;
      return [
        ...(first ? this.#row(link, 0, named(link), distance, unit) : []),
        ...(angle === null ? [] : this.#row(link, 1, first ? words.angle! : named(link, words.crossed!), angle, "°")),
      ];
    });
    renew(this.element, h("div.rows", {}, ...rows), this.#said);
    const own = h("p.error", { role: "alert" });
    renew(this.joints, h("div.rows", {}, ...this.#places(own)), own);
  }

  /** Places and axes of the joints in the reference pose: what makes the machine in full. */
  #places(said: HTMLElement): HTMLElement[] {
    const { document, ends, texts, unit } = this.owner.shown();
    const { links, words } = texts[currentLanguage()];
    return Object.entries(document.screws.joints).flatMap(([key, place], joint) => {
      const given = (["x", "y", "z"] as const).filter((axis) => place[axis]);
      const name = ends[joint]!.map((link) => links[link]!).join(" – ");
      return [
        h("b", {}, name),
        ...(unit ? this.#vector(key, joint, "at", words.place!, said) : []), // on a sphere there are axes alone
        ...given.flatMap((axis) => {
          const label = given.length > 1 ? words[`${axis}-axis`]! : words.axis!;
          return this.#vector(key, joint, axis, label, said);
        }),
      ];
    });
  }

  #vector(key: string, joint: number, what: keyof Placed, label: string, said: HTMLElement): HTMLElement[] {
    const data = this.owner.shown();
    const { document, resizable, unit } = data;
    const { joints } = document.screws;
    const old = joints[key]![what]!;
    const all = Object.values(joints).flatMap((each) => [...(each[what] ?? [])]);
    const least = 1e-9 * Math.max(...all.map(Math.abs)); // below it is rounding
    const shown = old.map((part) => number(Math.abs(part) < least ? 0 : part, what === "at" ? DIGITS - 1 : DIGITS - 2));
    const id = `joint-${joint}-${what}`;
    const field = h("input", {
      id,
      readonly: !resizable,
      value: shown.join(" | "),
      onchange: () => {
        const parts = field.value.split(/[|;\s]+/).filter(Boolean);
        const wanted = parts.map((text, k) => (text === shown[k] ? old[k]! : parsed(text))); // with all its digits
        const bad = wanted.length !== 3 || wanted.some(Number.isNaN);
        field.setAttribute("aria-invalid", String(bad));
        if (bad) return;
        const screws = { ...document.screws, joints: { ...joints, [key]: { ...joints[key], [what]: wanted } } };
        void this.#ask({ ...data, document: { ...document, screws } }, {}, said);
      },
    });
    return [h("label", { for: id }, label), field, h("span.unit", {}, what === "at" ? unit : "")];
  }

  #row(link: number, which: 0 | 1, label: HTMLElement | string, value: number, unit: string): HTMLElement[] {
    const id = `size-${link}-${which}`;
    const typed = this.#typed.get(link)?.[which] ?? null;
    const field = h("input", {
      id,
      inputmode: "decimal",
      value: number(typed ?? value, DIGITS),
      "aria-invalid": String(typed !== null),
      onchange: () => {
        const wanted = parsed(field.value);
        field.setAttribute("aria-invalid", String(Number.isNaN(wanted)));
        if (Number.isNaN(wanted)) {
          this.#said.textContent = t("Expected a number, such as {value}.", { value: number(value, DIGITS) });
          return;
        }
        const size: Size = [...(this.#typed.get(link) ?? [null, null])];
        size[which] = wanted;
        this.#typed.set(link, size);
        const data = this.owner.shown();
        const sizes = [...this.#typed].map(([each, one]) => [data.names[each]!, one]);
        void this.#ask(data, Object.fromEntries(sizes), this.#said);
      },
    });
    return [h("label", { for: id }, label), field, h("span.unit", {}, unit)];
  }

  /** The machine with sizes; what is wrong with them is said. */
  async #ask(data: Model, sizes: Record<string, Size>, said: HTMLElement): Promise<void> {
    const question = ++this.#asked;
    const before = this.owner.shown();
    renew(said, moment());
    try {
      const made = await asked<Model>("resize", data, { sizes });
      if (question !== this.#asked) return;
      const lengths = made.sizes.filter(({ distance }, k) => distance !== before.sizes[k]?.distance).length;
      const scaled = this.#typed.size && lengths > this.#typed.size;
      this.#typed = new Map();
      this.#past.push(before);
      this.#future.length = 0;
      this.#take(made);
      renew(said, scaled ? h("span.good", {}, made.texts[currentLanguage()].words.scaled) : "");
    } catch (error) {
      if (question !== this.#asked) return;
      said.textContent = withMinus((error as Error).message);
      if (said !== this.#said) return;
      this.arrange();
      this.#say(said.textContent);
      said.scrollIntoView({ block: "nearest" });
    }
  }

  /** What is wrong; what was typed is kept, since other sizes may go with it, until it is put back. */
  #say(text: string): void {
    const { words } = this.owner.shown().texts[currentLanguage()];
    const back = h("button.plain", { onclick: () => this.#putBack() }, words.back!);
    renew(this.#said, `${text.replace(/\.?$/, ".")} ${words.together} `, back);
  }

  #putBack(): void {
    this.#asked += 1; // what is under way is not wanted any more
    this.#typed = new Map();
    this.#said.textContent = "";
    this.arrange();
  }

  /** First of all what was typed and is not used yet. */
  undo(): void {
    const { size } = this.#typed;
    this.#putBack();
    if (!size) this.#step(this.#past, this.#future);
  }

  redo(): void {
    this.#step(this.#future, this.#past);
  }

  #step(from: Model[], to: Model[]): void {
    this.#said.textContent = "";
    const data = from.pop();
    if (!data) return;
    to.push(this.owner.shown());
    this.#take(data);
  }
}
