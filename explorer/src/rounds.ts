/** The sizes of wheels, cams and slotted wheels, as the document has them; those of cams and rollers can be changed. */

import { h } from "./dom";
import { givenOf } from "./followers";
import { softened } from "./header";
import { away } from "./hull";
import { number, t } from "./language";
import { lawFields } from "./lifts";
import { type Resizer, roundField } from "./roundfields";
import type { Pair } from "./rows";

/** A row for each size of each of them, and for the distance of the axes of two that mesh. */
export function roundRows(editor: Resizer): HTMLElement[] {
  const { linkage } = editor;
  const { model, sizes } = linkage;
  const { joints, unit } = model;
  const rows = new Map<string, HTMLElement[]>(); // a wheel that meets several has them once
  const add = (name: string, what: string, value: string, its = unit) => {
    const shown = h("span", {}, value);
    const label = h("label", {}, h("b", {}, softened(name)), `, ${what}`);
    Object.assign(shown.style, { textAlign: "right", padding: "3px 7px" });
    const cells = [label, shown, h("span.unit", {}, its), h("span", {})];
    rows.set(name + what, cells);
  };
  const given = (k: number) => givenOf(linkage, k);
  const centred = (k: number) => ["radius", "slots", "pins", "transfer"].some((key) => key in given(k));
  const wording = words();
  const known = new Set<string>(); // two wheels about one axis are as far from a third one
  for (const joint of joints.keys()) {
    const mine = sizes.elementsOf(joint).filter((k) => sizes.is(k, "round"));
    for (const k of mine) {
      const name = linkage.linkName(sizes.element(k).link);
      const own = given(k);
      for (const [key, [what, its]] of Object.entries(wording)) {
        const value = own[key];
        if (key === "roller" && mine.some((m) => given(m).circle === value)) continue;
        if (typeof value !== "number" || (!value && key !== "pins")) continue;
        if (value > 0 && editor.page.served && ["base", "circle"].includes(key) && cammed(mine, given))
          rows.set(name + what, roundField(editor, k, name, { what, value, unit, set: (size) => ({ [key]: size }) }));
        else add(name, what, number(Math.abs(value)), its);
      }
      const law = typeof own.cam === "string" && editor.page.served ? lawFields(own.cam) : null;
      for (const [n, field] of law?.entries() ?? []) {
        const its = field.angle || own.distance ? "°" : unit;
        rows.set(`${name} ${n}`, roundField(editor, k, name, { ...field, unit: its }));
      }
      if (!law && typeof own.cam === "string")
        rows.set(`${name} lift`, [
          h("p.note", {}, `${name}, ${t("lift")}: ${liftText(own.cam, own.distance ? "°" : ` ${unit}`)}`),
        ]);
    }
    const [one, two] = mine;
    if (one === undefined || two === undefined || !centred(one) || !centred(two)) continue;
    const axes = [one, two].map((k) => linkage.elementAt(k)) as [Pair, Pair];
    const far = away(axes[0], ...axes[1]);
    const shown = axes
      .map((at) => at.map((value) => number(sizes.clean(value))))
      .sort()
      .join(" ");
    if (far > sizes.near && !known.has(shown) && known.add(shown))
      add([one, two].map((k) => linkage.linkName(sizes.element(k).link)).join(" – "), t("axis distance"), number(far));
  }
  return [...rows.values()].flat();
}

/** Whether a joint is one of a cam. */
function cammed(mine: readonly number[], given: (k: number) => Record<string, unknown>): boolean {
  return mine.some((k) => "cam" in given(k));
}

/** What the sizes are called that no other link has as a length, and their unit if it is not that of the linkage. */
function words(): Record<string, [string, string?]> {
  return {
    teeth: [t("teeth"), ""],
    radius: [t("pitch radius")],
    circle: [t("radius")],
    base: [t("radius of the base circle")],
    roller: [t("radius of the roller")],
    offset: [t("offset of the follower")],
    pins: [t("pins"), ""],
    slots: [t("slots"), ""],
  };
}

/** A law of lift in words: "rise 20 90; dwell" is a rise of 20 within 90 degrees, then a dwell for the rest. */
function liftText(law: string, unit: string): string {
  const parts = law.split(/[;\n]/).map((part) => {
    const [kind, far, angle, ...more] = part.trim().split(/\s+/);
    const kinds: Record<string, string> = { rise: t("rise"), fall: t("fall"), dwell: t("dwell") };
    const name = kinds[kind!];
    const [size, turned] = [Number(far), Number(angle)];
    if (!name || more[0]) return part.trim();
    if (kind === "dwell") return far ? `${name} ${number(size)}°` : name;
    return t("{kind} {length} over {angle}", {
      kind: name,
      length: `${number(size)}${unit}`.trim(),
      angle: `${number(turned)}°`,
    });
  });
  return parts.join(", ");
}
