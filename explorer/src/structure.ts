/** The view of the structure: a chain out of all, its frame, drive and joint types, its mobility; then dimensions. */

import { h, picture, renew, svg, thumbnail } from "./dom";
import { currentLanguage, t } from "./language";
import { chainText, type Model } from "./model";
import type { Page, View } from "./view";
import { awaited, moment } from "./waiting";

interface Choice {
  text: string;
  frame: string;
  drives: string[];
  family: string;
  picture: string;
}

export interface Structure {
  text: string;
  /** The frame that was chosen, or the one of the list that is like it; empty if none was. */
  chosen: string;
  picture: string;
  joints: {
    name: string;
    at: [number, number];
    types: { symbol: string; name: string; text: string; chosen: boolean }[];
  }[];
  links: {
    name: string;
    at: [number, number];
    outline: [number, number][];
    overconstrained: boolean;
    rigid: boolean;
  }[];
  frame: string;
  counted: number;
  generic: number;
  verdict: string;
  lines: string[];
  drives: string;
  inversions: Choice[];
  driven: Choice[];
}

interface Chains {
  total: number;
  start: number;
  items: { text: string; picture: string }[];
}

/** The names of the links of a linkage in the language of the page. */
function namesOf({ links, linkNames }: Model): Record<string, string> {
  const names = linkNames[currentLanguage()] ?? [];
  return Object.fromEntries(names.map((name, link) => [links[link]!, name]));
}

/** The heading of a step. */
function step(number: number, title: string): HTMLElement {
  return h("h2", { class: "step" }, h("i", {}, String(number)), title);
}

interface Realised {
  model: Model;
  message: string;
}

export class StructureView implements View {
  readonly element = h("div", { class: "view", "data-page": "structure" });
  private text = "";
  private links = 6;
  private mobility = 1;
  private chains: Chains | null = null;
  private structure: Structure | null = null;
  private joint = -1;
  private atFrame = true;
  private readonly list = h("div", {});
  private readonly count = h("span", { class: "note" });
  private readonly shown = h("div", {});
  private readonly detail = h("div", {});
  private readonly status = h("div", { class: "form" });
  private readonly error = h("p", { class: "error", role: "alert" });
  private readonly field = h("textarea", { spellcheck: false, "data-field": "chain" });
  private typing = 0;
  private asked = 0;
  private listed = 0;

  constructor(private readonly page: Page) {
    this.field.addEventListener("input", () => {
      clearTimeout(this.typing);
      this.typing = window.setTimeout(() => void this.describe(this.field.value), 300);
    });
  }

  appeared(): void {
    if (!this.text) void this.describe(chainText(this.page.shown));
    if (!this.chains) void this.listChains(0);
  }

  arrange(): void {
    const links = h("input", {
      type: "number",
      ...this.page.limits.links,
      value: this.links,
      "aria-label": t("Links"),
      onchange: () => {
        this.links = Number(links.value);
        void this.listChains(0);
      },
    });
    const mobility = h("input", {
      type: "number",
      ...this.page.limits.mobility,
      value: this.mobility,
      "aria-label": t("Mobility"),
      onchange: () => {
        this.mobility = Number(mobility.value);
        void this.listChains(0);
      },
    });
    this.field.setAttribute("aria-label", t("The chain as text"));
    renew(
      this.element,
      h(
        "div",
        { class: "page" },
        step(1, t("Chain")),
        h(
          "div",
          { class: "form" },
          h("label", {}, t("Links"), links),
          h("label", {}, t("Mobility"), mobility),
          this.count,
          this.status,
        ),
        this.list,
        this.shown,
        h("details", { class: "words" }, h("summary", {}, t("The chain as text")), this.field),
        this.error,
        this.detail,
      ),
    );
    this.showChains();
    if (this.text) void this.describe(this.text);
  }

  private async listChains(start: number): Promise<void> {
    const question = { links: this.links, mobility: this.mobility, start };
    const number = ++this.listed;
    const found = await awaited(this.status, (progress) => this.page.ask<Chains>("chains", question, progress));
    if (number !== this.listed) return; // another list is wanted by now
    if (found) {
      const before = start && this.chains ? this.chains.items : [];
      this.chains = { ...found, items: [...before, ...found.items] };
    }
    this.showChains();
  }

