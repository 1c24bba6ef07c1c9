/** Which part of the drive's range plots show, and where it begins: one for all that stand together. */

import type { Pair } from "./rows";

/** So many times a range can be enlarged: as far as its rows still make a curve. */
const MOST = 30;
/** Left of the plots: as much as numbers mostly take. */
const LEFT = 44;

export class Span {
  /** Its ends, as parts of the range. */
  #ends: Pair = [0, 1];
  /** Pixels for the numbers at their left, as many as the longest takes. */
  left = LEFT;

  constructor(private readonly changed: () => void) {}

  get whole(): boolean {
    return this.#ends[1] - this.#ends[0] >= 1;
  }

  /** Whether the numbers need more room than they had. */
  widen(left: number): boolean {
    const wider = left > this.left;
    if (wider) {
      this.left = left;
      this.changed();
    }
    return wider;
  }

  /** Of other plots. */
  narrow(): void {
    this.left = LEFT;
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
