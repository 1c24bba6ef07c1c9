// Poses of a linkage in space for given values of all its drives, by Gauss and Newton from the last ones.
//
// A joint has a frame in the reference pose, common to its links. The frame E of its second link, seen from its first,
// keeps the directions in which the joint does not slide and turn; drives, and wheels on common carriers, add rows.

import { cross, dot, minus, moved, type Vector } from "./algebra";

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
/** A number of a joint, and how it grows as the second link turns and shifts, in radians and sizes; as the first one
 * does, it shrinks by as much. */
type Reading = { value: number; slopes: number[] };
/** What is to be 0, and how it grows with six unknowns each of some links, from numbers on. */
type Row = { gap: number; slopes: [first: number, by: number[]][] };

const STEP = 0.08; // radians, or parts of the size, from one solution to the next
const SHORTEST = 1 / 64; // of it
const LEAP = 0.25; // radians or sizes: a link that goes farther in a step is in another assembly mode
const CLOSED = 1e-9;
const MOST = 12;
const SMALL = 1e-6; // of the differences by which the place of a pointer is derived
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

/** Readings of one joint with their weights, added. */
function sum(parts: [Reading, number][]): Reading {
  const value = parts.reduce((all, [one, weight]) => all + weight * one.value, 0);
  return { value, slopes: [0, 1, 2, 3, 4, 5].map((k) => parts.reduce((all, [one, w]) => all + w * one.slopes[k]!, 0)) };
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
  /** The first of six unknowns of each link that moves. */
  readonly #places: Map<number, number>;

  constructor(
    private readonly live: Live,
    private readonly size: number,
    private readonly middle: Vector,
    links: number,
  ) {
    this.poses = Array.from({ length: links }, () => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
    this.values = live.drives.map(() => 0);
    this.turned = live.joints.map(() => 0);
    const moving = this.poses.map((_, k) => k).filter((k) => k !== live.frame);
    this.#places = new Map(moving.map((link, k) => [link, 6 * k]));
  }

  /** Another one, which goes on from here. */
  copy(): Solver {
    const other = new Solver(this.live, this.size, this.middle, this.poses.length);
    [other.poses, other.turned] = [this.poses, this.turned];
    other.values.splice(0, this.values.length, ...this.values);
    return other;
  }

  /** The angle of a joint from that of a frame of its second link, seen from its first one, with full turns. */
  #angle(poses: Pose[], number: number, axis = 2): Reading {
    const e = this.#seen(poses, number);
    const [one, two] = [(axis + 1) % 3, (axis + 2) % 3];
    const [x, y] = [e.cosine(one, one), e.cosine(two, one)];
    const far = x.value ** 2 + y.value ** 2;
    const turned = this.turned[number]!;
    return {
      value: turned + wrapped(Math.atan2(y.value, x.value) - turned),
      slopes: y.slopes.map((slope, k) => (x.value * slope - y.value * x.slopes[k]!) / far),
    };
  }

  /** What is read of the second link's frame of a joint, seen from its first one. */
  #seen(poses: Pose[], number: number) {
    const { links, frame } = this.live.joints[number]!;
    const [a, b] = links.map((link) => times(poses[link]!, frame)) as [Pose, Pose];
    const column = (pose: Pose, k: number): Vector => [pose[k]!, pose[k + 4]!, pose[k + 8]!];
    const place = column(b, 3);
    return {
      /** The cosine between an axis of the first and one of the second. */
      cosine: (first: number, second: number): Reading => {
        const [u, v] = [column(a, first), column(b, second)];
        return { value: dot(u, v), slopes: [...cross(v, u), 0, 0, 0] };
      },
      /** How far the second is along an axis of the first. */
      way: (axis: number): Reading => {
        const u = column(a, axis);
        const slopes = [...cross(minus(place, this.middle), u), ...u.map((part) => this.size * part)];
        return { value: dot(u, minus(place, column(a, 3))), slopes };
      },
    };
  }

  /** What a drive stands at. */
  #value(poses: Pose[], { joint, axis, turns, sign }: Drive): Reading {
    return sum([[turns ? this.#angle(poses, joint, axis) : this.#seen(poses, joint).way(axis), sign]]);
  }

  #rows(poses: Pose[], targets: number[], hold: number): Row[] {
    const { drives, gears, joints } = this.live;
    const rows: Row[] = [];
    const slopesOf = (number: number, { slopes }: Reading, weight = 1): Row["slopes"] =>
      joints[number]!.links.flatMap((link, side) => {
        const first = this.#places.get(link);
        const sign = side ? weight : -weight;
        return first === undefined ? [] : [[first, slopes.map((slope) => sign * slope)]];
      });
    joints.forEach(({ pitch, slides, turns }, number) => {
      const seen = this.#seen(poses, number);
      const add = (...parts: [Reading, number][]) => {
        const read = sum(parts);
        rows.push({ gap: read.value, slopes: slopesOf(number, read) });
      };
      for (let k = 0; k < 3; k++)
        if (pitch && k === 2) add([seen.way(k), 1 / this.size], [this.#angle(poses, number), -pitch / this.size]);
        else if (!slides.includes("xyz"[k]!)) add([seen.way(k), 1 / this.size]);
      if (turns === "")
        for (const [a, b] of [
          [0, 1],
          [1, 2],
          [2, 0],
        ] as const)
          add([seen.cosine(b, a), 0.5], [seen.cosine(a, b), -0.5]);
      if (turns === "xy") add([seen.cosine(0, 1), 1]);
      if (turns.length === 1) {
        const k = "xyz".indexOf(turns);
        for (const n of [0, 1, 2]) if (n !== k) add([seen.cosine(n, k), 1]);
      }
    });
    for (const gear of gears) {
      const turned = gear.map(([joint]) => this.#angle(poses, joint));
      rows.push({
        gap: gear.reduce((all, [, weight], k) => all + weight * turned[k]!.value, 0),
        slopes: gear.flatMap(([joint, weight], k) => slopesOf(joint, turned[k]!, weight)),
      });
    }
    drives.forEach((drive, k) => {
      const unit = hold / (drive.turns ? 1 : this.size);
      const read = this.#value(poses, drive);
      rows.push({ gap: unit * (read.value - targets[k]!), slopes: slopesOf(drive.joint, read, unit) });
    });
    return rows;
  }

  /** Poses in which all rows are 0 as nearly as can be, and the largest miss. */
  #solved(rowsOf: (poses: Pose[]) => Row[], most: number): { poses: Pose[]; miss: number } {
    let { poses } = this;
    const n = 6 * this.#places.size;
    let miss = Infinity;
    for (let step = 0; step <= most; step++) {
      const rows = rowsOf(poses);
      miss = Math.max(...rows.map(({ gap }) => Math.abs(gap)));
      if (miss < CLOSED || step === most) break;
      const normal = new Float64Array(n * n);
      const right = new Float64Array(n);
      for (const { gap, slopes } of rows)
        for (const [i, a] of slopes)
          for (let k = 0; k < 6; k++) {
            if (!a[k]) continue;
            right[i + k]! -= a[k]! * gap;
            for (const [j, b] of slopes) for (let m = 0; m < 6; m++) normal[n * (i + k) + j + m]! += a[k]! * b[m]!;
          }
      const by = solvedSystem(normal, right, n);
      poses = poses.map((pose, link) => {
        const first = this.#places.get(link);
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
      const { poses, miss } = this.#solved((tried) => this.#rows(tried, targets, 1), MOST);
      if (miss < 1e-6 && this.#leap(poses) < LEAP) {
        this.poses = poses;
        this.turned = this.live.joints.map((_, k) => this.#angle(poses, k).value);
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
    return [...this.#places.keys()].reduce((most, link) => {
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
    const first = this.#places.get(link);
    const rows = (tried: Pose[]): Row[] => {
      const pose = tried[link]!;
      const gaps = at(pose);
      const slopes: [number[], number[]] = [[], []];
      for (let k = 0; k < 6; k++) {
        const by = [0, 0, 0, 0, 0, 0];
        by[k] = SMALL;
        at(nudged(pose, by, 0, this.middle, this.size)).forEach((value, n) => {
          slopes[n]!.push((WEIGHT * (value - gaps[n]!)) / SMALL);
        });
      }
      return [
        ...this.#rows(tried, this.values, HOLD),
        ...gaps.map((gap, n): Row => ({ gap: WEIGHT * gap, slopes: first === undefined ? [] : [[first, slopes[n]!]] })),
      ];
    };
    const { poses } = this.#solved(rows, 4);
    const wanted = this.live.drives.map((drive, k) => {
      const most = 2 * STEP * (drive.turns ? 1 : this.size); // the pointer may be where the link cannot come
      return Math.min(Math.max(this.#value(poses, drive).value, this.values[k]! - most), this.values[k]! + most);
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
