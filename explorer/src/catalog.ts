/** The catalog: every machine with its picture, found by words of either language and by its features. */

import { choice, h, menu, ownPage, renew, thumbnail } from "./dom";
import { movesOnHover } from "./hover";
import { currentLanguage, t } from "./language";
import type { Model } from "./model";
import type { Page, View } from "./view";

interface Entry {
  id: string;
  name: string;
  /** What it has or does (`gruebler.teaching.catalog.kinds`). */
  kinds: string[];
  links: number;
  counted: number;
  /** The mobility that special dimensions give, null where they give none other. */
  special: number | null;
  /** How many freedoms change nothing but a part for itself, such as the spin of a rod between two balls. */
  idle: number;
  moves: boolean;
  /** Whether it has a page of its own, on which it moves in space. */
  space: boolean;
  text: string;
}

const EMPTY = 24; // cards: more than a screen

/** The place of a machine that is not there yet. */
function emptyCard(): HTMLElement {
  return h("div.card", {}, h("div", { "data-place": "" }), h("b", {}), h("span", {}));
}

export class CatalogView implements View {
  readonly element = h("div.view", { "data-page": "catalog" });
  /** What is looked for, as it was typed. */
  #query: Record<string, string> = {};
  #kind = "";
  #refining = false;
  #byLinks = false;
  readonly #cards = h("div.cards", { "data-list": "catalog" });
  readonly #note = h("span.note", { role: "status" });
  #typing = 0;
  #asked = 0;
  #filled = false;
  readonly #watcher = new IntersectionObserver(
    (seen) => {
      for (const { target, isIntersecting } of seen) {
        if (!isIntersecting) continue;
        this.#watcher.unobserve(target);
        void this.#draw(target as HTMLElement);
      }
    },
    { rootMargin: "200px" },
  );
  readonly #page: Page;

  constructor(page: Page) {
    this.#page = page;
  }

  appeared(): void {
    if (!this.#filled) void this.#search();
  }

  arrange(): void {
    const field = (key: string, label: string, hint = "") => {
      const input = h("input", {
        value: this.#query[key] ?? "",
        "aria-label": label,
        placeholder: hint,
        "data-field": key,
        oninput: () => {
          this.#query[key] = input.value;
          clearTimeout(this.#typing);
          this.#typing = setTimeout(() => void this.#search(), 250);
        },
      });
      return h("label", {}, key !== "words" && label, input); // its hint says it
    };
    const together = (...fields: HTMLElement[]) => h("div", {}, ...fields);
    const more = h(
      "details.words",
      { open: this.#refining, "data-panel": "features", ontoggle: () => (this.#refining = more.open) },
      h("summary", {}, t("More filters")),
      h(
        "div.form.numbers",
        {},
        together(
          field("pairs", t("Joint types: R turning, P sliding, G gears")),
          field("joints", t("Joints by type"), t("R:4,P:0")),
        ),
        together(field("drive_joints", t("Drive joints")), field("drive_joints_at_frame", t("of them at the frame"))),
        together(
          field("output_links", t("Output links")),
          field("output_links_at_frame", t("of them jointed to the frame")),
        ),
        together(field("links", t("Links")), field("mobility", t("Mobility by the count"))),
        together(field("binary", t("Binary links")), field("ternary", t("Ternary links"))),
        together(
          field("multiple_joints", t("Multiple joints")),
          h("button.plain", { "data-act": "clear", onclick: () => this.#showAll() }, t("Clear")),
        ),
      ),
    );
    const orders: [string, string][] = [
      ["", t("by name")],
      ["links", t("by number of links")],
    ];
    const sort = (value: string) => {
      this.#byLinks = !!value;
      void this.#search();
    };
    const order = menu(t("Order"), orders, this.#byLinks ? "links" : "", sort, { "data-field": "order" });
    const kinds: [string, string][] = [
      ["", t("All")],
      ["crank", t("Cranks")],
      ["slider", t("Sliders")],
      ["gear", t("Gears")],
      ["cam", t("Cams")],
      ["cylinder", t("Cylinders")],
      ["straight", t("Straight lines")],
      ["guide", t("Guide mechanisms")],
      ["space", t("In space")],
    ];
    const words = field("words", t("Words"), t("Search: crank, six-bar, …"));
    const choose = (kind: string) => {
      this.#kind = kind;
      void this.#search();
    };
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("div.form", {}, h("h2", {}, t("Catalog")), this.#note),
        choice(t("Kinds of machines"), kinds, this.#kind, choose, { class: "choice palette" }),
        h("div.form.search", {}, words, order),
        h("div.said", {}, more),
        this.#cards,
      ),
    );
    if (this.#asked) void this.#search();
  }

  async #search(): Promise<void> {
    const number = ++this.#asked;
    const asked = Object.entries(this.#query).flatMap(([key, text]) => {
      if (/^(words|pairs|joints)$/.test(key)) return [[key, text]];
      return /^\s*\d+\s*$/.test(text) ? [[key, Number(text)]] : [];
    });
    const cards = this.#cards;
    this.#note.textContent = t("Searching …");
    cards.classList.add("asking"); // those of the search before
    cards.toggleAttribute("data-waiting", !this.#filled);
    if (!this.#filled) renew(cards, ...Array.from({ length: EMPTY }, emptyCard));
    try {
      let found = await this.#page.ask<Entry[]>("catalog", Object.fromEntries(asked));
      if (number !== this.#asked) return;
      found = found.filter(({ kinds }) => !this.#kind || kinds.includes(this.#kind));
      this.#filled = true;
      cards.removeAttribute("data-waiting");
      const few = [t("No machine has all of this."), t("One machine")];
      this.#note.textContent = few[found.length] ?? t("{count} machines", { count: found.length });
      const byName = (a: Entry, b: Entry) => a.name.localeCompare(b.name, currentLanguage());
      // those whose name has what is looked for, not their description alone
      const named = ({ name }: Entry) => +name.toLowerCase().includes((this.#query.words ?? "").toLowerCase());
      found.sort((a, b) => (this.#byLinks && a.links - b.links) || named(b) - named(a) || byName(a, b));
      renew(cards, ...found.map((entry) => this.#card(entry)));
      for (const card of cards.children) this.#watcher.observe(card);
      if (!found.length) renew(cards, h("button.plain", { onclick: () => this.#showAll() }, t("Show all")));
    } catch (error) {
      if (number !== this.#asked) return;
      this.#note.textContent = (error as Error).message;
      if (!this.#filled) renew(cards);
    }
    cards.classList.remove("asking");
  }

  #showAll(): void {
    this.#query = {};
    this.#kind = "";
    this.arrange();
  }

  #card(entry: Entry): HTMLElement {
    const { id, idle, links, counted, moves, space } = entry;
    const special = entry.special ?? counted;
    const sizes = [
      t("{links} links, F = {mobility}", { links, mobility: special - idle }),
      idle && t("freely spinning parts: {idle}", { idle }),
      special !== counted && t("by the count {counted}", { counted }),
    ];
    const kind = space ? t("in space") : !moves && t("structure only");
    const joined = (parts: unknown[], by: string) => parts.filter(Boolean).join(by);
    const card = h(
      "button.card",
      { "data-id": id, onclick: () => void this.#choose(entry) },
      h("div", { "data-place": "" }),
      h("b", {}, entry.name),
      h("span", {}, joined([joined(sizes, ", "), kind], " · ")),
    );
    if (moves) movesOnHover(card, id, () => this.#page.ask("moving", { id }));
    return card;
  }

  async #draw(card: HTMLElement): Promise<void> {
    const id = card.dataset.id!;
    try {
      const { picture } = await this.#page.ask<{ picture: string }>("picture", { id });
      card.querySelector("[data-place]")?.replaceWith(thumbnail(picture, id));
    } catch {
      // it keeps its name
    }
  }

  async #choose(entry: Entry): Promise<void> {
    if (entry.space && ownPage()) {
      location.href = `space/${entry.id}.html#${currentLanguage()}`;
      return;
    }
    if (!entry.moves) return this.#page.describe(entry.text);
    try {
      this.#page.open(await this.#page.ask<Model>("open", { id: entry.id }));
    } catch (error) {
      this.#page.say((error as Error).message);
    }
  }
}
