/** The plane of the synthesis: how much of it is seen, its grid, and how large its marks are. */

import { svg } from "./dom";
import { degreeStep, gridStep } from "./grid";
import { SUPPORT } from "./ground";
import { number } from "./language";
import type { Box } from "./viewport";

export const MARK = 3.2; // pixels that a mark has for each of its units
const AROUND = 45; // pixels around a mark
const CLOSE = 30; // the same in a narrow element
const LINES = 36; // pixels between lines of the grid, at least

export interface Area extends Box {
  /** The unit of marks, as a length of the plane. */
  unit: number;
}

/** A square about the origin of that width, or less of its height where that part of the window is low, and all of the
 * places; only these if the width is -Infinity. It is as wide as the element, and as high whatever the places are. */
export function areaOf(wide: number, part: number, places: readonly (readonly number[])[], element: Element): Area {
  const pixels = element.clientWidth || 840;
  const ratio = Math.min(1, Math.max(0.3, (part * window.innerHeight) / pixels));
  const ends = ([0, 1] as const).map((axis) => {
    const values = places.map((place) => place[axis]!);
    return [Math.min(...values), Math.max(...values)] as const;
  });
  const widest = Math.max(wide, ...ends.map(([low, most], axis) => (most - low) / (axis ? ratio : 1)));
  const around = pixels > 500 ? AROUND : CLOSE;
  const room = (around * widest) / (pixels - 2 * around); // for marks and their numbers
  let [[left, right], [bottom, top]] = ends.map(([low, most], axis) => {
    const half = (axis ? ratio * wide : wide) / 2;
    return [Math.min(-half, low - room), Math.max(half, most + room)];
  });
  const more = ((top - bottom) / ratio - (right - left)) / 2;
  left -= Math.max(0, more);
  right += Math.max(0, more);
  bottom += Math.min(0, more) * ratio;
  top -= Math.min(0, more) * ratio;
  return { left, right, bottom, top, unit: (MARK * (right - left)) / pixels };
}

/** What an element with this area as its picture has as its view box. */
export function viewBoxOf({ left, right, bottom, top }: Area): string {
  return [left, -top, right - left, top - bottom].map((value) => value.toPrecision(6)).join(" ");
}

/** Lines with their numbers, and the unit of length or else the names of both axes. */
export function gridOf(
  { left, right, bottom, top, unit }: Area,
  [across = "", up = "mm"]: string[] = [],
): SVGElement[] {
  const step = (across ? degreeStep : gridStep)((LINES / MARK) * unit);
  const line = (k: number, d: string) => svg("path", { class: k ? "mesh" : "axis", d });
  const tick = (x: number, y: number, text: string) =>
    svg("text.tick", { transform: `translate(${x} ${-y}) scale(${unit})` }, text);
  const lines: SVGElement[] = [];
  const ticks = [tick(up === "mm" ? right - 9 * unit : unit, top - 6 * unit, up)];
  ticks.push(tick(right - 2.2 * across.length * unit, unit, across));
  for (let k = Math.ceil(left / step); k * step < right; k++) {
    lines.push(line(k, `M${k * step} ${-top}V${-bottom}`));
    if (k % 2 === 0 && k * step < right - 8 * unit)
      ticks.push(tick(k * step + unit, bottom + 2 * unit, number(k * step)));
  }
  for (let k = Math.ceil(bottom / step); k * step < top; k++) {
    lines.push(line(k, `M${left} ${-k * step}H${right}`));
    if (k % 2 === 0 && k * step < top - 5 * unit && k * step > bottom + 6 * unit)
      ticks.push(tick(left + unit, k * step + unit, number(k * step)));
  }
  return [...lines, ...ticks];
}

/** A mark of the stage in pixels, at a place of the plane in which units of marks are so long; turned by degrees. */
export function mark(name: string, d: string, place: readonly number[], unit: number, turn = 0): SVGPathElement {
  return svg("path", { class: name, d, transform: markPlace(place, unit, turn) });
}

/** Where it is. */
export function markPlace([x, y]: readonly number[], unit: number, turn: number): string {
  return `translate(${x} ${-y!}) scale(${unit / MARK}) rotate(${turn})`;
}

/** A joint of the frame. */
export function groundMark(place: readonly number[], unit: number, turn = 0): SVGPathElement {
  return mark("support", SUPPORT, place, unit, turn);
}
