/** The plane on which a mechanism is drawn: its picture, with a grid. */

import { type Backdrop, backdropElement, cornersOf, gripsOf, putBackdrop } from "./backdrop";
import { ROD, SLOT } from "./bodies";
import { DEGREE } from "./cycle";
import { dimensionElements, dimensionsOf } from "./dimensions";
import { svg } from "./dom";
import { type Drawing, isPin, type Knot, lengthsOf, linksOf, type Spot, unitOf } from "./drawing";
import { gridOf } from "./grid";
import { BOX, DRIVEN, GUIDE, HATCH, lying, PUSHED, RAIL, SUPPORT } from "./ground";
import { away, nearest, onLine, pathThrough, toHull } from "./hull";
import { angle, number, spaced } from "./language";
import { isKept } from "./lengths";
import { lettering, linesOf } from "./lettering";
import { halfOf } from "./names";
import { LEADERS, leadersThrough } from "./naming";
import { BARREL, bodiesOf, isCylinder, outlineOf, RING, ringOf, wayOf } from "./outlines";
import { ARROW, BESIDE } from "./pushed";
import type { Pair } from "./rows";
import { guidelines, snapped } from "./snapping";
import type { Viewport } from "./viewport";

export const GRIP = 16; // pixels

/** A knot, else a link, else the picture behind them. */
export interface Chosen {
  readonly knot: number | null;
  readonly link: string | null;
}

export interface Plane {
  readonly drawing: Drawing;
  readonly viewport: Viewport;
  readonly chosen: Chosen | null;
  /** What the tool has got already. */
  readonly spots: readonly Spot[];
  readonly cursor: Pair;
  /** Whether the cursor is shown, and the lines to what is in line with it. */
  readonly aim: Aim;
  /** What is told beside the cursor of what a click there leads to. */
  readonly ahead: string;
}

export type Aim = "away" | "here" | "aiming";

export function isPicture(chosen: Chosen | null): boolean {
  return chosen?.knot === null && chosen.link === null;
}

/** What is at a pixel: a knot, a link, else a place, which snaps and is level or upright if that is wanted; one knot is
 * passed over. */
export function spotAt(
  plane: Plane,
  [x, y]: Pair,
  { snapping, upright, but }: { snapping: boolean; upright: boolean; but: number },
): Spot {
  const { drawing, spots, viewport } = plane;
  const off = ({ at }: Knot, k: number) => (k === but ? Infinity : away(viewport.screen(...at), x, y));
  const knot = nearest(drawing.knots, GRIP, off);
  if (knot !== null) return { at: drawing.knots[knot]!.at, knot, link: null };
  const last = spots.at(-1);
  const pins = drawing.knots.filter((one, k) => isPin(one) && k !== but);
  let [u, v] = viewport.world(x, y);
  if (snapping)
    [u, v] = snapped([u, v], viewport, {
      places: [...pins, ...spots].map(({ at }) => at),
      from: last ? [last.at] : [],
      lengths: lengthsOf(drawing),
    });
  if (upright && last) {
    if (Math.abs(u - last.at[0]) > Math.abs(v - last.at[1])) v = last.at[1];
    else u = last.at[0];
  }
  const link = linksOf(drawing).find((one) => one !== drawing.frame && toHull(outlineOf(plane, one), x, y) < GRIP / 2);
  const [first, second, more] = pins.filter(({ links }) => links.includes(link!));
  const bar = but < 0 && second && !more; // it stays one
  if (bar && snapping && !upright) [u, v] = onLine(first!.at, second.at, [u, v]);
  return { at: [u, v], knot: null, link: link ?? null };
}

/** The link of a point at a pixel: what is there, else the one that is the nearest; null if there is none. */
export function linkFor(plane: Plane, { knot, link }: Spot, [x, y]: Pair): string | null {
  const { drawing } = plane;
  const bodies = linksOf(drawing).filter((one) => one !== drawing.frame);
  const here = knot === null ? undefined : drawing.knots[knot]!.links.filter((one) => one !== drawing.frame).at(-1);
  const near = nearest(bodies, Infinity, (one) => toHull(outlineOf(plane, one), x, y));
  return link ?? here ?? (near === null ? null : bodies[near]!);
}

