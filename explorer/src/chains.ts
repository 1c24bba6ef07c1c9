/** The list of all chains of a size, of which one is taken. */

import { inPlane, type Structure } from "./chain";
import { type Child, h, menu, renew, thumbnail } from "./dom";
import type { Request } from "./host";
import { currentLanguage, type Language, t } from "./language";
import type { Page } from "./view";
import { awaited, moment } from "./waiting";

interface Chains {
  total: number;
  /** The link assortments of the size: numbers of binary, ternary, ... links, in words, and how many chains have it. */
  assortments: { links: number[]; kinds: Record<Language, string>; chains: number }[];
  /** Each with its code, the same for chains of one structure, its name in the literature, if it has one, and what
   * links it has. */
  items: {
    code: string;
    text: string;
    name: Record<Language, string>;
    kinds: Record<Language, string>;
    picture: string;
  }[];
}

/** Links and mobility. */
type Size = [number, number];

/** How many cards are shown at first: as many as stand in one row, on a phone in several. */
const fewOf = () => (innerWidth > 1250 || innerWidth < 500 ? 6 : 4);

/** A list of cards, the first ones and the one that is chosen or all, and a key for more if there are. */
export function listOf(key: string, cards: HTMLElement[], all: boolean, more: () => void, total = 0): Node[] {
  const count = Math.max(total, cards.length);
  const few = fewOf();
  const most = count === few + 1 ? count : few; // one more takes no more room than a key for it
  const shown = cards.filter((card, k) => all || k < most || card.ariaPressed === "true");
  const list = h(all ? "div.cards.few.whole" : "div.cards.few", { "data-list": key }, ...shown);
  if (shown.length === count) return [list];
  const text = t("More ({shown} of {total} shown)", { shown: shown.length, total: count });
  return [list, h("button.plain", { "data-more": key, onclick: more }, text)];
}

/** Links and mobility of the list in which a structure stands: of one in space that of the plane with as many links. */
function placeOf(found: Structure): Size {
  return [found.size, inPlane(found) ? found.counted : 1 + (found.size % 2)];
}

export class ChainList {
  readonly element = h("div", {});
  #links: number;
  private mobility: number;
  /** The structure of the machine at hand, with which the list begins. */
  own: Structure | null = null;
  /** The last structure that was described without a card of its own. */
  #other: Structure | null = null;
  #found: Chains | null = null;
  /** The one that is described. */
  #chosen: Structure | null = null;
  #all = false;
  /** The link assortment of those that are shown, as 4,6; any if empty. */
  #assortment = "";
  readonly #assortments = h("span", { hidden: true });
  readonly #list = h("div.chains", {});
  readonly #count = h("span.note", { role: "status" }, "\u00a0");
  readonly #status = h("div.form", {});
  /** How far the first count is, beside the machine at hand. */
  readonly #counts = h("div", {});
  #asked = 0;
  #request: Request<Chains> | null = null;

