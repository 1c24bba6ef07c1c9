/** The plane on which a mechanism is drawn: its picture, with a grid. */

import { type Backdrop, backdropElement, cornersOf, gripsOf, putBackdrop } from "./backdrop";
import { DEGREE } from "./cycle";
import { svg } from "./dom";
import {
  type Drawing,
  isPin,
  type Knot,
  knotName,
  lengthsOf,
  linksOf,
  radiiOf,
  type Spot,
  same,
  unitOf,
} from "./drawing";
import { gridOf } from "./grid";
import { BOX, DRIVEN, DRIVING, HATCH, PUSHED, PUSHING, placed, RAIL, SUPPORT } from "./ground";
import { away, clearAbout, convexHull, middleOf, nearest, onLine, pathThrough, sidesOf, toHull } from "./hull";
import { angle, number, spaced } from "./language";
import { clearSpot, halfOf, namePlace, nameSpots, rimSpots } from "./names";
import type { Pair } from "./rows";
import { guidelines, snapped } from "./snapping";
import type { Viewport } from "./viewport";

export const GRIP = 16; // pixels
const TOOLS = 165; // down to where the buttons over the plane end
const BESIDE = 56; // from its right edge to the left one of these
const RING = 8; // pixels from the teeth of a ring gear to its rim

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
}

export type Aim = "away" | "here" | "aiming";

export function isPicture(chosen: Chosen | null): boolean {
  return chosen?.knot === null && chosen.link === null;
}

/** The hull of the knots of a link, in pixels. */
export function outlineOf({ drawing, viewport }: Pick<Plane, "drawing" | "viewport">, link: string): Pair[] {
  const mine = drawing.knots.filter((knot) => knot.links.includes(link) && isPin(knot));
  return convexHull(mine.map(({ at }) => viewport.screen(...at)));
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

type Drawn = Pick<Plane, "drawing" | "viewport" | "chosen">;

/** The links that move, in the order in which they lie upon each other. */
function bodiesOf(plane: Drawn): string[] {
  const { drawing } = plane;
  const reach = (link: string) => drawing.knots.filter((knot) => knot.links.includes(link)).length;
  // plates first; a bar with a joint between others goes on over these
  const rank = (link: string) => (outlineOf(plane, link)[2] ? 0 : 99) + reach(link);
  const bodies = linksOf(drawing).filter((link) => link !== drawing.frame);
  return bodies.sort((one, other) => rank(one) - rank(other));
}

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
  // as in Motion a cylinder lies upon the plates that it moves
  return [...those((knot) => !isPin(knot) && !isCylinder(knot)), ...links, ...those(isCylinder), ...those(isPin)];
}

/** The picture of all of it, with the spots that are put already and the place of the cursor. */
export function planePicture(plane: Plane): SVGElement[] {
  const { aim, chosen, cursor, drawing, spots, viewport } = plane;
  const bodies = bodiesOf(plane);
  const hulls = bodies.map((link) => {
    const held = drawing.knots.filter((knot) => isCylinder(knot) && knot.links.includes(link)); // a half of it
    return convexHull([...outlineOf(plane, link), ...held.map(({ at }) => viewport.screen(...at))]);
  });
  const arrows = drawing.drives.map((k) => {
    const way = wayOf(drawing.knots[k]!);
    return placed(way === null ? DRIVING : PUSHING, viewport.screen(...drawing.knots[k]!.at), -(way ?? 0));
  });
  const letters = lettersOf(plane, [...hulls, ...arrows]);
  const texts = [...letters];
  for (const [k, link] of bodies.entries()) {
    const hull = hulls[k]!;
    const mine = drawing.knots.filter((knot) => knot.links.includes(link));
    const joints = mine.map(({ at }) => at);
    const name = spaced(link);
    const ring = mine.find((knot) => knot.links[ringOf(knot)] === link);
    const places = ring
      ? rimSpots(
          viewport.screen(...ring.between![ringOf(ring)]!),
          Math.max(...radiiOf(ring)) * viewport.scale + RING,
          name,
        )
      : nameSpots(viewport, namePlace(joints, [], name, viewport.scale), name);
    // of a plate upon which it lies only the edges are others
    const over = hull[0] ? middleOf(hull) : null;
    const others = [...hulls, ...arrows].flatMap((one) => {
      if (one === hull || !one.length) return [];
      return over && one[2] && !toHull(one, ...over) ? sidesOf(one) : [one];
    });
    const half = halfOf(name);
    const free = ([x, y]: Pair) =>
      x > half &&
      x + half < viewport.width - (y < TOOLS ? BESIDE : 0) &&
      texts.every(({ at: [u, v], name: other }) => Math.abs(v - y) > 14 || Math.abs(u - x) > 8 + half + halfOf(other));
    const put = places[clearSpot(places, name, [hull, others], free)]!;
    if (!viewport.narrow || free(put)) texts.push({ at: put, name });
  }
  const names = texts.slice(letters.length).map(({ at, name }) => text(name, at));
  const waiting = [...spots.map(({ at }) => at), ...(aim === "away" ? [] : [cursor])].map((at) =>
    viewport.screen(...at),
  );
  const [cx, cy] = viewport.screen(...cursor);
  const inLine = drawing.knots.filter(isPin).map(({ at }) => at);
  const guides = aim !== "aiming" ? [] : guidelines(cursor, [...inLine, ...spots.map(({ at }) => at)]);
  const last = spots.at(-1);
  const [dx, dy] = last && aim === "aiming" ? [cursor[0] - last.at[0], cursor[1] - last.at[1]] : [0, 0];
  const read = dx || dy ? `${number(Math.hypot(dx, dy))} ${unitOf(drawing)}, ${angle(Math.atan2(dy, dx), 3)}` : "";
  const { picture } = drawing;
  const behind = picture ? [backdropElement(picture)] : [];
  for (const element of behind) putBackdrop(element, picture!, viewport);
  return [
    ...behind,
    ...gridOf(viewport, unitOf(drawing)),
    svg("path.guide", { d: guides.map((ends) => pathThrough(ends.map((at) => viewport.screen(...at)))).join("") }),
    ...mechanismPicture(plane),
    ...names,
    ...letters.map(({ at, name }) => text(name, at)),
    ...(waiting.length > 1 ? [svg("path.pending", { d: pathThrough(waiting) })] : []),
    svg("text.tick", { x: cx + 12, y: cy + 18 }, read),
    ...(picture && isPicture(chosen) ? grips(plane, picture) : []),
    svg("path.crosshair", { d: waiting.map(([x, y]) => `M${x - 7} ${y}h14M${x} ${y - 7}v14`).join("") }),
  ];
}

