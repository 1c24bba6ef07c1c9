/** Play and pause: the drive goes on by itself. */

import { type Reach, TURN } from "./cycle";
import { h, put, svg } from "./dom";
import { t } from "./language";

const LONGEST = 0.1; // seconds: what a page that slept goes on by

export class Player {
  readonly button = h("button.play", { onclick: () => this.toggle() });
  playing = false;
  #last = 0;
  #frame = 0;

  constructor(
    /** So many seconds went by. */
    private readonly step: (seconds: number) => void,
    private readonly paused: () => void,
  ) {}

  toggle(): void {
    if (this.playing) this.pause();
    else {
      this.playing = true;
      this.#last = performance.now();
      this.arrange();
      this.#frame = requestAnimationFrame((now) => this.#tick(now));
    }
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.#frame);
    this.arrange();
    this.paused();
  }

  /** Write the button, in the language of the page. */
  arrange(): void {
    const text = this.playing ? t("Pause") : t("Play");
    put(this.button, { "aria-label": text, title: text });
    const d = this.playing ? "M3 2h4v14H3zM11 2h4v14h-4z" : "M4 1.5v15l12.5-7.5z";
    this.button.replaceChildren(svg("svg", { viewBox: "0 0 18 18", "aria-hidden": "true" }, svg("path", { d })));
  }

  #tick(now: number): void {
    if (!this.playing) return;
    const seconds = Math.min(LONGEST, (now - this.#last) / 1000);
    this.#last = now;
    this.step(seconds);
    this.#frame = requestAnimationFrame((next) => this.#tick(next));
  }
}

/** A drive value some seconds later, and the way in which it goes on from there: full turns one way, or to and fro. */
export function later(
  value: number,
  way: number,
  seconds: number,
  speed: number,
  cycle: Reach,
  [low, high]: [number, number],
): { value: number; way: number } {
  if (cycle.full) return { value: value + (way * seconds * speed * TURN) / 60, way };
  const next = value + (way * seconds * speed * (high - low) * 2) / 60;
  if (next < high && next > low) return { value: next, way };
  return { value: Math.max(low, Math.min(high, next)), way: next >= high ? -1 : 1 };
}
