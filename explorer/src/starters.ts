/** What a drawing begins with: the linkage at hand, or a mechanism that one then changes. */

import { h, svg } from "./dom";
import type { Drawing, Knot } from "./drawing";
import { away } from "./hull";
import { t } from "./language";
import type { Linkage } from "./linkage";
import { mechanismPicture } from "./plane";
import { drawingOf } from "./taken";
import { type Box, Extent, Viewport } from "./viewport";

const WIDE = 104; // pixels of a card's picture
const HIGH = 58;
const SMALL = 0.5; // a pixel of the plane
const ROOM = 52; // pixels of the plane for signs around joints

/** What takes a drawing to begin with. */
interface Beginning {
  readonly viewport: Viewport;
  /** Begin with a drawing, perhaps of what Motion shows. */
  begin(drawing: Drawing, known?: boolean): void;
}

/** A drawing whose first knot is driven; its knots are written as x, y, the links ("f" is the frame), the slide. */
function drawn(text: string): Drawing {
  const frame = t("frame");
  const knots = text.split("/").map((row): Knot => {
    const [x, y, links, slide] = row.split(" ");
    const named = [...links!].map((link) => (link === "f" ? frame : link));
    return { at: [Number(x), Number(y)], links: named, ...(slide && { slide: Number(slide) }) };
  });
  return { knots, frame, drives: [0] };
}

// 20 + 70 < 63.2 + 41.2: the crank turns fully
const FOUR_BAR = "0 0 f1/0 20 12/60 40 23/70 0 f3/30 60 2";
const SLIDER_CRANK = "0 0 f1/0 20 12/80 0 23/80 0 f3 0";
const SIX_BAR = `${FOUR_BAR}/92 32 34/150 42 45/150 0 f5`;

/** Where knots lie, and wheels about them. */
export function extentOf({ knots }: Drawing): Box {
  const box = new Extent();
  for (const { at, between, part } of knots) {
    box.add(at);
    for (const centre of between ?? []) box.add(centre, part === undefined ? 0 : away(at, ...centre));
  }
  return box;
}

/** A drawing as in the plane, small. */
function sketch(drawing: Drawing): SVGElement {
  const viewport = new Viewport();
  const { left, right, bottom, top } = extentOf(drawing);
  const [wide, high] = [WIDE / SMALL, HIGH / SMALL];
  viewport.scale = Math.min((wide - ROOM) / (right - left), (high - ROOM) / (top - bottom));
  viewport.pan((wide - viewport.scale * (left + right)) / 2, (high + viewport.scale * (top + bottom)) / 2);
  const picture = mechanismPicture({ drawing, viewport, chosen: null });
  return svg("svg", { viewBox: `0 0 ${wide} ${high}`, width: WIDE, height: HIGH, "aria-hidden": "true" }, ...picture);
}

/** What Motion shows, or why it cannot be edited; on an empty plane other cards, too. */
export function starters(view: Beginning, linkage: Linkage, empty: boolean): HTMLElement[] {
  const { drawing: found, other } = drawingOf(linkage);
  const { title } = linkage;
  const name = empty ? title.replace(/^(?=.{29})(.{1,26}) .*/, "$1 …") : title;
  const cards: [string, string, Drawing | undefined][] = [
    ["hand", empty ? t("Edit {name}", { name }) : t("Edit {name} instead", { name }), found],
    ["four-bar", t("Four-bar linkage"), drawn(FOUR_BAR)],
    ["slider-crank", t("Slider-crank"), drawn(SLIDER_CRANK)],
    ["six-bar", t("Six-bar (Watt\u00a0II)"), drawn(SIX_BAR)],
  ];
  const buttons = cards.slice(0, empty ? 4 : 1).flatMap(([key, text, drawing]) => {
    if (!drawing) return [];
    const begin = () => view.begin(drawing, key === "hand");
    return [h("button.plain", { "data-begin": key, onclick: begin }, empty ? sketch(drawing) : "", text)];
  });
  const head = empty ? [h("h2", {}, t("Begin with"))] : [];
  const [joint] = other;
  const why = joint && t("{name} cannot be edited here: no tool for joints like {joint} yet.", { name, joint });
  return [...head, ...buttons, ...(why ? [h("p.note", {}, why)] : [])];
}
