/** What a file holds: the library reads every format, a page alone its own mechanism in JSON. */

import { h } from "./dom";
import type { Drawing } from "./drawing";
import { drawingFrom } from "./kept";
import { t } from "./language";
import type { LinkageDocument, Model } from "./model";
import { base64Of } from "./packed";
import { isOf } from "./sharing";
import type { Page } from "./view";

const LARGEST = 280_000; // bytes: in base64 they fit into a message

interface Content {
  /** The mechanism that is shown, with other sizes. */
  document?: LinkageDocument;
  model?: Model;
  drawing?: Drawing;
  text?: string;
  points?: [number, number][];
  closed?: boolean;
  /** Of each point its place in the order; null at any time. */
  order?: (number | null)[];
  note?: string;
}

/** What a file holds; it is said while it is read, and why it cannot be. */
export async function contentOf(file: File, page: Page): Promise<Content | null> {
  page.say(t("Opening {name} …", { name: file.name }), "done", h("progress", { "aria-hidden": "true" }));
  try {
    const found = await read(file, page);
    page.say("");
    return found;
  } catch (error) {
    page.say((error as Error).message);
    return null;
  }
}

async function read(file: File, page: Page): Promise<Content> {
  if (file.size > LARGEST) throw new Error(t("The file {name} is too large for the page.", { name: file.name }));
  const drawing = /\.json$/i.test(file.name) && page.served ? drawingFrom(await file.text()) : null;
  if (drawing) return { drawing };
  if (page.served) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const base64 = base64Of(bytes);
    return page.ask<Content>("open_file", { name: file.name.slice(-200), base64 });
  }
  const document = jsonOf(await file.text());
  if (document?.reference_pose && isOf(page.shown, document)) return { document };
  throw new Error(t("This page alone opens its own mechanism as JSON. Others: gruebler explore FILE"));
}

/** Open what is dropped on the page. */
export function takeDropped(page: HTMLElement, open: (file: File | undefined) => void): void {
  page.addEventListener("dragover", (event) => event.preventDefault());
  page.addEventListener("drop", (event) => {
    event.preventDefault();
    open(event.dataTransfer?.files[0]);
  });
}

function jsonOf(text: string): LinkageDocument | null {
  try {
    return JSON.parse(text) as LinkageDocument;
  } catch {
    return null;
  }
}
