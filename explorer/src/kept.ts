/** What can be undone, kept for the same page when it is loaded again. */

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
