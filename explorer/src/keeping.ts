/** Places that are brought to given distances, moved as little as possible. */

import type { Pair } from "./rows";

/** Two places by their numbers, and how far they shall be apart; or in which direction, at whatever distance. */
export type Distance = readonly [one: number, other: number, length: number, direction?: Pair];

const MOST_STEPS = 60;
const RIDGE = 1e-13; // of the diagonal: distances that follow from others do no harm

/**
 * The places after Newton's method on the distances, each step the shortest one, in which a place counts the less the
 * easier it moves; null if they cannot be met to a part of 1e-12, or a direction was turned round.
 */
export function kept(places: readonly Pair[], distances: readonly Distance[], ease: readonly number[]): Pair[] | null {
  const at = places.map(([x, y]): Pair => [x, y]);
  const size = Math.max(...distances.map(([, , length]) => length));
  for (let step = 0; step < MOST_STEPS; step++) {
    // the direction from one to the other, and how much is missing
    const rows = distances.map(([one, other, length, direction]) => {
      const [dx, dy] = [at[other]![0] - at[one]![0], at[other]![1] - at[one]![1]];
      if (direction) {
        const [c, s] = direction;
        return { one, other, x: -s, y: c, missing: s * dx - c * dy, turned: !(c * dx + s * dy > 0) };
      }
      const far = Math.hypot(dx, dy) || 1e-300;
      return { one, other, x: dx / far, y: dy / far, missing: length - far, turned: false };
    });
    if (rows.every(({ missing }) => Math.abs(missing) <= 1e-12 * size))
      return rows.some(({ turned }) => turned) ? null : at;
    const moves = (place: number, row: (typeof rows)[number]) =>
      (place === row.other ? 1 : 0) - (place === row.one ? 1 : 0);
    const matrix = rows.map((a, k) =>
      rows.map((b, m) => {
        const shared = [a.one, a.other].reduce((sum, p) => sum + ease[p]! * moves(p, a) * moves(p, b), 0);
        return shared * (a.x * b.x + a.y * b.y) * (k === m ? 1 + RIDGE : 1);
      }),
    );
    const pulls = solved(
      matrix,
      rows.map(({ missing }) => missing),
    );
    if (!pulls) return null;
    rows.forEach(({ one, other, x, y }, k) => {
      for (const [place, sign] of [
        [one, -1],
        [other, 1],
      ] as const) {
        at[place]![0] += sign * ease[place]! * pulls[k]! * x;
        at[place]![1] += sign * ease[place]! * pulls[k]! * y;
      }
    });
  }
  return null;
}

/** The solution of linear equations by elimination with pivots; rows that are nothing are passed over. */
function solved(matrix: number[][], right: readonly number[]): number[] | null {
  const rows = matrix.map((row, k) => [...row, right[k]!]);
  const count = rows.length;
  const most = Math.max(...rows.map((row, k) => Math.abs(row[k]!)));
  for (let k = 0; k < count; k++) {
    let best = k;
    for (let m = k; m < count; m++) if (Math.abs(rows[m]![k]!) > Math.abs(rows[best]![k]!)) best = m;
    [rows[k], rows[best]] = [rows[best]!, rows[k]!];
    const pivot = rows[k]![k]!;
    if (!(Math.abs(pivot) > 1e-18 * most)) return null;
    for (let m = 0; m < count; m++) {
      const factor = m === k ? 0 : rows[m]![k]! / pivot;
      if (factor) for (let j = k; j <= count; j++) rows[m]![j]! -= factor * rows[k]![j]!;
    }
  }
  const found = rows.map((row, k) => row[count]! / row[k]!);
  return found.every(Number.isFinite) ? found : null;
}
