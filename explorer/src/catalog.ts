/** The catalog: every machine with its picture, found by words of either language and by its features. */

import { choice, h, menu, ownPage, renew, thumbnail } from "./dom";
import { softened } from "./header";
import { movesOnHover } from "./hover";
import { currentLanguage, t, number as written } from "./language";
import type { Model } from "./model";
import { store, stored } from "./storing";
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

/** Kinds of joints that are asked for by their number, or by "some". */
const JOINTS = new Set(["revolute", "prismatic", "roll_slide", "spherical", "universal"]);
const SOME = "some";

const LEFT = "gruebler-catalog";

/** What is looked for; how far to scroll once it is filled, where a machine was opened on a page of its own. */
interface Left {
  /** As it was typed. */
  query: Record<string, string>;
  kind: string;
  refining: boolean;
  byLinks: boolean;
  top: number;
}

const EMPTY = 24; // cards: more than a screen

/** The place of a machine that is not there yet. */
function emptyCard(): HTMLElement {
  return h("div.card", {}, h("div", { "data-place": "" }), h("b", {}), h("span", {}));
}

export class CatalogView implements View {
  readonly element = h("div.view", { "data-page": "catalog" });
  #at: Left = { query: {}, kind: "", refining: false, byLinks: false, top: 0 };
  readonly #cards = h("div.cards", { "data-list": "catalog" });
  /** Those drawn before stand at once on the cards of another search. */
  readonly #pictures = new Map<string, Element>();
  readonly #note = h("span.note", { role: "status" });
  /** The same at the lower edge of a phone, below many filters: it leads to the cards, or clears what leaves none. */
  readonly #below = h("button.key", {
    onclick: () => (this.#cards.querySelector(".card") ? this.#cards.scrollIntoView() : this.#showAll()),
  });
  #typing = 0;
  #asked = 0;
  #filled = false;
  #searching = false;
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
    Object.assign(this.#at, stored<Left>(LEFT));
    store(LEFT, null);
  }

  appeared(): void {
    if (!this.#filled) void this.#search();
  }

  arrange(): void {
    const words = h("input", {
      value: this.#at.query.words ?? "",
      "aria-label": t("Words"),
      placeholder: t("Search: crank, six-bar, …"),
      "data-field": "words",
      oninput: () => {
        this.#at.query.words = words.value;
        clearTimeout(this.#typing);
        this.#typing = setTimeout(() => void this.#search(), 250);
      },
    });
    const summary = h("summary", {});
    const count = () => {
      const { words: _, ...set } = this.#at.query;
      const filters = Object.values(set).filter(Boolean).length;
      summary.textContent = t("More filters") + (filters ? ` (${filters})` : "");
    };
    count();
    const field = (key: string, label: string, most: number, least = 0) => {
      const numbers = Array.from({ length: most - least + 1 }, (_, k) => least + k);
      const options = [["", t("any")], ...numbers.map((one) => [String(one), written(one)])] as [string, string][];
      if (JOINTS.has(key)) options.splice(1, 0, [SOME, t("at least 1")]);
      const choose = (value: string) => {
        this.#at.query[key] = value;
        count();
        void this.#search();
      };
      return h("label", {}, label, menu(label, options, this.#at.query[key] ?? "", choose, { "data-field": key }));
    };
    const group = (title: string, ...fields: HTMLElement[]) => h("div", {}, h("h3", {}, title), ...fields);
    const more = h(
      "details.words",
      { open: this.#at.refining, "data-panel": "features", ontoggle: () => (this.#at.refining = more.open) },
      summary,
      h(
        "div.form.numbers",
        {},
        group(
          t("Joints"),
          field("revolute", t("turning"), 14),
          field("prismatic", t("sliding"), 6),
          field("roll_slide", t("gears, cams, belts"), 4),
          field("spherical", t("ball joints"), 12),
          field("universal", t("universal joints"), 6),
          field("multiple_joints", t("multiple joints"), 4),
        ),
        group(
          t("Links"),
          field("links", t("in all, with the frame"), 14, 3),
          field("binary", t("binary (2 joints)"), 12),
          field("ternary", t("ternary (3 joints)"), 6),
          field("output_links", t("outputs"), 3),
          field("output_links_at_frame", t("of them at the frame"), 3),
        ),
        group(
          t("Mobility and drives"),
          field("mobility", t("mobility by the count"), 9, -7),
          field("drive_joints", t("driven joints"), 6),
          field("drive_joints_at_frame", t("of them at the frame"), 3),
          h("button.plain", { "data-act": "clear", onclick: () => this.#showAll() }, t("Clear")),
        ),
      ),
      window.innerWidth > 820 ? "" : h("div.form.go", {}, this.#below),
    );
    const orders: [string, string][] = [
      ["", t("by name")],
      ["links", t("by number of links")],
    ];
    const sort = (value: string) => {
      this.#at.byLinks = !!value;
      void this.#search();
    };
    const order = menu(t("Order"), orders, this.#at.byLinks ? "links" : "", sort, { "data-field": "order" });
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
    const choose = (kind: string) => {
      this.#at.kind = kind;
      void this.#search();
    };
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("div.form", {}, h("h2", {}, t("Catalog")), this.#note),
        choice(t("Kinds of machines"), kinds, this.#at.kind, choose, { class: "choice palette" }),
        h("div.form.search", {}, h("label", {}, words), order),
        h("div.said", {}, more),
        this.#cards,
      ),
    );
    if (this.#asked) void this.#search();
  }

  /** What is looked for, as `gruebler.page.params.ListCatalog` has it. */
  #wanted(): Record<string, unknown> {
    const { words, ...numbers } = this.#at.query;
    const [some, joints]: [string[], string[]] = [[], []];
    const wanted: Record<string, unknown> = words ? { words } : {};
    for (const [key, text] of Object.entries(numbers)) {
      if (text === SOME) some.push(key);
      else if (text && JOINTS.has(key)) joints.push(`${key}:${text}`);
      else if (text) wanted[key] = Number(text);
    }
    return { ...wanted, pairs: some.join(" "), joints: joints.join() };
  }

  /** One search at a time; what is typed meanwhile is looked for after it, and alone the last of it. */
  async #search(): Promise<void> {
    const number = ++this.#asked;
    const cards = this.#cards;
    this.#tell(t("Searching …"));
    cards.classList.add("asking"); // those of the search before
    cards.toggleAttribute("data-waiting", !this.#filled);
    if (!this.#filled) renew(cards, ...Array.from({ length: EMPTY }, emptyCard));
    if (this.#searching) return;
    this.#searching = true;
    let found: Entry[] | Error;
    try {
      found = await this.#page.ask<Entry[]>("catalog", this.#wanted());
    } catch (error) {
      found = error as Error;
    }
    this.#searching = false;
    if (number !== this.#asked) return this.#search();
    cards.classList.remove("asking");
    if (found instanceof Error) {
      this.#tell(found.message);
      if (!this.#filled) renew(cards);
      return;
    }
    found = found.filter(({ kinds }) => !this.#at.kind || kinds.includes(this.#at.kind));
    this.#filled = true;
    cards.removeAttribute("data-waiting");
    const few = [t("No machine matches."), t("One machine")];
    this.#tell(few[found.length] ?? t("{count} machines", { count: found.length }));
    const byName = (a: Entry, b: Entry) => a.name.localeCompare(b.name, currentLanguage());
    // those whose name has what is looked for, not their description alone
    const named = ({ name }: Entry) => +name.toLowerCase().includes((this.#at.query.words ?? "").toLowerCase());
    found.sort((a, b) => (this.#at.byLinks && a.links - b.links) || named(b) - named(a) || byName(a, b));
    renew(cards, ...found.map((entry) => this.#card(entry)));
    for (const card of cards.children) this.#watcher.observe(card);
    if (!found.length) {
      this.#below.textContent = t("Show all");
      renew(cards, h("button.plain", { onclick: () => this.#showAll() }, t("Show all")));
    }
    if (this.#at.top) for (const scrolled of [this.element, window]) scrolled.scrollTo(0, this.#at.top);
    this.#at.top = 0;
  }

  #tell(text: string): void {
    this.#note.textContent = text;
    this.#below.textContent = `↓ ${text}`;
  }

  #showAll(): void {
    this.#at.query = {};
    this.#at.kind = "";
    this.arrange();
  }

  #card(entry: Entry): HTMLElement {
    const { id, idle, links, counted, moves, space } = entry;
    const special = entry.special ?? counted;
    const sizes = [
      t("{links} links, F = {mobility}", { links, mobility: special - idle }),
      idle && t("freely spinning parts: {idle}", { idle }),
      special !== counted && t("Grübler: {counted}", { counted: written(counted) }),
      space ? t("in space").replace(" ", "\u00a0") : !moves && t("structure only"),
    ];
    // a number stays with its word
    const facts = sizes
      .filter(Boolean)
      .join(", ")
      .replace(/ (?==|−?\d+(,|$))|(?<==) /g, "\u00a0");
    const card = h(
      "button.card",
      { "data-id": id, onclick: () => void this.#choose(entry) },
      this.#pictures.get(id) ?? h("div", { "data-place": "" }),
      h("b", {}, softened(entry.name)),
      h("span", {}, facts),
    );
    if (moves || space) movesOnHover(card, id, () => this.#picture("moving", id));
    return card;
  }

  /** A picture of a machine without the names of its points, which are not read in a small one. */
  async #picture(kind: "picture" | "moving", id: string): Promise<{ picture: string }> {
    const { picture } = await this.#page.ask<{ picture: string }>(kind, { id });
    return { picture: picture.replace(/<text.*?<\/text>/gs, "") };
  }

  async #draw(card: HTMLElement): Promise<void> {
    const id = card.dataset.id!;
    if (this.#pictures.has(id)) return;
    try {
      const made = thumbnail((await this.#picture("picture", id)).picture, id);
      this.#pictures.set(id, made);
      // of a search after the one that asked for it, too
      this.#cards.querySelector(`[data-id="${id}"] [data-place]`)?.replaceWith(made);
    } catch {
      // it keeps its name
    }
  }

  async #choose(entry: Entry): Promise<void> {
    if (entry.space && ownPage()) {
      store(LEFT, { ...this.#at, top: scrollY || this.element.scrollTop });
      location.href = `space/${entry.id}.html#${currentLanguage()}`;
      return;
    }
    if (!entry.moves) return this.#page.describe(entry.text);
    await this.#page.choose(this.#page.ask<Model>("open", { id: entry.id }), (model) => this.#page.open(model));
  }
}
