/** A picture behind the plane: read from a file, made small, put where it is wanted. */

import { h, svg } from "./dom";
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

/** A picture out of a file, in the middle of a plane so wide. */
export async function backdropOf(file: File, wide: number, middle: readonly number[]): Promise<Backdrop> {
  const image = await createImageBitmap(file);
  for (let width = Math.min(image.width, WIDEST); ; width *= 0.8) {
    const high = image.height / image.width;
    const canvas = h("canvas", { width: Math.ceil(width), height: Math.ceil(width * high) });
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    const href = canvas.toDataURL("image/webp", 0.7);
    if (href.length < LONGEST) return { href, high, at: [...middle, wide, 0] };
  }
}

/** The picture, half transparent, as a viewport shows it. */
export function backdropElement({ at, high, href }: Backdrop): SVGImageElement {
  const [, , wide] = at as [number, number, number];
  const [x, y] = [-wide / 2, (-wide * high) / 2];
  return svg("image.backdrop", { href, x, y, width: wide, height: wide * high, opacity: 0.5 });
}

/** Put it where a viewport has it. */
export function putBackdrop(element: SVGElement, { at }: Backdrop, viewport: Viewport): void {
  const [x, y, , turned] = at as [number, number, number, number];
  const [u, v] = viewport.screen(x, y);
  element.setAttribute("transform", `translate(${u} ${v}) scale(${viewport.scale}) rotate(${-turned})`);
}