function text(name: string, [x, y]: Pair): SVGElement {
  return svg("text.name", { x, y, "text-anchor": "middle" }, name);
}

/** What the knots are called, beside them; of those at one place, such as a block and its slide, all of them. */
function lettersOf({ drawing, viewport }: Plane, hulls: readonly Pair[][]): { at: Pair; name: string }[] {
  const { frame, knots } = drawing;
  const ends = knots.flatMap((knot) =>
    knot.between && knot.part === undefined ? [knot.between.map((at) => viewport.screen(...at))] : [],
  );
  // above the joint of a link that has one stands its name, above one that is driven an arrow
  const drawn = [
    ...ends,
    ...knots.flatMap((knot) => rimsOf(knot, viewport)),
    ...hulls.map((hull) =>
      hull[1]
        ? hull
        : hull.flatMap(([x, y]): Pair[] => [
            [x, y],
            [x, y - 15],
          ]),
    ),
  ];
  return knots.flatMap((knot, k) => {
    const here = [...knots.keys()].filter((one) => same(knots[one]!, knot));
    if (here[0]! < k) return [];
    const has = (what: (one: Knot) => unknown) => here.some((one) => what(knots[one]!));
    const [x, y] = viewport.screen(...knot.at);
    const [above, top, below, foot] = has(({ slide }) => slide !== undefined) ? [15, -9, 46, 14] : [3, 4, 17, 24];
    const under = convexHull(
      [-1, 1].flatMap((side): Pair[] => [
        [x + side * above, y + top],
        [x + side * below, y + foot],
      ]),
    );
    const letters = here.map((one) => knotName(drawing, one)).join(", ");
    const radii = radiiOf(knot);
    const told = `${letters} ${radii.map((radius) => number(radius, 3)).join(" : ")}`;
    // in the larger wheel, if it has room
    const name = Math.max(0, ...radii) * viewport.scale > 2 * halfOf(told) + 40 ? told : letters;
    const around = has(({ links }) => links.includes(frame!)) ? [...drawn, under] : drawn;
    const [u, v] = clearAbout([x, y], -20, around, halfOf(name) - 2);
    drawn.push([[u, v]]); // others keep clear of it
    return [{ at: [u, v + 4], name }];
  });
}

/** Strokes around the wheels of a knot that has some. */
function rimsOf({ at, between, part }: Knot, viewport: Viewport): Pair[][] {
  const [x, y] = viewport.screen(...at);
  return (part === undefined ? [] : between!).flatMap((centre) => {
    const [u, v] = viewport.screen(...centre);
    const on = (k: number): Pair => {
      const [c, s] = [Math.cos((k * Math.PI) / 18), Math.sin((k * Math.PI) / 18)];
      return [u + c * (x - u) - s * (y - v), v + s * (x - u) + c * (y - v)];
    };
    return Array.from({ length: 36 }, (_, k) => [on(k), on(k + 1)]);
  });
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

function isCylinder({ between, part }: Knot): boolean {
  return !!between && part === undefined;
}

/** The direction in degrees in which a joint slides; null if it turns or meshes. */
function wayOf(knot: Knot): number | null {
  if (!isCylinder(knot)) return knot.slide ?? null;
  const [[x, y], [u, v]] = knot.between!;
  return Math.atan2(v - y, u - x) / DEGREE;
}

/** Which of two wheels is a ring that has the other one within it; -1 if none is. */
function ringOf({ part = 0.5 }: Knot): number {
  if (part >= 0 && part <= 1) return -1;
  return part < 0 ? 1 : 0;
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
    turned.append(svg("path.rail", { d: `M-46 ${RAIL}H46` }), svg("path.rail-hatch", { d: `M-46 ${RAIL + HATCH}H46` }));
    turned.append(svg("path.block", { d: BOX }));
    element.append(turned);
  } else if (ground) element.append(svg("path.support", { d: SUPPORT }));
  if (slide === undefined && !between) element.append(svg("circle.joint", { r: links.length > 1 || ground ? 5 : 3.2 }));
  if (drawing.drives.includes(k))
    element.append(svg("path.driven", way === null ? { d: DRIVEN } : { d: PUSHED, transform: `rotate(${-way})` }));
  return element;
}
