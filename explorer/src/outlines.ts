/** Where what is drawn lies on the plane, in pixels: outlines of links, rims of wheels, directions of slides. */

import { DEGREE } from "./cycle";
import { type Drawing, isPin, type Knot, linksOf } from "./drawing";
import { convexHull } from "./hull";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

export const RING = 8; // pixels from the teeth of a ring gear to its rim

/** A drawing as a viewport shows it. */
export interface Seen {
  readonly drawing: Drawing;
  readonly viewport: Viewport;
}

/** The hull of the knots of a link, in pixels. */
export function outlineOf({ drawing, viewport }: Seen, link: string): Pair[] {
  const mine = drawing.knots.filter((knot) => knot.links.includes(link) && isPin(knot));
  return convexHull(mine.map(({ at }) => viewport.screen(...at)));
}

/** The links that move, in the order in which they lie upon each other. */
export function bodiesOf(plane: Seen): string[] {
  const { drawing } = plane;
  const reach = (link: string) => drawing.knots.filter((knot) => knot.links.includes(link)).length;
  // plates first; a bar with a joint between others goes on over these
  const rank = (link: string) => (outlineOf(plane, link)[2] ? 0 : 99) + reach(link);
  const bodies = linksOf(drawing).filter((link) => link !== drawing.frame);
  return bodies.sort((one, other) => rank(one) - rank(other));
}

/** Strokes around the wheels of a knot that has some. */
export function rimsOf({ at, between, part }: Knot, viewport: Viewport): Pair[][] {
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

export function isCylinder({ between, part }: Knot): boolean {
  return !!between && part === undefined;
}

/** The direction in degrees in which a joint slides; null if it turns or meshes. */
export function wayOf(knot: Knot): number | null {
  if (!isCylinder(knot)) return knot.slide ?? null;
  const [[x, y], [u, v]] = knot.between!;
  return Math.atan2(v - y, u - x) / DEGREE;
}

/** Which of two wheels is a ring that has the other one within it; -1 if none is. */
export function ringOf({ part = 0.5 }: Knot): number {
  if (part >= 0 && part <= 1) return -1;
  return part < 0 ? 1 : 0;
}
