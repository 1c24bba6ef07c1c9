/** What is chosen in the drawing, and what can be done with it. */

import { digits } from "./digits";
import { action, h } from "./dom";
import {
  type Drawing,
  driven,
  isPin,
  type Knot,
  knotName,
  moved,
  renamed,
  split,
  unitOf,
  without,
  withoutLink,
  withoutLoose,
} from "./drawing";
import { parsed, spaced, t } from "./language";
import { isPicture, type Plane } from "./plane";
import type { Pair } from "./rows";

const SHEET = 90; // pixels at an edge of the plane, with what can be done with what is chosen

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

/** Whether what is chosen is at the lower edge of the plane, where else stands what can be done with it. */
export function isLow({ chosen, drawing, viewport }: Plane): boolean {
  const places = drawing.knots.filter(({ links }, k) => k === chosen?.knot || links.includes(chosen?.link ?? ""));
  const rows = places.map(({ at }) => viewport.screen(...at)[1]);
  return Math.max(...rows) > viewport.height - SHEET && Math.min(...rows) > SHEET;
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
    ...digits(value),
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

/** The length of a link with two joints: the second one moves along it, unless it alone stands on the ground. */
function lengthField(view: Changing, link: string): HTMLElement[] {
  const { drawing } = view;
  const [first, second, more] = [...drawing.knots.entries()].filter(
    ([, one]) => one.links.includes(link) && isPin(one),
  );
  if (!first || !second || more) return [];
  const grounded = ([, { links }]: [number, Knot]) => links.includes(drawing.frame!);
  const swap = grounded(second) && !grounded(first);
  const [[, { at }], [k, end]] = swap ? [second, first] : [first, second];
  const [dx, dy] = [end.at[0] - at[0], end.at[1] - at[1]];
  const long = Math.hypot(dx, dy);
  const set = (value: number) => {
    const part = value / long;
    return part > 0 && part < Infinity ? moved(drawing, k, [at[0] + part * dx, at[1] + part * dy]) : null;
  };
  return [field(view, `${t("Length")} [${unitOf(drawing)}]`, "length", long, set)];
}

export function choiceOf(view: Changing): HTMLElement[] {
  const { chosen, drawing } = view;
  const removing = action("remove", () => removeChosen(view), t("Remove"));
  const note = (text: string) => h("b", {}, text);
  if (!chosen) return [];
  const { link } = chosen;
  if (isPicture(chosen)) {
    const how = t("Drag it; its corner sizes it, the grip turns it.");
    return [note(how), removing];
  }
  if (link !== null) {
    const name = h("input", {
      value: spaced(link),
      size: 7,
      "data-field": "link-name",
      onchange: () =>
        view.change(
          renamed(drawing, link, name.value.trim().replaceAll(" ", "_")),
          t("Expected a new name without spaces and brackets."),
        ),
    });
    const frame = action("frame", () => view.change({ ...drawing, frame: link, drives: [] }), t("Hold as frame"));
    return [h("label", {}, t("Name"), name), ...lengthField(view, link), frame, removing];
  }
  const knot = chosen.knot!;
  const { at, between, links } = drawing.knots[knot]!;
  const parts: HTMLElement[] = [removing];
  if (links.length > 1) {
    const is = drawing.drives.includes(knot);
    parts.unshift(action("drive", () => view.change(driven(drawing, knot)), is ? t("Not driven") : t("Drive")));
    if (isPin(drawing.knots[knot]!))
      parts.push(action("split", () => view.change(split(drawing, knot, view.step / 2)), t("Split")));
  }
  const places = (["x", "y"] as const).map((key, axis) =>
    field(view, key, key, at[axis]!, (value) => {
      const place: Pair = axis ? [at[0], value] : [value, at[1]];
      return Number.isFinite(value) ? moved(drawing, knot, place) : null;
    }),
  );
  const name = `${knotName(drawing, knot)}: ${links.map(spaced).join(" – ")}`;
  return [note(name), ...(between ? [] : places), ...parts];
}
