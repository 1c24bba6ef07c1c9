/** A linkage moved along a path of its drives, by the core: `core/src/motion`, compiled to WebAssembly.
 *
 * core/page/door.cpp is the other side of the door and says what lies where in the block of memory between them. */

import { unpacked } from "./packed";
import type { Program } from "./program";
import type { Status } from "./status";

/** Where a motion starts: the signs of its dyads and the unknowns of its larger groups. */
export interface State {
  signs: Float64Array;
  unknowns: Float64Array;
}

/** Rows of poses, a column for each number, as the core writes them; `rows.ts` reads them. */
export interface Rows {
  status: Status;
  reached: number;
  /** Where on the path it stopped, in rows. */
  at: number;
  /** The dyad at fault, or -1 minus the larger group. */
  fault: number;
  order: number;
  links: number;
  /** (order + 1, links, rows, 2) */
  places: Float64Array;
  /** (links, rows, 2) */
  turns: Float64Array;
  /** (order, links, rows) */
  rates: Float64Array;
  /** (dyads, rows) */
  roots: Float64Array;
  /** (unknowns, rows) */
  unknowns: Float64Array;
}

interface Core {
  readonly memory: WebAssembly.Memory;
  /** The block, with room for so many words of eight bytes. */
  reserve(words: number): number;
  /** Move what stands in the block; the address of what is wrong, or 0. */
  run(): number;
  unwound(x: number, y: number, near: number): number;
}

let core: Core;

/** Compile the packed module, once, before anything moves: some milliseconds. Fails where WebAssembly is forbidden or
 * missing. */
export async function loadKernel(packed: BlobPart): Promise<void> {
  const { instance } = await WebAssembly.instantiate(await unpacked(packed).arrayBuffer());
  core = instance.exports as unknown as Core;
}

/** The angle of a direction, with as many whole turns as bring it next to one near by. */
export function unwoundAngle(x: number, y: number, near: number): number {
  return core.unwound(x, y, near);
}

type Numbers = Float64Array | BigInt64Array;

export class Kernel {
  /** What stands first in the block but for counts of rows; points, lines and values change when joints are dragged. */
  readonly #program: readonly Numbers[];
  /** Of the program, then of rows and derivatives. */
  readonly #counts: BigInt64Array;
  readonly #unknowns: number;

  constructor(private readonly p: Program) {
    const whole = (numbers: ArrayLike<number>) => BigInt64Array.from(Array.from(numbers, BigInt));
    const width = p.pieces[0]?.length ?? 0;
    const pieces = new Float64Array(p.pieces.length * width);
    for (const [k, piece] of p.pieces.entries()) pieces.set(piece, k * width);
    this.#unknowns = 3 * p.roots.length + 2 * p.windings.filter((winding) => winding >= 0).length;
    const groups = p.conditions.length - 1;
    const first = [p.operations.length, p.links.length, p.linkCount, p.drives, p.dyads, groups, p.kinds.length];
    this.#counts = whole([...first, p.roots.length, this.#unknowns, p.pieces.length, width, 0, 0]);
    this.#program = [
      whole(p.operations.flat()),
      whole(p.links),
      p.points,
      p.lines,
      whole(p.conditions),
      whole(p.kinds),
      whole(p.sides),
      whole(p.owners),
      whole(p.bodies),
      whole(p.roots),
      p.most,
      p.values,
      whole(p.windings),
      pieces,
    ];
  }

  /** Move along rows of drive values, (rows * drives,); speeds are those of the drives for order 1 and 2. Where it ends
   * is found to the least step, in rows. */
  run(path: Float64Array, start: State, order = 0, speeds: readonly Float64Array[] = [], least = 1e-14): Rows {
    const { dyads, drives, linkCount: links, size } = this.p;
    const count = drives ? path.length / drives : 1;
    this.#counts.set([BigInt(count), BigInt(order)], 11);
    const given: Numbers[] = [
      this.#counts,
      Float64Array.of(size),
      ...this.#program,
      path,
      ...speeds.slice(0, order),
      start.signs,
      start.unknowns,
      Float64Array.of(least),
    ];
    const lengths = [4, (order + 1) * 2 * links, 2 * links, order * links, dyads, this.#unknowns];
    const found = lengths.map((length, k) => (k ? length * count : length));
    const words = [...given.map((numbers) => numbers.length), ...found, Math.ceil((links * count) / 2)];
    let at = core.reserve(words.reduce((sum, length) => sum + length, 0));
    for (const numbers of given) {
      const Kind = numbers instanceof Float64Array ? Float64Array : BigInt64Array;
      new Kind(core.memory.buffer, at, numbers.length).set(numbers as never);
      at += 8 * numbers.length;
    }
    const wrong = core.run();
    if (wrong) throw new Error(textAt(core.memory, wrong));
    const [outcome, places, turns, rates, roots, unknowns] = found.map((length) => {
      const from = at;
      at += 8 * length;
      return new Float64Array(core.memory.buffer, from, length).slice();
    }) as [Float64Array, Float64Array, Float64Array, Float64Array, Float64Array, Float64Array];
    const [status, reached, stop, fault] = outcome as unknown as [Status, number, number, number];
    return { status, reached, at: stop, fault, order, links, places, turns, rates, roots, unknowns };
  }
}

function textAt(memory: WebAssembly.Memory, at: number): string {
  const bytes = new Uint8Array(memory.buffer, at);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}
