/** A linkage in space that is driven: along rows that are there, or by the page's own solver. */

import { type Reach, TURN, wrapped } from "../cycle";
import { currentLanguage } from "../language";
import type { Drivable } from "../transport";
import { type Camera, dot, minus, moved, projection, seen, type Vector } from "./algebra";
import type { Model, Motion, ReadJoint, Spot } from "./model";
import { type Pose, Solver } from "./solver";

/** Radians: a link that is turned less only shifts. */
export const TURNED = 1e-6;
const STILL = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const NEAR = 8; // rows before and behind among which a pulled link looks for its place
const OFF = 1e-7; // by this part of its range a slider keeps off the ends, which can be reached here
const PARTS = [0, 0.25, 0.5, 0.75, 1]; // of a range
const TRAIL = 600; // places of a point that are remembered

/** Where all links are, and how far the joints are turned that are solved here. */
export interface State {
  poses: ArrayLike<number>[];
  turned?: number[];
}

export class Machine implements Drivable {
  active = 0;
  /** Of the drives that move it: radians or lengths. */
  readonly drives: number[];
  readonly model: Drivable["model"];
  readonly size: number;
  /** Whether the drive could not go where it was sent. */
  ended = false;
  /** The links that do not only shift where it is driven; on a sphere all of them turn. */
  readonly turning: Set<number>;
  /** The place that was pulled last. */
  traced: Spot | null = null;
  readonly #solver: Solver | null;
  /** Of each drive that turns round: how far a turn of it turns the joints. */
  readonly #laps: number[][] = [];
  /** Some of the poses that it reaches, of several drives by each alone. */
  readonly reached: ArrayLike<number>[][];
  #trails: Vector[][] = [];

  constructor(readonly data: Model) {
    const { bodies, live, middle, motions, size } = data;
    this.size = size;
    this.#solver = live && new Solver(live, size, middle, bodies.length);
    const names = motions.map(({ drive }) => ({ name: String(drive) }));
    this.model = { drives: names, unit: data.unit };
    const rows = live ? motions.flatMap((motion) => this.#alone(motion)) : motions.flatMap(({ poses }) => poses);
    const turns = (link: number) => !data.unit || rows.some((row) => turnOf(row[link]!) > TURNED);
    this.turning = new Set(bodies.map((_, link) => link).filter(turns));
    this.drives = motions.map((motion) => {
      const [low, high] = endsOf(motion);
      return live ? 0 : Math.min(Math.max(0, low), high);
    });
    const some = live ? rows : rows.filter((_, k) => k % Math.ceil(rows.length / 24) === 0);
    this.reached = some.length ? some : [this.poses];
  }

  /** Poses over the range of one of several drives, and what a turn of it adds to the joints. */
  #alone(motion: Motion): ArrayLike<number>[][] {
    const [low, high] = endsOf(motion);
    const solver = this.#solver!.copy();
    const rows = PARTS.map((part) => {
      solver.drive(withValue(solver.values, motion.drive, low + part * (high - low)));
      return { poses: solver.poses, turned: solver.turned };
    });
    const first = rows[0]!.turned;
    this.#laps.push(rows.at(-1)!.turned.map((turn, k) => (motion.round ? turn - first[k]! : 0)));
    return rows.map(({ poses }) => poses);
  }

