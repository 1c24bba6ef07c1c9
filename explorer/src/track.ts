/** The slider of the drive: where it may go, where the output turns back, where the transmission is worst. */

import { DEGREE, type Reach, TURN, wrapped } from "./cycle";
import { h, put, svg } from "./dom";
import { angle, currentLanguage, number, t } from "./language";

export class Track {
  readonly element: HTMLElement;
  readonly #root = svg("svg", { "aria-hidden": "true" });
  readonly #knob = svg("circle.knob", { r: 9, cy: 17 });
  #cycle: Reach | null = null;
  #unit = 1;
  #from = 0;
  #to = 1;
  #limits: [number, number] = [0, 1];
  #here = 0;
  #textOf: (value: number) => string = String;
  /** Of what the marks tell. */
  #told = "";

  constructor(private readonly pick: (value: number, beyond: boolean) => void) {
    const onpointerdown = (event: PointerEvent) => {
      this.element.setPointerCapture(event.pointerId);
      this.#at(event);
    };
    const onpointermove = (event: PointerEvent) => event.buttons && this.#at(event);
    const onkeydown = (event: KeyboardEvent) => {
      const [low, high] = this.#limits;
      const part = (high - low) / (/^Page/.test(event.key) ? 12 : 360);
      const here = this.#here;
      const ways: Record<string, number> = { ArrowUp: part, PageUp: part, ArrowDown: -part, PageDown: -part };
      const ends: Record<string, number> = { Home: low, End: high };
      const value = ends[event.key] ?? here + (ways[event.key] ?? NaN);
      if (Number.isNaN(value)) return;
      event.preventDefault();
      this.pickWithin(value);
    };
    const heard = { onpointerdown, onpointermove, onkeydown };
    this.element = h("div.track", { role: "slider", tabindex: 0, ...heard }, this.#root);
  }

  #at(event: PointerEvent): void {
    const box = this.element.getBoundingClientRect();
    const part = Math.max(0, Math.min(1, (event.clientX - box.left - 12) / (box.width - 24)));
    this.pickWithin(this.#from + part * (this.#to - this.#from));
  }

  /** As far as it goes. */
  pickWithin(value: number): void {
    const [low, high] = this.#limits;
    this.pick(Math.max(low, Math.min(high, value)), value < low || value > high);
  }

  /** The drive values that are played and that the slider reaches. */
  get range(): [number, number] {
    return this.#limits;
  }

  show(cycle: Reach, turning: boolean, dead: number[], least: number | null, unit: string): void {
    this.#cycle = cycle;
    const { full, turns, low: from, high: to } = cycle;
    const reached = full ? [] : [from, to, ...cycle.stops.map(Boolean)]; // full turns go from 0 on wherever they began
    const shows = JSON.stringify([turning, dead, least, unit, turns, reached, currentLanguage()]);
    if (shows === this.#told) return;
    this.#told = shows;
    this.#unit = turning ? DEGREE : 1;
    const [low, high] = limitsOf(cycle);
    this.#limits = [low, high];
    const timed = unit === "s";
    [this.#from, this.#to] = timed ? [from, to] : shownRange(this.#limits, full);
    const parts: SVGElement[] = [];
    const x = (value: number) => `${((value - this.#from) / (this.#to - this.#from)) * 100}%`;
    const line = (a: number, b: number, style: string) =>
      parts.push(svg("line", { class: style, x1: x(a), x2: x(b), y1: 17, y2: 17 }));
    line(this.#from, this.#to, "barred");
    if (cycle.stops[0]) line(this.#from, low, "hatched");
    if (cycle.stops[1]) line(high, this.#to, "hatched");
    line(low, high, "free");
    const wrap = (value: number) => wrapped(cycle, value);
    const mark = (value: number, style: string, d: string, title: string) => {
      const here = wrap(value);
      if (here < this.#from || here > this.#to) return;
      const group = svg(
        "svg",
        { x: x(here), y: 0, overflow: "visible" },
        svg("path", { class: style, d }, svg("title", {}, title)),
      );
      parts.push(group);
    };
    this.#textOf = (value) => driveText({ drive: { turning }, model: { unit } }, value, timed ? 3 : 5);
    const shown = (value: number) => this.#textOf(wrap(value));
    for (const value of dead)
      mark(value, "dead", "M0 8 L-5 0 H5 Z", t("Turns back at {value}", { value: shown(value) }));
    if (least !== null)
      mark(
        least,
        "least",
        "M0 26 L-4.5 33 H4.5 Z",
        t("Smallest transmission angle at {value}", { value: shown(least) }),
      );
    const label = (value: number, anchor: string, told = value) => {
      const text = svg("text", { x: x(value), y: 43, "text-anchor": anchor }, this.#textOf(told));
      parts.push(text);
    };
    const end = (value: number) => (Math.abs(value) < 1e-6 * (high - low) ? 0 : value); // but for rounding
    const ended = full || timed;
    label(low, ended ? "start" : "middle", end(full ? low : from));
    if (high > low) label(high, ended ? "end" : "middle", end(full ? high : to));
    this.#root.replaceChildren(...parts, this.#knob);
    const [valuemin, valuemax] = [low / this.#unit, high / this.#unit];
    put(this.element, {
      "aria-label": timed ? t("Time") : t("Drive"),
      "aria-valuemin": valuemin,
      "aria-valuemax": valuemax,
    });
  }

  set(value: number): void {
    const here = this.#cycle ? wrapped(this.#cycle, value) : value;
    this.#here = here;
    put(this.#knob, { cx: `${Math.max(0, Math.min(1, (here - this.#from) / (this.#to - this.#from))) * 100}%` });
    put(this.element, { "aria-valuenow": (here / this.#unit).toFixed(3), "aria-valuetext": this.#textOf(here) });
  }
}

/** A value of a drive with its unit. */
export function driveText(
  { drive, model }: { drive: { turning: boolean } | null; model: { unit: string } },
  value: number,
  digits = 4,
): string {
  return drive?.turning ? angle(value, digits) : `${number(value, digits)} ${model.unit}`;
}

/** The drive values that are played. */
export function limitsOf({ full, high, low, turns }: Reach): [number, number] {
  const room = 1e-7 * (high - low);
  return full ? [0, TURN * turns] : [low + room, high - room];
}

/** The drive values from end to end of the slider: whole turns, or somewhat more than the limits. */
export function shownRange([low, high]: [number, number], full: boolean): [number, number] {
  const more = full ? 0 : 0.12 * (high - low || 1);
  return [low - more, high + more];
}
