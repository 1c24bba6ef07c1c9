/** The names in the picture of a linkage, and where each of them may stand. */

import { cylinderOf, mouthOf } from "./bodies";
import { svg } from "./dom";
import { away as apart, convexHull, middleOf, spotsAbout, toHull } from "./hull";
import { numberOf } from "./legend";
import type { Linkage } from "./linkage";
import { halfOf, type NamePlace, namePlace, nameSpots, rimSpots } from "./names";
import { cornersOf, quietSpots } from "./quiet";
import { direction, type Pair, place } from "./rows";
import type { Viewport } from "./viewport";

const EDGE = 4; // pixels of a picture in which texts would be cut
const PAST = 999;
const [RULE, FOOT] = [38, 24]; // the numbers of the grid at the left and below
const INK = 8; // pixels from a name to an arrow
const LETTER = 20; // from a joint to its letter
const BLOCK = 29; // from the middle of a block to a letter
const RIM = 3; // from a name on a wheel to its rim
const SHARES = [0.6, 0.45, 0.7]; // of the radius of a wheel, at which its name may stand

/** A name and where it stands in the picture. */
export interface Label {
  element: SVGTextElement;
  name: string;
  /** After the sizes of its link or the scale changed. */
  sized?: (scale: number) => void;
  /** Where it may stand, and which of these places it takes. */
  spots: (viewport: Viewport) => Pair[];
  taken: number;
  /** The place that it takes at the end of a line; none if it stands beside its body. */
  leader?: number | undefined;
  /** Where it has none: in how many pictures it is not sought. */
  waits?: number;
  /** Of a wheel with spokes: places between them and upon them, which turn with it, and the spokes. */
  wheel?: ((viewport: Viewport) => { places: Pair[]; spokes: Pair[][] }) | undefined;
  /** Its link, of which it is the name. */
  link?: number;
  /** The corners of its link. */
  hull?: (viewport: Viewport) => Pair[];
  /** Half its width, in pixels. */
  half: number;
  /** Whether it has so many places that others have theirs before. */
  many?: boolean;
}

/** The links that have names in the picture. */
export function namedLinks({ model }: Linkage): number[] {
  return [...model.links.slice(0, model.own).keys()].filter((link) => link !== model.frame);
}

/** The names of links or their numbers, in or beside their bodies, and the names of points. */
export function labelsOf(linkage: Linkage, numbered: boolean): Label[] {
  const { model, sizes } = linkage;
  const names = namedLinks(linkage).map((link): Label => {
    const name = numbered ? numberOf(link) : linkage.linkName(link);
    let held: ReturnType<typeof cylinderOf> = null; // of a cylinder its barrel, or what is seen of its rod
    const joints = () => [
      ...sizes.elementsOn(link).map((k) => sizes.xy(k)),
      ...(held ? [linkage.toLocal(link, ...mouthOf(linkage, held, sizes.element(held.ends[1]!).link === link))] : []),
    ];
    let on!: NamePlace;
    const points = () => sizes.points.filter((point) => point.link === link).map((point) => point.at);
    const sized = (scale: number) => {
      const found = sizes.elementsOn(link).map((k) => cylinderOf(linkage, sizes.element(k).joint));
      held = found.find((one) => one) ?? null;
      on = namePlace(joints(), points(), name, scale);
    };
    const rim = rimOf(linkage, link);
    const quiet = quietSpots(linkage, link, name);
    const spots = (viewport: Viewport) => {
      if (rim) {
        const centre = viewport.screen(...place(linkage.pose, 0, link, ...rim[0]));
        return rimSpots(centre, rim[1] * viewport.scale, name);
      }
      if (held) on = namePlace(joints(), [], name, viewport.scale); // it telescopes
      const { at, away, along, ...more } = on;
      const turned = (way: Pair) => direction(linkage.pose, 0, link, way);
      const where = { at: at.map((one) => place(linkage.pose, 0, link, ...one)), away: away && turned(away) };
      return nameSpots(viewport, { ...where, ...more, along: turned(along ?? [0, 0]) }, name);
    };
    const hull = (viewport: Viewport) =>
      convexHull(
        [
          ...(held
            ? joints().map((at) => place(linkage.pose, 0, link, ...at))
            : sizes
                .elementsOn(link)
                .map((k) => (sizes.is(k, "round") ? linkage.elementAt(k) : linkage.jointAt(sizes.element(k).joint)))),
          ...points().map((at) => place(linkage.pose, 0, link, ...at)),
        ].map((at) => viewport.screen(...at)),
      );
    const element = svg("text.name", { "text-anchor": "middle", "font-weight": numbered ? 600 : null }, name);
    return {
      element,
      name,
      sized,
      wheel: wheelOf(linkage, link, halfOf(name)),
      spots,
      taken: 0,
      ...(quiet ? { spots: quiet } : !rim && { hull, link }),
      half: halfOf(name),
      many: convexHull(joints()).length > 1,
    };
  });
  const marks = sizes.points.map((point): Label => {
    const name = linkage.pointName(point.name);
    const half = halfOf(name);
    const spots = (viewport: Viewport) => {
      const [x, y] = viewport.screen(...place(linkage.pose, 0, point.link, ...point.at));
      return [9 + half, -9 - half].flatMap((right): Pair[] => [
        [x + right, y - 9],
        [x + right, y + 18],
      ]);
    };
    const element = svg("text.mark", { "text-anchor": "middle" }, name);
    return { element, name: point.name, spots, taken: 0, half };
  });
  const letters = [...model.joints.keys()].flatMap((joint): Label[] => {
    const name = linkage.letterOf(joint);
    if (!name) return [];
    const at = () => {
      const ends = sizes.cylinder(joint)?.slice(2);
      return ends ? middleOf(ends.map((k) => linkage.elementAt(k))) : linkage.jointAt(joint);
    };
    const here = linkage.jointAt(joint);
    const slides = model.joints.some(({ pair }, k) => pair.sliding && apart(linkage.jointAt(k), ...here) < 1e-6);
    const spots = (viewport: Viewport) =>
      spotsAbout(viewport.screen(...at()), slides ? -BLOCK : -LETTER).map(([x, y]): Pair => [x, y + 4]);
    const element = svg("text.name", { "text-anchor": "middle" }, name);
    return [{ element, name, spots, taken: 0, half: halfOf(name) }];
  });
  return [...letters, ...names, ...frameOf(linkage), ...marks];
}

