/** The list of lengths of a drawing, in which they are typed and kept. */

import { digits } from "./digits";
import { h } from "./dom";
import { type Drawing, type Keep, knotName, unitOf } from "./drawing";
import { parsed, spaced, t } from "./language";
import { isKept, keeping, lengthOf, type Span, spansOf, withLength } from "./lengths";
import { lockButton } from "./shell";

/** The view of a drawing, as far as its lengths are changed. */
interface Measured {
  readonly drawing: Drawing;
  change(next: Drawing | null, text?: string): void;
}

const keptText = () => t("What is kept does not allow it.");

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

/** Give a length as it was typed, or say why not. */
export function setLength(view: Measured, span: Span, value: number): boolean {
  const next = withLength(view.drawing, span, value);
  if (next || value > 0) view.change(next, keptText());
  return !!next;
}

export function spanName(drawing: Drawing, { ends }: Span): string {
  return ends.map((k) => knotName(drawing, k)).join("–");
}

export function lengthList(view: Measured): HTMLElement[] {
  const { drawing } = view;
  const spans = spansOf(drawing);
  const row = (span: Span) => {
    const name = spanName(drawing, span);
    const id = `length-${name}`;
    const input: HTMLInputElement = h("input", {
      id,
      ...digits(lengthOf(drawing, span.ends)),
      inputmode: "decimal",
      "data-span": name,
      onchange: () => input.setAttribute("aria-invalid", String(!setLength(view, span, parsed(input.value)))),
    });
    const locks = (["length", "direction"] as const).map((kind) => keeper(view, kind, span.ends, name));
    return [
      h("label", { for: id, title: spaced(span.link) }, h("b", {}, name), h("span.unit", {}, ` ${spaced(span.link)}`)),
      input,
      h("span.unit", {}, unitOf(drawing)),
      h("span.locks", {}, ...locks),
    ];
  };
  return spans.length ? [h("h2", {}, t("Lengths")), h("div.rows.sizes", {}, ...spans.flatMap(row))] : [];
}
