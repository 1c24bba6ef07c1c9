/** The plots of what a machine in space drives: how far its outputs turn or shift, over the only drive. */

import { TURN, wrapped } from "../cycle";
import type { Fact } from "../facts";
import { number, t } from "../language";
import { Plot } from "../plot";
import { Span } from "../span";
import { inBrackets } from "../wording";
import type { Vector } from "./algebra";
import { axisOf, endsOf, jointValue, type Machine, turnOf } from "./machine";

type Pose = ArrayLike<number>;

const DEGREES = 360 / TURN; // of a radian
const EVEN = 1e-5; // values that differ by less are the same but for the digits of poses
const EVEN_RATES = 1e-4; // and their slopes, from rows that are hundredths apart
const SAME = 1e-4; // of the longest: directions that differ by less are one

export class OutputPlots {
  readonly elements: Element[];
  readonly #plots: Plot[] = [];
  /** What they show, in the order of the outputs, then of the joints, from the first value of the drive on in such
   * steps. */
  readonly #values: Float64Array[] = [];
  readonly #rates: { name: string; note: string; now: () => number }[] = [];
  #first = 0;
  #step = 1;

  constructor(
    private readonly machine: Machine,
    names: string[],
    joints: string[],
    pick: (value: number) => void,
  ) {
    const { data, drive, turning } = machine;
    const [motion, ...more] = data.motions;
    const rows = more.length ? [] : (motion?.poses ?? []);
    if (rows.length) {
      const span = new Span(() => {
        for (const plot of this.#plots) plot.redraw();
      });
      const range = endsOf(motion!);
      const step = (range[1] - range[0]) / (rows.length - 1);
      const drives = Float64Array.from(rows, (_, row) => range[0] + row * step);
      [this.#first, this.#step] = [range[0], step];
      type Now = (() => number) | undefined;
      const show = (name: string, unit: string, values: Float64Array, colour: string, now: Now, even = EVEN) => {
        const most = Math.max(1, ...values.map(Math.abs).filter(Number.isFinite));
        const same = even * (unit === data.unit ? data.size : most);
        const plot = new Plot(drive?.turning ? "°" : data.unit, pick, span);
        const title = name + inBrackets(unit);
        plot.show(drives, { title, values, colour, same, now, degrees: unit === "°" }, range);
        this.#plots.push(plot);
      };
      for (const [k, link] of data.outputs.entries()) {
        const turns = turning.has(link);
        const [values, signed] = wayOf(
          rows.map((row) => row[link]!),
          turns,
        );
        this.#values.push(values);
        const name = names[link]!;
        const turned = () => this.plotted(k, turnOf(machine.poses[link]!)) * DEGREES;
        show(name, turns ? "°" : data.unit, values, "--motion", turns ? turned : undefined);
        if (!signed) continue;
        const rates = slopes(turns ? values.map((value) => value / DEGREES) : values, step, motion!.round);
        const [above, below] = [turns, drive!.turning].map((one) => (one ? "rad" : data.unit));
        const note = above === below ? "" : `${above}/${below}`;
        const told = t("Transfer function {sign}", { sign: `${turns ? "ψ" : "s"}′` });
        const title = data.outputs[1] ? `${told}, ${name}` : told;
        const now = () => cubicAt(rates, (this.#drive - range[0]) / step, motion!.round);
        this.#rates.push({ name: title, note, now });
        show(title, note, rates, "--green", now, EVEN_RATES);
      }
      for (const [k, joint] of data.joints.entries()) {
        const values = unwound(
          rows.map((row) => jointValue(joint, row)),
          joint.turns,
        );
        this.#values.push(values);
        const now = () => {
          const value = jointValue(joint, machine.poses);
          return joint.turns ? this.near(data.outputs.length + k, value) * DEGREES : value;
        };
        show(joints[k]!, joint.turns ? "°" : data.unit, values, "--purple", now);
      }
    }
    this.elements = this.#plots.map(({ element }) => element);
  }

  get #drive(): number {
    const { active, cycle, drives } = this.machine;
    return wrapped(cycle, drives[active] ?? 0);
  }

  /** Put the cursor to where the drive stands. */
  follow(): void {
    for (const plot of this.#plots) plot.at(this.#drive);
  }

  /** How far an output goes to and fro, in degrees or lengths; 0 of one that turns round, and where none is plotted. */
  travel(output: number): number {
    const values = this.#values[output];
    if (!values) return 0;
    const far = highest(values) + highest(values.map((value) => -value));
    return this.machine.turning.has(this.machine.data.outputs[output]!) && far > 359.9 ? 0 : far;
  }

  /** An angle of an output with the sign and the full turns that its plot has there, in radians. */
  plotted(output: number, turned: number): number {
    const away = (value: number) => Math.abs(value - this.#about(output));
    const [same, other] = [this.near(output, turned), this.near(output, -turned)];
    return away(other) < away(same) ? other : same;
  }

  /** An angle with the full turns that a plot has where the drive stands, in radians. */
  near(plot: number, turned: number): number {
    const about = this.#about(plot);
    return turned + (Number.isNaN(about) ? 0 : TURN * Math.round((about - turned) / TURN));
  }

  #about(plot: number): number {
    return (this.#values[plot]?.[Math.round((this.#drive - this.#first) / this.#step)] ?? NaN) / DEGREES;
  }

  /** What the transfer functions are where the drive stands. */
  get rates(): Fact[] {
    return this.#rates.map(({ name, note, now }) => ({ name, note, text: number(now(), 4) }));
  }
}

/** The largest of values that are evenly apart, between two of them perhaps: that of the parabola through three. */
function highest(values: Float64Array): number {
  const most = Math.max(...values);
  const at = values.indexOf(most);
  const [before, after] = [values[at - 1] ?? most, values[at + 1] ?? most];
  const bend = 2 * most - before - after;
  return most + (at && at < values.length - 1 && bend ? (after - before) ** 2 / (8 * bend) : 0);
}

/** How far a link is turned, in degrees, or shifted, and whether that has a sign: where it turns about one axis, or
 * shifts along a line. The sign is that for which most of the range is positive: an axis has no sense of its own. */
function wayOf(poses: Pose[], turns: boolean): [Float64Array, boolean] {
  const vectors = poses.map((pose): Vector => (turns ? axisOf(pose) : [pose[3]!, pose[7]!, pose[11]!]));
  const along = partsAlong(vectors);
  if (!along) {
    const far = turns ? poses.map((pose) => turnOf(pose) * DEGREES) : vectors.map((way) => Math.hypot(...way));
    return [Float64Array.from(far), false];
  }
  const cosines = poses.map((pose) => pose[0]! + pose[5]! + pose[10]! - 1);
  const values = unwound(turns ? along.map((part, row) => Math.atan2(part, cosines[row]!)) : along, turns);
  return [Math.max(...values) < -Math.min(...values) ? values.map((value) => -value) : values, true];
}

/** Angles in degrees, over full turns; lengths as they are. */
function unwound(values: number[], turns: boolean): Float64Array {
  let last = 0;
  return Float64Array.from(values, (value) => {
    last = turns ? value + TURN * Math.round((last - value) / TURN) : value;
    return turns ? last * DEGREES : last;
  });
}

/** A value of a row; beyond a full turn it goes on by as much as that adds. */
function rowAt(values: Float64Array, row: number, round: boolean): number {
  const last = values.length - 1;
  const whole = values[last]! - values[0]!;
  return values[row] ?? (round ? values[(row + last) % last]! + (row < 0 ? -whole : whole) : NaN);
}

/** The derivative of values that are a step apart, over a full turn or not; unknown at ends. */
function slopes(values: Float64Array, step: number, round: boolean): Float64Array {
  const at = (row: number) => rowAt(values, row, round);
  return values.map((_, row) => {
    const [near, far] = [at(row + 1) - at(row - 1), at(row + 2) - at(row - 2)];
    return (Number.isNaN(far) ? near : (8 * near - far) / 6) / (2 * step);
  });
}

/** A value between rows: on the cubic through four of them. */
function cubicAt(values: Float64Array, at: number, round: boolean): number {
  const low = Math.max(0, Math.min(Math.floor(at), values.length - 2));
  const x = at - low;
  const [a, b, c, d] = [-1, 0, 1, 2].map((k) => rowAt(values, low + k, round)) as [number, number, number, number];
  return ((x - 1) * (x - 2) * (b * (3 * x + 3) - a * x) + (x + 1) * x * (d * (x - 1) - c * (3 * x - 6))) / 6;
}

/** The parts of vectors along the longest of them; null if they have several directions. */
function partsAlong(vectors: Vector[]): number[] | null {
  const lengths = vectors.map((v) => Math.hypot(...v));
  const length = Math.max(...lengths) || 1;
  const longest = vectors[Math.max(0, lengths.indexOf(length))]!;
  const parts = vectors.map((v) => v.reduce((sum, part, k) => sum + part * longest[k]!, 0) / length);
  const off = lengths.map((long, k) => long - Math.abs(parts[k]!));
  return Math.max(...off) < SAME * length ? parts : null;
}
