/** The panels beside the stage: sizes, coupler points, assembly modes, options. */

import type { Ruler } from "./beside";
import { digits, showDigits } from "./digits";
import { applyDocument, documentOf } from "./document";
import { action, h, option, renew } from "./dom";
import { type Dragging, type Length, LONGEST } from "./dragging";
import { isFace } from "./followers";
import { softened } from "./header";
import { middleOf } from "./hull";
import { number, parsed, t } from "./language";
import type { Kept } from "./locks";
import type { LinkageDocument } from "./model";
import { type Resizer, resize } from "./roundfields";
import { roundRows } from "./rounds";
import { renameEnds } from "./rulers";
import { cross, lockButton } from "./shell";
import { ownColour, type Shown } from "./shown";
import { endsOf } from "./springs";
import { awaited } from "./waiting";

/** An assembly mode that the library found. */
interface Mode {
  label: string;
  document: LinkageDocument;
}

/** What the panels show and change. */
export interface Editor extends Resizer {
  readonly dragging: Dragging;
  readonly shown: Shown;
  readonly stage: { fit(): void };
  /** Change sizes, or make a part of the change; where that is impossible, say why, and if the sizes can be told offer
   * other drive values. It can be undone. */
  attempt(change: (part?: number) => void, told?: (part: number) => string): void;
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
  readonly element = h("div.rows.sizes", {});
  #fields: HTMLInputElement[] = [];
  #locks: HTMLElement[] = [];
  #labels: HTMLElement[] = [];
  #names = "";

  constructor(private readonly editor: Editor) {}

  show(): void {
    const { editor } = this;
    const lengths = editor.dragging.lengths();
    const sizes = lengths.slice(0, MOST_SIZES);
    // the only length of a link needs no other name
    const alone = ({ link }: Length) => sizes.filter((one) => one.link === link).length === 1;
    const rows = sizes.map((size) => sizeRow(editor, size, alone(size)));
    const fixed = roundRows(editor);
    const names = [...rows.map(([label]) => label!), ...fixed].map((one) => one.outerHTML).join("");
    const anew = names !== this.#names || !this.element.isConnected;
    this.element.closest("details")!.hidden = !names;
    if (anew) {
      this.#names = names;
      this.#labels = rows.map(([label]) => label!);
      this.#fields = rows.map(([, input]) => input as HTMLInputElement);
      // behind all fields, so that Tab leads from field to field
      this.#locks = rows.map((row, k) => {
        const last = row.pop()!;
        last.style.gridArea = `${k + 1} / 4`;
        return last;
      });
      const more = lengths.length - sizes.length;
      const rest = more > 0 ? [h("p.note", {}, t("… {count} more", { count: more }))] : [];
      renew(this.element, ...rows.flat(), ...this.#locks, ...rest, ...fixed);
    }
    sizes.forEach(({ link }, k) => {
      this.#labels[k]!.classList.toggle("chosen", link === editor.shown.chosen);
    });
    if (anew) return;
    sizes.forEach(({ first, second }, k) => {
      for (const button of this.#locks[k]!.children) showLock(editor, button as HTMLElement, first, second);
      this.#fields[k]!.setAttribute("aria-invalid", "false");
    });
    this.follow();
  }

