/** The panels beside the stage: sizes, coupler points, assembly modes, options. */

import { applyDocument, documentOf } from "./document";
import { h, renew } from "./dom";
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
  addPoint(link: number, x: number, y: number): void;
  /** Draw everything anew. */
  show(): void;
  redraw(): void;
}

const MOST_SIZES = 60;

// --- sizes -----------------------------------------------------------------------------------------------------------

/** A label, a field and a unit for each size; the fields stay while the linkage does, so that one can type on. */
export class SizeRows {
  readonly element = h("div", { class: "rows" });
  private fields: HTMLInputElement[] = [];
  private names = "";

  constructor(private readonly editor: Editor) {}

  show(): void {
    const { editor } = this;
    const lengths = editor.dragging.lengths();
    const sizes = lengths.slice(0, MOST_SIZES);
    const rows = sizes.map((size) => sizeRow(editor, size));
    const names = rows.map(([label]) => label!.outerHTML).join("");
    if (names !== this.names || !this.element.isConnected) {
      this.names = names;
      this.fields = rows.map(([, input]) => input as HTMLInputElement);
      const more = lengths.length - sizes.length;
      const rest =
        more > 0 ? [h("p", { class: "note" }, t("{count} more sizes are not listed.", { count: more }))] : [];
      renew(this.element, ...rows.flat(), ...rest);
      return;
    }
    sizes.forEach(({ value }, k) => {
      this.fields[k]!.value = number(value, 7);
      this.fields[k]!.setAttribute("aria-invalid", "false");
    });
  }
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
      if (right) editor.attempt(() => editor.dragging.setLength(first, second, wanted));
      input.setAttribute("aria-invalid", String(!right));
      if (right) return;
      editor.page.say(t("Expected a length, such as {value}.", { value: number(value, 4) }));
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
  const { linkage, shown } = editor;
  const { model } = linkage;
  const rows = linkage.sizes.points.map((_, k) => pointRow(editor, k));
  const { frame, own } = model;
  const links = [...model.links.slice(0, own).keys()]
    .filter((k) => k !== frame)
    .map((k) => h("option", { value: k, selected: k === shown.link }, linkage.linkName(k)));
  const link = h(
    "select",
    { "aria-label": t("Link of a new point"), onchange: () => (shown.link = Number(link.value)) },
    ...links,
  );
  const add = () => {
    const mine = linkage.sizes.elementsOn(shown.link).map((k) => linkage.elementAt(k));
    const mean = (axis: 0 | 1) => mine.reduce((sum, p) => sum + p[axis], 0) / (mine.length || 1);
    editor.addPoint(shown.link, mean(0), mean(1) + 0.3 * linkage.size);
  };
  return h(
    "div",
    {},
    h("div", { class: "point-rows" }, ...rows),
    h(
      "div",
      { class: "form" },
      link,
      h("button", { class: "plain", "data-act": "add-point", onclick: add }, t("Add a point")),
    ),
    h(
      "p",
      { class: "note" },
      t("A double-click puts a point: on a link, or beside all links on the one chosen here. Points are dragged."),
    ),
  );
}

/** Name and place of a point on its link, to be typed. */
function pointRow(editor: Editor, k: number): HTMLElement {
  const { linkage } = editor;
  const { points } = linkage.sizes;
  const point = points[k]!;
  const rename = (field: HTMLInputElement) => {
    const name = field.value.trim();
    const taken = [...linkage.model.links, ...points.filter((one) => one !== point).map((one) => one.name)];
    if (/^[^\s=(){};,]+$/.test(name) && !taken.includes(name)) editor.edit(() => (point.name = name));
    else editor.page.say(t("Expected a name that nothing else has, without spaces and brackets."));
  };
  const coordinate = (axis: 0 | 1) => (field: HTMLInputElement) => {
    const value = parsed(field.value);
    field.setAttribute("aria-invalid", String(!Number.isFinite(value)));
    if (Number.isFinite(value)) editor.edit(() => (point.at[axis] = value));
    else editor.page.say(t("Expected a number, such as {value}.", { value: numberText(point.at[axis]) }));
  };
  const typed = (key: string, label: string, value: string, take: (field: HTMLInputElement) => void) => {
    const field = h("input", {
      value,
      "data-field": `${key}-${k}`,
      "aria-label": `${label} ${point.name}`,
      onchange: () => later(() => take(field)),
      onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
    });
    return field;
  };
  const remove = () => editor.edit(() => points.splice(k, 1));
  const row = h(
    "div",
    { class: "point-row" },
    h("i", {}),
    typed("point-name", t("Name"), point.name, rename),
    h("span", { class: "unit" }, linkage.linkName(point.link)),
    h("button", { class: "quiet", "aria-label": t("Remove {name}", { name: point.name }), onclick: remove }, "×"),
    h("span", { class: "unit" }, "x"),
    typed("point-x", "x", numberText(point.at[0]), coordinate(0)),
    h("span", { class: "unit" }, "y"),
    typed("point-y", "y", numberText(point.at[1]), coordinate(1)),
  );
  row.style.setProperty("--own", `var(${ownColour(k)})`);
  return row;
}

function numberText(value: number): string {
  return number(value, 7);
}

/** After the browser has moved the focus: a field that was left must not be replaced before. */
function later(act: () => void): void {
  setTimeout(act, 0);
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
  renew(place, ...choices);
}

// --- options ---------------------------------------------------------------------------------------------------------

export function optionsPanel(editor: Editor): HTMLElement {
  const { linkage, shown } = editor;
  const option = (key: Exclude<keyof Shown, "link" | "forces">, text: string) => {
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
