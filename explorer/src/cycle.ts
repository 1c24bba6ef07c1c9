/** The whole motion of one drive, the others at rest: found from the pose that is shown. */

import type { Rows, State } from "./kernel";
import type { DriveRecord } from "./model";
import { direction, joined, leastRoot, origin, place, stateAt, turn } from "./rows";
import type { Sizes } from "./sizes";
import { Status } from "./status";

export const TURN = 2 * Math.PI;
export const DEGREE = TURN / 360;
const MOST_TURNS = 8;
const MOST_WITH_WHEELS = 40;
const BACK = 1e-7; // how near a linkage is to where it was, after whole turns
const OPEN = 1e-9; // sizes and radians: redundant joints that are open by more are not closed
const DOUBTFUL = 1e-6; // below this root a pose may be wrong by more than that
const ENDLESS = 1.5; // sizes: how far a slide without limits is shown

export interface Stop {
  value: number;
  status: Status | "open";
  /** The form and the links of the group at fault, or the name of the open joint. */
  form: string;
  links: string[];
}

/** How far a drive goes. */
export interface Reach {
  full: boolean;
  /** After how many turns everything repeats; 0 if the drive does not go round. */
  turns: number;
  low: number;
  high: number;
  stops: [Stop | null, Stop | null];
}

export interface Cycle extends Reach {
  drive: number;
  values: Float64Array;
  rows: Rows;
  /** The row of the pose from which it was found. */
  home: number;
  /** Of a free motion the cycle before it. */
  whole?: Cycle;
}

/** What is moved: a linkage in a pose, with one of its drives. */
export interface Moved {
  readonly sizes: Sizes;
  /** The number of the drive, and its record. */
  readonly active: number;
  readonly drive: DriveRecord | null;
  readonly drives: Float64Array;
  readonly state: State;
  readonly pose: Rows;
  readonly wheels: boolean;
  /** Whether fewer rows will do. */
  readonly quick?: boolean;
  /** That of the sizes before, if there were any. */
  readonly cycle?: Cycle;
  /** Rows along values of the drive, from a state at the first value. */
  runAlong(values: Float64Array, state: State, order: number): Rows;
}

/** An end of the range: where it is and why, unless nothing stops it there. */
type End = [number, Stop | null];

/** The cycle of the active drive over its whole range, or the part in which the machine is used, from the pose that is
 * shown. */
export function findCycle(moved: Moved): Cycle {
  const { active, drive, drives, sizes, pose } = moved;
  // as `pose_at_reference`, so that what the library says of this pose has the same lap; wheels count their turns
  if (drive?.turning && !moved.wheels) drives[active] = principal(drives[active]!);
  const start = drives[active] ?? 0;
  const still: Cycle = {
    drive: active,
    values: Float64Array.of(start),
    rows: pose,
    full: false,
    turns: 0,
    low: start,
    high: start,
    stops: [null, null],
    home: 0,
  };
  if (!drive) return still;
  const { span } = sizes.model;
  const between = span.between ?? span.stops?.[active];
  const part = between && between[1] - between[0] < TURN - BACK; // it may turn fully, but is not used so
  const round = drive.turning && !part ? fullTurns(moved, start) : null;
  if (round && "rows" in round) {
    return { ...still, ...round, full: true, high: start + round.turns * TURN };
  }
  const turns = part ? 1 : MOST_TURNS;
  let [high, above] = round?.end ?? search(moved, start, 1, turns);
  let [low, below] = search(moved, start, -1, turns);
  if (!drive.turning) {
    if (!above) high = Math.min(high, start + ENDLESS * sizes.unit);
    if (!below) low = Math.max(low, start - ENDLESS * sizes.unit);
  }
  if (between) {
    const shift = drive.turning ? TURN * Math.round((low + high - between[0] - between[1]) / 2 / TURN) : 0;
    const [from, to] = [Math.min(start, between[0] + shift), Math.max(start, between[1] + shift)];
    if (from > low) [low, below] = [from, null];
    if (to < high) [high, above] = [to, null];
  }
  const stops: [Stop | null, Stop | null] = [below, above];
  if (high - low < 2e-6 * (drive.turning ? 1 : sizes.unit)) return { ...still, low, high, stops };
  const least = moved.quick ? 61 : 181;
  const count = drive.turning ? Math.max(least, Math.ceil((high - low) / (TURN / 60))) : least;
  const all = denseAtEnds(low, high, count);
  const up = all.filter((value) => value > start);
  const down = all.filter((value) => value <= start).reverse();
  const one = moved.runAlong(Float64Array.of(start, ...up), moved.state, 2);
  const two = moved.runAlong(Float64Array.of(start, ...down), moved.state, 2);
  const home = Math.max(0, two.reached - 1);
  const reachedUp = up.slice(0, Math.max(0, one.reached - 1));
  const values = Float64Array.from([...down.slice(0, home).reverse(), start, ...reachedUp]);
  return { ...still, values, rows: joined(two, one), low, high, stops, home };
}

/** The same angle between -180° and 180°. */
export function principal(angle: number): number {
  return angle - TURN * Math.round(angle / TURN);
}

/** Values of a range, the more of them the nearer to its ends, which are no values themselves. */
export function denseAtEnds(low: number, high: number, count: number): number[] {
  const part = (k: number) => Math.sin((Math.PI * (k + 0.5)) / (2 * count)) ** 2;
  return Array.from({ length: count }, (_, k) => low + (high - low) * part(k));
}

