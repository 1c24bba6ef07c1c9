/** The tools with which is drawn: their names and keys, what each asks for. */

import { h } from "./dom";
import {
  type Drawing,
  type Spot,
  same,
  withCylinder,
  withDyad,
  withGears,
  withGround,
  withLink,
  withPoint,
  withSlider,
} from "./drawing";
import { icon } from "./icons";
import { t } from "./language";

export type Tool = "move" | "ground" | "link" | "slider" | "dyad" | "cylinder" | "gears" | "point" | "scale";

/** The drawing with what a tool makes at its places; null where two of them are one. */
export function withTool(tool: Tool, drawing: Drawing, spots: readonly Spot[]): Drawing | null {
  const [one, two, three] = spots as [Spot, Spot, Spot];
  if (tool === "ground") return withGround(drawing, one);
  if (tool === "point") return one.link === null ? null : withPoint(drawing, one.link, one.at);
  if (tool === "slider") return withSlider(drawing, one);
  if (same(one, two)) return null;
  if (tool === "gears") return withGears(drawing, one, two, three.at);
  if (tool === "cylinder") return withCylinder(drawing, one, two);
  if (tool === "link") return withLink(drawing, one, two);
  return same(two, three) ? null : withDyad(drawing, one, two, three);
}

export const KEYS: Record<string, Exclude<Tool, "scale">> = {
  v: "move",
  g: "ground",
  l: "link",
  s: "slider",
  d: "dyad",
  c: "cylinder",
  w: "gears",
  p: "point",
};

/** What a tool is called, and what is to be done for each place that it needs. */
export function wordsOf(tool: Tool): string[] {
  const words: Record<Tool, string[]> = {
    move: [t("Move")],
    ground: [t("Ground"), t("Place it on the plane or on a joint.")],
    slider: [t("Slider"), t("Place it; drag in its direction.")],
    link: [
      t("Link"),
      t("Place joint after joint, also on links, or drag a bar."),
      t("Now its other end; press Link to restart."),
    ],
    cylinder: [t("Cylinder"), t("Place both ends, or drag from end to end."), t("Now the end of its rod.")],
    dyad: [
      t("Dyad"),
      t("Place an end, the middle, the other end."),
      t("Now its middle joint."),
      t("Now its other end."),
    ],
    scale: [
      t("Scale of the picture"),
      t("Place two points of the picture, then type their distance."),
      t("Now the second point."),
    ],
    gears: [
      t("Gear pair"),
      t("Place both centres, then the contact."),
      t("Now the other centre."),
      t("Now the contact; outside: ring gear."),
    ],
    point: [t("Point"), t("Press on a link, drag the point anywhere.")],
  };
  return words[tool];
}

/** A button for each tool. */
export function palette(chosen: Tool, take: (tool: Tool) => void): HTMLElement[] {
  return Object.entries(KEYS).map(([letter, key]) =>
    h(
      "button",
      {
        class: key === chosen ? "key" : "plain",
        "data-tool": key,
        "aria-pressed": String(key === chosen),
        onclick: () => take(key),
      },
      icon(key === "link" ? "bar" : key),
      wordsOf(key)[0],
      h("span.letter.keys", {}, ` (${letter.toUpperCase()})`),
    ),
  );
}

/** What is to be done with a tool that has so many places already. */
export function hintOf(tool: Tool, placed: number): (Node | string)[] {
  const [name, ...asks] = wordsOf(tool);
  const hint = asks[placed] ?? asks[0] ?? t("Drag joints; select a joint or link to edit it.");
  return [h("b", {}, name), ": ", hint];
}
