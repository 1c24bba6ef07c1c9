/** What a link carries, and how it is made and read. */

import { h } from "./dom";
import type { Backend } from "./host";
import { t } from "./language";
import { unpacked } from "./link";
import type { LinkageDocument, Model } from "./model";
import type { MotionView } from "./motion";
import type { Page } from "./view";

export interface Shared {
  document: LinkageDocument;
  name: string;
  /** Its name in other languages, if it has them. */
  names?: Model["names"];
  source: string;
  drive: number;
  /** Whether it has other sizes than what its name and its source stand for. */
  changed?: boolean;
  /** How it moves, in links of a static site, where nobody finds it out of the document. */
  model?: Model;
}

/** That a link is of another mechanism than can be shown here. */
function another(): Error {
  return new Error(t("This address holds another mechanism. Open it with: gruebler explore LINK"));
}

/** Whether a document is of the mechanism of a model, with whatever sizes. */
export function isOf(model: Model, document: LinkageDocument): boolean {
  const same = (key: string) => JSON.stringify(model.document[key]) === JSON.stringify(document[key]);
  const rounds = ({ elements }: LinkageDocument) =>
    JSON.stringify(elements, (key, value) => (/^\d+$|^at$/.test(key) ? 0 : value));
  return ["joints", "frame", "drives", "links"].every(same) && rounds(model.document) === rounds(document);
}

export function sharedOf(motion: MotionView, withModel: boolean): Shared {
  const { active, drives, model } = motion.linkage;
  const { name, names, source } = model;
  const document = motion.document();
  const whole = withModel && !source ? { model: { ...model, document: {} } } : {};
  return { document, name, names, source, drive: drives[active] ?? 0, changed: motion.changed, ...whole };
}

/** What the text behind # carries; an error if it is none. */
export async function unshared(text: string): Promise<Shared> {
  const shared = (await unpacked(text)) as Shared;
  if (typeof shared?.document?.joints !== "string") throw new Error(t("This address holds no mechanism."));
  return shared;
}

/** The model of what a link carries: from the library, from the link itself, or from the machine of its name. */
async function modelOf({ document, name, names = {}, source, model }: Shared, page: Page): Promise<Model> {
  if (page.served) return { ...(await page.ask<Model>("open_document", { document, name, source })), names };
  const found = model ? { ...model, document } : await page.ask<Model>("open", { id: source });
  if (!isOf(found, document)) throw another();
  return found;
}

/** Take what a link carries: other sizes of the linkage at hand, or another linkage; whether it is one. */
export async function openShared(
  shared: Shared,
  page: Page & { backend: Backend; motion: MotionView },
): Promise<boolean> {
  const { document, drive, name, changed = false } = shared;
  const { backend, motion, shown, served } = page;
  const other = !isOf(shown, document) || (shown.name !== name && backend.present);
  if (other) {
    if (!backend.present) throw another();
    motion.open({ ...(await modelOf(shared, page)), changed });
  }
  if (!other || !served) motion.openDocument(document, drive);
  return other;
}

/** Put an address into the clipboard; where that is not allowed it is shown. */
export async function shareLink(page: Page, address: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(address);
    const where = page.served && address.includes("://") ? t("Others open it by: gruebler explore LINK") : "";
    page.say(`${t("The link is copied; it holds the mechanism.")} ${where}`, "done");
  } catch {
    const field = h("input", {
      value: address,
      readonly: true,
      "aria-label": t("Copy the link"),
      onfocus: () => field.select(),
    });
    page.say(t("Copy this link:"), "done", field);
    field.focus();
  }
}
