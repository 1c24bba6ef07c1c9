/** All four-bars through nine points, as complex solutions: stored generic ones followed to the task by the core
 * (core/page/solutions_door.cpp is the other side of the door), as `gruebler.design.synthesis.alt_burmester` does it,
 * but without the endgame. */

import packed from "../../../core/page/solutions.wasm.gz";
import { unpacked } from "../packed";
import { abs, add, type Complex, conj, div, mul, scaled, sub } from "./complex";

export const CLASSES = 1442;
/** Numbers of a solution: x, x*, y, y* (moving pivots), a, a*, b, b* (fixed ones), real and imaginary parts. */
export const WIDTH = 16;

const TASK = 64; // numbers of a task: complex[4, 8]
const POINTS = 8;
const [QUICK, CAREFUL] = [1e-3, 1e-6]; // how far the corrector may change a prediction
const BLOCK = 32; // paths between two messages of how far it is
const SAME = 1e-7; // relative: solutions nearer to each other are one
const REGULAR = 1e-8; // the last relative step of Newton's method at a regular solution, with what rounding leaves
const NEAR = 1e-4; // an end and what Newton's method makes of it are the same
const BENDS = [0.02, 0.1]; // how far bent ways lead aside, relative to the task
const FEW = 0.05; // where more than this part of the paths is lost, the task itself is special, not the way to it

interface Core {
  readonly memory: WebAssembly.Memory;
  reserve(count: number): number;
  track(positions: number, points: number, count: number, loose: number): void;
  refine(positions: number, points: number, count: number): void;
  certify(positions: number, points: number, count: number): void;
}

/** A generic task and its solutions, one of each class. */
export interface Generic {
  task: Float64Array;
  solutions: Float64Array;
}

export interface Complete {
  /** (found, WIDTH) */
  solutions: Float64Array;
  /** How many paths are not resolved. */
  missing: number;
}

type Said = { z: Float64Array; said: Float64Array };
type Progress = (done: number, total: number) => void;

export class Homotopy {
  readonly #generic: Generic;

  private constructor(
    private readonly core: Core,
    { task, solutions }: Generic,
  ) {
    const { z, said } = this.#refined(solutions, task);
    if (said.some((step) => !(step < 1e-10))) throw new Error("the stored solutions are damaged");
    this.#generic = { task, solutions: z };
  }

  static async from(generic: Generic): Promise<Homotopy> {
    const { instance } = await WebAssembly.instantiate(await unpacked(packed).arrayBuffer());
    return new Homotopy(instance.exports as unknown as Core, generic);
  }

  #called(z: Float64Array, begin: Float64Array, end: Float64Array, work: (count: number) => void): Said {
    const count = z.length / WIDTH;
    const at = this.core.reserve(count);
    const given = new Float64Array(this.core.memory.buffer, at, 2 * TASK + z.length);
    given.set(begin);
    given.set(end, TASK);
    given.set(z, 2 * TASK);
    work(count);
    const found = new Float64Array(this.core.memory.buffer, at + 16 * TASK, z.length + count).slice();
    return { z: found.subarray(0, z.length), said: found.subarray(z.length) };
  }

  #refined(z: Float64Array, task: Float64Array): Said {
    return this.#called(z, task, task, (count) => this.core.refine(0, POINTS, count));
  }

  #certified(z: Float64Array, task: Float64Array): boolean[] {
    const { said } = this.#called(z, task, task, (count) => this.core.certify(0, POINTS, count));
    return Array.from(said, (one) => one > 0);
  }

  /** Ends of paths, and how each ended: 0 where it arrived. */
  #followed(
    z: Float64Array,
    begin: Float64Array,
    end: Float64Array,
    loose: number,
    progress: Progress = () => {},
  ): Said {
    const total = z.length / WIDTH;
    const out = { z: new Float64Array(z.length), said: new Float64Array(total) };
    for (let from = 0; from < total; from += BLOCK) {
      const part = z.subarray(from * WIDTH, (from + BLOCK) * WIDTH);
      const found = this.#called(part, begin, end, (count) => this.core.track(0, POINTS, count, loose));
      out.z.set(found.z, from * WIDTH);
      out.said.set(found.said, from);
      progress(Math.min(from + BLOCK, total), total);
    }
    return out;
  }

  /** The solutions of a task whose displacements are of the order of 1, one of each class.
   *
   * Paths that fail, and those whose ends coincide, are followed again with fine steps; what is missing then is sought
   * along other ways. Where the rest ends, the library can tell. */
  solve(task: Float64Array, progress: Progress): Complete {
    const base = this.#generic;
    const { z: ends, said } = this.#followed(base.solutions, base.task, task, QUICK, progress);
    const alike = repeated(ends, said);
    const again = rows(CLASSES, (k) => said[k] !== 0 || alike.has(k));
    const careful = this.#followed(chosen(base.solutions, again), base.task, task, CAREFUL);
    again.forEach((k, row) => {
      ends.set(careful.z.subarray(row * WIDTH, (row + 1) * WIDTH), k * WIDTH);
      said[k] = careful.said[row]!;
    });
    const still = repeated(ends, said);
    const arrived = rows(CLASSES, (k) => said[k] === 0 && !still.has(k));
    let found = this.#proved(chosen(ends, arrived), task);
    const wide = base.task.map((value, k) => Math.max(Math.abs(value), Math.abs(task[k]!)));
    for (const [turn, bend] of BENDS.entries()) {
      const lost = rows(CLASSES, (k) => said[k] !== 0 || still.has(k));
      const missing = CLASSES - found.length / WIDTH;
      if (missing === 0 || missing > FEW * CLASSES) break;
      const middle = wide.map((size, k) => (base.task[k]! + task[k]!) / 2 + bend * size * aside(k + TASK * turn));
      const half = this.#followed(chosen(base.solutions, lost), base.task, middle, CAREFUL);
      const on = rows(lost.length, (k) => half.said[k] === 0);
      const whole = this.#followed(chosen(half.z, on), middle, task, CAREFUL);
      const more = chosen(
        whole.z,
        rows(on.length, (k) => whole.said[k] === 0),
      );
      found = distinct(joined(found, this.#proved(more, task)));
    }
    return { solutions: found, missing: CLASSES - found.length / WIDTH };
  }

  /** Ends sharpened, those that are solutions, each a different one: proved, or regular as far as rounding tells. */
  #proved(ends: Float64Array, task: Float64Array): Float64Array {
    const { z, said: steps } = this.#refined(ends, task);
    const sharp = this.#certified(z, task);
    const gap = (k: number) => Math.max(...Array.from({ length: WIDTH }, (_, i) => Math.abs(z[k + i]! - ends[k + i]!)));
    const holds = (k: number) => gap(k * WIDTH) < NEAR && (sharp[k]! || steps[k]! < REGULAR);
    return distinct(chosen(z, rows(sharp.length, holds)));
  }
}

