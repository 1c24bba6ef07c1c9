/** What is chosen in the drawing, and what can be done with it. */

import { digits } from "./digits";
import { action, h } from "./dom";
import {
  called,
  type Drawing,
  driven,
  isPin,
  knotName,
  renamed,
  same,
  split,
  turned,
  unitOf,
  without,
  withoutLink,
  withoutLoose,
} from "./drawing";
import { parsed, spaced, t } from "./language";
import { lengthOf, movedKept, spansOf, withLength } from "./lengths";
import { isPicture, type Plane } from "./plane";
import type { Pair } from "./rows";

const SHEET = 88; // pixels at an edge of the plane, with what can be done with what is chosen

/** The view of a drawing, as far as it is changed here. */
interface Changing extends Plane {
  /** How far a new end is put beside others. */
  readonly step: number;
  /** Nothing is a change that is not possible, for this reason. */
  change(next: Drawing | null, text?: string): void;
}

/** Take what is chosen out of the drawing, and the links that only it held. */
export function removeChosen(view: Changing): void {
  const { chosen, drawing } = view;
  if (!chosen) return;
  const { knot, link } = chosen;
  let next: Drawing = { ...drawing, picture: undefined };
  if (knot !== null) next = without(drawing, knot);
  else if (link !== null) next = withoutLink(drawing, link);
  view.change(withoutLoose(drawing, next));
}

/** Whether more is at the lower edge of the plane, where else stands what can be done with what is chosen, than at the
 * upper one. */
export function isLow({ chosen, drawing, viewport }: Plane): boolean {
  const more = drawing.knots.reduce((sum, { at, links }, k) => {
    const [, y] = viewport.screen(...at);
    const worth = k === chosen?.knot || links.includes(chosen?.link ?? "") ? 99 : 1;
    if (y > viewport.height - SHEET) return sum + worth;
    return y < SHEET ? sum - worth : sum;
  }, 0);
  return more > 0;
}

/** A number in a field that changes the drawing. */
export function field(
  view: Changing,
  text: string,
  key: string,
  value: number,
  set: (value: number) => Drawing | null,
) {
  const input: HTMLInputElement = h("input", {
    ...digits(
      value,
      view.drawing.knots.flatMap(({ at }) => at),
    ),
    size: 7,
    inputmode: "decimal",
    "data-field": key,
    onchange: () => {
      const next = set(parsed(input.value));
      input.setAttribute("aria-invalid", String(!next));
      if (next) view.change(next);
    },
  });
  return h("label", {}, text, input);
}

/** The length of a link with two joints. */
function lengthField(view: Changing, link: string): HTMLElement[] {
  const { drawing } = view;
  const [span, more] = spansOf(drawing).filter((one) => one.link === link);
  if (!span || more) return [];
  const set = (value: number) => withLength(drawing, span, value);
  return [field(view, `${t("Length")} [${unitOf(drawing)}]`, "length", lengthOf(drawing, span.ends), set)];
}

/** The direction of a slide is typed. */
function slideField(view: Changing, slide: number): HTMLElement {
  const set = (value: number) => (Number.isFinite(value) ? turned(view.drawing, slide, value) : null);
  return field(view, "φ [°]", "slide", view.drawing.knots[slide]!.slide!, set);
}

const NAMING = () => t("Expected a new name without spaces and brackets.");

function nameField(value: string, key: string, set: (text: string) => void): HTMLElement {
  const onchange = () => set(input.value.trim().replaceAll(" ", "_"));
  const input: HTMLInputElement = h("input", { value, size: 7, "data-field": key, onchange });
  return h("label", {}, t("Name"), input);
}

export function choiceOf(view: Changing): HTMLElement[] {
  const { chosen, drawing } = view;
  const removing = action("remove", () => removeChosen(view), t("Remove"));
  if (!chosen) return [];
  const { link } = chosen;
  if (isPicture(chosen)) return [h("b", {}, t("Drag it; its corner sizes it, the grip turns it.")), removing];
  if (link !== null) {
    const name = nameField(spaced(link), "link-name", (text) => view.change(renamed(drawing, link, text), NAMING()));
    const frame = action("frame", () => view.change({ ...drawing, frame: link, drives: [] }), t("Hold as frame"));
    return [name, ...lengthField(view, link), frame, removing];
  }
  const knot = chosen.knot!;
  const { at, between, links } = drawing.knots[knot]!;
  // a block and its slide lie at one place
  const slide = drawing.knots.findIndex((one) => one.slide !== undefined && same(one, drawing.knots[knot]!));
  const joints = [...new Set([knot, slide])].filter((k) => drawing.knots[k]?.links[1]);
  const parts = joints.map((k) => {
    const text = drawing.drives.includes(k) ? t("Not driven") : t("Drive");
    const letter = joints[1] === undefined ? "" : ` ${knotName(drawing, k)}`;
    return action("drive", () => view.change(driven(drawing, k)), text + letter);
  });
  parts.push(removing);
  if (links[1] && isPin(drawing.knots[knot]!))
    parts.push(action("split", () => view.change(split(drawing, knot, view.step / 2)), t("Split")));
  const places = (["x", "y"] as const).map((key, axis) =>
    field(view, key, key, at[axis]!, (value) => {
      const place: Pair = axis ? [at[0], value] : [value, at[1]];
      return Number.isFinite(value) ? movedKept(drawing, knot, place, true) : null;
    }),
  );
  const own = knotName(drawing, knot);
  const name = `${own}: ${links.map(spaced).join(" – ")}`;
  // on a phone joints have their places in the table, and no room for a name
  const naming =
    view.viewport.narrow && links[1]
      ? []
      : [nameField(own, "knot-name", (text) => view.change(called(drawing, knot, text), NAMING()))];
  return [
    h("b", {}, name),
    ...naming,
    ...(between ? [] : places),
    ...(slide < 0 ? [] : [slideField(view, slide)]),
    ...parts,
  ];
}
