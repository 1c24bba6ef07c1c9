/** Questions that take time. */

import { h } from "./dom";
import { Cancelled, type Request } from "./host";
import { t } from "./language";

/** Ask, and show at a place how far it is, with a button that gives it up.
 *
 * Returns the answer; or null, and why there is none stands at the place. */
export async function awaited<Result>(
  place: HTMLElement,
  ask: (progress: (text: string) => void) => Request<Result>,
): Promise<Result | null> {
  const bar = h("span", {}, "…");
  const request = ask((text) => (bar.textContent = text));
  const cancel = h("button", { class: "plain", "data-act": "cancel", onclick: () => request.cancel() }, t("Cancel"));
  place.replaceChildren(h("progress", {}), bar, cancel);
  try {
    const found = await request;
    place.replaceChildren();
    return found;
  } catch (error) {
    const text = error instanceof Cancelled ? t("Cancelled.") : (error as Error).message;
    place.replaceChildren(h("span", { class: "error", role: "alert" }, text));
    return null;
  }
}
