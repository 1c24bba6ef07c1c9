/** The list of lengths of a drawing, in which they are typed and kept. */

import { digits } from "./digits";
import { wantedOf } from "./dimensions";
import { h } from "./dom";
import { type Drawing, type Keep, knotName, turned, unitOf } from "./drawing";
import { softened } from "./header";
import { parsed, spaced, t } from "./language";
import { isKept, keeping, lengthOf, spanName, spansOf, withLength } from "./lengths";
import { lockButton } from "./shell";

/** The view of a drawing, as far as its lengths are changed. */
interface Measured {
  readonly drawing: Drawing;
  change(next: Drawing | null, text?: string): void;
}

/** A button that keeps a length, a direction or a place. */
export function keeper(view: Measured, kind: Keep[0], knots: readonly number[], name: string): HTMLElement {
  const { drawing } = view;
  const titles = {
    length: t("Keep this length"),
    direction: t("Keep this direction"),
    joint: t("Keep this place"),
  };
  const button = lockButton(kind, titles[kind], name, () => view.change(keeping(drawing, kind, knots)));
  button.setAttribute("aria-pressed", String(isKept(drawing, kind, knots)));
  return button;
}

/** A number alone is no name. */
function linkNamed(link: string): string {
  return /^\d/.test(link) ? t("link {link}", { link }) : spaced(link);
}

/** Mark the lengths of what is chosen. */
export function markLengths(list: HTMLElement, plane: Parameters<typeof wantedOf>[0]): void {
  const names = wantedOf(plane).map(({ ends }) => spanName(plane.drawing, ends));
  for (const field of list.querySelectorAll<HTMLElement>("[data-span]"))
    field.previousElementSibling!.classList.toggle("chosen", names.includes(field.dataset.span!));
}

/** Lengths and directions of slides. */
export function lengthList(view: Measured): HTMLElement[] {
  const { drawing } = view;
  const row = (
    name: string,
    link: string,
    [value, unit]: [number, string],
    set: (value: number) => Drawing | null,
    locks: HTMLElement[],
  ) => {
    const id = `length-${name}`;
    const input: HTMLInputElement = h("input", {
      id,
      ...digits(value),
      inputmode: "decimal",
      "data-span": name,
      onchange: () => {
        const typed = parsed(input.value);
        const next = set(typed);
        if (next || typed > 0) view.change(next, t("What is kept does not allow it."));
        input.setAttribute("aria-invalid", String(!next));
      },
    });
    return [
      h(
        "label",
        { for: id, title: link },
        h("b", {}, name.replace("–", "\u2060–\u2060")),
        h("span.unit", {}, softened(` ${link}`)),
      ),
      input,
      h("span.unit", {}, unit),
      h("span.locks", {}, ...locks),
    ];
  };
  const lengths = spansOf(drawing).flatMap((span) => {
    const name = spanName(drawing, span.ends);
    const locks = (["length", "direction"] as const).map((kind) => keeper(view, kind, span.ends, name));
    const set = (typed: number) => withLength(drawing, span, typed);
    const value = lengthOf(drawing, span.ends);
    return row(name, linkNamed(span.link), [value, unitOf(drawing)], set, locks);
  });
  const directions = drawing.knots.flatMap(({ links, slide }, k) => {
    if (slide === undefined) return [];
    const set = (typed: number) => (Number.isFinite(typed) ? turned(drawing, k, typed) : null);
    const name = `φ\u00a0${knotName(drawing, k)}`;
    return row(name, linkNamed(links.find((link) => link !== drawing.frame)!), [slide, "°"], set, []);
  });
  const rows = [...lengths, ...directions];
  return rows[0] ? [h("h2", {}, t("Sizes")), h("div.rows.sizes", {}, ...rows)] : [];
}