  get #motion(): Motion | undefined {
    return this.data.motions[this.active];
  }

  get drive(): { turning: boolean } | null {
    return this.#motion ? { turning: this.#motion.unit === "°" } : null;
  }

  get cycle(): Reach {
    return this.cycleOf(this.active);
  }

  cycleOf(number: number): Reach {
    const motion = this.data.motions[number];
    const [low, high] = motion ? endsOf(motion) : [0, 0];
    const full = motion?.round ?? false;
    const room = OFF * (high - low);
    return { full, turns: Number(full), low: low - room, high: high + room, stops: [null, null] };
  }

  driveName(number: number): string {
    return this.data.texts[currentLanguage()].drives[number]!;
  }

  choose(active: number): void {
    this.active = active;
  }

  moveTo(value: number): boolean {
    const { active, drives } = this;
    const [motion, solver] = [this.#motion, this.#solver];
    if (!motion) return false;
    const [low, high] = endsOf(motion);
    drives[active] = motion.round
      ? value + TURN * Math.round((drives[active]! - value) / TURN) // on from where it stands
      : Math.min(Math.max(value, low), high);
    if (!solver) return true;
    this.ended = !solver.drive(withValue(solver.values, motion.drive, drives[active]!));
    this.#follow();
    return true;
  }

  /** After the solver: where its drives stand, and where points were. */
  #follow(): void {
    const { data, drives, spots } = this;
    const solver = this.#solver;
    for (const [k, { drive }] of data.motions.entries()) drives[k] = solver!.values[drive]!;
    this.#trails = spots.map(({ link, at }, k) =>
      [...(this.#trails[k] ?? []), moved(solver!.poses[link]!, at)].slice(-TRAIL),
    );
  }

  /** The poses of all links, by the drives as they stand. */
  get poses(): ArrayLike<number>[] {
    const [motion, solver] = [this.#motion, this.#solver];
    if (solver) return solver.poses;
    if (!motion) return this.data.bodies.map(() => STILL);
    return between(motion, rowOf(motion, this.drives[this.active]!));
  }

  get state(): State {
    return this.#solver ? this.#counted(this.#solver, this.#whole) : this;
  }

  /** What full turns of the drives, which are not told of them, add to the joints. */
  get #whole(): number[] {
    const laps = this.drives.map((value, k) => Math.round((value - wrapped(this.cycleOf(k), value)) / TURN));
    return this.data.live!.joints.map((_, joint) =>
      laps.reduce((sum, lap, k) => sum + lap * this.#laps[k]![joint]!, 0),
    );
  }

  #counted({ poses, turned }: Solver, whole: number[]): State {
    return { poses, turned: turned.map((turn, joint) => turn - whole[joint]!) };
  }

  /** All rows of the motion of the drive, the others where they stand; null where it cannot be, and where it is not
   * known yet: solving takes long. */
  *course(): Generator<(State | null)[], (State | null)[]> {
    const [motion, start] = [this.#motion!, this.#solver?.copy()];
    if (!start) return motion.poses.map((poses) => ({ poses }));
    const [whole, value] = [this.#whole, this.drives[this.active]!];
    const [low, high] = endsOf(motion);
    const last = motion.values.length - 1;
    const rows: (State | null)[] = motion.values.map(() => null);
    const base = value - wrapped(this.cycle, value);
    const here = Math.round((last * (value - base - low)) / (high - low));
    for (const way of [-1, 1]) {
      const solver = start.copy();
      for (let row = here; rows[row] !== undefined; row += way) {
        const next = base + low + (row / last) * (high - low);
        if (!solver.drive(withValue(solver.values, motion.drive, next))) break;
        rows[row] = this.#counted(solver, whole);
        yield rows;
      }
    }
    return rows;
  }

  /** The places whose paths are drawn. */
  get spots(): Spot[] {
    const { data, traced } = this;
    return traced ? [...data.points, traced] : data.points;
  }

  get paths(): Vector[][] {
    if (this.#solver) return this.#trails;
    const rows = this.#motion?.poses ?? [];
    return this.spots.map(({ link, at }) => rows.map((poses) => moved(poses[link]!, at)));
  }

  /** Whether a link is one of those that a drive moves. */
  moves(link: number): boolean {
    const [first, ...others] = this.reached.map((poses) => String(poses[link]));
    return others.some((pose) => pose !== first);
  }

  /** A place is taken: its path begins. */
  take(spot: Spot): void {
    this.traced = spot;
    this.#trails = this.#trails.slice(0, this.data.points.length);
  }

  /** Bring the place that was taken as near as can be to one on the picture. */
  pull(camera: Camera, wide: number, x: number, y: number): void {
    const { link, at } = this.traced!;
    const view = projection(camera, wide);
    const off = (pose: ArrayLike<number>): [number, number] => {
      const [u, v] = seen(view, moved(pose, at));
      return [wide * (u - x), v - y];
    };
    if (this.#solver) {
      this.ended = false;
      this.#solver.pull(link, off as (pose: Pose) => [number, number]);
      return this.#follow();
    }
    const motion = this.#motion;
    if (!motion) return;
    const [last, here] = [motion.values.length - 1, rowOf(motion, this.drives[this.active]!)];
    let [best, least] = [here, Infinity];
    for (let step = -NEAR; step <= NEAR; step += 0.25) {
      const tried = motion.round ? (here + step + last) % last : Math.min(Math.max(here + step, 0), last);
      const gap = Math.hypot(...off(between(motion, tried)[link]!));
      if (gap < least) [least, best] = [gap, tried];
    }
    const [low, high] = endsOf(motion);
    this.moveTo(low + (best / last) * (high - low));
  }
}

function withValue(values: number[], drive: number, value: number): number[] {
  return values.map((old, k) => (k === drive ? value : old));
}

/** By what angle a link is turned: its cosine alone would not tell small ones. */
export function turnOf(pose: ArrayLike<number>): number {
  return Math.atan2(Math.hypot(...axisOf(pose)), cosineOf(pose));
}

/** Twice the cosine of the angle by which a link is turned. */
export function cosineOf(pose: ArrayLike<number>): number {
  return pose[0]! + pose[5]! + pose[10]! - 1;
}

/** By how much a joint is turned, in radians with full turns as far as they are counted, or shifted. */
export function jointValue({ axis, frame, links, number, sign, turns }: ReadJoint, { poses, turned }: State): number {
  const [one, two] = links.map((link) => poses[link]!) as [Pose, Pose];
  const column = (k: number): Vector => [frame[k]!, frame[k + 4]!, frame[k + 8]!];
  const along = (pose: Pose, k: number) => minus(moved(pose, column(k % 3)), moved(pose, [0, 0, 0]));
  const [u, v] = [along(one, axis + 1), along(one, axis + 2)];
  const other = along(two, axis + 1);
  if (!turns) return sign * dot(minus(moved(two, column(3)), moved(one, column(3))), along(one, axis));
  const turn = Math.atan2(dot(other, v), dot(other, u));
  return sign * nearest(turn, turned?.[number] ?? turn);
}

/** An angle with the full turns with which it is nearest to another one. */
export function nearest(angle: number, other: number): number {
  return angle + TURN * Math.round((other - angle) / TURN);
}

/** About which axis a link is turned: a vector of twice the sine of the angle. */
export function axisOf(pose: ArrayLike<number>): Vector {
  return [pose[9]! - pose[6]!, pose[2]! - pose[8]!, pose[4]! - pose[1]!];
}

/** The first and the last value of a motion's drive, in radians or as lengths. */
export function endsOf({ unit, values }: Motion): [number, number] {
  const part = unit === "°" ? TURN / 360 : 1;
  return [part * values[0]!, part * values.at(-1)!];
}

/** The row, between two perhaps, at a value of the drive: rows are evenly spaced. */
function rowOf(motion: Motion, value: number): number {
  const [low, high] = endsOf(motion);
  const part = (value - low) / (high - low);
  return (motion.values.length - 1) * (motion.round ? part - Math.floor(part) : Math.min(Math.max(part, 0), 1));
}

/** Poses between rows: on the polynomial through six of them. */
function between({ poses, round }: Motion, at: number): number[][] {
  const last = poses.length - 1;
  const first = Math.floor(at) - 2;
  const low = round ? first : Math.max(0, Math.min(first, last - 5));
  const rows = [0, 1, 2, 3, 4, 5].map((k) => low + k);
  const parts = rows.map((row) => ({
    row: poses[round ? (row + last) % last : row]!,
    weight: rows.reduce((part, other) => (other === row ? part : (part * (at - other)) / (row - other)), 1),
  }));
  return poses[0]!.map((pose, link) =>
    pose.map((_, k) => parts.reduce((sum, { row, weight }) => sum + weight * row[link]![k]!, 0)),
  );
}
