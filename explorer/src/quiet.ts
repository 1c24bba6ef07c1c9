/** Where the names of cams, rollers and their followers stand, so that they keep still while these turn. */

import { armOf, isFace, rollerOf, stemOf } from "./followers";
import { away } from "./hull";
import type { Linkage } from "./linkage";
import { between, halfOf } from "./names";
import { direction, type Pair, place } from "./rows";
import type { Viewport } from "./viewport";

const DEEP = 0.55; // of the base circle, from the axis to a name
const AXIS = 36; // pixels from an axis to what is clear of its ground
const PAST = 15; // from the end of a follower to its name
const BESIDE = 10; // from a roller to its name
const BAR = 9; // from the middle of an arm
const INK = 6; // half the height of a name
const LEAN = 0.3; // of the way from a cam to a roller: then no stem stands above that
const RISE = 0.3; // of a roller: above its middle

type Spots = (viewport: Viewport) => Pair[];

/** The places of a name, in pixels; null of a link that has none of its own. */
export function quietSpots(linkage: Linkage, link: number, name: string): Spots | null {
  const { model, sizes } = linkage;
  const half = halfOf(name);
  const stem = stemOf(linkage, link);
  if (stem) return past(linkage, link, stem.foot, stem.top, half);
  const face = sizes.elementsOn(link).find((k) => isFace(linkage, k));
  const pin = sizes.elementsOn(link).find((k) => sizes.is(k, "pin"));
  if (face !== undefined && pin !== undefined) {
    const corners = model.shapes
      .filter((shape) => shape.link === link && shape.closed)
      .flatMap(({ lines = [] }) => cornersOf(lines));
    const from = sizes.xy(pin);
    const [one, other] = corners.sort((a, b) => away(b, ...from) - away(a, ...from)) as [Pair, Pair];
    return past(linkage, link, from, between(one, other, 0.5), half);
  }
  const arm = armOf(linkage, link);
  if (arm)
    return (viewport) => {
      const [from, to, cam] = arm.map((k) => viewport.screen(...linkage.elementAt(k))) as [Pair, Pair, Pair];
      const [x, y] = between(from, to, 0.5);
      const far = away(from, ...to);
      let [c, s] = [(to[1] - from[1]) / far, (from[0] - to[0]) / far];
      if (c * (x - cam[0]) + s * (y - cam[1]) < 0) [c, s] = [-c, -s];
      const off = BAR + half * Math.abs(c) + INK * Math.abs(s);
      const spot = (part: number): Pair => {
        const [u, v] = between(from, to, part);
        return [u + c * off, v + s * off + 4];
      };
      return [spot(0.5), spot(0.35), spot(0.65)];
    };
  const base = model.shapes.find((shape) => shape.link === link && shape.style === "dead")?.circle;
  if (base) {
    const [u, v, radius] = base;
    return (viewport) => {
      const [x, y] = viewport.screen(...place(linkage.pose, 0, link, u, v));
      const deep = Math.max(AXIS, DEEP * radius * viewport.scale);
      const wide = Math.max(deep, AXIS + half);
      const low = y + 4;
      return [
        [x, low + deep],
        [x, low - deep],
        [x + wide, low],
        [x - wide, low],
      ];
    };
  }
  const roller = rollerOf(linkage, link);
  if (!roller) return null;
  return (viewport) => {
    const [x, y] = viewport.screen(...linkage.elementAt(roller[0]));
    const radius = roller[1] * viewport.scale;
    const [u, v] = viewport.screen(...linkage.elementAt(roller[2]));
    const [c, s] = [(x - u) / away([x, y], u, v), (y - v) / away([x, y], u, v)];
    const out = radius + BESIDE;
    if (Math.abs(c) > LEAN) return [[x + c * (out + half * Math.abs(c)), y + 4 + s * out]];
    return [1, -1].flatMap((side) =>
      [RISE, 1].map((up): Pair => [x + side * (radius + BESIDE + half), y + 4 - up * radius]),
    );
  };
}

/** The places of lines. */
export function cornersOf(lines: number[][]): Pair[] {
  return lines.flatMap((line) => line.flatMap((_, k): Pair[] => (k % 2 ? [] : [[line[k]!, line[k + 1]!]])));
}

/** Past the end of a body, on the way on to it, or beside that. */
function past(linkage: Linkage, link: number, [x, y]: Pair, [u, v]: Pair, half: number): Spots {
  return (viewport) => {
    const [dx, dy] = direction(linkage.pose, 0, link, [u - x, v - y]);
    const [c, s] = [dx / Math.hypot(dx, dy), -dy / Math.hypot(dx, dy)];
    const [left, top] = viewport.screen(...place(linkage.pose, 0, link, u, v));
    const spot = (right: number, down: number): Pair => [
      left + right * (PAST + half * Math.abs(right)),
      top + 4 + down * PAST,
    ];
    return [spot(c, s), spot(1, 1), spot(-1, 1)];
  };
}
