/** Convex hulls and distances, in pixels or in the plane. */

import type { Pair } from "./rows";

/** The corners of the convex hull, in order. */
export function convexHull(points: readonly (readonly [number, number])[]): Pair[] {
  const different = new Map(points.map(([x, y]) => [`${x},${y}`, [x, y] as Pair]));
  const sorted = [...different.values()].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
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

/** How far a point is from a convex polygon: 0 within it. */
export function toHull(hull: readonly Pair[], x: number, y: number): number {
  if (inside(hull, x, y)) return 0;
  return Math.min(...hull.map((p, k) => toSegment(x, y, p, hull[(k + 1) % hull.length]!)));
}

function inside(hull: readonly Pair[], x: number, y: number): boolean {
  return (
    hull.length > 2 &&
    hull.every(([ax, ay], k) => {
      const [bx, by] = hull[(k + 1) % hull.length]!;
      return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
    })
  );
}

function toSegment(x: number, y: number, [ax, ay]: Pair, [bx, by]: Pair): number {
  const dx = bx - ax;
  const dy = by - ay;
  const d = dx * dx + dy * dy;
  const part = d ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / d)) : 0;
  return Math.hypot(x - ax - part * dx, y - ay - part * dy);
}

/** Of places so far from another, or twice as far, the one that is clearest of hulls, with some room at its sides. The
 * first of equals lies to the right and, where y grows upward, above; with a negative distance on the other side. */
export function clearAbout([x, y]: Pair, far: number, hulls: readonly (readonly Pair[])[], room = 0): Pair {
  const around = spotsAbout([x, y], far, room);
  const near = hulls.filter((hull) => toHull(hull, x, y) < 3 * Math.abs(far) + 2 * room); // others are no matter
  const clear = around.map(([u, v], k) => {
    const gaps = [-room, 0, room].flatMap((d) => near.map((hull) => toHull(hull, u + d, v)));
    return Math.min(Math.abs(far), ...gaps) / (1 + (k >> 4));
  });
  return around[clear.indexOf(Math.max(...clear))]!;
}

/** These places. */
export function spotsAbout([x, y]: Pair, far: number, room = 0): Pair[] {
  return Array.from({ length: 32 }, (_, k): Pair => {
    const phi = ((3 - k) * Math.PI) / 8;
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
