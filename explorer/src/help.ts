/** The list of keys. */

import { h } from "./dom";
import { t } from "./language";

/** Show the keys of the page over it, until they are read. */
export function showKeys(root: HTMLElement): void {
  const rows: [string, string][] = [
    [t("Space"), t("play and pause")],
    ["Esc", t("give up a drag")],
    [t("Shift"), t("while dragging: in line with others, on the grid, at round angles and lengths of other links")],
    ["← →", t("move the drive by 1°, with Shift by 10°")],
    ["Tab, ← → ↑ ↓", t("choose a joint and move it, with Shift in small steps")],
    [t("Enter, double-click"), t("let a joint stay where it is while others are dragged")],
    ["Ctrl Z, Ctrl Y", t("undo, redo")],
    ["+ − 0", t("zoom, show everything")],
    ["?", t("this list")],
  ];
  showRows(root, rows);
}

/** Show what keys do, until it is read. */
export function showRows(root: HTMLElement, rows: [string, string][]): void {
  const dialog = h(
    "dialog",
    { "aria-label": t("Keys") },
    h("table", {}, ...rows.map(([key, text]) => h("tr", {}, h("td", {}, h("kbd", {}, key)), h("td", {}, text)))),
    h("form", { method: "dialog" }, h("button.key", {}, t("Close"))),
  );
  dialog.addEventListener("close", () => dialog.remove());
  root.append(dialog);
  dialog.showModal();
}
