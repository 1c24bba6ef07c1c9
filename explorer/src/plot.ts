/** Small plots over the drive, linked with it by a cursor; the value at the drive or pointer stands above the curve. */

import { DEGREE } from "./cycle";
import { put, renew, svg } from "./dom";
import { degreeStep, gridStep } from "./grid";
import { number, t } from "./language";
import { halfOf } from "./names";
import type { Pair } from "./rows";
import { Span } from "./span";

export interface Series {
  title: string;
  values: Float64Array;
  /** The value of the pose that is shown. */
  now?: (() => number) | undefined;
  colour: string;
  /** Below this value the ground is shaded. */
  floor?: number;
  /** Values that differ by less are the same but for rounding. */
  same?: number;
  /** Whether values are angles in degrees. */
  degrees?: boolean;
  /** After which values begin anew, if they do. */
  turn?: number;
  /** Places with rings, of drive and value. */
  marks?: readonly Pair[] | undefined;
}

export const WIDTH = 300;
export const HEIGHT = 140;
const RIGHT = 10;
const TOP = 20;
const BOTTOM = 30;
const TICK = 6.6; // pixels of a digit at an axis
const LONG = 36; // letters of a title beside which a value has no room
const LINES = /^(.{0,45})(?: (.+))?$/; // of a title
const ROW = 14; // pixels of one more row above
const EVEN = 200; // places of the drive at which values are compared
const PART = 0.05; // of the drive: where values may be without bound
const ONE = 1e-5; // of values: those that differ by less are read as one
const TINY = 2e-3; // values up to which are told in thousandths
const FLAT = 0.1; // pixels: the second difference below which a line is nearly straight

export class Plot {
  readonly element = svg("svg.plot", {
    role: "img",
  });
  readonly #curve = svg("path.curve", {});
  readonly #band = svg("rect.band", { height: 0 });
  readonly #cursor = svg("path.cursor", {});
  readonly #here = svg("circle.here", { r: 3, cy: -9 });
  readonly #title = svg("text.title", { x: 2 });
  readonly #value = svg("text.read", { x: WIDTH - RIGHT, y: 13, "text-anchor": "end" });
  readonly #beyond = svg("path.here", {});
  readonly #mesh = svg("path.mesh", {});
  readonly #marks = svg("path.curve", { stroke: "var(--purple)" });
  readonly #frame = svg("path.axis", { fill: "none" });
  /** What is enlarged ends at the axes. */
  readonly #inner = svg("svg", {}, this.#curve, this.#beyond, this.#marks);
  readonly #along = svg("text", { x: WIDTH - RIGHT, y: HEIGHT - 3, "text-anchor": "end" });
  readonly #upward = svg("g");
  readonly #across = svg("g");
  #pointed = NaN;
  private drive = NaN;
  private drives: Float64Array = new Float64Array(0);
  /** The whole range of the drive, and what is shown of it. */
  private range: Pair = [0, 1];
  private domain: Pair = [0, 1];
  private series: Series | null = null;
  #low = 0;
  #high = 1;
  /** By how much values are told larger. */
  #times = 1;