  /** The same sizes while a joint is dragged. */
  follow(): void {
    const lengths = this.editor.dragging.lengths();
    for (const [k, field] of this.#fields.entries()) showDigits(field, lengths[k]!.value);
  }
}

function sizeRow(editor: Editor, { link, first, off, second, value }: Length, alone: boolean): HTMLElement[] {
  const { linkage } = editor;
  const { joints, unit } = linkage.model;
  const others = (k: number) => {
    const element = linkage.sizes.element(k);
    const letter = linkage.letterOf(element.joint);
    if (letter) return letter;
    const links = joints[element.joint]!.links.filter((other) => other !== element.link);
    return links.map((other) => linkage.linkName(other)).join(", ");
  };
  const id = `size-${first}-${second}`;
  const input = h("input", {
    id,
    ...digits(value),
    inputmode: "decimal",
    onchange: () => {
      const wanted = parsed(input.value);
      const right = wanted >= 0 && wanted < LONGEST;
      const here = editor.dragging.lengths().find((one) => one.first === first && one.second === second)!;
      const at = (part: number) => here.value + part * (wanted - here.value);
      const told = (part: number) => `${name} ${number(at(part))} ${unit}`;
      if (right) editor.attempt((part = 1) => editor.dragging.setLength(first, second, at(part)), told);
      input.setAttribute("aria-invalid", String(!right));
      // a body with a face on a cam is drawn anew
      const face = [first, second].find((k) => isFace(linkage, k));
      if (!right)
        editor.page.say(t("Expected a length of at least 0 and below 10⁹, such as {value}.", { value: number(value) }));
      else if (face !== undefined && editor.page.served) void resize(editor, face, {}, input);
    },
    onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
  });
  const frame = off && link === linkage.model.frame;
  const called = [...(frame ? [] : [linkage.linkName(link)]), ...(off ? [t("eccentricity")] : [])];
  const name = called.join(", ");
  const lettered = linkage.letterOf(0);
  const ends = `${others(first)}${lettered ? "–" : " – "}${others(second)}`;
  const short = lettered && !off;
  const told = alone ? called : [...called, ends];
  const [own, ...more] = short ? [ends] : told;
  const bold = h("b", {}, softened(own!));
  const label = h("label", { for: id, title: `${name}: ${ends}` }, bold, softened(["", ...more].join(", ")));
  return [
    label,
    input,
    h("span.unit", {}, unit),
    h("span.locks", {}, ...(off ? [] : locksOf(editor, first, second, name))),
  ];
}

/** Buttons that keep a length, or a direction, while joints are dragged. */
function locksOf(editor: Editor, first: number, second: number, name: string): HTMLElement[] {
  const lock = (kind: Kept, title: string) => {
    const onclick = () => editor.attempt(() => editor.dragging.locks.keep(kind, first, second));
    const button = lockButton(kind, title, name, onclick);
    showLock(editor, button, first, second);
    return button;
  };
  return [lock("length", t("Keep this length")), lock("direction", t("Keep this direction"))];
}

function showLock({ dragging }: Editor, button: HTMLElement, first: number, second: number): void {
  const pressed = dragging.locks.keeps(button.dataset.lock as Kept, first, second);
  button.setAttribute("aria-pressed", String(pressed));
}

// --- points ----------------------------------------------------------------------------------------------------------

/** The links that move, of which one is chosen for new points and poles. */
function linkMenu(editor: Editor, label: string): HTMLElement {
  const { linkage, shown } = editor;
  const { frame, links, own } = linkage.model;
  const choices = [...links.slice(0, own).keys()]
    .filter((k) => k !== frame)
    .map((k) => h("option", { value: k, selected: k === shown.link }, linkage.linkName(k)));
  const onchange = () => {
    shown.link = Number(link.value);
    editor.redraw();
  };
  const link = h("select", { "aria-label": label, onchange }, ...choices);
  return link;
}

export function pointsPanel(editor: Editor): HTMLElement {
  const { linkage, shown } = editor;
  const rows = linkage.sizes.points.map((_, k) => pointRow(editor, k));
  const link = linkMenu(editor, t("Link of a new point"));
  const add = () => {
    const mine = linkage.sizes.elementsOn(shown.link).map((k) => linkage.elementAt(k));
    const [x, y] = middleOf(mine);
    editor.addPoint(shown.link, x, y + 0.3 * linkage.size);
    editor.stage.fit();
  };
  return h(
    "div",
    {},
    h("div.point-rows", {}, ...rows),
    h("div.form", {}, link, action("add-point", add, t("Add a point"))),
    h("p.note", {}, t("Double-click or double-tap a link to add a point.")),
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
    if (/^[^\s=(){};,]+$/.test(name) && !taken.includes(name))
      editor.edit(() => {
        renameEnds(linkage, point.name, name);
        point.name = name;
      });
    else editor.page.say(t("Expected a new name without spaces and brackets."));
  };
  const coordinate = (axis: 0 | 1) => (field: HTMLInputElement) => {
    const value = parsed(field.value);
    field.setAttribute("aria-invalid", String(!Number.isFinite(value)));
    if (Number.isFinite(value)) editor.edit(() => (point.at[axis] = value));
    else editor.page.say(t("Expected a number, such as {value}.", { value: number(point.at[axis]) }));
  };
  const typed = (key: string, label: string, value: string | number, take: (field: HTMLInputElement) => void) => {
    const field = h("input", {
      ...(typeof value === "number" ? digits(value) : { value }),
      "data-field": `${key}-${k}`,
      "aria-label": `${label} ${point.name}`,
      onchange: () => later(() => take(field)),
      onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
    });
    return field;
  };
  const remove = () =>
    editor.edit(() => {
      renameEnds(linkage, point.name, `${linkage.model.links[point.link]}:${point.at}`);
      points.splice(k, 1);
    });
  const row = h(
    "div.point-row",
    {},
    h("i", {}),
    typed("point-name", t("Name"), linkage.pointName(point.name), rename),
    h("span.unit", {}, linkage.linkName(point.link)),
    cross(point.name, remove),
    h("span.unit", {}, "x"),
    typed("point-x", "x", point.at[0], coordinate(0)),
    h("span.unit", {}, "y"),
    typed("point-y", "y", point.at[1], coordinate(1)),
  );
  row.style.setProperty("--own", `var(${ownColour(k)})`);
  return row;
}

/** After the browser has moved the focus: a field that was left must not be replaced before. */
function later(act: () => void): void {
  setTimeout(act, 0);
}

// --- measurement lines ---------------------------------------------------------------------------------------------

/** Where measurement lines are put and removed. */
export function rulersPanel(editor: Editor): HTMLElement {
  const { linkage } = editor;
  const { rulers = [], ...rest } = linkage.beside;
  const ends = endsOf(linkage);
  const put = (next: Ruler[]) =>
    editor.edit(() => {
      linkage.beside = { ...rest, ...(next.length && { rulers: next }) };
    });
  const select = (text: string, chosen: number) =>
    h(
      "select",
      { "aria-label": text },
      ...ends.map(([, shownAs, name], k) => h("option", { value: name, selected: k === chosen }, shownAs)),
    );
  const [from, to] = [select(t("from"), 0), select(t("to"), ends.length - 1)];
  const add = () => {
    if (from.value !== to.value) put([...rulers, [from.value, to.value]]);
  };
  const called = (name: string) => ends.find((end) => end[2] === name)?.[1] ?? name;
  return h(
    "details.words",
    {},
    h("summary", {}, t("Measurement lines")),
    h("div.form", {}, from, to, action("measure", add, t("Add"))),
    ...rulers.map((ruler, k) => {
      const name = ruler.map(called).join(" – ");
      return h(
        "div.form",
        {},
        name,
        cross(name, () => put(rulers.filter((_, other) => other !== k))),
      );
    }),
  );
}

// --- assembly modes --------------------------------------------------------------------------------------------------

export function modesPanel(editor: Editor): HTMLElement {
  const { linkage } = editor;
  const groups = linkage.model.groups.filter((group) => group.modes);
  if (!groups.length) return h("p.note", {}, t("There is one assembly mode only."));
  const chips = groups.map(({ dyad, links, number: mode }) => {
    const text = linkage.linkList(links);
    if (!dyad) return h("span.note", {}, text);
    const onclick = () => editor.attempt(() => linkage.switchMode(mode));
    return h("button.plain", { "data-mode": mode, onclick }, t("{links}: other side", { links: text }));
  });
  const own = h("div.chips", {}, ...chips);
  if (!editor.page.served || groups.every((group) => group.dyad)) return own;
  const onclick = () => void listModes(editor, all);
  const all = h("div.chips", {}, action("modes", onclick, t("All assembly modes at this position")));
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
    h("button.plain", { "data-mode": label, onclick: () => take(document) }, label),
  );
  renew(place, ...choices);
}

