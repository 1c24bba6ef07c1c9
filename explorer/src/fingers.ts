/** What pointers do to a picture: where they are, how long they are down, the wheel, two fingers. */

import { ownPage } from "./dom";
import { away } from "./hull";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

/** The pixel of an event within an element. */
export function pixelIn(element: Element, event: MouseEvent): Pair {
  const { left, top } = element.getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

/** Let the wheel enlarge a picture about its pixel; a notebook scrolls past it, unless Ctrl is down. */
export function wheelZooms(root: SVGElement, zoom: (factor: number, x: number, y: number) => void): void {
  const turned = (event: WheelEvent) => {
    if (!ownPage() && !event.ctrlKey) return;
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...pixelIn(root, event));
  };
  root.addEventListener("wheel", turned, { passive: false });
}

/** Hear of pointers on an element until one of them is up, or the function that is returned is called. */
export function whileDown(
  root: SVGElement,
  move: (event: PointerEvent) => void,
  up: (event: PointerEvent) => void,
): () => void {
  const heard = new AbortController();
  const { signal } = heard;
  root.addEventListener("pointermove", move, { signal });
  for (const name of ["pointerup", "pointercancel"] as const) root.addEventListener(name, up, { signal });
  return () => heard.abort();
}

/** Two fingers on a picture: the place between them goes with them, and what lies between is enlarged. */
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
    const wide = away(before, ...other);
    if (!(wide > 1)) return true;
    viewport.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
    const far = away(now, ...other);
    viewport.zoom(far / wide, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    return true;
  }
}
