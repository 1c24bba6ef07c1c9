/** What a document keeps for the page alone, under its key `page`: what the linkage was designed for. */

import type { LinkageDocument, Target } from "./model";

/** It is not changed but replaced, so that it can be undone. */
export interface Beside {
  readonly targets?: readonly Target[];
}

/** What a document keeps, as far as it is what the page writes. */
export function besideOf({ page }: LinkageDocument): Beside {
  const numbers = (row: unknown) =>
    Array.isArray(row) && (row.length === 2 || row.length === 3) && row.every((one) => Number.isFinite(one));
  const { targets } = (page ?? {}) as { targets?: unknown };
  return Array.isArray(targets) && targets.length && targets.every(numbers) ? { targets } : {};
}