// --- options ---------------------------------------------------------------------------------------------------------

export function optionsPanel(editor: Editor): HTMLElement {
  const { shown } = editor;
  type Key = Exclude<keyof Shown, "chosen" | "link" | "forces" | "springs">;
  const box = (key: Key, text: string, ...lines: HTMLElement[]) => {
    const label = option(text, shown[key], (on) => {
      shown[key] = on;
      editor.show();
    });
    label.append(...lines);
    return label;
  };
  /** What a line of the picture is, in its colour. */
  const line = (colour: "accent" | "green" | "motion" | "purple", words: string) => {
    const one = h("small", {}, words);
    one.style.color = `var(--${colour})`;
    return one;
  };
  const link = linkMenu(editor, t("Link"));
  return h(
    "div.options",
    {},
    box("curves", t("Coupler curves")),
    box("velocities", t("Velocities"), line("motion", "→")),
    box("accelerations", t("Accelerations"), line("accent", "⇢")),
    box("hodographs", t("Hodographs")),
    box("poles", t("Pole and centrodes"), line("green", `—\xa0${t("fixed")}`), line("purple", `┄\xa0${t("moving")}`)),
    box("inflection", t("Inflection circle"), line("green", "┄")),
    h("label", {}, t("of the link"), link),
    box("labels", t("Names")),
    box("grid", t("Grid")),
    box("snap", t("Snap")),
  );
}
