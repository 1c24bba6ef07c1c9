/** Whether a four-bar does what was wanted, by moving it with the kernel of motion: as
 * `gruebler.design.synthesis.judging` does it, on the way from the first point to the last. */

import { type Cycle, findCycle, type Moved, TURN } from "../cycle";
import { Kernel, type State } from "../kernel";
import type { Model } from "../model";
import { programOf } from "../program";
import { place } from "../rows";
import { Sizes } from "../sizes";
import { Status } from "../status";
import { abs, angle, type Complex, sub } from "./complex";
import { couplerTurns, type FourBar, lengthsOf, modelOf, placed, type Template } from "./fourbars";

const EXACT = 1e-9; // of the task's size: a point is met if it is missed by less
const ROUNDING = 1e-13; // of the linkage's size: what the poses of a large linkage for a small task cannot promise
const SLENDER = 20; // the longest length by the shortest, as a workshop accepts it
const STEP = TURN / 180;

export interface Demands {
  /** Whether the drive must turn fully. */
  crank: boolean;
  /** The least transmission angle on the way, in degrees. */
  transmission: number;
}

/** A four-bar that does it, and how well. */
export interface Judged {
  model: Model;
  cycle: Cycle;
  full: boolean;
  /** In degrees. */
  transmission: number;
  ratio: number;
  /** The largest deviation, relative to the size of the task. */
  error: number;
}

/** A four-bar in the position of one of the points, judged; null if it does not do it.
 *
 * Args:
 *     template: of the model.
 *     bar: the dyad that is driven, and the other.
 *     targets: the points in their order, and `first` the number of that in whose position it stands.
 *     size: of the task. */
export function judged(
  template: Template,
  bar: FourBar,
  targets: readonly Complex[],
  first: number,
  size: number,
  demands: Demands,
): Judged | null {
  const lengths = lengthsOf(bar);
  const ratio = Math.max(...lengths) / Math.min(...lengths);
  if (!(ratio <= SLENDER)) return null;
  const from = targets[first]!;
  const turns = couplerTurns(
    bar,
    from,
    targets.map((target) => sub(target, from)),
  );
  turns[first] = [1, 0];
  const poses = targets.map((target, k) => placed(bar, from, target, turns[k]!));
  const model = modelOf(template, bar, from, poses[0]!);
  const way = ways(poses.map(({ crank }) => crank)).map((angles) => carried(model, angles, targets, size));
  const limit = EXACT + (ROUNDING * Math.max(...lengths)) / size;
  const best = way.find((one) => one && one.error <= limit && one.transmission >= demands.transmission);
  if (!best) return null;
  const cycle = findCycle(movedBy(model));
  const full = cycle.full && cycle.turns === 1;
  if (demands.crank && !full) return null;
  return { model: { ...model, span: { turns: full ? 1 : 0, between: null } }, cycle, full, ratio, ...best };
}

/** The drive from point to point, in either sense, where it goes round once at most. */
function ways(angles: readonly number[]): number[][] {
  return [1, -1].flatMap((sense) => {
    const way = [angles[0]!];
    for (const next of angles.slice(1)) {
      const step = sense * (next - way.at(-1)!);
      way.push(way.at(-1)! + sense * (step - TURN * Math.floor(step / TURN)));
    }
    return Math.abs(way.at(-1)! - way[0]!) < TURN ? [way] : [];
  });
}

/** The points met on a way of the drive, by the kernel; null where it does not lead through all of them. */
function carried(
  model: Model,
  angles: readonly number[],
  targets: readonly Complex[],
  size: number,
): { error: number; transmission: number } | null {
  const values: number[] = [];
  const at = angles.map((value, k) => {
    const last = angles[k - 1] ?? value;
    const steps = Math.ceil(Math.abs(value - last) / STEP);
    const between = Array.from(
      { length: Math.max(0, steps - 1) },
      (_, step) => last + ((value - last) * (step + 1)) / steps,
    );
    values.push(...withExtremes(model, [...between, value], last));
    return values.length - 1;
  });
  const rows = new Kernel(programOf(model.program)).run(Float64Array.from(values), stateOf(model), 0);
  if (rows.status !== Status.DONE) return null;
  const { link, at: point } = model.points[0]!;
  const miss = targets.map((target, k) => abs(sub(place(rows, at[k]!, link, ...point), target)));
  const least = values.map((_, row) => transmissionAt(model, (l, x, y) => place(rows, row, l, x, y)));
  return { error: Math.max(...miss) / size, transmission: Math.min(...least) };
}

/** Values from one to the last, and those between where the crank is in line with the frame: there the transmission
 * angle is smallest, or largest. */
function withExtremes({ elements, frame }: Model, values: number[], last: number): number[] {
  const [[x, y], [u, v]] = elements.filter((e) => e.link === frame).map((e): Complex => e.at) as [Complex, Complex];
  const sense = Math.sign(values.at(-1)! - last) || 1;
  const lineUp = Math.atan2(v - y, u - x);
  const next = last + sense * (Math.PI - (((((last - lineUp) * sense) % Math.PI) + Math.PI) % Math.PI));
  const more = [next, next + sense * Math.PI].filter((value) => (values.at(-1)! - value) * sense > 0);
  return [...values, ...more].sort((one, other) => sense * (one - other));
}

/** The transmission angle in degrees: between coupler and rocker, at most a right one. */
function transmissionAt(model: Model, lies: (link: number, x: number, y: number) => Complex): number {
  const { from, pin, guide } = model.outputs[0]!.legs[0]!;
  const [a, b, c] = [from, pin, guide!.at].map(([link, x, y]) => lies(link, x, y)) as [Complex, Complex, Complex];
  const between = Math.abs(angle(sub(a, b)) - angle(sub(c, b))) % Math.PI;
  return (Math.min(between, Math.PI - between) * 180) / Math.PI;
}

function stateOf(model: Model): State {
  return { signs: Float64Array.from(model.start.signs), unknowns: new Float64Array(0) };
}

/** A four-bar as its cycle is found. */
function movedBy(model: Model): Moved {
  const program = programOf(model.program);
  const kernel = new Kernel(program);
  const speeds = (count: number) => [new Float64Array(count).fill(1), new Float64Array(count)];
  const runAlong = (values: Float64Array, from: State, order: number) =>
    kernel.run(values, from, order, order ? speeds(values.length) : []);
  const [drives, state] = [Float64Array.from(model.start.drives), stateOf(model)];
  return {
    sizes: new Sizes(model, program.size),
    active: 0,
    drive: model.drives[0]!,
    drives,
    state,
    pose: runAlong(drives, state, 2),
    wheels: false,
    runAlong,
  };
}
