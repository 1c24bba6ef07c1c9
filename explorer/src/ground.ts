/** The signs of the frame, bearings and rails, and on which side of a joint or a slide they are. */

import { DEGREE } from "./cycle";
import type { Pair } from "./rows";

export const SUPPORT = "M0 0L-11 17H11ZM-17 17H17M-14 23l5-6M-5 23l5-6M4 23l5-6M13 23l4-5";
/** Counter-clockwise, as a drive grows. */
export const DRIVEN = "M9.5-9.5A13.4 13.4 0 0 0-12.5-5m0 0l6-1.5m-6 1.5l-.6-6";
/** Beside a slide that is driven, along it. */
export const PUSHED = "M-16-15H16m-6-5l6 5-6 5";
/** A block, in pixels about its middle. */
export const BOX = "M-15-9h30v18h-30z";
export const GUIDE = 46; // pixels from the middle of a block to the end of its guide
export const RAIL = 11; // pixels from there to its rail
export const HATCH = 5; // pixels from a rail to the middle of its hatching

/** The line beside another one on which a block stands: below it, at its right if it is upright. */
export function railOf([[x, y], [u, v]]: [Pair, Pair], off: number): [Pair, Pair] {
  const [dx, dy] = [u - x, v - y];
  const part = (off / Math.hypot(dx, dy)) * ((Math.abs(dx) > 1e-9 * Math.abs(dy) ? dx : dy) > 0 ? 1 : -1);
  return [
    [x + part * dy, y - part * dx],
    [u + part * dy, v - part * dx],
  ];
}

/** The direction of a slide, in degrees, in which its rail is on this side. */
export function lying(way: number): number {
  return way - 180 * Math.ceil((way - 90.001) / 180);
}

/** From the arrow of a drive to the hatching of a ground, in pixels about its joint. */
export const STANDING: Pair[] = [
  [0, -14],
  [17, 23],
  [-17, 23],
];

/** The arrow of a drive but for its head, beside which a letter has room. */
export const DRIVING: Pair[] = [
  [-8, -6],
  [0, -15],
  [9, -11],
];

export const PUSHING: Pair[] = [
  [-16, -15],
  [16, -15],
];

/** Where a sign is that is turned. */
export function placed(sign: readonly Pair[], [x, y]: Pair, turn = 0): Pair[] {
  const [c, s] = [Math.cos(turn * DEGREE), Math.sin(turn * DEGREE)];
  return sign.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
}
