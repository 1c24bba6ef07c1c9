/** A linkage that moves by itself: poses that the library found, played in real time. */

import type { Rows } from "./kernel";
import { number } from "./language";
import type { Linkage } from "./linkage";

/** Poses of all links, x and y, cosine and sine in turn, values and speeds of the drives, so many a second. */
export interface Fall {
  rate: number;
  places: number[][];
  turns: number[][];
  drives: number[][];
  speeds: number[][];
  lines: string[];
}

export class Falling {
  /** The pose before. */
  readonly start: Rows;
  /** Poses since it was let go. */
  #at = 0;

  constructor(
    readonly fall: Fall,
    linkage: Linkage,
  ) {
    this.start = linkage.pose;
  }

  /** Since it was let go. */
  get seconds(): number {
    return Math.floor(this.#at) / this.fall.rate;
  }

  /** How long it lasts, in seconds. */
  get until(): number {
    return (this.fall.places.length - 1) / this.fall.rate;
  }

  get text(): string {
    return `${number(Number(this.seconds.toFixed(2)))} s`;
  }

  /** The pose so many seconds later, without rates; the first one follows the last. */
  later(seconds: number): Rows {
    const { rate, places } = this.fall;
    this.#at = Math.max(0, this.#at + seconds * rate) % places.length; // the first frame may be older than the answer
    return this.#pose();
  }

  /** The pose so many seconds after the start. */
  at(seconds: number): Rows {
    this.#at = Math.max(0, Math.min(seconds, this.until)) * this.fall.rate + 1e-6; // no row is missed by rounding
    return this.#pose();
  }

  #pose(): Rows {
    const { places, turns } = this.fall;
    const row = Math.floor(this.#at);
    const { start } = this;
    const still = new Float64Array(start.places.length).fill(NaN);
    still.set(places[row]!);
    const rates = new Float64Array(start.rates.length).fill(NaN);
    return { ...start, places: still, turns: Float64Array.from(turns[row]!), rates };
  }
}
