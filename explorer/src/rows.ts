/** What stands in the rows of poses that the kernel gives: places, turns and rates of the links. */

import { type Rows, type State, Status } from "./kernel";

/** Two coordinates. */
export type Pair = [number, number];

/** The origin of a link in a row, or its velocity (1) or acceleration (2). */
export function origin(rows: Rows, row: number, link: number, k = 0): Pair {
  const at = ((row * (rows.order + 1) + k) * rows.links + link) * 2;
  return [rows.places[at]!, rows.places[at + 1]!];
}

/** Cosine and sine of the angle of a link in a row. */
export function turn(rows: Rows, row: number, link: number): Pair {
  const at = (row * rows.links + link) * 2;
  return [rows.turns[at]!, rows.turns[at + 1]!];
}

/** The angular velocity (1) or acceleration (2) of a link in a row. */
export function rate(rows: Rows, row: number, link: number, k = 1): number {
  return rows.rates[(row * rows.order + k - 1) * rows.links + link]!;
}

/** A point of a link in a row, or its velocity (1) or acceleration (2). */
export function place(rows: Rows, row: number, link: number, x: number, y: number, k = 0): Pair {
  const [ax, ay] = direction(rows, row, link, [x, y]);
  const [ox, oy] = origin(rows, row, link, k);
  if (k === 0) return [ox + ax, oy + ay];
  const w = rate(rows, row, link, 1);
  if (k === 1) return [ox - w * ay, oy + w * ax];
  const a = rate(rows, row, link, 2);
  return [ox - w * w * ax - a * ay, oy - w * w * ay + a * ax];
}

/** A direction on a link, as it lies in the plane in a row. */
export function direction(rows: Rows, row: number, link: number, [x, y]: Pair): Pair {
  const [c, s] = turn(rows, row, link);
  return [c * x - s * y, c * y + s * x];
}

/** Put the origin of a link to a place in the first row. */
export function putOrigin(rows: Rows, link: number, x: number, y: number): void {
  rows.places[2 * link] = x;
  rows.places[2 * link + 1] = y;
}

/** Move a link in the first row. */
export function move(rows: Rows, link: number, dx: number, dy: number): void {
  rows.places[2 * link]! += dx;
  rows.places[2 * link + 1]! += dy;
}

/** Turn a link in the first row; cosine and sine are given. */
export function putTurn(rows: Rows, link: number, c: number, s: number): void {
  rows.turns[2 * link] = c;
  rows.turns[2 * link + 1] = s;
}

/** How many rows there are, those that were not reached included. */
function countOf(rows: Rows): number {
  return rows.turns.length / (2 * rows.links);
}

/** Signs of the dyads and unknowns of the larger groups in a row. */
export function stateAt(rows: Rows, row: number): State {
  const count = countOf(rows);
  const dyads = rows.roots.length / count;
  const unknowns = rows.unknowns.length / count;
  return {
    signs: rows.roots.slice(row * dyads, (row + 1) * dyads).map((root) => (root < 0 ? -1 : 1)),
    unknowns: rows.unknowns.slice(row * unknowns, (row + 1) * unknowns),
  };
}

/** How far a row is from a change point or limit of a dyad: at most 1. */
export function leastRoot(rows: Rows, row: number): number {
  const dyads = rows.roots.length / countOf(rows);
  let out = 1;
  for (let m = 0; m < dyads; m++) out = Math.min(out, Math.abs(rows.roots[row * dyads + m]!));
  return out;
}

const WIDE = ["places", "turns", "rates", "roots", "unknowns"] as const;

/** One row of others, as a pose of its own. */
export function oneRow(rows: Rows, row: number): Rows {
  const count = countOf(rows);
  const out = { ...rows, status: Status.DONE, reached: 1, at: 0 };
  for (const key of WIDE) {
    const wide = rows[key].length / count;
    out[key] = rows[key].slice(row * wide, (row + 1) * wide);
  }
  return out;
}

/** Some rows of others; `at` is a place between the rows asked for. */
export function picked(rows: Rows, asked: number[], all: number[], values: Float64Array): Rows {
  const count = all.length;
  const reached = asked.filter((row) => row < rows.reached).length;
  const out = { ...rows, reached };
  for (const key of WIDE) {
    const wide = rows[key].length / count;
    const made = new Float64Array(wide * asked.length);
    for (const [k, row] of asked.entries()) made.set(rows[key].subarray(row * wide, (row + 1) * wide), k * wide);
    out[key] = made;
  }
  if (rows.status !== Status.DONE) {
    const low = Math.min(Math.floor(rows.at), count - 1);
    const high = Math.min(low + 1, count - 1);
    const value = all[low]! + (rows.at - low) * (all[high]! - all[low]!);
    const last = Math.max(0, reached - 1);
    const next = Math.min(last + 1, values.length - 1);
    out.at = last + (next === last ? 0 : (value - values[last]!) / (values[next]! - values[last]!));
  }
  return out;
}

/** Rows that go down from a pose, turned round, then those that go up; the pose itself once. */
export function joined(down: Rows, up: Rows): Rows {
  const out = { ...up, reached: down.reached - 1 + up.reached, status: Status.DONE };
  const count = countOf(up);
  for (const key of WIDE) {
    const wide = up[key].length / count;
    const made = new Float64Array(wide * out.reached);
    for (let row = 1; row < down.reached; row++)
      made.set(down[key].subarray(row * wide, (row + 1) * wide), (down.reached - 1 - row) * wide);
    made.set(up[key].subarray(0, up.reached * wide), (down.reached - 1) * wide);
    out[key] = made;
  }
  return out;
}