  constructor(
    private readonly page: Page,
    private readonly take: (text: string) => void,
    private readonly waits: (on: boolean) => void,
  ) {
    const { links, drives } = page.shown; // as the machine at hand, whose structure is said a moment later
    [this.#links, this.mobility] = [links.length, drives.length || 1];
  }

  /** Whether the machine at hand has so few links that each step has one card. */
  get few(): boolean {
    return this.page.shown.links.length < 5;
  }

  /** The machine at hand; what was chosen beside another one is no longer shown. */
  begin(own: Structure): void {
    if (own.text !== this.own?.text) this.#other = null;
    this.own = own;
  }

  /** Another machine is at hand, whose list is not known yet, or known now. */
  leave(on: boolean): void {
    this.element.classList.toggle("asking", on);
  }

  /** A structure is described, or there is none; the list turns to its size if it is the machine at hand or comes
   * from another view. */
  follow(found: Structure | null, leads: boolean): void {
    // a size that the reader wants goes before
    const wrong = this.element.querySelector('[aria-invalid="true"]');
    const typed = this.waiting || (!wrong && !this.#is(this.#given()));
    const turned = !typed && found && (leads || !this.#asked) && !(this.#is(placeOf(found)) && this.#fits(found));
    if (turned) {
      this.#turn(placeOf(found));
      this.#found = null; // those of another size are no choice here
    }
    this.#chosen = found;
    const cards = [...this.#list.querySelectorAll<HTMLElement>("[data-of]")];
    for (const card of cards) card.setAttribute("aria-pressed", String(card.dataset.of === found?.code));
    const anew = found && !cards.some(({ dataset }) => dataset.of === found.code);
    if (anew) this.#other = found;
    if (!typed && (leads || turned || anew)) this.arrange();
    if ((turned || !this.#asked) && !this.#inSpace) void this.#ask(0);
  }

  /** Whether the one that is described is of no list. */
  get #inSpace(): boolean {
    return !!this.#chosen && !inPlane(this.#chosen);
  }

  /** Whether another list is counted. */
  get waiting(): boolean {
    return this.#list.matches(".asking");
  }

  /** Whether these are the links and the mobility of the list. */
  #is(size: number[]): boolean {
    return String(size) === String([this.#links, this.mobility]);
  }

  /** Turn to all chains of a size. */
  #turn(size: Size): void {
    [this.#links, this.mobility] = size;
    this.#assortment = "";
    renew(this.#assortments);
    this.#count.textContent = t("counting …"); // no longer as many as before
  }

  /** Whether a chain has the link assortment that is wanted. */
  #fits({ kinds }: Structure): boolean {
    const wanted = this.#found?.assortments.find(({ links }) => String(links) === this.#assortment);
    return !wanted || Object.values(wanted.kinds).includes(kinds.split(";")[0]!);
  }

  /** What stands in the fields, where there are any. */
  #given(): number[] {
    const fields = [...this.element.querySelectorAll("input")];
    return fields.length ? fields.map(({ value }) => Number(value || NaN)) : [this.#links, this.mobility];
  }

  /** Of which sizes there are lists, if this is none of them. */
  #unlisted([size, freedom]: number[] = [this.#links, this.mobility]): string {
    const none = { min: 1, max: 0 };
    const { links = none, mobility = none } = this.page.limits;
    const within = (value: number, { min, max }: typeof none) => !(value % 1) && min <= value && value <= max;
    const all = ({ min, max }: typeof none) => `${min}\u00a0…\u00a0${max}`;
    if (within(size!, links) && within(freedom!, mobility)) return "";
    const listed = { links: all(links), mobility: all(mobility) };
    return t("Chains are listed with {links} links and mobility {mobility}.", listed);
  }

  #whyNone(): string {
    return (
      this.#unlisted() ||
      ((this.#links + this.mobility) % 2
        ? t("No chain with so few links has this mobility.")
        : t("No chain of revolute and prismatic joints alone: F = 3(n − 1) − 2g is odd for even n and even for odd n."))
    );
  }

  arrange(): void {
    const field = (key: "links" | "mobility", label: string, value: number) => {
      const given = { type: "number", ...this.page.limits[key], value, onchange: () => this.#typed() };
      return h("label", {}, label, h("input", given));
    };
    renew(
      this.element,
      !this.#inSpace &&
        h(
          "div.form",
          {},
          field("links", t("Links"), this.#links),
          field("mobility", t("Mobility"), this.mobility),
          this.#assortments,
          this.#count,
          this.#status,
        ),
      this.#list,
    );
    this.#show();
  }

  /** Take what is typed; of sizes that are not listed it is said, and the list stays. */
  #typed(): void {
    const size = this.#given();
    const unlisted = this.#unlisted(size);
    for (const field of this.element.querySelectorAll("input"))
      field.setAttribute("aria-invalid", String(!field.value || !field.checkValidity()));
    if (unlisted) {
      this.#list.querySelector(".why")?.remove(); // why there was none
      if (this.waiting) this.#giveUp();
      this.#count.textContent = unlisted;
      return;
    }
    this.#turn(size as Size);
    void this.#ask(0, true);
  }

  /** What is being counted is no longer wanted, and what is listed is of another size. */
  #giveUp(): void {
    this.#asked++;
    this.#request?.cancel();
    this.#found = null;
    this.#list.classList.remove("asking");
    for (const part of [this.#list, this.#status]) renew(part);
    this.waits(false);
  }

  /** Show those of a link assortment, or all. */
  #only(assortment: string): void {
    this.#assortment = assortment;
    void this.#ask(0, true, !assortment || (!!this.#chosen && this.#fits(this.#chosen)));
  }

  /** Ask for some more of them; the first one is taken if others are wanted, or none, unless the chosen one stays. */
  async #ask(start: number, others = false, stays = false): Promise<void> {
    const assortment = this.#assortment ? this.#assortment.split(",").map(Number) : null;
    const question = { links: this.#links, mobility: this.mobility, start, assortment };
    const number = ++this.#asked;
    this.#all = start > 0;
    this.#list.classList.toggle("asking", others); // those of the size before
    if (others) {
      this.#list.querySelector(".why")?.remove();
      this.#count.textContent = t("counting …");
      renew(this.#counts); // one bar is enough
      this.waits(!stays);
    }
    this.#request?.cancel(); // it would be counted to its end first
    const place = h("div", {}); // what is said of one given up stays in its own
    place.style.display = "contents";
    renew(this.#found || others ? this.#status : this.#counts, place);
    const found = this.#unlisted()
      ? { total: 0, assortments: [], items: [] }
      : await awaited(place, (progress) => {
          this.#request = this.page.ask<Chains>("chains", question, progress);
          return this.#request;
        });
    if (number !== this.#asked) return; // another list is wanted by now
    this.#list.classList.remove("asking");
    this.waits(false);
    const before = start ? this.#found!.items : [];
    if (found) this.#found = { ...found, items: [...before, ...found.items] };
    this.#show();
    if (others && found && !stays) this.take(found.items[0]?.text ?? "");
  }

  #show(): void {
    const { own } = this;
    const [found, other] = [this.#found, this.#other];
    const cardOf = (drawn: Structure, name: string, kinds = drawn.kinds) => {
      // without a list of names, if there is one
      const { picture } = drawn.inversions.find(({ frame }) => frame === drawn.chosen) ?? drawn;
      // of a chain no link is the frame yet
      const plain = picture.replace(/<path class=.gr-hatch.*?>/g, "").replaceAll("gr-frame", "gr-body");
      return this.#is(placeOf(drawn)) && this.#fits(drawn) && this.#card(drawn.code, drawn.text, plain, name, kinds);
    };
    const yours = t("Your machine");
    const listed = [own, ...(found?.items ?? [])].some((each) => each?.code === other?.code);
    const mine = [
      own && (own.name ? cardOf(own, own.name, `${yours}: ${own.kinds}`) : cardOf(own, yours)),
      other && !listed && cardOf(other, other.name || t("Chosen")),
    ].filter((card) => card instanceof Node);
    if (this.#inSpace) return this.#showAlone(mine);
    if (!found) {
      // below the only card of a row, where it moves nothing
      this.#counts.style.cssText = this.few ? "position: absolute; margin-top: 195px" : "";
      if (!this.#asked) renew(this.#counts, moment());
      return renew(this.#list, h("div.cards.few", {}, ...mine, this.#counts));
    }
    const { assortments, items, total } = found;
    this.#count.textContent = ["", t("one chain")][total] ?? t("{total} chains", { total });
    const language = currentLanguage();
    const all = assortments.reduce((sum, one) => sum + one.chains, 0);
    const options = assortments.map((one): [string, string] => [
      String(one.links),
      `${one.kinds[language]} · ${one.chains}`,
    ]);
    const every = t("All link assortments · {total}", { total: all });
    const choose = (assortment: string) => this.#only(assortment);
    const filter = menu(t("Link assortment"), [["", every], ...options], this.#assortment, choose);
    renew(this.#assortments, options.length > 1 && filter);
    this.#assortments.hidden = !options[1];
    if (!total) {
      const [n, F] = [this.#links, this.mobility];
      const sizes: [Size, string][] = [F - 1, F + 1].map((freedom) => [[n, freedom], `F = ${freedom}`]);
      const least = F + 3; // of one loop
      for (const links of n < least ? [least] : [n - 1, n + 1]) sizes.push([[links, F], `n = ${links}`]);
      const keys = sizes
        .filter(([size]) => (size[0] - size[1]) % 2 && size[0] >= Math.min(n, size[1] + 3) && !this.#unlisted(size))
        .map(([size, text]) => this.#way(size, text));
      const told = h("div.form.why", {}, h("p.note", {}, this.#whyNone()), ...keys);
      return renew(this.#list, told, h("div.cards.few", {}, ...mine));
    }
    const chains = items.map(
      ({ code, name, text, picture, kinds }, k) =>
        // the machine at hand takes the place of its chain
        code !== own?.code && this.#card(code, text, picture, name[language] || `${k + 1}`, kinds[language]),
    );
    const cards = [...mine, ...chains.filter((card) => card !== false)];
    const rest = items.length < total;
    const more = () => {
      if (this.#all && rest) return void this.#ask(items.length);
      this.#all = true;
      this.#show();
    };
    renew(this.#list, ...listOf("chains", cards, this.#all, more, rest ? total : 0));
  }

  #way(size: Size, text: string): HTMLElement {
    return h("button.plain", { onclick: () => this.#begin(size) }, text);
  }

  /** Begin another list. */
  #begin(size: Size): void {
    this.#chosen = null;
    this.#turn(size);
    this.arrange();
    void this.#ask(0, true);
  }

  /** A chain in space without the list, to whose beginning a key leads. */
  #showAlone(cards: Child[]): void {
    const turn = () => this.#begin([4, 1]);
    const told = t("Only chains of the plane are listed; this one is in space.");
    const list = h("button.plain", { "data-act": "plane", onclick: turn }, t("Chains of the plane"));
    renew(this.#list, h("div.cards.few", {}, ...cards), h("p.note", {}, told), list);
  }

  #card(code: string, text: string, picture: string, name: string, kinds: string): HTMLElement {
    return h(
      "button.card",
      {
        "data-chain": text,
        "data-of": code,
        "aria-pressed": String(code === this.#chosen?.code),
        onclick: () => this.take(text),
      },
      thumbnail(picture, text),
      h("b", {}, name),
      h("span", { title: kinds }, kinds.replace(/(;.*?):.*/, "$1")), // what it is to be fractionated
    );
  }
}