  private showChains(): void {
    const { chains } = this;
    if (!chains) return renew(this.list);
    this.count.textContent = t("{shown} of {total} chains", { shown: chains.items.length, total: chains.total });
    const more =
      chains.items.length < chains.total
        ? h("button", { class: "plain", onclick: () => void this.listChains(chains.items.length) }, t("More"))
        : null;
    renew(
      this.list,
      h(
        "div",
        { class: "cards few", "data-list": "chains" },
        ...chains.items.map(({ text, picture: drawn }, k) =>
          h(
            "button",
            {
              class: "card",
              "data-chain": text,
              "aria-pressed": String(this.text.startsWith(text)),
              onclick: () => void this.describe(text),
            },
            thumbnail(drawn, text),
            h("span", {}, `${k + 1}`),
          ),
        ),
      ),
      ...(more ? [more] : []),
    );
  }

  async describe(text: string): Promise<void> {
    const number = ++this.asked;
    if (this.field.value !== text) this.field.value = text;
    if (!this.structure) renew(this.shown, moment());
    try {
      const found = await this.page.ask<Structure>("structure", {
        text,
        at_frame: this.atFrame,
        names: namesOf(this.page.shown),
        document: this.contacts(text),
      });
      if (number !== this.asked) return;
      this.text = text;
      this.structure = found;
      if (this.joint >= found.joints.length) this.joint = -1;
      this.error.textContent = "";
      this.field.setAttribute("aria-invalid", "false");
      this.showStructure();
      for (const card of this.list.querySelectorAll<HTMLElement>("[data-chain]"))
        card.setAttribute("aria-pressed", String(text.startsWith(card.dataset.chain!)));
    } catch (error) {
      if (number !== this.asked) return;
      if (!this.structure) renew(this.shown);
      const said = (error as Error).message;
      this.field.setAttribute("aria-invalid", "true");
      this.field.closest("details")!.open = true;
      const place = /(?:character|Stelle) (\d+)/.exec(said);
      renew(this.error, said);
      if (place) {
        const at = Number(place[1]);
        const before = text.slice(Math.max(0, at - 24), at - 1);
        this.error.append(h("span", { class: "place" }, `\n${before}▸${text.slice(at - 1, at + 16)}`));
      }
    }
  }

  /** The linkage that is shown if it has higher pairs and the text is of its chain; else nothing. */
  private contacts(text: string): object {
    const model = this.page.shown;
    const higher = model.joints.some((joint) => joint.pair.contours);
    return higher && text.split(";")[0]!.trim() === String(model.document.joints).trim() ? model.document : {};
  }

