/** What can be undone, and what was drawn, kept for the same page when it is loaded again. */

import { type Drawing, EMPTY } from "./drawing";
import { chainText, type Model } from "./model";
import type { Snapshot } from "./snapshot";

const KEPT = "gruebler-undo";
const MOST = 40; // changes

/** What identifies the structure whose sizes are kept. */
function structureOf(model: Model): string {
  return JSON.stringify([chainText(model), model.elements.map(({ joint, kind, link }) => [joint, kind, link])]);
}

export function keepSizes(model: Model, past: readonly Snapshot[]): void {
  try {
    sessionStorage.setItem(KEPT, JSON.stringify({ of: structureOf(model), past: past.slice(-MOST) }));
  } catch {
    // what cannot be kept lasts as long as the page
  }
}

/** The sizes that were kept of the same structure, the oldest first. */
export function keptSizes(model: Model): Snapshot[] {
  try {
    const kept = JSON.parse(sessionStorage.getItem(KEPT) ?? "{}") as { of?: string; past?: Snapshot[] };
    return kept.of === structureOf(model) ? kept.past! : [];
  } catch {
    return [];
  }
}

const DRAWING = "gruebler-drawing";

/** Keep the drawing for when the page is opened again. */
export function keepDrawing(drawing: Drawing): void {
  try {
    localStorage.setItem(DRAWING, JSON.stringify(drawing));
  } catch {
    // what cannot be kept lasts as long as the page
  }
}

/** The drawing that was kept when the page was left. */
export function keptDrawing(): Drawing {
  try {
    const found = JSON.parse(localStorage.getItem(DRAWING) ?? "null") as Drawing | null;
    return found && Array.isArray(found.knots) && Array.isArray(found.drives) ? found : EMPTY;
  } catch {
    return EMPTY;
  }
}
