/** The panel that tells the mobility of what is drawn, and offers what would mend it. */

import { h, renew } from "./dom";
import {
  counted,
  type Drawing,
  driven,
  jointName,
  jointsOf,
  knotName,
  linksOf,
  type Spot,
  withGround,
  withLink,
  withoutLink,
} from "./drawing";
import { spaced, t } from "./language";
import type { Page } from "./view";
import { moment } from "./waiting";

interface Offer {
  kind: "drive" | "undrive" | "ground" | "bar" | "remove";
  joint?: number;
  links?: string[];
  generic: number;
}

interface Told {
  counted: number;
  generic: number;
  /** Whether the drives fix the motion; and if as many as are needed do not, why. */
  fixed: boolean;
  reason: string;
  lines: string[];
  offers: Offer[];
}

/** What the panel asks of its view. */
export interface Drawn {
  readonly page: Page;
  readonly drawing: Drawing;
  /** How far a new end is put beside others. */
  readonly step: number;
  change(next: Drawing): void;
  /** Open the drawing as a linkage. */
  move(): void;
}

export class MobilityPanel {
  readonly element = h("div", { role: "status", "data-place": "mobility" });
  #asked = 0;
  /** The last drawing that was found to move. */
  moving: Drawing | null = null;

  constructor(private readonly view: Drawn) {}

  /** The mobility by the count at once, then what the library says, with offers to mend it. */
  async tell(): Promise<void> {
    const asked = ++this.#asked;
    const { drawing, page } = this.view;
    const count = h("p.mobility", { "data-fact": "drawn" }, `F = ${counted(drawing)}`);
    const { frame } = drawing;
    this.element.classList.remove("asking");
    const all = linksOf(drawing);
    const loose = all.find((link) => !jointsOf(drawing).some((k) => drawing.knots[k]!.links.includes(link)));
    if (frame === null || all.length < 3 || loose) {
      let text = frame === null ? t("Put a ground") : t("Draw links, at least three.");
      if (frame !== null && all.length > 2) text = t("Link {link} has no joint yet.", { link: spaced(loose!) });
      return renew(this.element, ...(all.length ? [count] : []), h("p.note", {}, text));
    }
    if (this.element.querySelector("[data-fact=freedoms]")) this.element.firstChild!.replaceWith(count);
    else renew(this.element, count, moment());
    this.element.classList.add("asking"); // what was offered before does not hold any more
    const numbers = jointsOf(drawing);
    const joints = numbers.map((k) => jointName(drawing, k)).join(" ");
    const names = numbers.map((k) => knotName(drawing, k));
    const drives = drawing.drives.map((k) => numbers.indexOf(k));
    const ends = drawing.knots.flatMap(({ links }) => (links[1] ? [] : links));
    try {
      const told = await page.ask<Told>("drawing", { joints, names, frame, drives, ends: [...new Set(ends)] });
      if (asked !== this.#asked) return;
      const { fixed: good, generic } = told;
      const text = told.reason || t("Mobility {generic}, drives: {drives}", { generic, drives: drives.length });
      if (generic !== told.counted)
        renew(count, `F = ${generic} `, h("small", {}, t("counted {count}", { count: told.counted })));
      const offers = told.offers.map((offer) => this.#offer(offer, numbers));
      if (good) this.moving = drawing;
      const move = h("button.key", { "data-act": "move", onclick: () => this.view.move() }, t("Move it"));
      renew(
        this.element,
        count,
        h("p", { class: good ? "good" : "bad", "data-fact": "freedoms" }, text),
        h("div.form", {}, ...offers, ...(good ? [move] : [])),
        h("details", {}, h("summary", {}, t("Why")), ...told.lines.map((line) => h("p.note", {}, line))),
      );
    } catch (error) {
      if (asked === this.#asked) renew(this.element, count, h("p.note", {}, (error as Error).message));
    } finally {
      if (asked === this.#asked) this.element.classList.remove("asking");
    }
  }

  #offer({ kind, joint, links, generic }: Offer, numbers: number[]): HTMLElement {
    const { drawing } = this.view;
    const [one, two] = (links ?? []) as [string, string];
    const knot = joint === undefined ? endOf(drawing, one) : numbers[joint]!;
    const [from, to] = [one, two].map((link) => spaced(link ?? ""));
    const called = { joint: knot < 0 ? "" : knotName(drawing, knot), one: from!, two: to!, generic };
    const [text, act] = {
      drive: [t("Drive {joint}", called), () => driven(drawing, knot)],
      undrive: [t("Let {joint} free", called), () => driven(drawing, knot)],
      ground: [
        t("Ground at {joint}: F = {generic}", called),
        () => withGround(drawing, { at: drawing.knots[knot]!.at, knot, link: null }),
      ],
      bar: [t("A link between {one} and {two}: F = {generic}", called), () => barred(this.view, one, two)],
      remove: [t("Without {one}: F = {generic}", called), () => withoutLink(drawing, one)],
    }[kind] as [string, () => Drawing];
    return h("button.plain", { "data-offer": kind, onclick: () => this.view.change(act()) }, text);
  }
}

/** The first open end of a link, else -1. */
function endOf({ knots }: Drawing, link: string): number {
  return knots.findIndex(({ links }) => `${links}` === link);
}

/** A link between two others: from an open end if there is one, to a place beside. */
function barred({ drawing, step }: Drawn, one: string, two: string): Drawing {
  const place = (link: string, aside: number): Spot => {
    const end = endOf(drawing, link);
    if (end >= 0) return { at: drawing.knots[end]!.at, knot: end, link: null };
    const mine = drawing.knots.filter(({ links }) => links.includes(link)).map(({ at }) => at);
    const mean = (axis: 0 | 1) => mine.reduce((sum, at) => sum + at[axis], 0) / mine.length;
    return { at: [mean(0) + aside * step, mean(1) + 0.4 * aside * step], knot: null, link };
  };
  return withLink(drawing, place(one, 1), place(two, 2));
}
