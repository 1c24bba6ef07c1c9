/** Convex hulls and distances, in pixels or in the plane. */

import type { Pair } from "./rows";

/** The corners of the convex hull, in order. */
export function convexHull(points: readonly (readonly [number, number])[]): Pair[] {
  const all = points.map(([x, y]): Pair => [x, y]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const equal = (one: number, other: number) => one === other || (Number.isNaN(one) && Number.isNaN(other));
  const sorted = all.filter(([x, y], k) => !k || !equal(x, all[k - 1]![0]) || !equal(y, all[k - 1]![1]));
  if (sorted.length < 3) return sorted;
  return [...half(sorted), ...half([...sorted].reverse())];
}

/** One side of the hull of sorted points, without its last. */
function half(list: readonly Pair[]): Pair[] {
  const out: Pair[] = [];
  for (const p of list) {
    while (out.length > 1) {
      const [ax, ay] = out[out.length - 2]!;
      const [bx, by] = out[out.length - 1]!;
      if ((bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0) break;
      out.pop();
    }
    out.push(p);
  }
  return out.slice(0, -1);
}

/** From each corner to the next. */
export function sidesOf(hull: readonly Pair[]): [Pair, Pair][] {
  return hull.map((one, k) => [one, hull[(k + 1) % hull.length]!]);
}

/** How far a point is from a convex polygon: 0 within it. Asked some thousand times a frame, so nothing is made. */
export function toHull(hull: readonly Pair[], x: number, y: number): number {
  let within = hull.length > 2;
  let least = Infinity;
  for (let k = 0; k < hull.length; k++) {
    const p = hull[k]!;
    const q = hull[(k + 1) % hull.length]!;
    const dx = q[0] - p[0];
    const dy = q[1] - p[1];
    const u = x - p[0];
    const v = y - p[1];
    if (dx * v < dy * u) within = false;
    const part = Math.max(0, Math.min(1, (u * dx + v * dy) / (dx * dx + dy * dy || 1)));
    const [far, aside] = [u - part * dx, v - part * dy];
    least = Math.min(least, far * far + aside * aside);
  }
  return within ? 0 : Math.sqrt(least);
}

/** Of places so far from another, or twice as far, the one that is clearest of hulls, with some room at its sides. The
 * first of equals lies to the right and, where y grows upward, above; with a negative distance on the other side. The
 * first half of these places is near. */
export function clearAbout([x, y]: Pair, far: number, hulls: readonly (readonly Pair[])[], room = 0): Pair {
  const around = spotsAbout([x, y], far, room);
  const near = hulls.filter((hull) => toHull(hull, x, y) < 3 * Math.abs(far) + 2 * room); // others are no matter
  const clear = around.map(([u, v], k) => {
    const gaps = [-room, 0, room].flatMap((d) => near.map((hull) => toHull(hull, u + d, v)));
    return Math.min(Math.abs(far), ...gaps) / (1 + (k >> 4));
  });
  return around[clear.indexOf(Math.max(...clear))]!;
}

/** These places, the first of them there, or in a given direction. */
export function spotsAbout([x, y]: Pair, far: number, room = 0, toward?: number): Pair[] {
  return Array.from({ length: 32 }, (_, k): Pair => {
    const aside = ((k & 1) - 0.5) * ((k + 1) & 14); // to both sides in turn
    const phi = toward === undefined ? ((3 - k) * Math.PI) / 8 : toward + (aside * Math.PI) / 8;
    const off = far * (1 + (k >> 4));
    return [x + (off + Math.sign(far) * room) * Math.cos(phi), y + off * Math.sin(phi)];
  });
}

/** The place on the line through two others that is the nearest to a third. */
export function onLine([x, y]: Pair, [u, v]: Pair, [p, q]: Pair): Pair {
  const [dx, dy] = [u - x, v - y];
  const part = ((p - x) * dx + (q - y) * dy) / (dx * dx + dy * dy);
  return [x + part * dx, y + part * dy];
}

/** The middle of places. */
export function middleOf(places: readonly Pair[]): Pair {
  const mean = (axis: 0 | 1) => places.reduce((sum, at) => sum + at[axis], 0) / (places.length || 1);
  return [mean(0), mean(1)];
}

/** How far a place is from another. */
export function away([px, py]: Pair, x: number, y: number): number {
  return Math.hypot(px - x, py - y);
}

/** The number of what is nearest, if anything is within reach. */
export function nearest<Item>(items: readonly Item[], reach: number, far: (item: Item, k: number) => number) {
  let best: number | null = null;
  let least = reach;
  for (const [k, item] of items.entries()) {
    const gap = far(item, k);
    if (gap < least) [best, least] = [k, gap];
  }
  return best;
}

/** A path through places in pixels. */
export function pathThrough(places: readonly Pair[]): string {
  return places.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
}
