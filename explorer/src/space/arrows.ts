/** The arrows of the drives of a machine in space: about the axes of turning ones, along those of sliding ones. */

import { svg } from "../dom";
import type { Pair } from "../rows";
import { cross, dot, minus, moved, type Vector } from "./algebra";
import type { Machine } from "./machine";

const LONG = 0.16; // of the size of the machine, half the length of an arrow along an axis
const BESIDE = 0.055; // between it and its bar
const RADIUS = 0.1; // of one about it
const TURNED = 4.7; // radians
const CORNERS = 40;
const HEAD = 9; // pixels
const TIP = 0.035; // of the size of the machine, the head of an arrow of another drive

/** The places of each arrow, from its tail to its tip, which goes the way that the drive grows; seen from near, those
 * that slide stand beside their bars. */
export function arrowsOf({ data }: Machine, poses: ArrayLike<number>[], near: Vector): Vector[][] {
  return data.motions.map(({ arrow, unit }) => {
    const pose = poses[arrow.link]!;
    const at = moved(pose, arrow.at);
    const along = minus(moved(pose, arrow.at.map((v, n) => v + arrow.along[n]!) as Vector), at);
    const turned = unit === "°";
    const own = arrow.along.map(Math.abs);
    const least = moved(
      pose,
      [0, 1, 2].map((k) => arrow.at[k]! + Number(k === own.indexOf(Math.min(...own)))) as Vector,
    );
    const across = cross(along, minus(least, at));
    const beside = cross(along, near);
    const aside = turned || Math.hypot(...beside) < BESIDE ? across : beside;
    const out = Math.sign(dot(aside, minus(at, data.middle))) || 1; // where there is most room
    const part = ((turned ? RADIUS : out * BESIDE) * data.size) / Math.hypot(...aside);
    const one = aside.map((v) => v * part) as Vector;
    const two = cross(along, one);
    return Array.from({ length: CORNERS + 1 }, (_, k): Vector => {
      const [c, s] = [Math.cos((TURNED * k) / CORNERS), Math.sin((TURNED * k) / CORNERS)];
      const far = (2 * (k / CORNERS) - 1) * LONG * data.size;
      return at.map((v, n) => v + (turned ? c * one[n]! + s * two[n]! : one[n]! + far * along[n]!)) as Vector;
    });
  });
}

/** The line of an arrow in space with a head that is seen from near its end. */
export function tipped(places: Vector[], near: Vector, size: number): Vector[] {
  const tip = places.at(-1)!;
  const back = minus(places.at(-4)!, tip);
  const aside = cross(back, near);
  const [long, wide] = [back, aside].map((v) => (TIP * size) / (Math.hypot(...v) || 1)) as [number, number];
  const side = (sign: number) => tip.map((v, n) => v + long * back[n]! + 0.5 * sign * wide * aside[n]!) as Vector;
  return [...places, side(1), tip, side(-1)];
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
