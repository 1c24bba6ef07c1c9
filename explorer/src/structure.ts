/** The view of the structure: a chain out of all, its frame, drive and joint types, its mobility; then dimensions. */

import { type Choice, chainPicture, inPlane, type Structure, typesOf } from "./chain";
import { ChainList, listOf } from "./chains";
import { savedDocument } from "./document";
import { type Child, countOf, h, option, renew, thumbnail } from "./dom";
import { softened } from "./header";
import { currentLanguage, t } from "./language";
import { chainText, type Model } from "./model";
import type { Page, View } from "./view";
import { awaited, moment } from "./waiting";

/** The names of the links of a linkage in the language of the page. */
function namesOf({ links, linkNames }: Model): Record<string, string> {
  const names = linkNames[currentLanguage()] ?? [];
  return Object.fromEntries(names.map((name, link) => [links[link]!, name]));
}

/** A step with its heading and what stands beside that. */
function step(number: number, title: string, beside: Child[], ...content: Child[]): HTMLElement {
  const heading = h("h2", {}, h("i", {}, String(number)), title);
  return h("div.step", {}, h("div.form", {}, heading, ...beside), ...content);
}

export class StructureView implements View {
  readonly element = h("div.view", { "data-page": "structure" });
  private text = "";
  /** The text of the machine at hand. */
  #own = "";
  private structure: Structure | null = null;
  #joint = -1;
  /** The lists of which all cards are shown. */
  readonly #whole = new Set<string>();
  #atFrame = true;
  private readonly chains: ChainList;
  readonly #shown = h("div.described.said", {});
  readonly #detail = h("div.contents", {});
  readonly #go = h("div.form.go", {});
  readonly #error = h("p.error", { role: "alert" });
  readonly #words = h("details.words", { hidden: true }); // until there is one
  readonly #field = h("textarea", { spellcheck: false, "data-field": "chain" });
  #typing = 0;
  #asked = 0;
  /** Whether another structure is on its way. */
  #pending = false;
  readonly #page: Page;
  readonly #narrow = matchMedia("(max-width: 820px)");

