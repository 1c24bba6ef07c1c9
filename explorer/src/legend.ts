/** What the numbers at links stand for, where these have no room for their names: rows at the foot of the picture. */

import { put, svg } from "./dom";
import type { Linkage } from "./linkage";
import { halfOf } from "./names";
import type { Viewport } from "./viewport";

const [LINE, SMALL] = [18, 16]; // pixels from a row to the next, in a wide picture and a narrow one
const LEFT = 49; // beside the numbers of the grid
const GAP = 12; // between columns
const ABOVE = 15; // from a row up to the edge of their ground
const BESIDE = 5; // the same to the left
const FOOT = 56; // below which is what can be done, and the numbers of the grid
const LOW = 300; // pixels of a picture that has no room for them

/** The number of a link where it is not called by its name: its place, from 1, which is mostly that of the frame. */
export function numberOf(link: number): string {
  return `${link + 1}`;
}

export class Legend {
  readonly element = svg("g", {});
  #entries: SVGTextElement[] = [];
  /** Upon which they are read where the picture is below them. */
  readonly #ground = svg("rect", { fill: "var(--paper)", opacity: 0.85 });
  #marked: string | null = "";
  /** The picture in which they are laid out, and how high they are. */
  #laid = "";
  #high = 0;

  constructor(
    private readonly point: (link: number | null) => void,
    private readonly choose: (link: number) => void,
  ) {}

  get listed(): boolean {
    return this.#entries.length > 0;
  }

  /** The entries of these links. */
  build(linkage: Linkage, links: readonly number[]): void {
    this.#entries = links.map((link) => {
      const number = svg("tspan", { "font-weight": 600 }, numberOf(link));
      const text = svg("text", { "data-entry": link }, number, ` ${linkage.linkName(link)}`);
      text.style.pointerEvents = "auto";
      text.style.cursor = "pointer";
      text.addEventListener("pointermove", (event) => {
        event.stopPropagation(); // no link lies there
        this.point(link);
      });
      text.addEventListener("pointerleave", () => this.point(null));
      text.addEventListener("pointerdown", (event) => {
        event.stopPropagation();
        this.choose(link);
      });
      return text;
    });
    this.#marked = "";
    this.#laid = "";
  }

  /** Lay the rows out in columns; how high all is from there to the lower edge of the picture, 0 without a row. */
  lay({ height, narrow, width }: Viewport): number {
    const laid = [height, width].join();
    if (laid === this.#laid) return this.#high;
    this.#laid = laid;
    const all = height > LOW ? this.#entries : []; // beside what is read and typed the machine alone
    const line = narrow ? SMALL : LINE;
    for (const text of all) text.style.fontSize = narrow ? "12px" : "";
    this.element.replaceChildren(this.#ground, ...all);
    const lengthOf = (text: SVGTextContentElement) => text.getComputedTextLength() || 2 * halfOf(text.textContent!);
    const numbers = all.map((text) => lengthOf(text.firstChild as SVGTSpanElement));
    // numbers of one and of two digits end below one another
    const before = numbers.map((one) => Math.max(...numbers) - one);
    const lengths = all.map((text, k) => before[k]! + lengthOf(text));
    // one column below the other, so that a long name takes room in one of them alone
    let rows = Math.min(1, all.length);
    const after = (columns = Math.ceil(all.length / rows)) =>
      all.slice(0, columns).reduce((x, _, k) => x + GAP + Math.max(...lengths.slice(rows * k, rows * (k + 1))), LEFT);
    while (rows < all.length && after() > width) rows++;
    const top = height - FOOT - line * (rows - 1);
    for (const [k, text] of all.entries())
      put(text, { x: after(Math.floor(k / rows)) + before[k]!, y: top + line * (k % rows) });
    put(this.#ground, { x: LEFT - BESIDE, y: top - ABOVE, width: after() - LEFT, height: rows && line * rows + 2 });
    this.#high = rows && FOOT + line * rows;
    return this.#high;
  }

  /** Show which links are chosen or pointed at. */
  mark(links: readonly number[]): void {
    const marked = links.join();
    if (marked === this.#marked) return;
    this.#marked = marked;
    for (const text of this.#entries)
      put(text, { "text-decoration": links.includes(Number(text.dataset.entry)) ? "underline" : "none" });
  }
}
