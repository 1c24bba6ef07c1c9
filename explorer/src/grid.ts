/** The lines of a plane with their numbers. */

import { svg } from "./dom";
import { number } from "./language";
import type { Viewport } from "./viewport";

/** The least of 1, 2, 5 times a power of ten that is not below a length. */
export function gridStep(wanted: number): number {
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].map((m) => m * power).find((value) => value >= wanted)!;
}

/** The least number of degrees that divides a circle and is not below others. */
export function degreeStep(wanted: number): number {
  return [5, 15, 30, 45, 90, 180, 360, 720, 1440].find((one) => one >= wanted) ?? gridStep(wanted);
}

/** Between lines of the grid, at least some 55 pixels; on a phone 40. */
export function stepOf({ narrow, scale }: Viewport): number {
  return gridStep((narrow ? 40 : 55) / scale);
}

/** Lines, numbers along the left and the lower edge, and the unit in their corner; what covers its upper
 * edge is so high. */
export function gridOf(viewport: Viewport, unit: string, above = 20): SVGElement[] {
  const { width, height } = viewport;
  const foot = height - 8;
  const step = stepOf(viewport);
  const numbers: SVGElement[] = [];
  const tick = (x: number, y: number, text: string) => numbers.push(svg("text.tick", { x, y }, text));
  tick(6, foot, unit);
  const [left, top] = viewport.world(0, 0);
  const [right, bottom] = viewport.world(width, height);
  let d = "";
  for (let k = Math.ceil(left / step); k * step <= right; k++) {
    const x = Math.round(viewport.screen(k * step, 0)[0]) + 0.5;
    d += `M${x} 0V${height}`;
    if (x > 40 && x < width - 60) tick(x + 3, foot, number(k * step));
  }
  for (let k = Math.ceil(bottom / step); k * step <= top; k++) {
    const y = Math.round(viewport.screen(0, k * step)[1]) + 0.5;
    d += `M0 ${y}H${width}`;
    if (y > above + 20 && y < height - 50) tick(6, y - 3, number(k * step));
  }
  return [svg("path.mesh", { d }), ...numbers];
}
