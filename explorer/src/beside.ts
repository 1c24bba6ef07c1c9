/** What a document keeps for the page alone, under its key `page`: what it was designed for, a
 * picture behind it, what stays while joints are dragged. */

import type { Backdrop } from "./backdrop";
import type { LinkageDocument, Target } from "./model";

/** A joint that stays, or the length or direction from one joint of a link to another that does; all by their names. */
export type Lock = readonly ["joint", string] | readonly ["length" | "direction", string, string, string];

/** It is not changed but replaced, so that it can be undone. */
export interface Beside {
  readonly targets?: readonly Target[];
  readonly picture?: Backdrop;
  readonly locks?: readonly Lock[];
}

/** What a document keeps, as far as it is what the page writes. */
export function besideOf({ page }: LinkageDocument): Beside {
  const numbers = (row: unknown, ...counts: number[]) =>
    Array.isArray(row) && counts.includes(row.length) && row.every((one) => Number.isFinite(one));
  const { locks, picture, targets } = (page ?? {}) as {
    locks?: unknown;
    picture?: Partial<Backdrop>;
    targets?: unknown;
  };
  const all = Array.isArray(targets) && targets.length && targets.every((row) => numbers(row, 2, 3));
  const shown = /^data:image\/\w+;/.test(`${picture?.href}`) && numbers([...(picture?.at ?? []), picture?.high], 5);
  const kept = Array.isArray(locks) ? locks.filter(isLock) : [];
  return {
    ...(all && { targets }),
    ...(shown && { picture: picture as Backdrop }),
    ...(kept.length && { locks: kept }),
  };
}

function isLock(row: unknown): row is Lock {
  if (!Array.isArray(row) || !row.every((one) => typeof one === "string")) return false;
  return row.length === 2 ? row[0] === "joint" : row.length === 4 && /^(length|direction)$/.test(row[0]!);
}