/** The task of real displacements, with their conjugates. */
export function taskOf(displacements: readonly Complex[]): Float64Array {
  const task = new Float64Array(TASK);
  displacements.forEach((t, k) => {
    task.set(t, 2 * k);
    task.set(conj(t), 2 * (POINTS + k));
  });
  return task;
}

/** A number of a solution. */
export function numberAt(z: Float64Array, row: number, k: number): Complex {
  return [z[row * WIDTH + 2 * k]!, z[row * WIDTH + 2 * k + 1]!];
}

/** The solutions in which conjugates are conjugates. */
export function realRows(z: Float64Array): number[] {
  return rows(z.length / WIDTH, (row) => {
    const numbers = Array.from({ length: 8 }, (_, k) => numberAt(z, row, k));
    const gap = Math.max(...[0, 2, 4, 6].map((k) => abs(sub(numbers[k + 1]!, conj(numbers[k]!)))));
    return gap <= 1e-7 * (1 + Math.max(...numbers.map(abs)));
  });
}

const rows = (count: number, holds: (row: number) => boolean) =>
  Array.from({ length: count }, (_, row) => row).filter(holds);

function chosen(z: Float64Array, which: readonly number[]): Float64Array {
  const out = new Float64Array(which.length * WIDTH);
  for (const [to, row] of which.entries()) out.set(z.subarray(row * WIDTH, (row + 1) * WIDTH), to * WIDTH);
  return out;
}

function joined(one: Float64Array, other: Float64Array): Float64Array {
  const out = new Float64Array(one.length + other.length);
  out.set(one);
  out.set(other, one.length);
  return out;
}

/** A fixed number between -1 and 1, another for each k: what is bent aside is so on every machine. */
function aside(k: number): number {
  const part = (k + 1) * 0.6180339887498949;
  return 2 * (part - Math.floor(part)) - 1;
}

/** Numbers that are the same for cognates: symmetric ones of the three fixed pivots, with logarithmic modulus. */
function marksOf(z: Float64Array, row: number): number[] {
  const [x, xc, y, yc, a, ac, b, bc] = Array.from({ length: 8 }, (_, k) => numberAt(z, row, k)) as [
    Complex,
    Complex,
    Complex,
    Complex,
    Complex,
    Complex,
    Complex,
    Complex,
  ];
  const third = (u: Complex, v: Complex, p: Complex, q: Complex) => div(sub(mul(p, v), mul(q, u)), sub(v, u));
  const [c, cc] = [third(x, y, a, b), third(xc, yc, ac, bc)];
  const sum = (p: Complex, q: Complex, r: Complex) => add(add(p, q), r);
  return [sum(a, b, c), sum(mul(a, b), mul(b, c), mul(c, a)), sum(ac, bc, cc)].flatMap((mark) => {
    const size = abs(mark);
    const level = size > 0 ? scaled(Math.log1p(size) / size, mark) : mark;
    return level.map((value) => (Number.isFinite(value) ? value : 9));
  });
}

/** Pairs of rows that are of one class. */
function pairs(z: Float64Array, which: readonly number[]): [number, number][] {
  const marked = which.map((row) => ({ row, marks: marksOf(z, row) }));
  marked.sort((one, other) => one.marks[0]! - other.marks[0]! || one.row - other.row);
  const out: [number, number][] = [];
  marked.forEach((one, k) => {
    for (const other of marked.slice(k + 1)) {
      if (other.marks[0]! - one.marks[0]! > SAME) break;
      if (Math.hypot(...one.marks.map((value, i) => value - other.marks[i]!)) <= SAME) out.push([one.row, other.row]);
    }
  });
  return out;
}

/** Which of those that arrived are in the class of another one. */
function repeated(z: Float64Array, said: Float64Array): Set<number> {
  return new Set(
    pairs(
      z,
      rows(said.length, (k) => said[k] === 0),
    ).flat(),
  );
}

/** One solution of each class. */
function distinct(z: Float64Array): Float64Array {
  const all = rows(z.length / WIDTH, () => true);
  const gone = new Set(pairs(z, all).map((pair) => Math.max(...pair)));
  return chosen(
    z,
    all.filter((row) => !gone.has(row)),
  );
}
