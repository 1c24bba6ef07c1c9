/** The panels beside the stage: sizes, coupler points, assembly modes, options. */

import { applyDocument, documentOf } from "./document";
import { h } from "./dom";
import type { Dragging, Length } from "./dragging";
import { number, parsed, t } from "./language";
import type { Linkage } from "./linkage";
import type { LinkageDocument } from "./model";
import { ownColour, type Shown } from "./shown";
import type { Page } from "./view";
import { awaited } from "./waiting";

/** An assembly mode that the library found. */
interface Mode {
  label: string;
  document: LinkageDocument;
}

/** What the panels show and change. */
export interface Editor {
  readonly page: Page;
  readonly linkage: Linkage;
  readonly dragging: Dragging;
  readonly shown: Shown;
  /** Change sizes; where that is impossible, say why. It can be undone. */
  attempt(change: () => void): void;
  /** Change the points; it can be undone. */
  edit(change: () => void): void;
  /** Draw everything anew. */
  show(): void;
  redraw(): void;
}

const MOST_SIZES = 60;

// --- sizes -----------------------------------------------------------------------------------------------------------

/** A label, a field and a unit for each size. */
export function sizeRows(editor: Editor): HTMLElement[] {
  const sizes = editor.dragging.lengths().slice(0, MOST_SIZES);
  return sizes.flatMap((size) => sizeRow(editor, size));
}

function sizeRow(editor: Editor, { link, first, second, value }: Length): HTMLElement[] {
  const { linkage } = editor;
  const { joints, unit } = linkage.model;
  const others = (k: number) => {
    const element = linkage.sizes.element(k);
    const links = joints[element.joint]!.links.filter((other) => other !== element.link);
    return links.map((other) => linkage.linkName(other)).join(", ");
  };
  const id = `size-${first}-${second}`;
  const input = h("input", {
    id,
    value: number(value, 7),
    inputmode: "decimal",
    onchange: () => {
      const wanted = parsed(input.value);
      const right = wanted >= 0;
      input.setAttribute("aria-invalid", String(!right));
      if (right) editor.attempt(() => editor.dragging.setLength(first, second, wanted));
      else editor.page.say(t("Expected a length, such as {value}.", { value: number(value, 4) }));
    },
    onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
  });
  const name = linkage.linkName(link);
  const ends = `${others(first)} – ${others(second)}`;
  const label = h("label", { for: id, title: `${name}: ${ends}` }, h("b", {}, name), ` ${ends}`);
  return [label, input, h("span", { class: "unit" }, unit)];
}

// --- points ----------------------------------------------------------------------------------------------------------

export function pointsPanel(editor: Editor): HTMLElement {
  const { linkage } = editor;
  const chips = linkage.sizes.points.map((point, k) => {
    const remove = () => editor.edit(() => linkage.sizes.points.splice(k, 1));
    const chip = h(
      "span",
      { class: "chip" },
      h("i", {}),
      `${point.name} · ${linkage.linkName(point.link)}`,
      h("button", { "aria-label": t("Remove {name}", { name: point.name }), onclick: remove }, "×"),
    );
    chip.style.setProperty("--own", `var(${ownColour(k)})`);
    return chip;
  });
  return h(
    "div",
    {},
    h("div", { class: "chips" }, ...chips),
    h("p", { class: "note" }, t("Double-click on a link to add a point that traces its curve.")),
  );
}

// --- assembly modes --------------------------------------------------------------------------------------------------

export function modesPanel(editor: Editor): HTMLElement {
  const { linkage } = editor;
  const groups = linkage.model.groups.filter((group) => group.modes);
  if (!groups.length) return h("p", { class: "note" }, t("There is one assembly mode only."));
  const chips = groups.map(({ dyad, form, links, number: mode }) => {
    const text = `${form} {${linkage.linkList(links)}}`;
    if (!dyad) return h("div", { class: "chip" }, text);
    const onclick = () => editor.attempt(() => linkage.switchMode(mode));
    const sign = linkage.state.signs[mode]! < 0 ? "−" : "+";
    return h("button", { class: "plain", "data-mode": mode, onclick }, `${text}  ${sign}`);
  });
  const own = h("div", { class: "chips" }, ...chips);
  if (!editor.page.served || groups.every((group) => group.dyad)) return own;
  const onclick = () => void listModes(editor, all);
  const all = h(
    "div",
    { class: "chips" },
    h("button", { class: "plain", "data-act": "modes", onclick }, t("All assembly modes at this position")),
  );
  return h("div", {}, own, all);
}

/** The assembly modes of larger groups, which the library finds; a click takes one. */
async function listModes(editor: Editor, place: HTMLElement): Promise<void> {
  const { linkage } = editor;
  const drives = [...linkage.drives].slice(0, linkage.model.drives.length);
  const question = { document: documentOf(linkage), drives };
  const found = await awaited(place, () => editor.page.ask<Mode[]>("modes", question));
  if (!found || linkage !== editor.linkage) return;
  const take = (document: LinkageDocument) => {
    const drive = drives[linkage.active] ?? linkage.drives[linkage.active]!;
    const elements = documentOf(linkage).elements!;
    editor.attempt(() => applyDocument(linkage, { ...document, elements }, drive));
    editor.show();
  };
  const choices = found.map(({ label, document }) =>
    h("button", { class: "plain", "data-mode": label, onclick: () => take(document) }, label),
  );
  place.replaceChildren(...choices);
}

// --- options ---------------------------------------------------------------------------------------------------------

export function optionsPanel(editor: Editor): HTMLElement {
  const { linkage, shown } = editor;
  const option = (key: Exclude<keyof Shown, "link">, text: string) => {
    const onchange = () => {
      shown[key] = box.checked;
      editor.show();
    };
    const box = h("input", { type: "checkbox", checked: shown[key], onchange });
    return h("label", {}, box, text);
  };
  const { frame, links, own } = linkage.model;
  const choices = [...links.slice(0, own).keys()]
    .filter((k) => k !== frame)
    .map((k) => h("option", { value: k, selected: k === shown.link }, linkage.linkName(k)));
  const onchange = () => {
    shown.link = Number(link.value);
    editor.redraw();
  };
  const link = h("select", { "aria-label": t("Link"), onchange }, ...choices);
  return h(
    "div",
    { class: "options" },
    option("curves", t("Coupler curves")),
    option("velocities", t("Velocities")),
    option("accelerations", t("Accelerations")),
    option("hodographs", t("Hodographs of the points")),
    option("poles", t("Pole and centrodes")),
    option("inflection", t("Inflection circle")),
    h("label", {}, t("of the link"), link),
    option("labels", t("Names")),
    option("grid", t("Grid")),
  );
}