type Drawn = Pick<Plane, "drawing" | "viewport" | "chosen">;

/** Links and joints, with the signs of the frame. */
export function mechanismPicture(plane: Drawn): SVGElement[] {
  const { chosen, drawing } = plane;
  const links = bodiesOf(plane).map((link) => {
    const hull = outlineOf(plane, link);
    const mark = chosen?.link === link ? " chosen" : "";
    const d = pathThrough(hull) + (hull.length > 2 ? "Z" : "");
    const outline = svg("path", { class: `outline${mark}`, d, "data-link": link });
    return svg("g", {}, svg("title", {}, spaced(link)), outline, svg("path.bar", { d }));
  });
  const knots = drawing.knots.map((knot, k) => knotElement(plane, k, knot.at));
  const those = (wanted: (knot: Knot) => boolean) => knots.filter((_, k) => wanted(drawing.knots[k]!));
  const isGear = ({ part }: Knot) => part !== undefined;
  // as in Motion a cylinder or a block lies upon the plates that it moves
  return [...those(isGear), ...links, ...those((knot) => !isPin(knot) && !isGear(knot)), ...those(isPin)];
}

/** The picture of all of it, with the spots that are put already and the place of the cursor; what covers its upper
 * edge is so high. */
export function planePicture(plane: Plane, covered: number): SVGElement[] {
  const { aim, chosen, cursor, drawing, spots, viewport } = plane;
  const dimensions = dimensionsOf(plane);
  const texts = lettering(plane, dimensions);
  const waiting = [...spots.map(({ at }) => at), ...(aim === "away" ? [] : [cursor])].map((at) =>
    viewport.screen(...at),
  );
  const [cx, cy] = viewport.screen(...cursor);
  const others = [...drawing.knots.filter(isPin), ...spots].map(({ at }) => at);
  const guides = aim === "aiming" ? guidelines(cursor, others) : [];
  const last = spots.at(-1);
  const [dx, dy] = last && aim === "aiming" ? [cursor[0] - last.at[0], cursor[1] - last.at[1]] : [0, 0];
  const read = dx || dy ? `${number(Math.hypot(dx, dy))} ${unitOf(drawing)}, ${angle(Math.atan2(dy, dx), 3)}` : "";
  const told = [read, plane.ahead].filter(Boolean).join(" → ");
  const beyond = cx + 24 + 2 * halfOf(told) > viewport.width;
  const { picture } = drawing;
  const behind = picture ? [backdropElement(picture)] : [];
  if (picture) putBackdrop(behind[0]!, picture, viewport);
  return [
    ...behind,
    ...gridOf(viewport, unitOf(drawing), covered),
    svg("path.guide", { d: guides.map((ends) => pathThrough(ends.map((at) => viewport.screen(...at)))).join("") }),
    ...mechanismPicture(plane),
    svg("path", { ...LEADERS, d: leadersThrough(linesOf(texts)) }),
    ...texts.map(({ x, y, name }) => svg("text.name", { x, y, "text-anchor": "middle" }, name)),
    ...dimensionElements(dimensions),
    ...(waiting.length > 1 ? [svg("path.pending", { d: pathThrough(waiting) })] : []),
    // beside the right edge it stands on the other side
    svg("text.tick", { x: beyond ? cx - 12 : cx + 12, y: cy + 18, "text-anchor": beyond ? "end" : "start" }, told),
    ...(picture && isPicture(chosen) ? grips(plane, picture) : []),
    svg("path.crosshair", { d: waiting.map(([x, y]) => `M${x - 7} ${y}h14M${x} ${y - 7}v14`).join("") }),
  ];
}

