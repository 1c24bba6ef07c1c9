/** A linkage that moves by itself: poses that the library found, played in real time. */

import type { Rows } from "./kernel";
import { fixed } from "./language";
import type { Linkage } from "./linkage";
import { together } from "./rows";

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
  /** What the linkage had before. */
  readonly before: Pick<Linkage, "cycle" | "pose">;
  readonly #poses: Rows[];
  /** Poses since it was let go. */
  #at = 0;

  constructor(
    readonly fall: Fall,
    linkage: Linkage,
  ) {
    const { cycle, pose } = linkage;
    this.before = { cycle, pose };
    const rates = new Float64Array();
    this.#poses = fall.places.map((one, row) => {
      const [places, turns] = [Float64Array.from(one), Float64Array.from(fall.turns[row]!)];
      return { ...pose, order: 0, places, turns, rates };
    });
    const values = Float64Array.from(this.#poses, (_, row) => row / fall.rate);
    linkage.cycle = { ...cycle, values, rows: together(this.#poses), whole: cycle };
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
    return `${fixed(this.seconds, 2)} s`;
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
    return this.#poses[Math.floor(this.#at)]!;
  }
}
