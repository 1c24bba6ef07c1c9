/** What is chosen in the drawing, and what can be done with it. */

import { h } from "./dom";
import { type Drawing, driven, isPin, renamed, split, without, withoutLink } from "./drawing";
import { t } from "./language";
import type { Plane } from "./plane";

/** The view of a drawing, as far as it is changed here. */
interface Changing extends Plane {
  /** How far a new end is put beside others. */
  readonly step: number;
  /** Nothing is a change that is not possible, for this reason. */
  change(next: Drawing | null, text?: string): void;
}

/** Take what is chosen out of the drawing. */
export function removeChosen(view: Changing): void {
  const { chosen, drawing } = view;
  if (!chosen) return;
  if ("picture" in chosen) view.change({ ...drawing, picture: undefined });
  else view.change("knot" in chosen ? without(drawing, chosen.knot) : withoutLink(drawing, chosen.link));
}

export function choiceOf(view: Changing): HTMLElement[] {
  const { chosen, drawing } = view;
  const button = (key: string, text: string, act: () => void) =>
    h("button.plain", { "data-act": key, onclick: act }, text);
  const removing = button("remove", t("Remove"), () => removeChosen(view));
  const note = (text: string) => h("p.note", {}, text);
  if (!chosen) return [note(t("Nothing yet: take Move and choose a joint or a link."))];
  if ("picture" in chosen) {
    const how = t("The picture: drag it; its corner sizes it, the grip on its side turns it.");
    return [note(how), h("div.form", {}, removing)];
  }
  if ("link" in chosen) {
    const { link } = chosen;
    const name = h("input", {
      value: link,
      "aria-label": t("Name"),
      "data-field": "link-name",
      onchange: () =>
        view.change(
          renamed(drawing, link, name.value.trim()),
          t("Expected a name that nothing else has, without spaces and brackets."),
        ),
    });
    const frame = button("frame", t("Hold as frame"), () => view.change({ ...drawing, frame: link, drives: [] }));
    return [h("div.form", {}, name, frame, removing)];
  }
  const { links } = drawing.knots[chosen.knot]!;
  const parts: HTMLElement[] = [removing];
  if (links.length > 1) {
    const is = drawing.drives.includes(chosen.knot);
    parts.unshift(button("drive", is ? t("Not driven") : t("Drive"), () => view.change(driven(drawing, chosen.knot))));
    if (isPin(drawing.knots[chosen.knot]!))
      parts.push(button("split", t("Split"), () => view.change(split(drawing, chosen.knot, view.step / 2))));
  }
  return [note(links.join(" – ")), h("div.form", {}, ...parts)];
}
