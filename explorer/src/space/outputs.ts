/** The plots of what a machine in space drives: how far its outputs turn or shift, over the only drive. */

import { TURN, wrapped } from "../cycle";
import { h, renew } from "../dom";
import type { Fact } from "../facts";
import { angle, number, t } from "../language";
import { HEIGHT, Plot, WIDTH } from "../plot";
import { Span } from "../span";
import { inBrackets } from "../wording";
import { dot, type Vector } from "./algebra";
import { axisOf, cosineOf, endsOf, jointValue, type Machine, nearest, type State, turnOf } from "./machine";
import type { ReadJoint } from "./model";

const DEGREES = 360 / TURN; // of a radian
const DIGITS = 4;
const EVEN = 1e-7; // values that differ by less are the same but for the digits of poses
const EVEN_RATES = 1e-5; // and their slopes, from rows that are hundredths apart
const SAME = 1e-4; // of the longest: directions that differ by less are one
const QUIET = 200; // milliseconds after the last change of another drive
const BENT = 0.05; // of differences of rows: those next to limits change faster
const GAP = 6; // below a plot
const SLICE = 100; // milliseconds of solving between frames: most machines are done in one slice
const PART = 200; // milliseconds after which what is solved by then is plotted, where nothing is yet

/** What is read of a machine: an output or a joint. */
interface Reading {
  name: string;
  /** With what it is compared, of outputs. */
  fact: string;
  /** Null of a joint between others. */
  link: number | null;
  turns: boolean;
  /** With a sign: in a joint, or about or along a direction that is the same all the way. */
  joint: ReadJoint | null;
  along: Vector | null;
}

/** Pieces of text by language that it needs. */
interface Words {
  links: string[];
  joints: string[];
  words: Record<string, string>;
}

export class OutputPlots {
  readonly element = h("div", {});
  #plots: Plot[] = [];
  readonly #readings: Reading[];
  readonly #words: Record<string, string>;
  /** Of readings, from the first value of the drive on in such steps: degrees or lengths. */
  #values: Float64Array[] = [];
  /** Of outputs with a sign: what their transfer functions are where the drive stands. */
  #rates: (() => number)[] = [];
  #first = 0;
  #step = 1;
  /** Which drive they are over, and where the others stand. */
  #known = "";
  #timer = 0;
  /** Whether they have been there once over the whole range. */
  #whole = false;

  constructor(
    private readonly machine: Machine,
    { joints, links, words }: Words,
    private readonly pick: (value: number) => void,
    /** They are there, after a while. */
    private readonly made: () => void,
  ) {
    this.#words = words;
    const { data, reached, turning } = machine;
    const outputs = data.outputs.map(({ joint, link }) => {
      const called = links[link]!.replace(/ \(.*/, "");
      const turns = joint ? joint.turns : turning.has(link);
      const along = joint ? null : directionOf(reached.map((row) => wayOf(row[link]!, turns)));
      const reading = { name: called, fact: "", link, joint, turns, along };
      const told = isTotal(reading) ? "total" : "turned";
      reading.fact = words[turns ? told : "shifted"]!.replace("{link}", called);
      if (turns && isTotal(reading)) reading.name = words.all!.replace("{link}", called);
      return reading;
    });
    const between = data.joints.map((joint, k) => {
      const name = joints[k]!;
      return { name, fact: name, link: null, joint, turns: joint.turns, along: null };
    });
    this.#readings = data.motions.length ? [...outputs, ...between] : [];
    const count = this.#readings.length + this.#readings.filter(isRated).length;
    this.element.style.aspectRatio = String(WIDTH / ((HEIGHT + GAP) * count)); // what is below stays
    this.follow();
  }

  get #drive(): number {
    const { active, cycle, drives } = this.machine;
    return wrapped(cycle, drives[active] ?? 0);
  }