/** As many turns as it takes to come back; else where the first one ends, if it does. */
function fullTurns(
  moved: Moved,
  start: number,
): { turns: number; values: Float64Array; rows: Rows } | { end: End | null } {
  const most = moved.wheels ? MOST_WITH_WHEELS : MOST_TURNS;
  const { span } = moved.sizes.model;
  // without rates where they were of no use in the cycle before
  const order = moved.cycle?.full === false ? 0 : 2;
  let turns = 1;
  while (turns <= most) {
    let steps = moved.quick ? 180 : 360;
    if (turns > 1) steps = turns <= MOST_TURNS ? 120 : 60;
    const values = new Float64Array(turns * steps + 1).map((_, k) => start + (k * TURN) / steps);
    let rows = moved.runAlong(values, moved.state, order);
    const end = endOf(moved, values, rows, TURN / steps);
    if (end) return { end: turns === 1 ? end : null };
    if (same(moved.sizes, rows, turns * steps)) {
      if (order < 2) rows = moved.runAlong(values, moved.state, 2);
      return { turns, values, rows };
    }
    if (turns === most) break;
    turns = turns === 1 && span.turns > 1 ? Math.min(span.turns, most) : turns + 1;
  }
  return { end: null };
}

/** Where the motion ends in one direction. */
function search(moved: Moved, start: number, way: number, turns: number): End {
  const turning = moved.drive?.turning ?? true;
  const far = turning ? turns * TURN : 3 * moved.sizes.unit;
  const step = turning ? TURN / 180 : moved.sizes.unit / 40;
  // by parts, so that a near limit is not looked for far away
  let from = start;
  let state = moved.state;
  while (Math.abs(from - start) < far - 1e-9) {
    const first = from;
    const values = new Float64Array(31).map((_, k) => first + way * k * step);
    const rows = moved.runAlong(values, state, 0);
    const end = endOf(moved, values, rows, way * step);
    if (end) return end;
    from = values[30]!;
    state = stateAt(rows, 30);
  }
  return [from, null];
}

/** Where rows end before all values were reached. */
function endOf(moved: Moved, values: Float64Array, rows: Rows, way: number): End | null {
  const open = firstOpen(moved.sizes, rows);
  if (open) {
    const stop: Stop = { value: values[open.row]!, status: "open", form: open.name, links: [] };
    return [values[Math.max(0, open.row - 1)]!, stop];
  }
  if (rows.status === Status.DONE) return null;
  const row = Math.min(Math.floor(rows.at), values.length - 2);
  const value = values[row]! + (rows.at - row) * way;
  return [value, stopOf(moved.sizes, rows, value)];
}

/** What stopped rows. */
export function stopOf({ model }: Sizes, rows: Rows, value: number): Stop {
  const dyad = rows.fault >= 0;
  const number = dyad ? rows.fault : -1 - rows.fault;
  const group = model.groups.find((g) => g.dyad === dyad && g.number === number);
  return { value, status: rows.status, form: group?.form ?? "", links: group?.links ?? [] };
}

/** Whether in a row all links lie where they lay in the first. */
function same({ unit }: Sizes, rows: Rows, row: number): boolean {
  const apart = ([x, y]: [number, number], [u, v]: [number, number], most: number) =>
    Math.abs(x - u) > most || Math.abs(y - v) > most;
  for (let link = 0; link < rows.links; link++) {
    if (apart(origin(rows, row, link), origin(rows, 0, link), BACK * unit)) return false;
    if (apart(turn(rows, row, link), turn(rows, 0, link), BACK)) return false;
  }
  return true;
}

/** The first row in which a redundant joint is open. */
function firstOpen(sizes: Sizes, rows: Rows): { row: number; name: string } | null {
  const { joints, released } = sizes.model;
  if (released.length === 0) return null;
  for (let row = 0; row < rows.reached; row++) {
    if (leastRoot(rows, row) < DOUBTFUL) continue;
    for (const joint of released)
      if (opening(sizes, rows, row, joint) > OPEN) return { row, name: joints[joint]!.name };
  }
  return null;
}

/** How far the elements of a joint are apart, in sizes and radians. */
function opening(sizes: Sizes, rows: Rows, row: number, joint: number): number {
  const [first, ...others] = sizes.elementsOf(joint) as [number, ...number[]];
  const lineAt = (k: number) => direction(rows, row, sizes.element(k).link, sizes.line(k));
  const at = (k: number) => place(rows, row, sizes.element(k).link, ...sizes.xy(k));
  const { free } = sizes.model.joints[joint]!.pair;
  let out = 0;
  for (const k of others) {
    const [ax, ay] = at(first);
    const [bx, by] = at(k);
    const gx = (bx - ax) / sizes.unit;
    const gy = (by - ay) / sizes.unit;
    const [lx, ly] = lineAt(sizes.is(first, "line") ? first : k);
    const [ox, oy] = lineAt(k);
    const apart = Math.hypot(free.along ? 0 : lx * gx + ly * gy, free.across ? 0 : lx * gy - ly * gx);
    out = Math.max(out, apart, free.turn ? 0 : Math.abs(lx * oy - ly * ox));
  }
  return out;
}

/** A drive value as it is shown: of full turns the one from 0 on. */
export function wrapped({ full, turns }: Pick<Reach, "full" | "turns">, value: number): number {
  if (!full) return value;
  const period = turns * TURN;
  const rest = ((value % period) + period) % period;
  return period - rest < 1e-6 ? 0 : rest;
}
