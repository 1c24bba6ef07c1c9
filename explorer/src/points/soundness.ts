/** Points that no coupler curve of a four-bar meets, as `gruebler.design.synthesis` refuses them. */

import { abs, type Complex, mul, scaled, sub } from "./complex";

const SAME = 1e-9;
const MOST = 6; // points in which a coupler curve meets a line or a circle: it is of degree six

/** Which two points are equal; how many lie on one line or circle. */
export type Fault = { equal: [number, number] } | { line: number } | { circle: number };

export function faultOf(points: readonly Complex[]): Fault | null {
  const size = Math.max(...points.map((one) => abs(sub(one, points[0]!)))) || 1;
  for (const [k, one] of points.entries())
    for (const [m, other] of points.slice(0, k).entries())
      if (abs(sub(one, other)) <= SAME * size) return { equal: [m + 1, k + 1] };
  const near = SAME * size;
  for (const [k, one] of points.entries())
    for (const [m, two] of points.slice(0, k).entries())
      for (const three of points.slice(0, m)) {
        const centre = centreOf(sub(two, one), sub(three, one), near);
        const off = centre
          ? (at: Complex) => Math.abs(abs(sub(sub(at, one), centre)) - abs(centre))
          : (at: Complex) => Math.abs(cross(sub(at, one), sub(two, one))) / abs(sub(two, one));
        const count = points.filter((at) => off(at) <= near).length;
        if (count > MOST) return centre ? { circle: count } : { line: count };
      }
  return null;
}

const cross = ([a, b]: Complex, [c, d]: Complex) => a * d - b * c;

/** The centre of the circle through 0, u and v; null where they lie on a line. */
function centreOf(u: Complex, v: Complex, near: number): Complex | null {
  const area = cross(u, v);
  if (Math.abs(area) <= near * Math.max(abs(u), abs(v))) return null;
  const [uu, vv] = [abs(u) ** 2, abs(v) ** 2];
  // from |c|^2 = |c - u|^2 = |c - v|^2
  return scaled(1 / (2 * area), mul([0, 1], sub(scaled(vv, u), scaled(uu, v))));
}