  /** Put the cursor to where the drive stands; where another drive moved the plots are made anew, once it rests. */
  follow(): void {
    const { active, data, drives } = this.machine;
    const known = [active, ...(data.live ? drives.filter((_, k) => k !== active) : [])].join();
    if (known === this.#known || !this.#readings.length) {
      for (const plot of this.#plots) plot.at(this.#drive);
      return;
    }
    this.#known = known;
    [this.#values, this.#rates] = [[], []];
    clearTimeout(this.#timer);
    this.#fade(true);
    const course = this.machine.course();
    if (this.#whole && data.live) this.#timer = setTimeout(() => this.#solve(course), QUIET);
    else this.#solve(course);
  }

  #solve(course: ReturnType<Machine["course"]>, since = performance.now()): void {
    const end = performance.now() + SLICE;
    let next = course.next();
    while (!next.done && performance.now() < end) next = course.next();
    if (next.done) {
      this.#whole = true;
      this.#show(next.value);
      this.#fade(false);
      if (this.machine.data.live) this.made();
      return;
    }
    const part = !this.#whole && performance.now() > since + PART;
    if (part) {
      this.#show(next.value, true);
      this.#values = []; // how far it goes is not known yet
    }
    this.#timer = setTimeout(() => this.#solve(course, part ? undefined : since));
  }

  /** Plot rows; of a part of them nothing of outputs without an axis, whose sign is that of their farthest way. */
  #show(rows: (State | null)[], part = false): void {
    const { active, data, drive } = this.machine;
    const motion = data.motions[active]!;
    const range = endsOf(motion);
    const step = (range[1] - range[0]) / (rows.length - 1);
    [this.#first, this.#step, this.#plots, this.#rates] = [range[0], step, [], []];
    const drives = Float64Array.from(rows, (_, row) => range[0] + row * step);
    const home = Math.min(Math.max(Math.round(-range[0] / step), 0), rows.length - 1); // of the reference pose
    const span = new Span(() => {
      for (const plot of this.#plots) plot.redraw();
    });
    const unitOf = (turns: boolean) => (turns ? "°" : data.unit);
    const show = (name: string, unit: string, values: Float64Array, colour: string, now: () => number, even = EVEN) => {
      const most = Math.max(1, ...values.map(Math.abs).filter(Number.isFinite));
      const same = even * (unit === data.unit ? data.size : most);
      const plot = new Plot(unitOf(drive!.turning), this.pick, span);
      const title = name + inBrackets(unit);
      plot.show(drives, { title, values, colour, same, now, degrees: unit === "°" }, range);
      this.#plots.push(plot);
    };
    for (const [k, reading] of this.#readings.entries()) {
      const { link, name, turns } = reading;
      const unsigned = part && isTotal(reading);
      const values = valuesOf(reading, unsigned ? rows.map(() => null) : rows, home);
      this.#values.push(values);
      const at = () => (unsigned ? NaN : this.#value(k));
      show(name, unitOf(turns), values, link === null ? "--purple" : "--motion", at);
      if (!isRated(reading)) continue;
      const rates = slopes(turns ? values.map((value) => value / DEGREES) : values, step, motion.round);
      const now = () => cubicAt(rates, (this.#drive - range[0]) / step, motion.round);
      this.#rates.push(now);
      const [title, note] = this.#rateOf(reading);
      show(title, note, rates, "--green", now, EVEN_RATES);
    }
    this.element.style.aspectRatio = "";
    renew(this.element, ...this.#plots.map(({ element }) => element));
    this.follow();
  }

  /** The name of the transfer function of an output, and its unit. */
  #rateOf({ name, turns }: Reading): [string, string] {
    const { data, drive } = this.machine;
    const [above, below] = [turns, drive!.turning].map((one) => (one ? "rad" : data.unit));
    const told = t("Transfer function {sign}", { sign: `${turns ? "ψ" : "s"}′` });
    return [data.outputs[1] ? `${told}, ${name}` : told, above === below ? "" : `${above}/${below}`];
  }

  /** Plots of what is no more are seen, but nothing is picked in them. */
  #fade(old: boolean): void {
    this.element.inert = old;
    this.element.style.opacity = old && this.#whole ? "0.3" : "";
  }

  /** What is read where the drives stand, in degrees or lengths: with the full turns, and without an axis with the
   * sign, that the plot has there. */
  #value(k: number): number {
    const reading = this.#readings[k]!;
    const { turns } = reading;
    const unit = turns ? DEGREES : 1;
    const value = valueIn(reading, this.machine.state);
    const at = (this.#drive - this.#first) / this.#step;
    const known = this.#values[k];
    if (!known) return isTotal(reading) ? NaN : value * unit;
    const between = cubicAt(known, at, this.machine.cycle.full);
    const about = Number.isNaN(between) ? (known[Math.round(at)] ?? NaN) : between;
    if (Number.isNaN(about)) return value * unit;
    return [value, isTotal(reading) ? -value : value]
      .map((told) => (turns ? nearest(told, about / unit) : told) * unit)
      .sort((a, b) => Math.abs(a - about) - Math.abs(b - about))[0]!;
  }

  /** Whether an output has no axis, which would tell its sign. */
  get total(): boolean {
    return this.#readings.some(isTotal);
  }

  /** Where outputs and joints are, how far outputs go to and fro, what the transfer functions are there. */
  get facts(): Fact[] {
    const { data } = this.machine;
    const read = this.#readings.map((reading, k) => {
      const { fact: name, turns } = reading;
      const values = this.#values[k];
      const now = this.#value(k);
      const text = (value: number) =>
        turns
          ? angle(value / DEGREES, DIGITS)
          : `${number(Math.abs(value) < 1e-6 * data.size ? 0 : value, DIGITS)} ${data.unit}`;
      const facts: Fact[] = [
        { name, text: Number.isNaN(now) ? "…" : text(now), ...(isTotal(reading) ? { style: "wide" } : {}) },
      ];
      if (!values || !isRated(reading)) return facts;
      const far = highest(values) + highest(values.map((value) => -value));
      if (!(turns && far > 359.9))
        facts.push({ name: this.#words[turns ? "swing" : "travel"]!.replace("{link}", reading.name), text: text(far) });
      return facts;
    });
    const rates = this.#readings.filter(isRated).map((reading, k) => {
      const [name, note] = this.#rateOf(reading);
      return { name, note, text: number(this.#rates[k]?.() ?? NaN, DIGITS) };
    });
    const outputs = data.outputs.length;
    return [...read.slice(0, outputs).flat(), ...rates, ...read.slice(outputs).flat()];
  }
}

/** Whether an output has no axis: it is told how far it is turned or shifted in all. */
function isTotal({ along, joint }: Pick<Reading, "along" | "joint">): boolean {
  return !along && !joint;
}

function isRated(reading: Reading): boolean {
  return reading.link !== null && !isTotal(reading);
}

/** How far something is turned, in radians, or shifted. */
function valueIn({ along, joint, link, turns }: Reading, state: State): number {
  if (joint) return jointValue(joint, state);
  const pose = state.poses[link!]!;
  const way = wayOf(pose, turns);
  if (!along) return turns ? turnOf(pose) : Math.hypot(...way);
  return turns ? Math.atan2(dot(way, along), cosineOf(pose)) : dot(way, along);
}

/** The same along rows, in degrees or lengths: angles go on over full turns, and that of the reference pose lies
 * between -180° and 180°. */
function valuesOf(reading: Reading, rows: (State | null)[], home: number): Float64Array {
  const { link, turns } = reading;
  const values = Float64Array.from(rows, (row) => (row ? valueIn(reading, row) : NaN));
  const total = isTotal(reading);
  if (!(turns || total)) return values;
  const least = turns ? SAME : SAME * Math.max(...values.filter(Number.isFinite));
  let axis: Vector = [0, 0, 0];
  let last = 0;
  const along = values.map((value, k) => {
    const row = rows[k];
    if (!row) return NaN;
    const way = wayOf(row.poses[link ?? 0]!, turns);
    // beyond 0, or 180°, its direction goes on, and what is told has a sign
    const side = total && dot(way, axis) < 0 ? -1 : 1;
    if (Math.hypot(...way) > least) axis = way.map((part) => side * part) as Vector;
    last = (row.turned && !total) || !turns ? side * value : nearest(side * value, last);
    return last;
  });
  const laps = !turns || (reading.joint && rows[home]?.turned) ? 0 : nearest(0, along[home] || 0);
  const known = along.filter(Number.isFinite).map((value) => value - laps);
  const down = total && Math.max(...known) < -Math.min(...known);
  return along.map((value) => (down ? -1 : 1) * (value - laps) * (turns ? DEGREES : 1));
}

/** The direction of ways along a line, to the side of the longest; null if they have several. */
function directionOf(ways: Vector[]): Vector | null {
  const lengths = ways.map((way) => Math.hypot(...way));
  const length = Math.max(...lengths);
  const first = ways[lengths.findIndex((long) => long > (1 - SAME) * length)] ?? [0, 0, 0];
  const along = first.map((part) => part / (length || 1)) as Vector;
  const off = ways.map((way, k) => lengths[k]! - Math.abs(dot(way, along)));
  return Math.max(...off) < SAME * length ? along : null;
}

/** Twice the sine of an angle along its axis, or how far a link is shifted. */
function wayOf(pose: ArrayLike<number>, turns: boolean): Vector {
  return turns ? axisOf(pose) : [pose[3]!, pose[7]!, pose[11]!];
}

/** The largest of values that are evenly apart, between two of them perhaps: that of the parabola through three. */
function highest(values: Float64Array): number {
  const most = Math.max(...values);
  const at = values.indexOf(most);
  const [before, after] = [values[at - 1] ?? most, values[at + 1] ?? most];
  const bend = 2 * most - before - after;
  return most + (at && at < values.length - 1 && bend ? (after - before) ** 2 / (8 * bend) : 0);
}

/** A value of a row; beyond a full turn it goes on by as much as that adds. */
function rowAt(values: Float64Array, row: number, round: boolean): number {
  const last = values.length - 1;
  const whole = values[last]! - values[0]!;
  return values[row] ?? (round ? values[(row + last) % last]! + (row < 0 ? -whole : whole) : NaN);
}

/** The derivative of values that are a step apart, over a full turn or not; at ends from the one side, but unknown
 * next to limits, where it is without bound. */
export function slopes(values: Float64Array, step: number, round: boolean): Float64Array {
  const at = (row: number) => rowAt(values, row, round);
  const end = (row: number, way: number) => {
    const [a, b, c] = [0, 1, 2].map((k) => way * (at(row + (k + 1) * way) - at(row + k * way))) as Vector;
    const even = Math.abs(a - 2 * b + c) <= BENT * Math.max(...[a, b, c].map(Math.abs));
    return even ? (11 * a - 7 * b + 2 * c) / 3 : NaN;
  };
  return values.map((_, row) => {
    const [near, far] = [at(row + 1) - at(row - 1), at(row + 2) - at(row - 2)];
    const told = [(8 * near - far) / 6, near, end(row, 1), end(row, -1)].find((each) => !Number.isNaN(each));
    return (told ?? NaN) / (2 * step);
  });
}

/** A value between rows: on the cubic through four of them. */
function cubicAt(values: Float64Array, at: number, round: boolean): number {
  const out = Number(!round); // at ends of a range the cubic is that of the first or last four
  const low = Math.max(out, Math.min(Math.floor(at), values.length - 2 - out));
  const x = at - low;
  const [a, b, c, d] = [-1, 0, 1, 2].map((k) => rowAt(values, low + k, round)) as [number, number, number, number];
  return ((x - 1) * (x - 2) * (b * (3 * x + 3) - a * x) + (x + 1) * x * (d * (x - 1) - c * (3 * x - 6))) / 6;
}
