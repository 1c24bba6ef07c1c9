/** What the browser keeps for a page that is loaded again, in this tab or in all of them. */

import type { Language } from "./language";

type Where = "localStorage" | "sessionStorage";

/** Keep it, if the browser does: otherwise it lasts as long as the page. */
export function store(key: string, value: unknown, where: Where = "sessionStorage"): void {
  try {
    window[where].setItem(key, JSON.stringify(value));
  } catch {
    // there is no room, or it is forbidden
  }
}

/** What was kept, if anything was. */
export function stored<Value>(key: string, where: Where = "sessionStorage"): Value | null {
  try {
    return JSON.parse(window[where].getItem(key) ?? "null") as Value | null;
  } catch {
    return null;
  }
}

/** Where a machine in space is kept that is shown on a page of its own, for the views of the page above. */
export const IN_SPACE = "gruebler-in-space";

export interface InSpace {
  /** Whether it has other sizes than at first. */
  changed: boolean;
  titles: Record<Language, string>;
  /** Chain, frame and drives as text, and its links by their names in it. */
  text: string;
  links: Record<Language, Record<string, string>>;
  /** As the library reads it. */
  document: Record<string, unknown>;
}
