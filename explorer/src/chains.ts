/** The list of all chains of a size, of which one is taken. */

import { inPlane, type Structure } from "./chain";
import { h, renew, thumbnail } from "./dom";
import { currentLanguage, type Language, t } from "./language";
import type { Page } from "./view";
import { awaited, moment } from "./waiting";

interface Chains {
  total: number;
  /** Each with its code, the same for chains of one structure, and its name in the literature, if it has one. */
  items: { code: string; text: string; name: Record<Language, string>; picture: string }[];
}

/** Links and mobility of the list in which a structure stands: of one in space that of the plane with as many links. */
function placeOf(found: Structure): [number, number] {
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
  /** The code of the chain that is described. */
  #chosen = "";
  readonly #list = h("div.chains", {});
  readonly #count = h("span.note", {}, "\u00a0");
  readonly #status = h("div.form", {});
  #asked = 0;

  constructor(
    private readonly page: Page,
    private readonly take: (text: string) => void,
  ) {
    const { links, drives } = page.shown; // as the machine at hand, whose structure is said a moment later
    [this.#links, this.mobility] = [links.length, drives.length || 1];
  }

  /** A structure is described, or there is none; the list turns to its size if it is the machine at hand or comes
   * from another view. */
  follow(found: Structure | null, leads: boolean): void {
    const turned = found && (leads || !this.#asked) && !this.#holds(found);
    if (turned) [this.#links, this.mobility] = placeOf(found);
    this.#chosen = found?.code ?? "";
    const cards = [...this.#list.querySelectorAll<HTMLElement>("[data-of]")];
    for (const card of cards) card.setAttribute("aria-pressed", String(card.dataset.of === this.#chosen));
    const anew = found && !cards.some(({ dataset }) => dataset.of === found.code);
    if (anew) this.#other = found;
    if (leads || turned || anew) this.arrange();
    if (turned || !this.#asked) void this.#ask(0);
  }

  /** Whether a structure is as large and as movable as those of the list. */
  #holds(found: Structure): boolean {
    return String(placeOf(found)) === String([this.#links, this.mobility]);
  }

  /** The sizes of which there are lists, if this is none of them. */
  #unlisted(): Record<"links" | "mobility", string> | null {
    const none = { min: 1, max: 0 };
    const { links = none, mobility = none } = this.page.limits;
    const within = (value: number, { min, max }: typeof none) => min <= value && value <= max;
    const all = ({ min, max }: typeof none) => `${min} … ${max}`;
    if (within(this.#links, links) && within(this.mobility, mobility)) return null;
    return { links: all(links), mobility: all(mobility) };
  }

  #whyNone(): string {
    const unlisted = this.#unlisted();
    if (unlisted) return t("Chains are listed with {links} links and mobility {mobility}.", unlisted);
    return (this.#links + this.mobility) % 2
      ? t("There is none with so few links.")
      : t("There is none: by F = 3(n − 1) − 2g one of n and F is even, the other odd.");
  }

  arrange(): void {
    const field = (key: "links" | "mobility", label: string, value: number) => {
      const given = { type: "number", ...this.page.limits[key], value, onchange: () => this.#typed() };
      return h("label", {}, label, h("input", given));
    };
    renew(
      this.element,
      h(
        "div.form",
        {},
        field("links", t("Links"), this.#links),
        field("mobility", t("Mobility"), this.mobility),
        this.#count,
        this.#status,
      ),
      this.#list,
    );
    this.#show();
  }

  /** Ask for the chains of the numbers that are typed, if there can be such; else the list stays that of the last. */
  #typed(): void {
    const fields = [...this.element.querySelectorAll("input")];
    const wrong = fields.find((field) => !field.value || !field.checkValidity());
    if (!wrong) {
      [this.#links, this.mobility] = fields.map(({ value }) => Number(value)) as [number, number];
      return void this.#ask(0, true);
    }
    const { min, max } = wrong;
    const text = t("Expected a whole number from {min} to {max}.", { min, max });
    renew(this.#status, h("span.error", { role: "alert" }, text));
  }

  /** Ask for some more of them; the first one is taken if others are wanted, or none. */
  async #ask(start: number, others = false): Promise<void> {
    const question = { links: this.#links, mobility: this.mobility, start };
    const number = ++this.#asked;
    const place = this.#found ? this.#status : this.#list;
    const found = this.#unlisted()
      ? { total: 0, items: [] }
      : await awaited(place, (progress) => this.page.ask<Chains>("chains", question, progress));
    if (number !== this.#asked) return; // another list is wanted by now
    const before = start ? this.#found!.items : [];
    if (found) this.#found = { ...found, items: [...before, ...found.items] };
    this.#show();
    if (others && found) this.take(found.items[0]?.text ?? "");
  }

  #show(): void {
    const { own } = this;
    const [found, other] = [this.#found, this.#other];
    if (!found) return renew(this.#list, moment());
    const { items, total } = found;
    const one = total === 1 ? t("one chain") : t("{total} chains", { total });
    const beside = own && this.#holds(own) && !items.some(({ code }) => code === own.code);
    const shown = items.length;
    const chains = shown < total ? t("{shown} of {total} chains", { shown, total }) : one;
    this.#count.textContent = beside ? t("{chains} and yours", { chains }) : chains;
    this.#count.hidden = this.#unlisted() !== null;
    const cardOf = (drawn: Structure, name: string) => {
      // without a list of names, if there is one
      const { picture } = drawn.inversions.find(({ frame }) => frame === drawn.chosen) ?? drawn;
      // of a chain no link is the frame yet
      const plain = picture.replace(/<path class=.gr-hatch.*?>/g, "").replaceAll("gr-frame", "gr-body");
      return this.#holds(drawn) && this.#card(drawn.code, drawn.text, plain, name);
    };
    const listed = [own, ...items].some((each) => each?.code === other?.code);
    const mine = [
      own && cardOf(own, own.name ? t("Yours: {name}", { name: own.name }) : t("Your machine")),
      other && !listed && cardOf(other, other.name || t("Chosen")),
    ];
    const none = total ? "" : this.#whyNone();
    if (none) return renew(this.#list, h("p.note", {}, none), h("div.cards.few", {}, ...mine));
    renew(
      this.#list,
      h(
        "div.cards.few",
        { "data-list": "chains" },
        ...mine,
        // the machine at hand takes the place of its chain
        ...items.map(({ code, name: names, text, picture }, k) =>
          code === own?.code ? null : this.#card(code, text, picture, names[currentLanguage()] || `${k + 1}`),
        ),
      ),
      shown < total && h("button.plain", { onclick: () => void this.#ask(shown) }, t("More")),
    );
  }

  #card(code: string, text: string, picture: string, name: string): HTMLElement {
    return h(
      "button.card",
      {
        "data-chain": text,
        "data-of": code,
        "aria-pressed": String(code === this.#chosen),
        onclick: () => this.take(text),
      },
      thumbnail(picture, text),
      h("b", {}, name),
    );
  }
}