/** The edge of a chosen picture, and what is dragged to size and to turn it. */
function grips({ viewport }: Plane, picture: Backdrop): SVGElement[] {
  const edge = cornersOf(picture).map((at) => viewport.screen(...at));
  return [
    svg("path.pending", { d: `${pathThrough(edge)}Z` }),
    ...Object.entries(gripsOf(picture)).map(([grip, at]) => {
      const [cx, cy] = viewport.screen(...at);
      return svg("circle.grip", { cx, cy, r: 8, "data-grip": grip });
    }),
  ];
}

/** A cylinder as in Motion, perhaps with the arrow of its drive, or two wheels, from end to end along x; in pixels
 * about where they meet. */
function alongEnds(knot: Knot, scale: number, driven: boolean): SVGElement {
  const { between, part } = knot;
  const [[x, y], [u, v]] = between!;
  const [dx, dy] = [u - x, v - y];
  const long = Math.hypot(dx, dy) * scale;
  const reach = BARREL * long;
  const stroke = (kind: string, to: number) => svg(`path.${kind}`, { d: `M${-long / 2} 0h${to}` });
  const within = `translate(${(reach - long) / 2} 0)scale(${Math.min(1, reach / ARROW)})translate(0 ${BESIDE})`;
  const cylinder = () => [
    ...ROD.map((kind) => stroke(kind, long)),
    ...SLOT.map((kind) => stroke(kind, reach)),
    ...(driven ? [svg("path.driven", { d: PUSHED, transform: within })] : []),
  ];
  const wheel = (cx: number, k: number) => {
    const circles = [0, RING].slice(0, k === ringOf(knot) ? 2 : 1).map((more) => circle(cx, Math.abs(cx) + more));
    return svg("path.shape", { d: circles.join("") });
  };
  const parts = part === undefined ? cylinder() : [-part * long, (1 - part) * long].map(wheel);
  return svg("g", { transform: `rotate(${-Math.atan2(dy, dx) / DEGREE})` }, ...parts);
}

function circle(x: number, radius: number): string {
  return `M${x - radius} 0a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0Z`;
}

/** Beside a slide, away from its rail. */
function alongWay(way: number): string {
  const lies = lying(way);
  return `rotate(${-lies})scale(${lies === way ? 1 : -1} 1)`;
}

/** The radius of a joint in pixels, smaller where another one is near. */
function ringOfPin({ knots }: Drawing, viewport: Viewport, k: number): number {
  const [x, y] = viewport.screen(...knots[k]!.at);
  const gaps = knots.map(({ at }) => away(viewport.screen(...at), x, y)).filter((gap) => gap > 1);
  return Math.max(2.5, Math.min(5, ...gaps.map((gap) => gap / 3)));
}

function knotElement({ chosen, drawing, viewport }: Drawn, k: number, at: Pair): SVGElement {
  const knot = drawing.knots[k]!;
  const { between, links, slide } = knot;
  const [x, y] = viewport.screen(...at);
  const marks = [chosen?.knot === k && "chosen", isKept(drawing, "joint", [k]) && "held"];
  const element = svg("g", {
    class: ["pin free", ...marks].filter(Boolean).join(" "),
    "data-knot": k,
    transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
  });
  const ground = links.includes(drawing.frame!);
  const way = wayOf(knot);
  const driven = drawing.drives.includes(k);
  if (between) element.append(alongEnds(knot, viewport.scale, driven));
  else if (slide !== undefined) {
    // on a link that moves there is none
    const rails = ground ? ["rail", "rail-hatch"] : [];
    const d = (low: number) => `M${-GUIDE} ${RAIL + low * HATCH}h${2 * GUIDE}`;
    const lines = rails.map((kind, low) => svg(`path.${kind}`, { d: d(low) }));
    element.append(svg("g", { transform: alongWay(slide) }, ...lines, svg("path.block", { d: BOX })));
  } else {
    if (ground) element.append(svg("path.support", { d: SUPPORT }));
    element.append(svg("circle.joint", { r: links[1] || ground ? ringOfPin(drawing, viewport, k) : 3.2 }));
  }
  if (driven && !isCylinder(knot))
    element.append(svg("path.driven", way === null ? { d: DRIVEN } : { d: PUSHED, transform: alongWay(way) }));
  return element;
}
