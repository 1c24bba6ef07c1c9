/** Which part of the plane the picture shows: pixels and places. */

import type { Pair } from "./rows";

/** A rectangle of the plane. */
export interface Box {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** The rectangle about places that are added one by one. */
export class Extent implements Box {
  /** The upper right corners of all of them. */
  readonly places: Pair[] = [];
  left = Infinity;
  right = -Infinity;
  bottom = Infinity;
  top = -Infinity;

  /** A place, with some room about it; it may be nowhere. */
  add([x, y]: Pair, room = 0): void {
    if (!Number.isFinite(x + y)) return;
    this.left = Math.min(this.left, x - room);
    this.right = Math.max(this.right, x + room);
    this.bottom = Math.min(this.bottom, y - room);
    this.top = Math.max(this.top, y + room);
    this.places.push([x + room, y + room]);
  }
}

const BESIDE = 56; // from the right edge of the picture to the left one of these
const ROW = [62, 208] as const; // how low buttons in a row reach, and how far from the right edge
const LOW = 300; // pixels of a picture with one button only
const LARGER = 1.03; // a picture by so much is worth a row of them

export class Viewport {
  /** In pixels. */
  width = 1;
  height = 1;
  /** Pixels a unit of length. */
  scale = 1;
  /** Whether it shows everything, and goes on doing so in another size. */
  fitted = true;
  /** Pixels down to where the buttons over it end. */
  lowest = 218;
  /** Whether they stand in a row, and whether they may on a phone. */
  row = false;
  rows = false;
  #ox = 0;
  #oy = 0;

  /** Whether it is that of a phone, whose buttons and numbers take room from it. */
  get narrow(): boolean {
    return this.width < 500;
  }

  /** Where the buttons over the picture end; a low one has one only. */
  get tools(): number {
    if (this.row) return ROW[0];
    return this.height < 2 * this.lowest ? 72 : this.lowest;
  }

  /** From the left edge of these to the right one of the picture. */
  get beside(): number {
    return this.row && this.height > LOW ? ROW[1] : BESIDE;
  }

  /** The right edge of the picture, or the left one of these. */
  right(y: number): number {
    return this.width - (y < this.tools ? this.beside : 0);
  }

  /** The pixel of a place. */
  screen(x: number, y: number): Pair {
    return [this.#ox + this.scale * x, this.#oy - this.scale * y];
  }

  /** The place of a pixel. */
  world(x: number, y: number): Pair {
    return [(x - this.#ox) / this.scale, (this.#oy - y) / this.scale];
  }

  /** Show a rectangle, or at least a square of that width; what lies below, so many pixels high, is left out. It
   * may reach below the buttons if none of the places there does. */
  fit(
    { left, right, bottom, top }: Box,
    least: number,
    below?: number,
    places?: readonly Pair[],
    room = this.height > LOW ? 34 : 22,
  ): void {
    const { narrow } = this;
    const margin = narrow ? room : 60;
    const rule = narrow ? 22 : 0; // the numbers on the left
    const said = this.height > LOW ? margin : 12; // what can be done, or a bearing above the numbers
    const foot = below ?? (narrow ? said : 0);
    const wide = Math.max(right - left, least);
    const high = Math.max(top - bottom, least);
    /** Whether all is clear of the buttons, in a row or not, with room beside them (1), below them (2) or not (0). */
    const lies = (row: boolean, where: number): boolean => {
      this.row = row;
      const keys = where === 1 ? this.beside : 0;
      const above = where === 2 ? this.tools : 0;
      const across = (this.width - 2 * margin - keys - rule) / wide;
      this.scale = Math.min(across, (this.height - 2 * margin - above - foot) / high);
      this.#ox = (this.width - keys + rule) / 2 - (this.scale * (left + right)) / 2;
      this.#oy = (this.height - foot + above) / 2 + (this.scale * (bottom + top)) / 2;
      return !!places?.every(([x, y]) => !this.#under(...this.screen(x, y)));
    };
    let best = 0;
    let chosen: [boolean, number] = [false, +(narrow || !!places)];
    for (const row of narrow && this.rows ? [false, true] : [false])
      for (const where of [0, 1, 2])
        if (lies(row, where) && this.scale > LARGER * best) [best, chosen] = [this.scale, [row, where]];
    lies(...chosen);
    this.fitted = true;
  }

  /** Whether it lies under a button, or near one. */
  #under(x: number, y: number): boolean {
    return x > this.right(y - 8) - 8;
  }

  /** Enlarge by a factor; the pixel stays where it is. */
  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    this.#ox = x + (this.#ox - x) * factor;
    this.#oy = y + (this.#oy - y) * factor;
    this.scale *= factor;
    this.fitted = false;
  }

  /** Shift by pixels. */
  pan(dx: number, dy: number): void {
    this.#ox += dx;
    this.#oy += dy;
    this.fitted = false;
  }
}
