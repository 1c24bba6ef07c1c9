// Poses of a linkage in space for given values of all its drives, by Gauss and Newton from the last ones.
//
// A joint has a frame in the reference pose, common to its links. The frame E of its second link, seen from its first,
// keeps the directions in which the joint does not slide and turn; drives, and wheels on common carriers, add rows.

import { moved, type Vector } from "./algebra";

export interface Joint {
  links: [number, number];
  /** Its frame in the reference pose, twelve numbers by rows. */
  frame: number[];
  /** The axes about which and along which it moves: "z", "xy", ... */
  turns: string;
  slides: string;
  /** The way along z for a radian, of a screw. */
  pitch: number;
}

export interface Drive {
  joint: number;
  axis: number;
  turns: boolean;
  /** -1 where it is counted the other way round. */
  sign: number;
  /** Radians or lengths. */
  low: number;
  high: number;
  /** Whether it turns fully, past its ends. */
  round: boolean;
}

export interface Live {
  frame: number;
  joints: Joint[];
  drives: Drive[];
  /** Sums of weights times turns of joints that stay 0. */
  gears: [number, number][][];
}

export type Pose = number[];
type Row = { value: number; links: number[]; of: (poses: Pose[]) => number };

const STEP = 0.08; // radians, or parts of the size, from one solution to the next
const SHORTEST = 1 / 64; // of it
const LEAP = 0.25; // radians or sizes: a link that goes farther in a step is in another assembly mode
const CLOSED = 1e-9;
const MOST = 12;
const SMALL = 1e-6; // of the differences by which rows are derived
const WEIGHT = 0.03; // of the pointer against the joints
const HOLD = 3e-3; // of the drives' values while a link is pulled

const wrapped = (angle: number): number => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

/** One rigid motion after another. */
function times(a: Pose, b: Pose): Pose {
  const c: Pose = [];
  for (let r = 0; r < 12; r += 4)
    for (let k = 0; k < 4; k++)
      c.push(a[r]! * b[k]! + a[r + 1]! * b[k + 4]! + a[r + 2]! * b[k + 8]! + (k === 3 ? a[r + 3]! : 0));
  return c;
}

function inverse(a: Pose): Pose {
  const out: Pose = [];
  for (let k = 0; k < 3; k++)
    out.push(a[k]!, a[k + 4]!, a[k + 8]!, -(a[k]! * a[3]! + a[k + 4]! * a[7]! + a[k + 8]! * a[11]!));
  return out;
}

/** The pose turned by a small rotation vector about a place, and shifted. */
function nudged(pose: Pose, by: ArrayLike<number>, from: number, about: Vector, size: number): Pose {
  const [x, y, z] = [by[from]!, by[from + 1]!, by[from + 2]!];
  const angle = Math.hypot(x, y, z);
  const s = angle > 1e-12 ? Math.sin(angle) / angle : 1;
  const c = angle > 1e-6 ? (1 - Math.cos(angle)) / angle ** 2 : 0.5;
  const r = [
    1 - c * (y * y + z * z),
    c * x * y - s * z,
    c * x * z + s * y,
    c * x * y + s * z,
    1 - c * (x * x + z * z),
    c * y * z - s * x,
    c * x * z - s * y,
    c * y * z + s * x,
    1 - c * (x * x + y * y),
  ];
  const turn: Pose = [0, 1, 2].flatMap((k) => {
    const row = r.slice(3 * k, 3 * k + 3);
    const turned = row[0]! * about[0] + row[1]! * about[1] + row[2]! * about[2];
    return [...row, about[k]! - turned + size * by[from + 3 + k]!];
  });
  return times(turn, pose);
}

export class Solver {
  poses: Pose[];
  readonly values: number[];
  /** The turns of all joints, whole ones counted. */
  turned: number[];
  readonly #moving: number[];
  readonly #backs: Pose[];

