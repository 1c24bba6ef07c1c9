/** The panel that tells the mobility of what is drawn, and offers what would mend it. */

import { countOf, h, indexed, renew } from "./dom";
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
import { clearAbout, convexHull, middleOf } from "./hull";
import { number, spaced, t } from "./language";
import { isCylinder } from "./outlines";
import type { Pair } from "./rows";
import { extentOf } from "./starters";
import type { Page } from "./view";
import { moment } from "./waiting";

interface Offer {
  kind: "drive" | "undrive" | "ground" | "bar" | "remove";
  joint?: number;
  links?: string[];
  text: string;
}

interface Told {
  counted: number;
  generic: number;
  /** Whether the drives fix the motion; a note if there are only too few; in words. */
  fixed: boolean;
  lacking: "" | "note";
  reason: string;
  lines: string[];
  offers: Offer[];
}

/** What the panel asks of its view. */
export interface Drawn {
  readonly page: Page;
  readonly drawing: Drawing;
  /** Nothing is a change that is not possible, for this reason. */
  change(next: Drawing | null, text?: string): void;
  /** Open the drawing as a linkage. */
  move(): void;
  /** Show all of it. */
  fit(): void;
}

export class MobilityPanel {
  readonly element = h("div", { role: "status", "data-place": "mobility" });
  #asked = 0;
  /** What the last step was that changed the count. */
  #step = "";
  #before: Drawing | null = null;
  /** The last drawing that was found to move. */
  moving: Drawing | null = null;

  constructor(private readonly view: Drawn) {}

  /** The mobility by the count at once, then what the library says, with offers to mend it. */
  async tell(): Promise<void> {
    const asked = ++this.#asked;
    const { drawing, page } = this.view;
    const count = h("p.mobility", { "data-fact": "drawn" }, `F = ${counted(drawing)}`);
    const { frame } = drawing;
    this.#step = stepFrom(this.#before, drawing) ?? this.#step;
    this.#before = drawing;
    this.element.classList.remove("asking");
    const all = linksOf(drawing);
    const loose = all.find((link) => !jointsOf(drawing).some((k) => drawing.knots[k]!.links.includes(link)));
    let missing = loose && t("Link {link} has no joint yet.", { link: spaced(loose) });
    if (all.length < 3)
      missing = t("Draw at least three links, with the ground: {count} so far.", { count: all.length });
    if (frame === null)
      missing = all.length
        ? t("Place ground at a joint, or choose a link and hold it as frame.")
        : t("Choose an example or place ground joints.");
    if (missing) return renew(this.element, all.length > 2 && count, h("p.note", {}, missing));
    if (this.element.querySelector("[data-fact=freedoms]")) this.element.firstChild!.replaceWith(count);
    else renew(this.element, count, moment());
    this.element.classList.add("asking"); // what was offered before does not hold any more
    const numbers = jointsOf(drawing);
    const joints = numbers.map((k) => jointName(drawing, k)).join(" ");
    const names = numbers.map((k) => knotName(drawing, k));
    const drives = drawing.drives.map((k) => numbers.indexOf(k));
    const cylinders = [...numbers.keys()].filter((k) => isCylinder(drawing.knots[numbers[k]!]!));
    const ends: Record<string, string> = {};
    for (const [k, { links }] of drawing.knots.entries()) if (!links[1]) ends[links[0]!] ??= knotName(drawing, k);
    try {
      const told = await page.ask<Told>("drawing", { joints, names, frame, drives, ends, cylinders });
      if (asked !== this.#asked) return;
      const { fixed: good, generic, reason } = told;
      if (generic !== told.counted)
        renew(count, `F = ${generic} `, h("small", {}, t("counted {count}", { count: told.counted })));
      const offers = told.offers.map((offer) => this.#offer(offer, numbers));
      if (good) this.moving = drawing;
      const quality = good ? "good" : told.lacking || "bad";
      const { open } = this.element.querySelector("details") ?? {};
      const move = h("button.key", { "data-act": "move", onclick: () => this.view.move() }, t("Move it"));
      renew(
        this.element,
        count,
        h("p", { class: quality, "data-fact": "freedoms" }, reason),
        this.#step && h("p.note", { "data-fact": "step" }, this.#step),
        h("div.form", {}, ...offers, ...(good ? [move] : [])),
        h(
          "details",
          { open },
          h("summary", {}, t("Why")),
          ...told.lines.map((line) => h("p.note", {}, ...countOf(line))),
        ),
      );
    } catch (error) {
      if (asked === this.#asked) renew(this.element, count, h("p.note", {}, (error as Error).message));
    } finally {
      if (asked === this.#asked) this.element.classList.remove("asking");
    }
  }

  #offer({ kind, joint, links, text }: Offer, numbers: number[]): HTMLElement {
    const { drawing } = this.view;
    const [one, two] = (links ?? []) as [string, string];
    const knot = joint === undefined ? endOf(drawing, one) : numbers[joint]!;
    const take = () => {
      let next: Drawing;
      if (kind === "ground") next = withGround(drawing, { at: drawing.knots[knot]!.at, knot, link: null });
      else if (kind === "bar") next = barred(drawing, one, two);
      else next = kind === "remove" ? withoutLink(drawing, one) : driven(drawing, knot);
      this.view.change(next);
      if (kind === "bar") this.view.fit();
    };
    return h("button.plain", { "data-offer": kind, onclick: take }, ...indexed(text));
  }
}

/** How a step changed the count: three for each link, less what its joints take; nothing if it left all of that. */
function stepFrom(before: Drawing | null, after: Drawing): string | null {
  if (!before?.frame || !after.frame || !linksOf(before)[1]) return "";
  if (!after.knots.some(({ at }) => before.knots.some((one) => one.at === at))) return ""; // another one was opened
  const links = 3 * (linksOf(after).length - linksOf(before).length);
  const [old, now] = [counted(before), counted(after)];
  const joints = now - old - links;
  if (!links && !joints) return null;
  const signed = (value: number) => `${value > 0 ? "+" : ""}${number(value)}`;
  const text = t("Last step: links change F by {links}, joints by {joints}.", {
    links: signed(links),
    joints: signed(joints),
  });
  return links === 6 && joints === -6 ? `${text} ${t("A dyad joined at both ends leaves F unchanged.")}` : text;
}

/** The first open end of a link, else -1. */
function endOf({ knots }: Drawing, link: string): number {
  return knots.findIndex(({ links }) => `${links}` === link);
}

/** A link between two others: from an open end, else from the middle of a link, and to the ground where nothing is. */
function barred(drawing: Drawing, one: string, two: string): Drawing {
  const of = (link: string) => drawing.knots.filter(({ links }) => links.includes(link)).map(({ at }) => at);
  const { left, right, bottom, top } = extentOf(drawing);
  const hulls = [
    ...drawing.knots.map(({ at }) => [at]),
    ...linksOf(drawing).flatMap((link) => (link === drawing.frame ? [] : [convexHull(of(link))])),
  ];
  const place = (link: string, near?: Pair): Spot => {
    const end = endOf(drawing, link);
    if (end >= 0) return { at: drawing.knots[end]!.at, knot: end, link: null };
    const middle = middleOf(of(link));
    const apart = link === drawing.frame || !convexHull(of(link))[1];
    const far = 0.4 * Math.max(right - left, top - bottom);
    return { at: apart ? clearAbout(near ?? middle, far, hulls) : middle, knot: null, link };
  };
  const from = place(one);
  return withLink(drawing, from, place(two, from.at));
}
