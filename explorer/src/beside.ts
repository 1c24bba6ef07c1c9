/** What a document keeps for the page alone, under its key `page`: what it was designed for, a
 * picture behind it. */

import type { Backdrop } from "./backdrop";
import type { LinkageDocument, Target } from "./model";

/** It is not changed but replaced, so that it can be undone. */
export interface Beside {
  readonly targets?: readonly Target[];
  readonly picture?: Backdrop;
}

/** What a document keeps, as far as it is what the page writes. */
export function besideOf({ page }: LinkageDocument): Beside {
  const numbers = (row: unknown, ...counts: number[]) =>
    Array.isArray(row) && counts.includes(row.length) && row.every((one) => Number.isFinite(one));
  const { picture, targets } = (page ?? {}) as { picture?: Partial<Backdrop>; targets?: unknown };
  const all = Array.isArray(targets) && targets.length && targets.every((row) => numbers(row, 2, 3));
  const shown = /^data:image\/\w+;/.test(`${picture?.href}`) && numbers([...(picture?.at ?? []), picture?.high], 5);
  return { ...(all && { targets }), ...(shown && { picture: picture as Backdrop }) };
}
