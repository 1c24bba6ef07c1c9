/** What can be undone, and what was drawn, kept for the same page when it is loaded again. */

import { type Drawing, EMPTY } from "./drawing";
import { download } from "./export";
import { t } from "./language";
import { chainText, type Model } from "./model";
import type { Tool } from "./palette";
import type { Snapshot } from "./snapshot";
import { store, stored } from "./storing";
import type { Page } from "./view";

const KEPT = "gruebler-undo";
const MOST = 40; // changes

/** What identifies the structure whose sizes are kept. */
function structureOf(model: Model): string {
  return JSON.stringify([chainText(model), model.elements.map(({ joint, kind, link }) => [joint, kind, link])]);
}

/** What is kept of a linkage: the part of the address that holds it, and its sizes before. */
interface Kept {
  link?: string;
  of?: string;
  past?: Snapshot[];
}

export function keepSizes(model: Model, past: readonly Snapshot[], link: string): void {
  store(KEPT, { link, of: structureOf(model), past: past.slice(-MOST) });
}

const kept = (): Kept => stored(KEPT) ?? {};

/** The sizes that were kept of the same structure, the oldest first. */
export function keptSizes(model: Model): Snapshot[] {
  const { of, past } = kept();
  return of === structureOf(model) ? past! : [];
}

/** The part of the address that held the linkage when the page was left. */
export function keptLink(): string {
  return kept().link ?? "";
}

const DRAWING = "gruebler-drawing";

/** Keep the drawing for when the page is opened again. */
export function keepDrawing(drawing: Drawing): void {
  store(DRAWING, drawing, "localStorage");
}

const DRAWN = "gruebler-drawn";

/** What was drawn before in this tab, and with which tool; each picture is kept once. */
interface Drawn {
  now: Drawing["knots"];
  tool: Tool;
  past: Drawing[];
  hrefs: string[];
}

function withHref(drawing: Drawing, of: (href: string) => string): Drawing {
  const { picture } = drawing;
  return picture ? { ...drawing, picture: { ...picture, href: of(picture.href) } } : drawing;
}

export function keepDrawn({ knots: now }: Drawing, all: readonly Drawing[], tool: Tool): void {
  const last = all.slice(-MOST);
  const hrefs = [...new Set(last.flatMap(({ picture }) => picture?.href ?? []))];
  const past = last.map((one) => withHref(one, (href) => String(hrefs.indexOf(href))));
  store(DRAWN, { now, tool, past, hrefs });
}

/** What can be undone of a drawing, the oldest first, and its tool, if it was left so in this tab. */
export function keptDrawn({ knots }: Drawing): { past: Drawing[]; tool?: Tool } {
  const found = stored<Drawn>(DRAWN);
  if (!found || JSON.stringify(found.now) !== JSON.stringify(knots)) return { past: [] };
  const { hrefs, past, tool } = found;
  return { past: past.map((one) => withHref(one, (k) => hrefs[Number(k)]!)), tool };
}

/** Save a drawing as it is opened again, and say under which name. */
export function saveDrawing(page: Page, drawing: Drawing, title: string): void {
  const name = `${title.replace(/[^\p{L}\d-]+/gu, "_")}.json`;
  download(name, new Blob([JSON.stringify(drawing, null, 1)], { type: "application/json" }));
  page.say(t("Saved: {name}", { name }), "done");
}

/** The drawing that something is, if it is one. */
function drawingOf(found: Drawing | null): Drawing | null {
  return found && Array.isArray(found.knots) && Array.isArray(found.drives) ? found : null;
}

/** The drawing of a text, if it is one. */
export function drawingFrom(text: string): Drawing | null {
  try {
    return drawingOf(JSON.parse(text) as Drawing | null);
  } catch {
    return null;
  }
}

/** The drawing that was kept when the page was left. */
export function keptDrawing(): Drawing {
  return drawingOf(stored(DRAWING, "localStorage")) ?? EMPTY;
}