  constructor(
    /** Of the drive: "°", else one of length; "s" of time. */
    private readonly unit: string,
    pick: (drive: number) => void,
    private readonly span = new Span(() => this.redraw()),
  ) {
    const { element } = this;
    element.append(
      this.#band,
      this.#mesh,
      this.#upward,
      this.#across,
      this.#along,
      this.#frame,
      this.#inner,
      this.#cursor,
      this.#here,
      this.#title,
      this.#value,
    );
    const partOf = (x: number) => {
      const box = element.getBoundingClientRect();
      return (((x - box.left) / box.width) * WIDTH - this.span.left) / this.#wide;
    };
    const driveOf = (event: MouseEvent) => {
      const [first, last] = this.domain;
      return first + Math.max(0, Math.min(1, partOf(event.clientX))) * (last - first);
    };
    const at = (event: MouseEvent) => pick(driveOf(event));
    const point = (drive: number) => {
      this.#pointed = drive;
      this.at(this.drive);
    };
    element.addEventListener("pointerleave", () => point(NaN));
    // a finger that goes up or down scrolls the page; one that taps or goes sideways picks, two of them enlarge
    let [startX, startY] = [0, 0];
    const fingers = new Map<number, number>();
    element.addEventListener("pointerdown", (event) => {
      [startX, startY] = [event.clientX, event.clientY];
      fingers.set(event.pointerId, event.clientX);
      if (event.pointerType === "touch") return;
      element.setPointerCapture(event.pointerId);
      at(event);
    });
    for (const name of ["pointerup", "pointerleave"] as const)
      element.addEventListener(name, (event) => void fingers.delete(event.pointerId));
    element.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
      if (before !== undefined) fingers.set(event.pointerId, event.clientX);
      if (before !== undefined && other !== undefined) {
        const [was, is, fixed] = [before, event.clientX, other].map(partOf) as [number, number, number];
        if ((was - fixed) * (is - fixed) > 0) this.span.zoom((is - fixed) / (was - fixed), fixed);
        return;
      }
      const sideways = Math.abs(event.clientX - startX) > Math.abs(event.clientY - startY);
      if (event.buttons && (sideways || event.pointerType !== "touch")) at(event);
      else if (event.pointerType === "mouse") point(driveOf(event));
    });
    element.addEventListener("click", at);
    element.addEventListener("dblclick", () => this.span.zoom(0, 0));
    // the wheel alone scrolls the panel
    element.addEventListener(
      "wheel",
      (event) => {
        const along = event.deltaX || (event.shiftKey ? event.deltaY : 0);
        if (event.ctrlKey || event.metaKey) this.span.zoom(Math.exp(-0.005 * event.deltaY), partOf(event.clientX));
        else if (along && !this.span.whole) this.span.pan(along / this.#wide);
        else return;
        event.preventDefault();
      },
      { passive: false },
    );
  }

  show(drives: Float64Array, series: Series, range: Pair, drive = this.drive): void {
    Object.assign(this, { drives, series, range, drive });
    this.redraw();
  }

  /** The same values in another part of the range. */
  redraw(): void {
    const { drives, range, series } = this;
    if (!series) return;
    this.domain = this.span.of(range);
    const [first, last] = this.domain;
    const within = (_: number, k: number) => this.span.whole || (drives[k]! >= first && drives[k]! <= last);
    const part = this.unit === "s" ? 0 : PART; // over time nothing is without bound
    const { low, high } = plotRange(series.values.filter(within), series.same, drives.filter(within), part);
    const room = 0.06 * (high - low);
    [this.#low, this.#high] = [low - room, high + room];
    const upward = (series.degrees ? degreeValues : roundValues)(this.#low, this.#high, 3);
    this.#times = Math.max(-low, high) < TINY ? 1000 : 1;
    const letters = Math.max(...upward.map((value) => number(value * this.#times, 7).length));
    if (this.span.widen(TICK * letters + 6)) return; // all of them anew
    const { left } = this.span;
    const across = drives.map((drive) => this.#x(drive));
    const sides = series.values.map((value) => +(value > this.#high) - +(value < this.#low));
    const places = series.values.map((value, k) => {
      const out = sides[k] && sides[k - 1] === sides[k] && sides[k + 1] === sides[k];
      return out ? NaN : Math.max(TOP - 2, Math.min(HEIGHT - BOTTOM + 2, this.#y(value)));
    });
    put(this.#beyond, { d: beyondMarks(across, series.values, sides) });
    put(this.#curve, { d: lineThrough(across, places, series.turn && HEIGHT / 4) });
    const ring = ([x, y]: Pair) => `M${this.#x(x)} ${this.#y(y) - 4}a4 4 0 1 0 .1 0`;
    put(this.#marks, { d: (series.marks ?? []).map(ring).join("") });
    const crossed = this.#low < 0 && this.#high > 0;
    const zero = crossed ? `M${left} ${this.#y(0).toFixed(1)}H${WIDTH - RIGHT}` : "";
    const foot = HEIGHT - BOTTOM;
    const top = Math.max(TOP, Math.min(foot, this.#y(series.floor ?? -Infinity)));
    const wide = this.#wide;
    put(this.#frame, { d: `M${left} ${TOP}V${foot}H${WIDTH - RIGHT}${zero}` });
    put(this.#inner, { x: left, width: wide, height: HEIGHT, viewBox: `${left} 0 ${wide} ${HEIGHT}` });
    put(this.#band, { x: left, width: wide, height: (foot - top).toFixed(1), y: top.toFixed(1) });
    let { title } = series;
    if (this.#times > 1) title = title.includes("[") ? title.replace("[", "[10⁻³\u00a0") : `${title} [10⁻³]`;
    if (this.element.getAttribute("aria-label") !== title) {
      this.#along.textContent = `${this.unit === "s" ? t("Time") : t("Drive")} [${this.unit}]`;
      const [, one = title, other] = LINES.exec(title) ?? [];
      const row = title.length > LONG ? ROW : 0;
      renew(this.#title, one, svg("tspan", { x: 2, dy: ROW }, other));
      put(this.#title, { y: 13 - row });
      this.#curve.style.stroke = `var(${series.colour})`;
      put(this.element, { "aria-label": title, viewBox: `0 ${-row} ${WIDTH} ${HEIGHT + row}` });
    }
    const unit = this.#scale;
    const ticks = (unit === 1 ? roundValues : degreeValues)(first / unit, last / unit, 4);
    const lines = [
      ...upward.map((value) => `M${left} ${this.#y(value).toFixed(1)}H${WIDTH - RIGHT}`),
      ...ticks.map((value) => `M${this.#x(value * unit).toFixed(1)} ${TOP}V${foot}`),
    ];
    put(this.#mesh, { d: lines.join("") });
    relabel(
      this.#upward,
      upward.map((value) => [left - 4, this.#y(value) + 4, value * this.#times]),
      "end",
    );
    relabel(
      this.#across,
      ticks.map((value) => [this.#x(value * unit), foot + 14, value]),
      "middle",
    );
    this.at(this.drive);
  }

  at(drive: number): void {
    this.drive = drive;
    const { drives, series } = this;
    const place = Number.isNaN(this.#pointed) ? drive : this.#pointed;
    if (!series || drives.length < 2) return;
    const value = valueAt(drives, series.values, place, series.turn);
    const outside = !(place >= this.domain[0] && place <= this.domain[1]);
    const x = outside ? "-9" : this.#x(place).toFixed(1);
    put(this.#cursor, { d: `M${x} ${TOP}V${HEIGHT - BOTTOM}` });
    const y = Number.isFinite(value) ? Math.max(TOP, Math.min(HEIGHT - BOTTOM, this.#y(value))) : -9;
    put(this.#here, { cx: x, cy: y.toFixed(1) });
    const exact = place === drive ? series.now?.() : NaN;
    const told = Number.isFinite(exact) ? exact! : value; // of a pose without rates that at the drive
    const read = number(Math.abs(told) < series.same! ? 0 : told * this.#times);
    const where = `${number(place / this.#scale)}${this.#scale === 1 ? "" : "°"}: ${read}`;
    this.#value.textContent = Object.is(place, drive) ? read : where;
  }

  get #scale(): number {
    return this.unit === "°" ? DEGREE : 1;
  }

  get #wide(): number {
    return WIDTH - this.span.left - RIGHT;
  }

  #x(drive: number): number {
    const [first, last] = this.domain;
    return this.span.left + ((drive - first) / (last - first || 1)) * this.#wide;
  }

  #y(value: number): number {
    return HEIGHT - BOTTOM - ((value - this.#low) / (this.#high - this.#low)) * (HEIGHT - BOTTOM - TOP);
  }
}

/** Round values at places, with the digits in which they differ; texts that stay are moved, since to write one takes
 * long. */
function relabel(group: SVGGElement, labels: [number, number, number][], anchor: string): void {
  while (group.childElementCount > labels.length) group.lastChild!.remove();
  for (const [k, [x, y, value]] of labels.entries()) {
    const text = number(value, 7);
    const old = group.children[k] ?? group.appendChild(svg("text", { "text-anchor": anchor }));
    const right = Math.min(x, WIDTH - halfOf(text)); // the last one is not cut
    put(old, { transform: `translate(${right.toFixed(1)} ${y.toFixed(1)})` });
    if (old.textContent !== text) old.textContent = text;
  }
}

/** A path through places in pixels, interrupted where one is unknown, and where it leaps so far, if it may; three of
 * four in nearly straight parts are left out, which moves the line by less than two tenths of a pixel. */
export function lineThrough(x: Float64Array, y: Float64Array, leap = 0): string {
  let d = "";
  let on = false;
  for (let k = 0; k < y.length; k++) {
    const here = y[k]!;
    if (leap && Math.abs(here - y[k - 1]!) > leap) on = false;
    if (Number.isNaN(here)) on = false;
    else {
      // NaN next to an end of a part: it is kept
      if (on && k % 4 && Math.abs(y[k - 1]! - 2 * here + y[k + 1]!) < FLAT) continue;
      d += `${on ? "L" : "M"}${Math.round(10 * x[k]!) / 10} ${Math.round(10 * here) / 10}`;
      on = true;
    }
  }
  return d;
}

/** Triangles at the edge where a curve goes on beyond it: one for each part, where it is farthest. */
function beyondMarks(across: Float64Array, values: Float64Array, sides: Float64Array): string {
  let d = "";
  let far = -1;
  for (const [k, side] of sides.entries()) {
    if (side && (far < 0 || side * values[k]! > side * values[far]!)) far = k;
    if (!side || side === sides[k + 1]) continue;
    d += `M${across[far]!.toFixed(1)} ${side > 0 ? TOP - 5 : HEIGHT - BOTTOM + 5}l-4 ${7 * side}h8z`;
    far = -1;
  }
  return d;
}

/** From where to where values over the drive are plotted.
 *
 * Next to limits and change points rates grow without bound: what five hundredths of the drive have at either end of
 * the values does not squash the rest. A range below `same` is rounding, and shown as one value. */
export function plotRange(
  values: Float64Array,
  same = 0,
  places = values.map((_, k) => k),
  part = PART,
): { low: number; high: number } {
  const finite = values.filter(Number.isFinite);
  let low = finite.length ? Math.min(...finite) : 0;
  let high = finite.length ? Math.max(...finite) : 1;
  const [first, last] = [places[0] ?? 0, places[places.length - 1] ?? 0];
  const even = Float64Array.from({ length: EVEN }, (_, k) =>
    valueAt(places, values, first + ((k + 0.5) / EVEN) * (last - first)),
  );
  const sorted = even.filter(Number.isFinite).sort();
  const [least, most] = [part, 1 - part].map((one) => sorted[Math.round(one * (sorted.length - 1))]!) as Pair;
  const wide = most - least;
  if (part && wide > same) {
    if (high > most + 2 * wide) high = most + wide / 2;
    if (low < least - 2 * wide) low = least - wide / 2;
  }
  if (high - low <= Math.max(same, ONE * Math.max(high, -low))) [low, high] = [low - 1, high + 1];
  return { low, high };
}

/** The value between two places, on the straight line through both; values may begin anew after a turn. */
export function valueAt(places: Float64Array, values: Float64Array, place: number, turn = 0): number {
  let [low, high] = [0, places.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (places[middle]! <= place) low = middle;
    else high = middle;
  }
  const width = places[high]! - places[low]!;
  const part = width > 0 ? Math.max(0, Math.min(1, (place - places[low]!) / width)) : 0;
  const step = values[high]! - values[low]!;
  const value = values[low]! + (part !== 0 ? part * (turn ? step - turn * Math.round(step / turn) : step) : 0);
  return turn ? value - turn * Math.floor(value / turn) : value;
}

/** About so many round values in a range: multiples of 1, 2 or 5 times a power of ten. */
export function roundValues(low: number, high: number, count: number): number[] {
  return multiples(gridStep((high - low) / (count + 1.5)), low, high);
}

function multiples(step: number, low: number, high: number): number[] {
  const first = Math.ceil(low / step - 1e-6);
  const count = Math.floor(high / step + 1e-6) - first + 1;
  return Array.from({ length: Math.max(0, count) }, (_, k) => (first + k) * step);
}

/** Angles in degrees that divide a circle, if there are two of them at least. */
export function degreeValues(low: number, high: number, count: number): number[] {
  const wide = high - low;
  return wide < 60 ? roundValues(low, high, count) : multiples(degreeStep(wide / 5), low, high);
}
