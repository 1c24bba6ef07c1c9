/** The sizes of a machine in space, typed: the server makes the machine with them, which can be undone. */

import { h, renew } from "../dom";
import { currentLanguage, number, parsed } from "../language";
import { moment } from "../waiting";
import type { Model } from "./model";

/** Distance and angle of a link, null where it stays. */
type Size = [number | null, number | null];

interface Owner {
  shown(): Model;
  /** Show the machine with other sizes. */
  take(data: Model): void;
  /** What can be undone has changed. */
  told(): void;
}

const DIGITS = 6;
const KEPT = "gruebler-space";
const MOST = 10; // changes

export class Resizing {
  readonly element = h("div", {});
  readonly #said = h("p.error", { role: "alert" });
  #past: Model[] = [];
  readonly #future: Model[] = [];
  /** What was typed and does not fit yet, by the numbers of the links. */
  #typed = new Map<number, Size>();
  #asked = 0;

  constructor(private readonly owner: Owner) {}

  /** The machine with the sizes that it had when the page was left, which can be undone. */
  recalled(data: Model): Model {
    try {
      const kept = JSON.parse(sessionStorage.getItem(KEPT) ?? "{}") as { of?: string; past?: Model[]; shown?: Model };
      if (kept.of !== location.pathname) return data;
      this.#past = kept.past!;
      return kept.shown!;
    } catch {
      return data;
    }
  }

  /** Show it with other sizes, and keep it for when the page is opened again. */
  #take(shown: Model): void {
    this.owner.take(shown);
    try {
      const kept = { of: location.pathname, past: this.#past.slice(-MOST), shown };
      sessionStorage.setItem(KEPT, JSON.stringify(kept));
    } catch {
      // what cannot be kept lasts as long as the page
    }
  }

  get changed(): boolean {
    return this.#past.length > 0;
  }

  get undoable(): boolean {
    return this.changed || this.#typed.size > 0;
  }

  get redoable(): boolean {
    return this.#future.length > 0;
  }

  arrange(): void {
    const { sizes, texts, unit } = this.owner.shown();
    const { links, words } = texts[currentLanguage()];
    const rows = sizes.flatMap(({ angle, distance, link }) => {
      const first = distance !== null;
      return [
        ...(first ? this.#row(link, 0, h("b", {}, links[link]!), distance, unit) : []),
        ...(angle === null ? [] : this.#row(link, 1, first ? words.angle! : h("b", {}, links[link]!), angle, "°")),
      ];
    });
    renew(this.element, h("div.rows", {}, ...rows), this.#said);
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
        if (Number.isNaN(wanted)) return;
        const size: Size = [...(this.#typed.get(link) ?? [null, null])];
        size[which] = wanted;
        this.#typed.set(link, size);
        void this.#ask();
      },
    });
    return [h("label", { for: id }, label), field, h("span.unit", {}, unit)];
  }

  async #ask(): Promise<void> {
    const asked = ++this.#asked;
    const before = this.owner.shown();
    const lang = currentLanguage();
    const { document: linkage, names, texts } = before;
    const sizes = Object.fromEntries([...this.#typed].map(([link, size]) => [names[link]!, size]));
    const said = (key: "drives" | "links" | "title") =>
      Object.fromEntries(Object.entries(texts).map(([language, one]) => [language, one[key]]));
    const params = { document: linkage, sizes, titles: said("title"), drives: said("drives"), links: said("links") };
    renew(this.#said, moment());
    try {
      const answer = await fetch("resize", { method: "POST", body: JSON.stringify({ id: asked, lang, params }) });
      const { error, result }: { error?: string; result?: Model } = await answer.json();
      if (asked !== this.#asked) return;
      this.#said.textContent = error ?? "";
      if (!result) return this.#refused();
      this.#typed = new Map();
      this.#past.push(before);
      this.#future.length = 0;
      this.#take(result);
    } catch {
      this.#said.textContent = texts[lang].words.lost!;
    }
  }

  /** What was typed is kept, since other sizes may go with it. */
  #refused(): void {
    this.arrange();
    this.#said.scrollIntoView({ block: "nearest" });
    this.owner.told();
  }

  undo(): void {
    this.#asked += 1; // what is under way is not wanted any more
    this.#said.textContent = "";
    if (this.#typed.size) {
      this.#typed = new Map();
      return this.#refused();
    }
    this.#step(this.#past, this.#future);
  }

  redo(): void {
    this.#step(this.#future, this.#past);
  }

  #step(from: Model[], to: Model[]): void {
    const data = from.pop();
    if (!data) return;
    to.push(this.owner.shown());
    this.#take(data);
  }
}