  private showStructure(): void {
    const found = this.structure!;
    const drawn = picture(found.picture, found.text) as SVGSVGElement;
    drawn.setAttribute("role", "group"); // its joints are buttons
    const marks: SVGElement[] = found.links
      .filter((link) => link.overconstrained || link.rigid)
      .map((link) =>
        svg("polyline", {
          points: link.outline.map((p) => p.join(",")).join(" "),
          fill: "none",
          "stroke-width": 5,
          "stroke-linecap": "round",
          "stroke-linejoin": "round",
          stroke: link.overconstrained ? "var(--accent)" : "var(--purple)",
          opacity: 0.85,
          "data-strained": link.name,
        }),
      );
    const joints = found.joints.map((one, k) =>
      svg(
        "circle",
        {
          cx: one.at[0],
          cy: one.at[1],
          r: 13,
          fill: "transparent",
          stroke: k === this.joint ? "var(--key)" : "transparent",
          "stroke-width": 3,
          tabindex: 0,
          role: "button",
          "aria-label": one.name,
          "data-joint": one.name,
          style: null,
          cursor: "pointer",
          onclick: () => this.pick(k),
          onkeydown: (event: KeyboardEvent) => {
            if (event.key !== "Enter" && event.key !== " ") return;
            event.preventDefault();
            this.pick(k);
          },
        },
        svg("title", {}, one.name),
      ),
    );
    drawn.append(...marks, ...joints);
    const joint = found.joints[this.joint];
    const types = joint
      ? h(
          "div",
          {},
          h("p", { class: "note" }, t("Type of {joint}", { joint: joint.name })),
          h(
            "div",
            { class: "joint-types" },
            ...joint.types.map((type) =>
              h(
                "button",
                {
                  class: type.chosen ? "key" : "plain",
                  title: type.name,
                  "data-type": type.symbol,
                  onclick: () => void this.describe(type.text),
                },
                `${type.symbol} ${type.name}`,
              ),
            ),
          ),
        )
      : h("p", { class: "note" }, t("Click on a joint to change its type."));
    const strained = found.links.some((link) => link.overconstrained);
    const lines = [...found.lines.slice(1), ...found.drives.split("\n")].filter((line) => line.trim());
    renew(
      this.shown,
      h(
        "div",
        { class: "two" },
        h("div", {}, h("div", { class: "chain-picture" }, drawn), types),
        h(
          "div",
          {},
          h(
            "dl",
            { class: "facts" },
            h("div", {}, h("dt", {}, t("Counted")), h("dd", { "data-fact": "counted" }, `F = ${found.counted}`)),
            h(
              "div",
              {},
              h("dt", {}, t("Generic")),
              h(
                "dd",
                { "data-fact": "generic", class: found.generic === found.counted ? "good" : "bad" },
                `F = ${found.generic}`,
              ),
            ),
          ),
          ...lines.map((line) => h("p", { class: "said" }, line.trim())),
          strained ? h("p", { class: "note" }, t("Orange: overconstrained links.")) : null,
        ),
      ),
    );
    const elsewhere = h("input", {
      type: "checkbox",
      checked: !this.atFrame,
      "data-field": "elsewhere",
      onchange: () => {
        this.atFrame = !elsewhere.checked;
        void this.describe(this.text);
      },
    });
    const driven = found.driven.filter(({ frame }) => !found.chosen || frame === found.chosen);
    const framed = (choice: Choice) => t("frame: {frame}", { frame: choice.frame });
    renew(
      this.detail,
      step(2, t("Frame")),
      h(
        "p",
        { class: "note" },
        t("Links that a symmetry exchanges give the same mechanism: each kind stands here once."),
      ),
      this.cards("inversions", found.inversions, framed, (choice) => choice.frame === found.chosen),
      step(3, t("Drive")),
      this.cards(
        "driven",
        driven,
        (choice) => (found.chosen ? "" : `${framed(choice)}, `) + choice.drives.join(", "),
        (choice) => choice.text === found.text,
      ),
      h("div", { class: "form" }, h("label", {}, elsewhere, t("also drives that are not at the frame"))),
      h(
        "div",
        { class: "form go" },
        h(
          "button",
          { class: "key", "data-act": "realise", onclick: () => void this.realise() },
          t("Find dimensions and move it"),
        ),
        found.drives ? "" : h("span", { class: "note" }, t("Choose a frame and a drive first.")),
      ),
    );
  }

  /** Mechanisms of which one is chosen. */
  private cards(
    key: string,
    list: Choice[],
    label: (choice: Choice) => string,
    chosen: (choice: Choice) => boolean,
  ): HTMLElement {
    const card = (choice: Choice) =>
      h(
        "button",
        {
          class: "card",
          "data-text": choice.text,
          "aria-pressed": String(chosen(choice)),
          onclick: () => void this.describe(choice.text),
        },
        thumbnail(choice.picture, choice.text),
        h("b", {}, label(choice)),
        choice.family ? h("span", {}, choice.family) : null,
      );
    return h("div", { class: "cards few", "data-list": key }, ...list.map(card));
  }

  private pick(joint: number): void {
    this.joint = this.joint === joint ? -1 : joint;
    this.showStructure();
  }

  private async realise(): Promise<void> {
    const text = this.field.value; // as it stands, described or not yet
    const place = h("span", { class: "form" });
    this.detail.querySelector('[data-act="realise"]')!.parentElement!.append(place);
    const found = await awaited(place, (progress) => this.page.ask<Realised>("realise", { text }, progress));
    if (!found) return;
    place.remove();
    this.page.open({ ...found.model, name: t("A mechanism with found dimensions") });
    this.page.say(found.message, "done");
  }
}