/** Of links that have numbers only that of the frame, too, beside one of its bearings. */
function frameOf(linkage: Linkage): Label[] {
  const { model } = linkage;
  const name = linkage.linkName(model.frame);
  const joint = model.joints.findIndex(({ links, pair }) => links.includes(model.frame) && pair.turning);
  if (!/^\d+$/.test(name) || joint < 0) return [];
  const spots = (viewport: Viewport) => {
    const [x, y] = viewport.screen(...linkage.jointAt(joint));
    return [
      [x, y + 36],
      [x + 28, y + 18],
      [x - 28, y + 18],
      [x, y - 20],
    ] as Pair[];
  };
  const element = svg("text.name", { "text-anchor": "middle" }, name);
  return [{ element, name, spots, taken: 0, half: halfOf(name), many: true }];
}

/** The centre of a ring, such as an internal gear, and how far its rim reaches. */
function rimOf({ model }: Linkage, link: number): [centre: Pair, far: number] | null {
  const ring = model.shapes.find(
    ({ between, closed, lines, link: own }) => own === link && closed && !between && lines?.[1],
  );
  if (!ring) return null;
  const places = cornersOf(ring.lines!.slice(0, 1));
  const centre = middleOf(places);
  return [centre, apart(places[0]!, ...centre)];
}

/** Where the name of a wheel with spokes has room between them. */
function wheelOf(linkage: Linkage, link: number, half: number): Label["wheel"] {
  const shapes = linkage.model.shapes.filter((shape) => shape.link === link);
  const circle = shapes.find((shape) => shape.circle)?.circle;
  const lines = shapes.flatMap((shape) => (shape.style === "hatch" && shape.lines) || []);
  if (!circle || !lines[0]) return undefined;
  const [x, y, radius] = circle;
  const angles = cornersOf(lines)
    .map(([u, v]) => Math.atan2(v - y, u - x))
    .sort((one, other) => one - other);
  const gaps = angles.map((one, k) => (one + (angles[k + 1] ?? angles[0]! + 2 * Math.PI)) / 2);
  return (viewport) => {
    const at = (u: number, v: number) => viewport.screen(...place(linkage.pose, 0, link, u, v));
    const [cx, cy] = at(x, y);
    const far = radius * viewport.scale - RIM;
    const inside = ([u, v]: Pair) => Math.hypot(Math.abs(u - cx) + half, Math.abs(v - 4 - cy) + INK) < far;
    const places = SHARES.flatMap((part) =>
      [...gaps, ...angles].map((phi): Pair => {
        const [u, v] = at(x + part * radius * Math.cos(phi), y + part * radius * Math.sin(phi));
        return [u, v + 4];
      }),
    );
    return {
      places: places.map((one) => (inside(one) ? one : [NaN, NaN])),
      spokes: lines.map(([a, b, c, d]) => [at(a!, b!), at(c!, d!)]),
    };
  };
}

/** Whether a name keeps clear of an arrow. */
export function clearOf(one: readonly Pair[], half: number, [x, y]: Pair): boolean {
  return [-half, 0, half].every((d) => !(toHull(one, x + d, y - 4) < INK));
}

/** What lies past the edges of a picture, where texts would be cut, or upon the numbers of the grid. */
export function pastEdges(width: number, height: number): Pair[][] {
  const [right, low] = [width + PAST, height + PAST];
  const sides = [
    [-PAST, -PAST, right, EDGE],
    [-PAST, height - FOOT, right, low],
    [-PAST, -PAST, RULE, low],
    [width, -PAST, right, low],
  ] as const;
  return sides.map(([x, y, u, v]) => convexHull([x, u].flatMap((p) => [y, v].map((q): Pair => [p, q]))));
}
