/** A linkage that moves by itself: poses that the library found, played in real time. */

import type { Rows } from "./kernel";
import { number } from "./language";
import type { Linkage } from "./linkage";

/** Poses of all links, x and y, cosine and sine in turn, and the values of the drives, so many a second. */
export interface Fall {
  rate: number;
  places: number[][];
  turns: number[][];
  drives: number[][];
  lines: string[];
}

export class Falling {
  /** The pose before. */
  readonly start: Rows;
  /** Poses since it was let go. */
  #at = 0;

  constructor(
    private readonly fall: Fall,
    linkage: Linkage,
  ) {
    this.start = linkage.pose;
  }

  /** The values of the drives now. */
  get drives(): number[] {
    return this.fall.drives[Math.floor(this.#at)]!;
  }

  get text(): string {
    return `${number(this.#at / this.fall.rate, 3)} s`;
  }

  /** The pose so many seconds later, without rates; the first one follows the last. */
  later(seconds: number): Rows {
    const { rate, places, turns } = this.fall;
    this.#at = Math.max(0, this.#at + seconds * rate) % places.length; // the first frame may be older than the answer
    const row = Math.floor(this.#at);
    const { start } = this;
    const still = new Float64Array(start.places.length).fill(NaN);
    still.set(places[row]!);
    const rates = new Float64Array(start.rates.length).fill(NaN);
    return { ...start, places: still, turns: Float64Array.from(turns[row]!), rates };
  }
}
