/** What takes time. */

import { action, h, renew, unbroken } from "./dom";
import { Cancelled, type Request } from "./host";
import { t } from "./language";

/** That something is under way, where it will stand. */
export function moment(): HTMLElement {
  return h(
    "p.note",
    { role: "status", "data-waiting": "" },
    h("progress", { "aria-hidden": "true" }),
    unbroken(t("One moment …"), / /g),
  );
}

/** Ask, and show at a place how far it is, also as a bar where it counts, with a button that gives it up.
 *
 * Returns the answer; or null, and why there is none stands at the place. */
export async function awaited<Result>(
  place: HTMLElement,
  ask: (progress: (text: string) => void) => Request<Result>,
): Promise<Result | null> {
  const said = h("span", {}, t("One moment …"));
  const bar = h("progress", {});
  const request = ask((text) => {
    said.textContent = text;
    const [done, all = text.endsWith("%") && 100, more] = text.match(/\d+/g) ?? [];
    if (all && !more) Object.assign(bar, { max: all, value: done });
    else bar.removeAttribute("value");
  });
  const cancel = action("cancel", () => request.cancel(), t("Cancel"));
  renew(place, bar, said, " ", cancel);
  try {
    const found = await request;
    renew(place);
    return found;
  } catch (error) {
    const text = error instanceof Cancelled ? t("Cancelled.") : (error as Error).message;
    renew(place, h("span.error", { role: "alert" }, text));
    return null;
  }
}

/** After the browser has drawn; a page that nobody sees is not drawn. */
export function drawn(): Promise<void> {
  return new Promise((go) => {
    requestAnimationFrame(() => setTimeout(go));
    setTimeout(go, 100);
  });
}

/** Do all pieces of a work at once. */
export function whole(pieces: Generator<void>): void {
  while (!pieces.next().done);
}
