/** The keys of the page, where no field keeps them for itself. */

import type { MotionView } from "./motion";
import type { View } from "./view";

/** The page as its keys know it. */
export interface Keyed {
  readonly motion: MotionView;
  /** The view that is shown. */
  readonly here: View;
  /** Whose changes are undone. */
  readonly undoing: Pick<View, "undoable" | "undo" | "redo">;
  save(): void;
  showKeys(): void;
}

/** Listen to keys: a page of its own everywhere, a cell of a notebook to itself. */
export function listenToKeys(page: () => Keyed, cell: HTMLElement | null): void {
  const answer = (done: typeof saved) => (event: Event) => {
    if (done(event as KeyboardEvent, page())) event.preventDefault();
  };
  (cell ?? document).addEventListener("keydown", answer(pressed));
  // before a field that keeps its keys for itself
  if (!cell) document.addEventListener("keydown", answer(saved), true);
}

/** Save if keys ask for it, which a browser would do with the page; whether they do. */
function saved(event: KeyboardEvent, { save }: Keyed): boolean {
  const asked = (event.ctrlKey || event.metaKey) && event.key === "s";
  if (asked) save();
  return asked;
}

/** Do what any other key does; whether it does anything. */
function pressed(event: KeyboardEvent, { here, motion, showKeys, undoing }: Keyed): boolean {
  const target = event.composedPath()[0] as HTMLElement;
  const key = event.key.toLowerCase();
  const ctrl = event.ctrlKey || event.metaKey;
  if (ctrl && key === "z" && motion.stage.cancelDrag()) return true;
  if (key === "escape" && here === motion && motion.escape()) return true;
  if (target.matches("input:not([type=range], [type=checkbox]), textarea, select, dialog *")) return false;
  if (ctrl) {
    if (key === "y" || (key === "z" && event.shiftKey)) undoing.redo?.();
    else if (key === "z") undoing.undo?.();
    else return false;
    return true;
  }
  if (key !== "?") return here.press?.(event, target) ?? false;
  showKeys();
  return true;
}
