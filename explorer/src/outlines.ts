/** Where what is drawn lies on the plane, in pixels: outlines of links, rims of wheels, directions of slides. */

import { DEGREE } from "./cycle";
import { type Drawing, isPin, type Knot, linksOf, radiiOf } from "./drawing";
import { GUIDE, placed } from "./ground";
import { convexHull, sidesOf, toHull } from "./hull";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

export const BARREL = 0.6; // of a cylinder from end to end
export const RING = 8; // pixels from the teeth of a ring gear to its rim

/** A drawing as a viewport shows it. */
export interface Seen {
  readonly drawing: Drawing;
  readonly viewport: Viewport;
}

/** The hull of the joints of a link; slides beside them it reaches, too, as their guide. */
export function outlineOf({ drawing, viewport }: Seen, link: string): Pair[] {
  const mine = drawing.knots.filter(({ links }) => links.includes(link));
  const hull = convexHull(mine.filter(isPin).map(({ at }) => viewport.screen(...at)));
  const guides = mine.flatMap(({ at, links, slide }) => {
    const [x, y] = viewport.screen(...at);
    if (slide === undefined || toHull(hull, x, y) < 9) return [];
    const half = links.includes(drawing.frame!) ? 0 : GUIDE;
    return [-half, half].map((along) => placed([[along, 0]], [x, y], -slide)[0]!);
  });
  return guides[0] ? convexHull([...hull, ...guides]) : hull;
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
export function rimsOf(knot: Knot, viewport: Viewport): Pair[][] {
  return radiiOf(knot).flatMap((radius, k) => {
    const [x, y] = viewport.screen(...knot.between![k]!);
    const on = (_: unknown, step: number): Pair => {
      const phi = (step * Math.PI) / 18;
      return [x + radius * viewport.scale * Math.cos(phi), y + radius * viewport.scale * Math.sin(phi)];
    };
    return sidesOf(Array.from({ length: 36 }, on));
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
