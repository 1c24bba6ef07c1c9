/** Small plots over the drive, linked with it by a cursor. */

import { svg } from "./dom";
import { number } from "./language";

export interface Series {
  title: string;
  values: Float64Array;
  colour: string;
  /** Below this value the ground is shaded. */
  floor?: number;
}

const WIDTH = 300;
const HEIGHT = 128;
const LEFT = 44;
const RIGHT = 8;
const TOP = 20;
const BOTTOM = 18;
const FLAT = 0.1; // pixels: the second difference below which a line is nearly straight

export class Plot {
  readonly element = svg("svg", {
    class: "plot",
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    role: "img",
    preserveAspectRatio: "none",
  });
  private readonly curve = svg("path", { class: "curve" });
  private readonly band = svg("rect", { class: "band", x: LEFT, width: WIDTH - LEFT - RIGHT, height: 0 });
  private readonly zero = svg("path", { class: "axis" });
  private readonly cursor = svg("path", { class: "cursor" });
  private readonly here = svg("circle", { class: "here", r: 3 });
  private readonly title = svg("text", { class: "title", x: LEFT, y: 13 });
  private readonly texts = [0, 1, 2, 3].map(() => svg("text"));
  private drives: Float64Array = new Float64Array(0);
  private domain: [number, number] = [0, 1];
  private series: Series | null = null;
  private low = 0;
  private high = 1;

  constructor(
    private readonly unit: number,
    pick: (drive: number) => void,
  ) {
    const frame = svg("path", {
      class: "axis",
      d: `M${LEFT} ${TOP}V${HEIGHT - BOTTOM}H${WIDTH - RIGHT}`,
      fill: "none",
    });
    this.element.append(this.band, frame, this.zero, this.curve, this.cursor, this.here, this.title, ...this.texts);
    const at = (event: MouseEvent) => {
      const box = this.element.getBoundingClientRect();
      const part = (((event.clientX - box.left) / box.width) * WIDTH - LEFT) / (WIDTH - LEFT - RIGHT);
      const [first, last] = this.domain;
      pick(first + Math.max(0, Math.min(1, part)) * (last - first));
    };
    // a finger that goes up or down scrolls the page; one that taps or goes sideways picks
    let [startX, startY] = [0, 0];
    this.element.addEventListener("pointerdown", (event) => {
      [startX, startY] = [event.clientX, event.clientY];
      if (event.pointerType === "touch") return;
      this.element.setPointerCapture(event.pointerId);
      at(event);
    });
    this.element.addEventListener("pointermove", (event) => {
      const sideways = Math.abs(event.clientX - startX) > Math.abs(event.clientY - startY);
      if (event.buttons && (sideways || event.pointerType !== "touch")) at(event);
    });
    this.element.addEventListener("click", at);
  }

  show(drives: Float64Array, series: Series, domain: [number, number]): void {
    this.drives = drives;
    this.domain = domain;
    this.series = series;
    const { low, high, wide } = plotRange(series.values);
    const room = 0.06 * (high - low);
    [this.low, this.high] = [low - room, high + room];
    const outside = (value: number) => !(value <= this.high + 10 * wide && value >= this.low - 10 * wide);
    const places = series.values.map((value) =>
      outside(value) ? NaN : Math.max(TOP - 4, Math.min(HEIGHT - BOTTOM + 4, this.y(value))),
    );
    this.curve.setAttribute(
      "d",
      lineThrough(
        drives.map((drive) => this.x(drive)),
        places,
      ),
    );
    this.curve.style.stroke = `var(${series.colour})`;
    this.zero.setAttribute(
      "d",
      this.low < 0 && this.high > 0 ? `M${LEFT} ${this.y(0).toFixed(1)}H${WIDTH - RIGHT}` : "",
    );
    const floor = series.floor;
    const shaded =
      floor === undefined ? 0 : Math.max(0, Math.min(HEIGHT - BOTTOM - TOP, HEIGHT - BOTTOM - this.y(floor)));
    this.band.setAttribute("height", shaded.toFixed(1));
    this.band.setAttribute("y", (HEIGHT - BOTTOM - shaded).toFixed(1));
    this.title.textContent = series.title;
    this.element.setAttribute("aria-label", series.title);
    const text = (k: number, x: number, y: number, anchor: string, content: string) => {
      this.texts[k]!.setAttribute("x", String(x));
      this.texts[k]!.setAttribute("y", String(y));
      this.texts[k]!.setAttribute("text-anchor", anchor);
      this.texts[k]!.textContent = content;
    };
    const rounded = (value: number) => (Math.abs(value) < 1e-9 * (high - low) ? 0 : value);
    text(0, LEFT - 4, TOP + 8, "end", number(rounded(high), 3));
    text(1, LEFT - 4, HEIGHT - BOTTOM - 1, "end", number(rounded(low), 3));
    text(2, LEFT, HEIGHT - 4, "start", number(domain[0] / this.unit, 4));
    text(3, WIDTH - RIGHT, HEIGHT - 4, "end", number(domain[1] / this.unit, 4));
  }

  at(drive: number): void {
    const { drives, series } = this;
    if (!series || drives.length < 2) return;
    let row = drives.findIndex((one) => one >= drive);
    if (row < 0) row = drives.length - 1;
    const x = this.x(drive);
    this.cursor.setAttribute("d", `M${x.toFixed(1)} ${TOP}V${HEIGHT - BOTTOM}`);
    const value = series.values[row]!;
    this.here.setAttribute("cx", x.toFixed(1));
    this.here.setAttribute(
      "cy",
      (Number.isFinite(value) ? Math.max(TOP, Math.min(HEIGHT - BOTTOM, this.y(value))) : -9).toFixed(1),
    );
  }

  private x(drive: number): number {
    const [first, last] = this.domain;
    return LEFT + ((drive - first) / (last - first || 1)) * (WIDTH - LEFT - RIGHT);
  }

  private y(value: number): number {
    return HEIGHT - BOTTOM - ((value - this.low) / (this.high - this.low)) * (HEIGHT - BOTTOM - TOP);
  }
}

/** A path through places in pixels, interrupted where one is unknown; three of four in nearly straight parts are left
 * out, which moves the line by less than two tenths of a pixel. */
export function lineThrough(x: Float64Array, y: Float64Array): string {
  let d = "";
  let on = false;
  for (let k = 0; k < y.length; k++) {
    const here = y[k]!;
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

/** From where to where values are plotted, and how wide the range of nearly all of them is.
 *
 * Next to limits rates grow without bound: the two hundredths at either end may stick out. */
export function plotRange(values: Float64Array): { low: number; high: number; wide: number } {
  const finite = values.filter((value) => Number.isFinite(value)).sort();
  let low = finite[0] ?? 0;
  let high = finite[finite.length - 1] ?? 1;
  const least = finite[Math.floor(0.02 * finite.length)] ?? low;
  const most = finite[Math.floor(0.98 * (finite.length - 1))] ?? high;
  const wide = most - least;
  if (high > most + 3 * wide) high = most + wide;
  if (low < least - 3 * wide) low = least - wide;
  if (high - low < 1e-9 * Math.max(Math.abs(high), Math.abs(low), 1e-9)) [low, high] = [low - 1, high + 1];
  return { low, high, wide };
}