  constructor(
    private readonly live: Live,
    private readonly size: number,
    private readonly middle: Vector,
    links: number,
  ) {
    this.poses = Array.from({ length: links }, () => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
    this.values = live.drives.map(() => 0);
    this.turned = live.joints.map(() => 0);
    this.#moving = this.poses.map((_, k) => k).filter((k) => k !== live.frame);
    this.#backs = live.joints.map(({ frame }) => inverse(frame));
  }

  /** Another one, which goes on from here. */
  copy(): Solver {
    const other = new Solver(this.live, this.size, this.middle, this.poses.length);
    [other.poses, other.turned] = [this.poses, this.turned];
    other.values.splice(0, this.values.length, ...this.values);
    return other;
  }

  /** The second link's frame of a joint, seen from its first one. */
  #seen(poses: Pose[], number: number): Pose {
    const { links, frame } = this.live.joints[number]!;
    return times(this.#backs[number]!, times(inverse(poses[links[0]]!), times(poses[links[1]]!, frame)));
  }

  #angle(poses: Pose[], number: number, axis = 2): number {
    const e = this.#seen(poses, number);
    const [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
    const turn = Math.atan2(e[4 * b + a]!, e[4 * a + a]!);
    return this.turned[number]! + wrapped(turn - this.turned[number]!);
  }

  /** What a drive stands at. */
  #value(poses: Pose[], { joint, axis, turns, sign }: Drive): number {
    return sign * (turns ? this.#angle(poses, joint, axis) : this.#seen(poses, joint)[4 * axis + 3]!);
  }

  #rows(targets: number[], hold: number): Row[] {
    const rows: Row[] = [];
    this.live.joints.forEach(({ links, turns, slides, pitch }, number) => {
      const add = (of: (e: Pose) => number) =>
        rows.push({ value: 0, links, of: (poses) => of(this.#seen(poses, number)) });
      for (let k = 0; k < 3; k++) {
        if (pitch && k === 2)
          rows.push({
            value: 0,
            links,
            of: (p) => (this.#seen(p, number)[11]! - pitch * this.#angle(p, number)) / this.size,
          });
        else if (!slides.includes("xyz"[k]!)) add((e) => e[4 * k + 3]! / this.size);
      }
      if (turns === "")
        for (const [a, b] of [
          [0, 1],
          [1, 2],
          [2, 0],
        ] as const)
          add((e) => (e[4 * b + a]! - e[4 * a + b]!) / 2);
      if (turns === "xy") add((e) => e[1]!);
      if (turns.length === 1) {
        const k = "xyz".indexOf(turns);
        for (const n of [0, 1, 2]) if (n !== k) add((e) => e[4 * n + k]!);
      }
    });
    for (const gear of this.live.gears) {
      const links = [...new Set(gear.flatMap(([joint]) => this.live.joints[joint]!.links))];
      rows.push({ value: 0, links, of: (p) => gear.reduce((sum, [joint, w]) => sum + w * this.#angle(p, joint), 0) });
    }
    this.live.drives.forEach((drive, k) => {
      const unit = hold / (drive.turns ? 1 : this.size);
      const { links } = this.live.joints[drive.joint]!;
      rows.push({ value: unit * targets[k]!, links, of: (p) => unit * this.#value(p, drive) });
    });
    return rows;
  }

  /** Poses in which all rows have their values as nearly as can be, and the largest miss of the first ones. */
  #solved(rows: Row[], start: Pose[], most: number): { poses: Pose[]; miss: number } {
    let poses = start;
    const place = new Map(this.#moving.map((link, k) => [link, 6 * k]));
    const n = 6 * this.#moving.length;
    let miss = Infinity;
    for (let step = 0; step <= most; step++) {
      const gaps = rows.map((row) => row.of(poses) - row.value);
      miss = Math.max(...gaps.map(Math.abs));
      if (miss < CLOSED || step === most) break;
      const normal = new Float64Array(n * n);
      const right = new Float64Array(n);
      rows.forEach((row, r) => {
        const entries: [number, number][] = [];
        for (const link of row.links) {
          const first = place.get(link);
          if (first === undefined) continue;
          for (let k = 0; k < 6; k++) {
            const by = [0, 0, 0, 0, 0, 0];
            by[k] = SMALL;
            const tried = poses.slice();
            tried[link] = nudged(poses[link]!, by, 0, this.middle, this.size);
            const slope = (row.of(tried) - row.value - gaps[r]!) / SMALL;
            if (slope) entries.push([first + k, slope]);
          }
        }
        for (const [i, a] of entries) {
          right[i]! -= a * gaps[r]!;
          for (const [j, b] of entries) normal[n * i + j]! += a * b;
        }
      });
      const by = solvedSystem(normal, right, n);
      poses = poses.map((pose, link) => {
        const first = place.get(link);
        return first === undefined ? pose : nudged(pose, by, first, this.middle, this.size);
      });
    }
    return { poses, miss };
  }

  /** Move all drives on straight ways to values within their ranges; false where that ends before. */
  drive(wanted: number[]): boolean {
    const { drives } = this.live;
    const ends = wanted.map((v, k) => {
      const { low, high, round } = drives[k]!;
      return round ? v : Math.min(Math.max(v, low), high);
    });
    const starts = [...this.values];
    const far = Math.max(...ends.map((v, k) => Math.abs(v - starts[k]!) / (drives[k]!.turns ? 1 : this.size)));
    const count = Math.max(1, Math.ceil(far / STEP));
    let [part, step] = [0, 1 / count];
    while (part < 1) {
      const next = Math.min(part + step, 1);
      const targets = ends.map((v, k) => starts[k]! + (v - starts[k]!) * next);
      const { poses, miss } = this.#solved(this.#rows(targets, 1), this.poses, MOST);
      if (miss < 1e-6 && this.#leap(poses) < LEAP) {
        this.poses = poses;
        this.turned = this.live.joints.map((_, k) => this.#angle(poses, k));
        this.values.splice(0, targets.length, ...targets);
        part = next;
      } else {
        step /= 2;
        if (step < SHORTEST / count) return false;
      }
    }
    return true;
  }

  /** How far any link has gone since the last poses, in radians or sizes: far leads into another assembly mode. */
  #leap(poses: Pose[]): number {
    return this.#moving.reduce((most, link) => {
      const [a, b] = [this.poses[link]!, poses[link]!];
      const shift = moved(a, this.middle).map((v, k) => (v - moved(b, this.middle)[k]!) / this.size);
      return Math.max(
        most,
        ...[0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => Math.abs(a[k]! - b[k]!)),
        ...shift.map(Math.abs),
      );
    }, 0);
  }

  /** Bring a place of a link as near as can be to where two functions of it are 0, by all drives. */
  pull(link: number, at: (pose: Pose) => [number, number]): void {
    const rows = this.#rows(this.values, HOLD);
    for (const k of [0, 1]) rows.push({ value: 0, links: [link], of: (p) => WEIGHT * at(p[link]!)[k]! });
    const { poses } = this.#solved(rows, this.poses, 4);
    const wanted = this.live.drives.map((drive, k) => {
      const most = 2 * STEP * (drive.turns ? 1 : this.size); // the pointer may be where the link cannot come
      return Math.min(Math.max(this.#value(poses, drive), this.values[k]! - most), this.values[k]! + most);
    });
    if (wanted.every(Number.isFinite)) this.drive(wanted);
  }
}

/** The solution of a symmetric system with a little damping, by Cholesky's factors. */
function solvedSystem(normal: Float64Array, right: Float64Array, n: number): Float64Array {
  let most = 0;
  for (let k = 0; k < n; k++) most = Math.max(most, normal[n * k + k]!);
  for (let k = 0; k < n; k++) normal[n * k + k]! += 1e-11 * most;
  for (let j = 0; j < n; j++) {
    for (let k = 0; k < j; k++) {
      const factor = normal[n * j + k]!;
      if (factor) for (let i = j; i < n; i++) normal[n * i + j]! -= factor * normal[n * i + k]!;
    }
    const root = Math.sqrt(Math.max(normal[n * j + j]!, 1e-300));
    for (let i = j; i < n; i++) normal[n * i + j]! /= root;
  }
  for (let i = 0; i < n; i++) {
    for (let k = 0; k < i; k++) right[i]! -= normal[n * i + k]! * right[k]!;
    right[i]! /= normal[n * i + i]!;
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let k = i + 1; k < n; k++) right[i]! -= normal[n * k + i]! * right[k]!;
    right[i]! /= normal[n * i + i]!;
  }
  return right;
}
