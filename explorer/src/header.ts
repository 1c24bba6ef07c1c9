/** Parts of the header: the tabs of the views, the choice of the language, what is said under it. */

import { h, menu } from "./dom";
import { currentLanguage, type Language, setLanguage, t } from "./language";
import { tool } from "./shell";

/** What long words of German names end with, or go on with. */
const PARTS =
  "antrieb|differential|führung|funktion|gelenk|getriebe|greifer|haube|hebe|kette|kinematik|kompressor|lampe|lenk|" +
  "maschine|presse|räder|scheibe|schneider|schwinge|stange|verdichter|vorrichtung|wischer|zylinder";

/** A name that can be broken within long words, also where the browser has no dictionary, but not before a dash, nor
 * after a letter alone between two hyphens. */
export function softened(name: string): string {
  const between = new RegExp(`(?<=\\p{L}{4})(?<!ge)(?=${PARTS})`, "gu");
  const held = name.replace(" –", "\u00a0–").replace(/-\p{Lu}-/gu, "$&\u2060");
  return held.replace(/\p{L}{15,}/gu, (word) => word.replace(between, "\u00ad"));
}

/** A name in parts: what stands in brackets is left out where the header is narrow. */
export function partsOf(name: string): (Node | string)[] {
  const parts = softened(name).split(/(?= \()|(?<=\))/);
  return parts.map((part) => (part[1] === "(" ? h("span.letter", {}, part) : part));
}

/** The names of the views in the language of the page. */
export function viewNames(): Record<string, string> {
  return {
    build: t("Draw"),
    structure: t("Structure"),
    motion: t("Motion"),
    synthesis: t("Synthesis"),
    catalog: t("Catalog"),
    exercises: t("Exercises"),
  };
}

/** A tab for each view; arrows, Home and End lead from one to the next, which keeps the focus. */
export function tabs(keys: string[], chosen: string, turnTo: (key: string) => void): HTMLElement {
  const names = viewNames();
  const step = (event: KeyboardEvent) => {
    const here = keys.indexOf(chosen);
    const steps: Record<string, number> = {
      ArrowLeft: (here + keys.length - 1) % keys.length,
      ArrowRight: (here + 1) % keys.length,
      Home: 0,
      End: keys.length - 1,
    };
    const next = keys[steps[event.key] ?? -1];
    if (next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const header = (event.currentTarget as Element).parentElement!;
    turnTo(next);
    header.querySelector<HTMLElement>(`[data-view="${next}"]`)?.focus();
  };
  const tab = (key: string) => {
    const here = key === chosen;
    const state = { tabindex: here ? 0 : -1, "data-view": key, "aria-selected": String(here) };
    return h("button", { role: "tab", ...state, onclick: () => turnTo(key) }, names[key]!);
  };
  const list = h("nav", { role: "tablist", onkeydown: step }, ...keys.map(tab));
  return centred(list);
}

/** On a phone tabs are wider than the screen: the chosen one stands in the middle, the page where it is. */
export function centred(list: HTMLElement): HTMLElement {
  requestAnimationFrame(() => {
    const here = list.querySelector<HTMLElement>("[aria-selected=true], [aria-current]");
    if (here) list.scrollLeft = here.offsetLeft - list.offsetLeft - (list.clientWidth - here.offsetWidth) / 2;
  });
  return list;
}

/** The languages of the page; after a choice everything is laid out anew. */
export function languageMenu(arrange: () => void): HTMLElement {
  const languages = Object.entries({ en: "English", de: "Deutsch" });
  return menu(t("Language"), languages, currentLanguage(), (value) => {
    setLanguage(value as Language);
    arrange();
  });
}

/** Say a sentence in its place under the header, an error or what is done; without a text the last one goes. */
export function sayIn(place: HTMLElement, text: string, kind: "error" | "done", action?: HTMLElement): void {
  if (place.firstChild?.textContent === text && !action) return;
  place.hidden = !text;
  place.classList.toggle("done", kind === "done");
  const close = h("button.quiet", { "aria-label": t("Close"), onclick: () => sayIn(place, "", "error") }, "×");
  place.replaceChildren(h("span", {}, text, action && " ", action), close);
}

/** Say that there is no connection, or no more. */
export function sayWhetherOn(place: HTMLElement, on: boolean): void {
  place.hidden = on;
  place.textContent = t("The connection to gruebler is lost until the server is back.");
}

/** The button of what can be taken away, on a wide page with its word. */
export function saving(show: () => void): HTMLElement {
  const button = tool("save", t("Save and export"), show);
  button.append(h("span.letter", {}, t("Save")));
  return button;
}
