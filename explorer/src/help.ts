/** Keys: what they do, the list of them; and how it and other sheets are shown over the page. */

import { type Child, h } from "./dom";
import { t } from "./language";
import { KEYS, wordsOf } from "./palette";
import type { Transport } from "./transport";

interface Picture {
  zoom(factor: number): void;
  fit(): void;
}

/** Show the keys of the page over it, those for drawing where one draws, until they are read. */
export function showKeys(root: HTMLElement, draws: boolean): void {
  const ctrl = t("Ctrl");
  const rows: [string, string][] = [
    [t("Space"), t("play and pause")],
    ["Esc", t("give up a drag")],
    [t("Shift"), t("snap while dragging")],
    ["← →", t("move the drive a little (an angle by 1°), with Shift ten times as far")],
    ["Tab, ← → ↑ ↓", t("move a joint, with Shift in small steps")],
    [t("Enter, double-click"), t("hold or release a joint")],
    [`${ctrl} Z, ${ctrl} Y`, t("undo, redo")],
    [`${ctrl} S`, t("save as JSON")],
    ["+ − 0", t("zoom, show everything")],
    ["?", t("this list")],
  ];
  const tools = `${t("Draw")}: ${Object.values(KEYS)
    .map((tool) => wordsOf(tool)[0])
    .join(", ")}`;
  if (draws) rows.push([Object.keys(KEYS).join(" ").toUpperCase(), tools]);
  showRows(root, rows);
}

/** Show what keys do, until it is read. */
export function showRows(root: HTMLElement, rows: [string, string][]): void {
  const line = ([key, text]: [string, string]) => h("tr", {}, h("td", {}, h("kbd", {}, key)), h("td", {}, text));
  showOver(root, t("Keys"), h("table", {}, ...rows.map(line)));
}

/** Show something over the page, until it is closed. */
export function showOver(root: HTMLElement, title: string, ...content: Child[]): HTMLDialogElement {
  const close = h("button.quiet", { "aria-label": t("Close") }, "×");
  const head = h("form.sheet-head", { method: "dialog" }, h("h2", {}, title), close);
  const dialog = h("dialog", { "aria-label": title, onclose: () => dialog.remove() }, head, ...content);
  root.append(dialog);
  dialog.showModal();
  return dialog;
}

/** Do what a key does with the drive and the picture; whether it does anything. */
export function drivenBy(event: KeyboardEvent, target: Element, transport: Transport, picture: Picture): boolean {
  const far = event.shiftKey ? 10 : 1;
  const way = { ArrowRight: far, ArrowLeft: -far }[event.key];
  const plays = event.key === " " && !target.matches("button, summary, a, [type=checkbox]");
  if (way) transport.nudge(way);
  else if (plays) transport.toggle();
  return !!way || plays || zoomedBy(event, picture);
}

/** Do what a key does with a picture; whether it does anything. */
export function zoomedBy({ key }: KeyboardEvent, picture: Picture): boolean {
  if (key === "0") picture.fit();
  else if (key === "+" || key === "-") picture.zoom(key === "+" ? 1.25 : 0.8);
  else return false;
  return true;
}