  constructor(page: Page) {
    this.#page = page;
    this.#narrow.onchange = () => this.arrange();
    this.chains = new ChainList(
      page,
      (text) => void this.describe(text),
      (on) => this.#fade(on),
    );
    this.#field.addEventListener("input", () => {
      clearTimeout(this.#typing);
      this.#typing = setTimeout(() => void this.describe(this.#field.value, true), 300);
    });
  }

  appeared(): void {
    const { inSpace, shown } = this.#page;
    const own = inSpace?.text ?? chainText(shown);
    if (own !== this.#own) {
      for (const scrolled of [this.element, window]) scrolled.scrollTo(0, 0);
      // what is said of the machine before would be taken for this one's
      if (this.#own) {
        for (const part of [this.#detail, this.#go]) renew(part);
        renew(this.#shown, moment());
      }
      this.chains.leave(true);
      void this.describe(own).then(() => own === this.#own && this.chains.leave(false));
    }
    this.#own = own;
  }

  arrange(): void {
    this.#field.setAttribute("aria-label", t("The chain as text"));
    renew(this.#words, h("summary", {}, t("The chain as text")), this.#field);
    const made = [this.#shown, this.#words, this.#error];
    renew(
      this.element,
      h(
        "div.page",
        {},
        h(
          "div",
          { class: this.chains.few ? "steps row" : "steps" },
          step(1, t("Chain"), [], this.chains.element),
          // on a phone the chain is seen before its frames
          ...(this.#narrow.matches
            ? [...made, this.#detail, this.#go]
            : [this.#detail, h("div.made.contents", {}, ...made, this.#go)]),
        ),
      ),
    );
    this.chains.arrange();
    if (this.text) void this.describe(this.text);
  }

  /** What is said of the chain before, while another one is asked for or what is typed is none. */
  #fade(on: boolean): void {
    for (const part of [...this.#detail.children, this.#shown, ...this.#go.children])
      part.classList.toggle("asking", on || this.#pending || !!this.#error.textContent);
  }

  /** Show the structure of a text, which may come from another view. */
  async describe(text: string, elsewhere = false): Promise<void> {
    const number = ++this.#asked;
    this.#pending = !!text;
    if (this.#field.value !== text) this.#field.value = text;
    if (!text) {
      this.text = text;
      this.#words.hidden = !elsewhere;
      for (const part of [this.#shown, this.#detail, this.#go, this.#error]) renew(part);
      this.element.querySelector(".steps")?.classList.remove("row");
      return this.#fade(false);
    }
    this.#fade(true); // a click would choose among frames of the chain before
    try {
      const found = await this.#page.ask<Structure>("structure", {
        text,
        at_frame: this.#atFrame,
        names: this.#page.inSpace?.links[currentLanguage()] ?? namesOf(this.#page.shown),
        document: this.#sized(text),
      });
      const own = text === this.#own;
      if (own) this.chains.begin(found);
      if (number !== this.#asked) return;
      // with the letters of the language, unless it is being typed
      if (this.#field.value === text && !elsewhere) this.#field.value = found.read ?? text;
      this.text = text;
      this.structure = found;
      this.#error.textContent = "";
      this.#showStructure();
      this.chains.follow(found, own || elsewhere);
    } catch (error) {
      if (number !== this.#asked) return;
      this.chains.follow(null, false);
      this.#shown.querySelector("[data-waiting]")?.remove();
      const said = (error as Error).message;
      this.#words.open = true;
      const [, place] = /(?:character|Stelle) (\d+)/.exec(said) ?? [];
      const at = +place! - 1;
      renew(this.#error, said, at >= 0 && h("code.place", {}, `\n${text.slice(0, at)}▸${text.slice(at)}`));
      this.#error.scrollIntoView({ block: "nearest" });
    }
    this.#field.setAttribute("aria-invalid", String(!!this.#error.textContent));
    this.#words.hidden = false;
    this.#pending = false;
    this.#fade(this.chains.waiting);
  }

  /** The linkage at hand if the text is of its chain; else nothing. */
  #sized(text: string): object {
    const { inSpace, linkage } = this.#page;
    const document = inSpace?.document ?? savedDocument(linkage);
    return text.split(";")[0]!.trim() === String(document.joints).trim() ? document : {};
  }

  /** Show it; what was chosen among frames and drives stays where it is on the screen. */
  #showStructure(): void {
    const found = this.structure!;
    const top = () => this.#detail.firstElementChild?.getBoundingClientRect().top ?? 0;
    const before = this.#detail.matches(":focus-within") && top();
    const drawn = chainPicture(found, this.#joint, (joint) => this.#pick(joint));
    const { links, own, generic } = found;
    const numbers = Object.entries(found.numbered);
    // that its drives fix the motion says the verdict
    const isSaid = ["constrained", "movable"].includes(found.verdict) && own == null && found.driver;
    const lines = [...(isSaid ? [] : found.drives.split("\n")), ...found.lines.slice(1)].filter(Boolean);
    const moves = (mobility: number) => mobility > 0 && "good";
    const fact = (key: "counted" | "generic" | "own", name: string, mark?: string | false) =>
      h("div", {}, h("dt", {}, name), h("dd", { "data-fact": key, class: mark }, `F = ${found[key]}`));
    renew(
      this.#shown,
      h(
        "div.chain-picture",
        {},
        drawn,
        h("div.form.note", {}, ...numbers.map(([number, name]) => h("span", {}, h("b", {}, number), `\u00a0${name}`))),
      ),
      typesOf(found, this.#joint, (text) => void this.describe(text)),
      h(
        "dl.facts",
        {},
        fact("counted", t("By the count")),
        fact("generic", t("Almost all sizes"), generic === found.counted ? moves(generic) : "bad"),
        own != null && fact("own", t("These sizes"), moves(own)),
      ),
      ...lines.map((line) => {
        const [, label, text] = /^([^.:]*:)?(.*)/s.exec(line)!;
        return h("p.said", {}, label && h("span.note", {}, label), ...countOf(text!));
      }),
      links.some(({ overconstrained }) => overconstrained) && h("p.note", {}, t("Orange: overconstrained links.")),
      links.some(({ overconstrained, rigid }) => rigid && !overconstrained) &&
        h("p.note", {}, t("Purple: links rigid against each other.")),
    );
    this.element.querySelector(".steps")!.classList.add("row"); // where each step has one card
    const all = (on: boolean) => {
      this.#atFrame = !on;
      void this.describe(this.text);
    };
    const numberOf = (frame: string) =>
      numbers.flatMap(([number, name]) => (name === frame ? `${number}\u00a0` : [])).join();
    const elsewhere = found.anywhere
      ? h("span.note", {}, t("Drives at the frame alone do not fix the motion."))
      : option(t("Also drives away from the frame"), !this.#atFrame, all, "elsewhere");
    renew(
      this.#detail,
      step(
        2,
        t("Frame"),
        [h("span.note", {}, t("Equivalent links are shown once."))],
        ...this.#cards("inversions", found.inversions, ({ frame }) => [
          [h("b", {}, /^\d/.test(frame) ? `${t("Frame")} ${frame}` : softened(numberOf(frame) + frame))],
          frame === found.chosen,
        ]),
      ),
      step(
        3,
        t("Drive"),
        [
          found.anywhere != null && elsewhere,
          generic > 1 &&
            inPlane(found) &&
            h("span.note", {}, t("F = {mobility} takes {mobility} drives, chosen together.", { mobility: generic })),
        ],
        ...this.#cards("driven", found.driven, ({ drives, brief, text }) => [
          (brief.length ? brief : drives).map((drive) => h("div", {}, drive)),
          text === found.driver,
        ]),
      ),
    );
    // the machine at hand has sizes of its own
    const isOwn = found.driver && this.chains.own?.driver === found.driver;
    const finding = isOwn ? t("Find other dimensions") : t("Find dimensions and move it");
    renew(
      this.#go,
      isOwn && h("button.key", { "data-act": "move", onclick: () => this.#page.move() }, t("Move it")),
      inPlane(found) && // of others no dimensions are found
        generic > 0 &&
        h(
          isOwn ? "button.plain" : "button.key",
          { "data-act": "realise", onclick: () => void this.#realise() },
          finding,
        ),
      // of a long list its picture is far
      this.#narrow.matches &&
        h(
          "button.plain",
          { "data-act": "down", title: t("To the picture"), onclick: () => this.#shown.scrollIntoView() },
          "↓",
        ),
    );
    if (before !== false) for (const scrolled of [this.element, window]) scrolled.scrollBy(0, top() - before);
  }

  /** Mechanisms of which one is chosen, each with its names and whether it is. */
  #cards(key: string, list: Choice[], about: (choice: Choice) => [Child[], boolean]): Node[] {
    const card = (choice: Choice) => {
      const { brief, drives, family, picture, text } = choice;
      const title = brief.length > 0 && drives.join("\n");
      const [names, pressed] = about(choice);
      return h(
        "button.card",
        { "data-text": text, title, "aria-pressed": String(pressed), onclick: () => void this.describe(text) },
        thumbnail(picture, text),
        ...names,
        // Viergelenk-getriebe, for a browser without a German dictionary
        family && h("span", {}, family.replace("kg", "k\u00adg")),
      );
    };
    const more = () => {
      this.#whole.add(key);
      this.#showStructure();
    };
    return listOf(key, list.map(card), this.#whole.has(key), more);
  }

  #pick(joint: number): void {
    this.#joint = this.#joint === joint ? -1 : joint;
    this.#showStructure();
    this.#shown.querySelector(".chips")?.scrollIntoView({ block: "nearest" });
  }

  async #realise(): Promise<void> {
    const text = this.#field.value; // as it stands, described or not yet
    const place = h("span.form", {});
    this.#go.append(place);
    const asked = awaited(place, (progress) => this.#page.ask<Model>("realise", { text }, progress));
    const driven = this.structure?.driven.find((choice) => choice.text === this.structure!.driver);
    const name = driven?.family || t("A mechanism with found dimensions");
    void this.#page.choose(asked, (model) => model && this.#page.open({ ...model, name }));
    if (await asked) place.remove();
  }
}
