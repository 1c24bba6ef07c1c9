/** The plane on which a mechanism is drawn: its picture, with a grid. */

import { type Backdrop, backdropElement, cornersOf, gripsOf, putBackdrop } from "./backdrop";
import { DEGREE } from "./cycle";
import { dimensionElements, dimensionsOf } from "./dimensions";
import { svg } from "./dom";
import { type Drawing, isPin, type Knot, lengthsOf, linksOf, type Spot, unitOf } from "./drawing";
import { gridOf } from "./grid";
import { BOX, DRIVEN, HATCH, PUSHED, RAIL, SUPPORT } from "./ground";
import { away, nearest, onLine, pathThrough, toHull } from "./hull";
import { angle, number } from "./language";
import { isKept } from "./lengths";
import { lettering } from "./lettering";
import { LEADERS, leadersThrough } from "./naming";
import { bodiesOf, outlineOf, RING, ringOf, wayOf } from "./outlines";
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
  const links = bodiesOf(plane).flatMap((link) => {
    const hull = outlineOf(plane, link);
    const mark = chosen?.link === link ? " chosen" : "";
    const d = pathThrough(hull) + (hull.length > 2 ? "Z" : "");
    return [svg("path", { class: `outline${mark}`, d, "data-link": link }), svg("path.bar", { d })];
  });
  const knots = drawing.knots.map((knot, k) => knotElement(plane, k, knot.at));
  const those = (wanted: (knot: Knot) => boolean) => knots.filter((_, k) => wanted(drawing.knots[k]!));
  const isGear = ({ part }: Knot) => part !== undefined;
  // as in Motion a cylinder or a block lies upon the plates that it moves
  return [...those(isGear), ...links, ...those((knot) => !isPin(knot) && !isGear(knot)), ...those(isPin)];
}

/** The picture of all of it, with the spots that are put already and the place of the cursor. */
export function planePicture(plane: Plane): SVGElement[] {
  const { aim, chosen, cursor, drawing, spots, viewport } = plane;
  const dimensions = dimensionsOf(plane);
  const texts = lettering(plane, dimensions);
  const waiting = [...spots.map(({ at }) => at), ...(aim === "away" ? [] : [cursor])].map((at) =>
    viewport.screen(...at),
  );
  const [cx, cy] = viewport.screen(...cursor);
  const inLine = drawing.knots.filter(isPin).map(({ at }) => at);
  const guides = aim !== "aiming" ? [] : guidelines(cursor, [...inLine, ...spots.map(({ at }) => at)]);
  const last = spots.at(-1);
  const [dx, dy] = last && aim === "aiming" ? [cursor[0] - last.at[0], cursor[1] - last.at[1]] : [0, 0];
  const read = dx || dy ? `${number(Math.hypot(dx, dy))} ${unitOf(drawing)}, ${angle(Math.atan2(dy, dx), 3)}` : "";
  const told = [read, plane.ahead].filter(Boolean).join(" → ");
  const { picture } = drawing;
  const behind = picture ? [backdropElement(picture)] : [];
  for (const element of behind) putBackdrop(element, picture!, viewport);
  return [
    ...behind,
    ...gridOf(viewport, unitOf(drawing)),
    svg("path.guide", { d: guides.map((ends) => pathThrough(ends.map((at) => viewport.screen(...at)))).join("") }),
    ...mechanismPicture(plane),
    svg("path", { ...LEADERS, d: leadersThrough(texts.flatMap(({ line }) => (line ? [line] : []))) }),
    ...texts.map(({ at: [x, y], name }) => svg("text.name", { x, y, "text-anchor": "middle" }, name)),
    ...dimensionElements(dimensions),
    ...(waiting.length > 1 ? [svg("path.pending", { d: pathThrough(waiting) })] : []),
    svg("text.tick", { x: cx + 12, y: cy + 18 }, told),
    ...(picture && isPicture(chosen) ? grips(plane, picture) : []),
    svg("path.crosshair", { d: waiting.map(([x, y]) => `M${x - 7} ${y}h14M${x} ${y - 7}v14`).join("") }),
  ];
}

/** The edge of a chosen picture, and what is dragged to size and to turn it. */
function grips({ viewport }: Plane, picture: Backdrop): SVGElement[] {
  const edge = cornersOf(picture).map((at) => viewport.screen(...at));
  return [
    svg("path.edge", { d: `${pathThrough(edge)}Z` }),
    ...Object.entries(gripsOf(picture)).map(([grip, at]) => {
      const [cx, cy] = viewport.screen(...at);
      return svg("circle.grip", { cx, cy, r: 8, "data-grip": grip });
    }),
  ];
}

/** A cylinder with its rod, or two wheels, from end to end along x; in pixels about where they meet. */
function alongEnds(knot: Knot, scale: number): SVGElement {
  const { between, part } = knot;
  const [[x, y], [u, v]] = between!;
  const [dx, dy] = [u - x, v - y];
  const long = Math.hypot(dx, dy) * scale;
  const turned = svg("g", { transform: `rotate(${-Math.atan2(dy, dx) / DEGREE})` });
  if (part === undefined)
    turned.append(
      ...["outline", "bar"].map((kind) => svg(`path.${kind}`, { d: `M0 0H${long / 2}` })),
      svg("rect.block", { x: -long / 2, y: -7, width: 0.6 * long, height: 14, rx: 3 }),
    );
  else
    for (const [k, cx] of [-part * long, (1 - part) * long].entries()) {
      const circles = [0, RING].slice(0, k === ringOf(knot) ? 2 : 1).map((more) => circle(cx, Math.abs(cx) + more));
      turned.append(svg("path.shape", { d: circles.join("") }));
    }
  return turned;
}

function circle(x: number, radius: number): string {
  return `M${x - radius} 0a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0Z`;
}

function knotElement({ chosen, drawing, viewport }: Drawn, k: number, at: Pair): SVGElement {
  const { between, links, slide } = drawing.knots[k]!;
  const [x, y] = viewport.screen(...at);
  const classes = ["pin", "free"];
  if (chosen?.knot === k) classes.push("chosen");
  if (isKept(drawing, "joint", [k])) classes.push("held");
  const element = svg("g", {
    class: classes.join(" "),
    "data-knot": String(k),
    transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
  });
  const ground = drawing.frame !== null && links.includes(drawing.frame);
  const way = wayOf(drawing.knots[k]!);
  if (between) element.append(alongEnds(drawing.knots[k]!, viewport.scale));
  else if (slide !== undefined) {
    const turned = svg("g", { transform: `rotate(${-slide})` });
    // on a link that moves there is none
    if (ground)
      turned.append(
        svg("path.rail", { d: `M-46 ${RAIL}H46` }),
        svg("path.rail-hatch", { d: `M-46 ${RAIL + HATCH}H46` }),
      );
    turned.append(svg("path.block", { d: BOX }));
    element.append(turned);
  } else if (ground) element.append(svg("path.support", { d: SUPPORT }));
  if (slide === undefined && !between) element.append(svg("circle.joint", { r: links.length > 1 || ground ? 5 : 3.2 }));
  if (drawing.drives.includes(k))
    element.append(svg("path.driven", way === null ? { d: DRIVEN } : { d: PUSHED, transform: `rotate(${-way})` }));
  return element;
}
