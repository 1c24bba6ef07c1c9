/** What is around the views of every page: an element with styles of its own, light or dark; buttons and panels. */

import { h } from "./dom";
import { type Icon, icon } from "./icons";
import { t } from "./language";
import { store, stored } from "./storing";

export type Theme = "light" | "dark";

/** The element of a page, and the shadow in which the page stands: those of the HTML with its styles, else new ones. */
export function shell(parent: HTMLElement, height: string, styles = ""): { host: HTMLElement; shadow: ShadowRoot } {
  const outlined = parent.querySelector<HTMLElement>(".gruebler-explorer");
  const host = outlined ?? h("div.gruebler-explorer", {});
  Object.assign(host.style, { display: "block", height });
  const shadow = host.shadowRoot ?? host.attachShadow({ mode: "open" });
  const outline = host.querySelector("template"); // which an older browser left as it was
  if (outline) shadow.append(outline.content);
  if (!outlined) {
    parent.append(host);
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(styles);
    shadow.adoptedStyleSheets = [sheet];
  }
  return { host, shadow };
}

const THEME = "gruebler-theme";

/** What the reader chose last, else what the system asks for. */
export function firstTheme(): Theme {
  const asked = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  return stored<Theme>(THEME, "localStorage") ?? asked;
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

/** The button for the other theme, which is kept for the next page; then the pictures take its colours. */
export function themeTool(host: HTMLElement, alone: boolean, recolour: () => void): HTMLElement {
  return tool("theme", t("Light or dark"), () => {
    const other = host.dataset.theme === "dark" ? "light" : "dark";
    store(THEME, other, "localStorage");
    setTheme(host, other, alone);
    recolour();
  });
}

/** A button over the picture. */
export function stageButton(sign: Icon, title: string, onclick: () => void): HTMLElement {
  return h("button", { title, "aria-label": title, onclick }, icon(sign));
}

/** The buttons that enlarge the picture and show all of it. */
export function zoomButtons(picture: { zoom(factor: number): void; fit(): void }): HTMLElement[] {
  return [
    stageButton("more", t("Zoom in"), () => picture.zoom(1.25)),
    stageButton("less", t("Zoom out"), () => picture.zoom(0.8)),
    stageButton("fit", t("Show everything"), () => picture.fit()),
  ];
}

/** A button that removes what is called so. */
export function cross(name: string, onclick: () => void): HTMLElement {
  return h("button.quiet", { "aria-label": t("Remove {name}", { name }), onclick }, "×");
}

/** A button that keeps something of what is called so; whether it does is shown by who has it. */
export function lockButton(kind: string, title: string, name: string, onclick: () => void): HTMLElement {
  const sign = icon(kind === "direction" ? "angle" : "lock");
  return h("button.lock", { title, "aria-label": `${title}: ${name}`, "data-lock": kind, onclick }, sign);
}

/** A panel beside the picture, open or closed. */
export function panelOf(key: string, title: string, open: boolean, ...content: Node[]): HTMLDetailsElement {
  return h("details", { open, "data-panel": key }, h("summary", {}, title), h("div", {}, ...content));
}
