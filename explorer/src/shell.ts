/** What is around the views of every page: an element with styles of its own, light or dark; buttons and panels. */

import { h } from "./dom";
import { type Icon, icon } from "./icons";
import styles from "./style.css";

export type Theme = "light" | "dark";

/** The element of a page, and the shadow in which the page stands with its styles. */
export function shell(parent: HTMLElement, height: string, more = ""): { host: HTMLElement; shadow: ShadowRoot } {
  const host = h("div.gruebler-explorer", {});
  parent.append(host);
  Object.assign(host.style, { display: "block", height });
  const shadow = host.attachShadow({ mode: "open" });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(styles + more);
  shadow.adoptedStyleSheets = [sheet];
  return { host, shadow };
}

/** What the reader's system asks for. */
export function firstTheme(): Theme {
  return window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

export function setTheme(host: HTMLElement, theme: Theme, alone: boolean): void {
  host.dataset.theme = theme;
  // a page that is longer than the window is of one colour down to its end
  if (alone) document.documentElement.style.background = getComputedStyle(host).getPropertyValue("--paper");
}

/** A button of the header. */
export function tool(sign: Icon, title: string, act: () => void, disabled = false): HTMLElement {
  return h("button.quiet", { title, "aria-label": title, "data-icon": sign, onclick: act, disabled }, icon(sign));
}

/** A button over the picture. */
export function stageButton(sign: Icon, title: string, onclick: () => void): HTMLElement {
  return h("button", { title, "aria-label": title, onclick }, icon(sign));
}

/** A panel beside the picture, open or closed. */
export function panelOf(key: string, title: string, open: boolean, ...content: Node[]): HTMLDetailsElement {
  return h("details", { open, "data-panel": key }, h("summary", {}, title), h("div", {}, ...content));
}
