/** A picture behind the plane: read from a file, made small, put where it is wanted. */

import { DEGREE } from "./cycle";
import { h, svg } from "./dom";
import { away, toHull } from "./hull";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

export interface Backdrop {
  /** As a data address. */
  readonly href: string;
  /** Its height as a part of its width. */
  readonly high: number;
  /** Its middle, its width, and how many degrees it is turned. */
  readonly at: readonly number[];
}

const WIDEST = 1000; // pixels
const LONGEST = 120_000; // characters: it fits into a link

/** A picture out of a file, at most so wide and so high, about a place. */
export async function backdropOf(file: File, [wide, most]: Pair, middle: readonly number[]): Promise<Backdrop> {
  const image = await createImageBitmap(file);
  for (let width = Math.min(image.width, WIDEST); ; width *= 0.8) {
    const high = image.height / image.width;
    const canvas = h("canvas", { width: Math.ceil(width), height: Math.ceil(width * high) });
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    const href = canvas.toDataURL("image/webp", 0.7);
    if (href.length < LONGEST) return { href, high, at: [...middle, Math.min(wide, most / high), 0] };
  }
}

/** The picture, half transparent, as a viewport shows it. */
export function backdropElement({ at, high, href }: Backdrop): SVGImageElement {
  const [, , wide] = at as [number, number, number];
  const [x, y] = [-wide / 2, (-wide * high) / 2];
  return svg("image.backdrop", { href, x, y, width: wide, height: wide * high, opacity: 0.5 });
}

/** A place of the picture, in parts of its half width and half height from its middle. */
function placeOn({ at, high }: Backdrop, part: Pair): Pair {
  const [x, y, wide, turned] = at as [number, number, number, number];
  const [u, v] = [(part[0] * wide) / 2, (part[1] * wide * high) / 2];
  const [c, s] = [Math.cos(turned * DEGREE), Math.sin(turned * DEGREE)];
  return [x + c * u - s * v, y + s * u + c * v];
}

export function cornersOf(picture: Backdrop): Pair[] {
  const parts: Pair[] = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ];
  return parts.map((part) => placeOn(picture, part));
}

/** What is dragged to size it, and to turn it. */
export function gripsOf(picture: Backdrop): { size: Pair; turn: Pair } {
  return { size: placeOn(picture, [1, -1]), turn: placeOn(picture, [1, 0]) };
}

export type Grip = "size" | "turn" | "move";

/** What of the picture is within reach of a place; null beside it. */
export function gripAt(picture: Backdrop, place: Pair, reach: number): Grip | null {
  const near = (at: Pair) => away(at, ...place) < reach;
  const { size, turn } = gripsOf(picture);
  if (near(size)) return "size";
  if (near(turn)) return "turn";
  return toHull(cornersOf(picture), ...place) === 0 ? "move" : null;
}

/** The picture after a grip was dragged from a place to another: moved, sized about its middle, turned by whole
 * degrees. */
export function gripped(picture: Backdrop, grip: Grip, from: Pair, to: Pair): Backdrop {
  const [x, y, wide, turned] = picture.at as [number, number, number, number];
  const degrees = Math.round(Math.atan2(to[1] - y, to[0] - x) / DEGREE);
  const at = {
    move: [x + to[0] - from[0], y + to[1] - from[1], wide, turned],
    size: [x, y, Math.max(wide / 100, (wide * away(to, x, y)) / away(from, x, y)), turned],
    turn: [x, y, wide, degrees],
  };
  return { ...picture, at: at[grip] };
}

/** The picture so many times as large, with a place that stays. */
export function enlarged(picture: Backdrop, [x, y]: Pair, times: number): Backdrop {
  const [left, top, wide, turned] = picture.at as [number, number, number, number];
  return { ...picture, at: [x + times * (left - x), y + times * (top - y), times * wide, turned] };
}

/** Put it where a viewport has it. */
export function putBackdrop(element: SVGElement, { at }: Backdrop, viewport: Viewport): void {
  const [x, y, , turned] = at as [number, number, number, number];
  const [u, v] = viewport.screen(x, y);
  element.setAttribute("transform", `translate(${u} ${v}) scale(${viewport.scale}) rotate(${-turned})`);
}
