/** Two fingers on a picture: the place between them goes with them, and what lies between is enlarged. */

import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

export class Fingers {
  readonly #places = new Map<number, Pair>();

  get count(): number {
    return this.#places.size;
  }

  clear(): void {
    this.#places.clear();
  }

  put(id: number, at: Pair): void {
    this.#places.set(id, at);
  }

  lift(id: number): void {
    this.#places.delete(id);
  }

  /** One of them is elsewhere; whether there are two, which change the picture. */
  move(id: number, now: Pair, viewport: Viewport): boolean {
    const before = this.#places.get(id);
    const other = [...this.#places].find(([one]) => one !== id)?.[1];
    if (!before) return false;
    this.#places.set(id, now);
    if (!other) return false;
    const wide = Math.hypot(before[0] - other[0], before[1] - other[1]);
    if (!(wide > 1)) return true;
    viewport.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
    const far = Math.hypot(now[0] - other[0], now[1] - other[1]);
    viewport.zoom(far / wide, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    return true;
  }
}
