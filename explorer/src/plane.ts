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
import { BOX, DRIVEN, DRIVING, HATCH, placed, RAIL, SUPPORT } from "./ground";
import { away, clearAbout, convexHull, nearest, onLine, pathThrough, toHull } from "./hull";
import { angle, number, spaced } from "./language";
import { clearSpot, halfOf, namePlace, nameSpots } from "./names";
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
  const pins = (wanted: boolean) => knots.filter((_, k) => isPin(drawing.knots[k]!) === wanted);
  return [...pins(false), ...links, ...pins(true)];
}

/** The picture of all of it, with the spots that are put already and the place of the cursor. */
export function planePicture(plane: Plane): SVGElement[] {
  const { aim, chosen, cursor, drawing, spots, viewport } = plane;
  const bodies = bodiesOf(plane);
  const hulls = bodies.map((link) => outlineOf(plane, link));
  const arrows = drawing.drives.map((k) => placed(DRIVING, viewport.screen(...drawing.knots[k]!.at)));
  const letters = lettersOf(plane, [...hulls, ...arrows]);
  const names = bodies.map((link, k) => {
    const hull = hulls[k]!;
    const joints = drawing.knots.filter((knot) => knot.links.includes(link)).map(({ at }) => at);
    const name = spaced(link);
    const places = nameSpots(viewport, namePlace(joints, [], name, viewport.scale), name);
    const others = [...hulls, ...arrows].filter((one) => one !== hull && one.length);
    const free = (spot: Pair) =>
      letters.every(({ at: [u, v], name: letter }) => {
        return Math.abs(v - spot[1]) > 14 || Math.abs(u - spot[0]) > 8 + halfOf(name) + halfOf(letter);
      });
    return text(name, places[clearSpot(places, name, [hull, others], free)]!);
  });
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

/** A cylinder with its rod, or two wheels, from end to end along x; in pixels about where they meet. */
function alongEnds({ between, part }: Knot, scale: number): SVGElement {
  const [[x, y], [u, v]] = between!;
  const [dx, dy] = [u - x, v - y];
  const long = Math.hypot(dx, dy) * scale;
  const turned = svg("g", { transform: `rotate(${-Math.atan2(dy, dx) / DEGREE})` });
  if (part === undefined)
    turned.append(
      ...["outline", "bar"].map((kind) => svg(`path.${kind}`, { d: `M0 0H${long / 2}` })),
      svg("rect.block", { x: -long / 2, y: -7, width: 0.6 * long, height: 14, rx: 3 }),
    );
  else for (const cx of [-part * long, (1 - part) * long]) turned.append(svg("circle.wheel", { cx, r: Math.abs(cx) }));
  return turned;
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
  if (between) element.append(alongEnds(drawing.knots[k]!, viewport.scale));
  else if (slide !== undefined) {
    const turned = svg("g", { transform: `rotate(${-slide})` });
    turned.append(svg("path.rail", { d: `M-46 ${RAIL}H46` }), svg("path.rail-hatch", { d: `M-46 ${RAIL + HATCH}H46` }));
    turned.append(svg("path.block", { d: BOX }));
    element.append(turned);
  } else if (ground) element.append(svg("path.support", { d: SUPPORT }));
  if (slide === undefined && !between) element.append(svg("circle.joint", { r: links.length > 1 || ground ? 5 : 3.2 }));
  if (drawing.drives.includes(k)) element.append(svg("path.driven", { d: DRIVEN }));
  return element;
}
