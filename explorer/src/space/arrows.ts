/** The arrows of the drives of a machine in space: about the axes of turning ones, along those of sliding ones. */

import { svg } from "../dom";
import type { Pair } from "../rows";
import { cross, moved, type Vector } from "./algebra";
import type { Machine } from "./machine";

const LONG = 0.16; // of the size of the machine, half the length of an arrow along an axis
const RADIUS = 0.1; // of one about it
const TURNED = 4.7; // radians
const CORNERS = 40;
const HEAD = 9; // pixels

/** The places of each arrow, from its tail to its tip, which goes the way that the drive grows. */
export function arrowsOf({ data }: Machine, poses: ArrayLike<number>[]): Vector[][] {
  return data.motions.map(({ arrow: { along, at, link }, unit }) => {
    const least = along.map(Math.abs).indexOf(Math.min(...along.map(Math.abs)));
    const aside = cross(along, [0, 1, 2].map((k) => Number(k === least)) as Vector);
    const far = Math.hypot(...aside);
    const turned = unit === "°";
    const radius = (turned ? RADIUS : LONG) * data.size;
    const one = aside.map((v) => (v * radius) / far) as Vector;
    const two = cross(along, one);
    const places = Array.from({ length: CORNERS + 1 }, (_, k): Vector => {
      const part = k / CORNERS;
      const [c, s] = [Math.cos(TURNED * part), Math.sin(TURNED * part)];
      return at.map((v, n) =>
        turned ? v + c * one[n]! + s * two[n]! : v + one[n]! + (2 * part - 1) * radius * along[n]!,
      ) as Vector;
    });
    return places.map((place) => moved(poses[link]!, place));
  });
}

/** A line of pixels with a head at its end. */
export function headed(places: Pair[]): SVGElement {
  const [x, y] = places.at(-1)!;
  const [u, v] = places.at(-4)!;
  const long = Math.hypot(x - u, y - v) || 1;
  const [dx, dy] = [(HEAD * (x - u)) / long, (HEAD * (y - v)) / long];
  const side = (sign: number) => `${(x - dx - sign * 0.5 * dy).toFixed(1)} ${(y - dy + sign * 0.5 * dx).toFixed(1)}`;
  const line = places.map(([px, py]) => `${px.toFixed(1)} ${py.toFixed(1)}`).join("L");
  return svg("path.driven", { d: `M${line}M${side(1)}L${x.toFixed(1)} ${y.toFixed(1)}L${side(-1)}` });
}
