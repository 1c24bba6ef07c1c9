/** What can be undone, and what was drawn, kept for the same page when it is loaded again. */

import { type Drawing, EMPTY } from "./drawing";
import { download } from "./export";
import { t } from "./language";
import { chainText, type Model } from "./model";
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
