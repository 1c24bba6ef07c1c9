/** What stands in the rows of poses that the kernel gives: places, turns and rates of the links. */

import type { Rows, State } from "./kernel";
import { Status } from "./status";

/** Two coordinates. */
export type Pair = [number, number];

/** The origin of a link in a row, or its velocity (1) or acceleration (2). */
export function origin(rows: Rows, row: number, link: number, k = 0): Pair {
  const at = 2 * ((k * rows.links + link) * countOf(rows) + row);
  return [rows.places[at]!, rows.places[at + 1]!];
}

/** Cosine and sine of the angle of a link in a row. */
export function turn(rows: Rows, row: number, link: number): Pair {
  const at = 2 * (link * countOf(rows) + row);
  return [rows.turns[at]!, rows.turns[at + 1]!];
}

/** The angular velocity (1) or acceleration (2) of a link in a row. */
export function rate(rows: Rows, row: number, link: number, k = 1): number {
  return rows.rates[((k - 1) * rows.links + link) * countOf(rows) + row]!;
}

/** A point of a link in a row, or its velocity (1) or acceleration (2). */
export function place(rows: Rows, row: number, link: number, x: number, y: number, k = 0): Pair {
  const count = countOf(rows);
  const at = 2 * (link * count + row);
  const c = rows.turns[at]!;
  const s = rows.turns[at + 1]!;
  const ax = c * x - s * y; // by hand: this is asked for each row of a motion
  const ay = c * y + s * x;
  const own = at + 2 * k * rows.links * count;
  const ox = rows.places[own]!;
  const oy = rows.places[own + 1]!;
  if (k === 0) return [ox + ax, oy + ay];
  const w = rate(rows, row, link, 1);
  if (k === 1) return [ox - w * ay, oy + w * ax];
  const a = rate(rows, row, link, 2);
  return [ox - w * w * ax - a * ay, oy - w * w * ay + a * ax];
}

/** How fast the origin of a link is in a row. */
export function speed(rows: Rows, row: number, link: number): number {
  const at = 2 * ((rows.links + link) * countOf(rows) + row);
  return Math.hypot(rows.places[at]!, rows.places[at + 1]!);
}

/** A direction on a link, as it lies in the plane in a row. */
export function direction(rows: Rows, row: number, link: number, [x, y]: Pair): Pair {
  const [c, s] = turn(rows, row, link);
  return [c * x - s * y, c * y + s * x];
}

/** Put the origin of a link to a place in a pose, one row. */
export function putOrigin(pose: Rows, link: number, x: number, y: number): void {
  pose.places[2 * link] = x;
  pose.places[2 * link + 1] = y;
}

/** Move a link in a pose. */
export function move(pose: Rows, link: number, dx: number, dy: number): void {
  pose.places[2 * link]! += dx;
  pose.places[2 * link + 1]! += dy;
}

/** Turn a link in a pose; cosine and sine are given. */
export function putTurn(pose: Rows, link: number, c: number, s: number): void {
  pose.turns[2 * link] = c;
  pose.turns[2 * link + 1] = s;
}

/** How many rows there are, those that were not reached included. */
function countOf(rows: Rows): number {
  return rows.turns.length / (2 * rows.links);
}

/** Signs of the dyads and unknowns of the larger groups in a row. */
export function stateAt(rows: Rows, row: number): State {
  const count = countOf(rows);
  const column = (all: Float64Array) => new Float64Array(all.length / count).map((_, k) => all[k * count + row]!);
  return { signs: column(rows.roots).map((root) => (root < 0 ? -1 : 1)), unknowns: column(rows.unknowns) };
}

/** How far a row is from a change point or limit of a dyad: at most 1. */
export function leastRoot(rows: Rows, row: number): number {
  const count = countOf(rows);
  let out = 1;
  for (let at = row; at < rows.roots.length; at += count) out = Math.min(out, Math.abs(rows.roots[at]!));
  return out;
}

/** How many numbers of a row stand side by side. */
const WIDTHS = { places: 2, turns: 2, rates: 1, roots: 1, unknowns: 1 } as const;

type Columns = Pick<Rows, keyof typeof WIDTHS>;

/** The columns of some rows, each out of one motion or another of the same linkage. */
function selected(wanted: readonly (readonly [Rows, number])[]): Columns {
  const [model] = wanted[0]!;
  const made = (key: keyof Columns) => {
    const width = WIDTHS[key];
    const columns = model[key].length / (width * countOf(model));
    const out = new Float64Array(width * columns * wanted.length);
    wanted.forEach(([source, from], row) => {
      const all = source[key];
      const step = width * countOf(source);
      for (let part = 0; part < width; part++) {
        let to = width * row + part;
        for (let at = width * from + part; at < all.length; at += step) {
          out[to] = all[at]!;
          to += width * wanted.length;
        }
      }
    });
    return out;
  };
  const [places, turns, rates] = [made("places"), made("turns"), made("rates")];
  return { places, turns, rates, roots: made("roots"), unknowns: made("unknowns") };
}

/** One row of others, as a pose of its own. */
export function oneRow(rows: Rows, row: number): Rows {
  return { ...rows, status: Status.DONE, reached: 1, at: 0, ...selected([[rows, row]]) };
}

/** Poses as rows. */
export function together(poses: readonly Rows[]): Rows {
  return { ...poses[0]!, reached: poses.length, ...selected(poses.map((pose) => [pose, 0])) };
}

/** Some rows of others; `at` is a place between the rows asked for. */
export function picked(rows: Rows, asked: number[], all: number[], values: Float64Array): Rows {
  const count = all.length;
  const reached = asked.filter((row) => row < rows.reached).length;
  const out = { ...rows, reached, ...selected(asked.map((row) => [rows, row])) };
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
  const below = Array.from({ length: Math.max(0, down.reached - 1) }, (_, k) => [down, down.reached - 1 - k] as const);
  const above = Array.from({ length: up.reached }, (_, row) => [up, row] as const);
  const wanted = [...below, ...above];
  return { ...up, reached: wanted.length, status: Status.DONE, ...selected(wanted) };
}
