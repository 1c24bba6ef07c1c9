/** The plots of what a machine in space drives: how far its outputs turn or shift, over the only drive. */

import { TURN, wrapped } from "../cycle";
import { Plot } from "../plot";
import { Span } from "../span";
import type { Vector } from "./algebra";
import { axisOf, endsOf, type Machine, turnOf } from "./machine";

type Pose = ArrayLike<number>;

const SAME = 1e-4; // of the longest: directions that differ by less are one

export class OutputPlots {
  readonly elements: Element[];
  readonly #plots: Plot[];
  /** What they show, in the order of the outputs, from the first value of the drive on in such steps. */
  readonly #values: Float64Array[] = [];
  #first = 0;
  #step = 1;

  constructor(
    private readonly machine: Machine,
    names: string[],
    pick: (value: number) => void,
  ) {
    const { data, drive, turning } = machine;
    const [motion, ...more] = data.motions;
    const rows = more.length ? [] : (motion?.poses ?? []);
    const span = new Span(() => {
      for (const plot of this.#plots) plot.redraw();
    });
    this.#plots = (rows.length ? data.outputs : []).map((link) => {
      const range = endsOf(motion!);
      const step = (range[1] - range[0]) / (rows.length - 1);
      const drives = Float64Array.from(rows, (_, row) => range[0] + row * step);
      const poses = rows.map((row) => row[link]!);
      const unit = turning.has(link) ? "°" : data.unit;
      const values = upward(turning.has(link) ? turns(poses) : shifts(poses));
      [this.#first, this.#step] = [range[0], step];
      this.#values.push(values);
      const plot = new Plot(drive?.turning ? "°" : data.unit, pick, span);
      const title = `${names[link]} [${unit}]`;
      plot.show(drives, { title, values, colour: "--motion", same: 1e-6 * (unit === "°" ? 1 : data.size) }, range);
      return plot;
    });
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
  plotted(output: number, angle: number): number {
    const values = this.#values[output];
    if (!values) return angle;
    const about = (values[Math.round((this.#drive - this.#first) / this.#step)]! * TURN) / 360;
    const near = (one: number) => one + TURN * Math.round((about - one) / TURN);
    const [same, other] = [near(angle), near(-angle)];
    return Math.abs(same - about) <= Math.abs(other - about) ? same : other;
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

/** Values with the sign for which most of their range is positive: an axis has no sense of its own. */
function upward(values: Float64Array): Float64Array {
  return Math.max(...values) < -Math.min(...values) ? values.map((value) => -value) : values;
}

/** Degrees by which a link is turned, with a sign and over full turns where its axis stays the same. */
function turns(poses: Pose[]): Float64Array {
  const along = partsAlong(poses.map(axisOf));
  let last = 0;
  return Float64Array.from(poses, (pose, row) => {
    if (!along) return turnOf(pose) * (360 / TURN);
    const angle = Math.atan2(along[row]!, pose[0]! + pose[5]! + pose[10]! - 1);
    last = angle + TURN * Math.round((last - angle) / TURN);
    return last * (360 / TURN);
  });
}

/** How far a link is shifted, with a sign where it shifts along a line. */
function shifts(poses: Pose[]): Float64Array {
  const ways = poses.map((pose): Vector => [pose[3]!, pose[7]!, pose[11]!]);
  return Float64Array.from(partsAlong(ways) ?? ways.map((way) => Math.hypot(...way)));
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
