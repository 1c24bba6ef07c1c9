/** Which part of the drive's range plots show: one for all that stand together. */

import type { Pair } from "./rows";

/** So many times a range can be enlarged: as far as its rows still make a curve. */
const MOST = 30;

export class Span {
  /** Its ends, as parts of the range. */
  #ends: Pair = [0, 1];

  constructor(private readonly changed: () => void) {}

  get whole(): boolean {
    return this.#ends[1] - this.#ends[0] >= 1;
  }

  /** What is shown of a range. */
  of([first, last]: Pair): Pair {
    const [from, to] = this.#ends;
    return [first + from * (last - first), first + to * (last - first)];
  }

  /** Enlarge by a factor; what lies at a part of the plot's width stays there. */
  zoom(factor: number, part: number): void {
    const [from, to] = this.#ends;
    const wide = Math.min(1, Math.max(1 / MOST, (to - from) / factor));
    this.#put(from + part * (to - from - wide), wide);
  }

  /** Shift by a part of the plot's width. */
  pan(part: number): void {
    const [from, to] = this.#ends;
    this.#put(from + part * (to - from), to - from);
  }

  #put(from: number, wide: number): void {
    const first = Math.max(0, Math.min(1 - wide, from));
    this.#ends = [first, first + wide];
    this.changed();
  }
}
