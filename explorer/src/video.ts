/** A film of the moving linkage: pictures made beforehand, then played into a recorder at their times. */

import { h } from "./dom";

export const FRAMES = 25; // a second
const TYPES = ["video/webm;codecs=vp9", "video/webm", "video/mp4"];

/** The kind of film that this browser records, if any. */
export function filmType(): string | undefined {
  return globalThis.MediaRecorder ? TYPES.find((type) => MediaRecorder.isTypeSupported(type)) : undefined;
}

export async function imageOf(file: string): Promise<HTMLImageElement> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(file)}`;
  await image.decode();
  return image;
}

/** Record pictures in SVG, `width` pixels wide; the length in seconds is that of their count. */
export async function film(pictures: Iterable<string>, width: number, type: string): Promise<Blob> {
  const images: HTMLImageElement[] = [];
  for (const picture of pictures) images.push(await imageOf(picture));
  const { naturalWidth, naturalHeight } = images[0]!;
  // encoders want even numbers
  const height = 2 * Math.round((width * naturalHeight) / naturalWidth / 2);
  const canvas = h("canvas", { width, height });
  const pen = canvas.getContext("2d")!;
  const draw = (frame: number) => pen.drawImage(images[frame]!, 0, 0, width, height);
  draw(0);
  const recorder = new MediaRecorder(canvas.captureStream(FRAMES), { mimeType: type, videoBitsPerSecond: 6e6 });
  const pieces: Blob[] = [];
  recorder.ondataavailable = ({ data }) => pieces.push(data);
  const done = new Promise<void>((resolve, reject) => {
    recorder.onstop = () => resolve();
    recorder.onerror = () => reject(new Error("MediaRecorder"));
  });
  const started = new Promise((resolve) => recorder.addEventListener("start", resolve));
  recorder.start();
  await started; // on a busy machine that takes a while, and a short film would be over
  const start = performance.now();
  for (;;) {
    const frame = Math.floor(((performance.now() - start) / 1000) * FRAMES);
    if (frame >= images.length) break;
    draw(frame);
    await new Promise((resolve) => setTimeout(resolve, 500 / FRAMES));
  }
  recorder.stop();
  await done;
  return new Blob(pieces, { type });
}
