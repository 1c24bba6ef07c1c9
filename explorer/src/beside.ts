/** What a document keeps for the page alone, under its key `page`: what it was designed for, a
 * picture behind it, what stays while joints are dragged, what is measured. */

import type { Backdrop } from "./backdrop";
import type { LinkageDocument, Target } from "./model";

/** A joint that stays, or the length or direction from one joint of a link to another that does; all by their names. */
export type Lock = readonly ["joint", string] | readonly ["length" | "direction", string, string, string];

/** The ends of a measurement line, by their names. */
export type Ruler = readonly [string, string];

/** It is not changed but replaced, so that it can be undone. */
export interface Beside {
  readonly targets?: readonly Target[];
  readonly picture?: Backdrop;
  readonly locks?: readonly Lock[];
  readonly rulers?: readonly Ruler[];
  /** What joints are called where they were drawn, in the order of the linkage, spaces between. */
  readonly letters?: string;
  /** Pairs of angles that were asked for, which the library reads and marks. */
  readonly pairs?: unknown;
  /** The links whose masses lie along their bars, which the library reads; or all are of steel. */
  readonly bars?: unknown;
  /** The drive turns clockwise to meet the targets in their order. */
  readonly backward?: boolean;
}

/** The way in which a drive begins. */
export function wayOf({ backward }: Beside = {}): number {
  return backward ? -1 : 1;
}

/** What a document keeps, as far as it is what the page writes. */
export function besideOf({ page }: LinkageDocument): Beside {
  const numbers = (row: unknown, ...counts: number[]) =>
    Array.isArray(row) && counts.includes(row.length) && row.every((one) => Number.isFinite(one));
  const { backward, bars, letters, locks, pairs, picture, rulers, targets } = (page ?? {}) as {
    backward?: unknown;
    bars?: unknown;
    pairs?: unknown;
    letters?: unknown;
    locks?: unknown;
    rulers?: unknown;
    picture?: Partial<Backdrop>;
    targets?: unknown;
  };
  const all = Array.isArray(targets) && targets.length && targets.every((row) => numbers(row, 2, 3));
  const shown = /^data:image\/\w+;/.test(`${picture?.href}`) && numbers([...(picture?.at ?? []), picture?.high], 5);
  const kept = Array.isArray(locks) ? locks.filter(isLock) : [];
  const measured = Array.isArray(rulers) ? rulers.filter((row) => areTexts(row) && row.length === 2) : [];
  return {
    ...(all && { targets }),
    ...(shown && { picture: picture as Backdrop }),
    ...(kept.length && { locks: kept }),
    ...(measured.length && { rulers: measured }),
    ...(!!pairs && { pairs }),
    ...(!!bars && { bars }),
    ...(backward === true && { backward }),
    ...(typeof letters === "string" && { letters }),
  };
}

function isLock(row: unknown): row is Lock {
  if (!areTexts(row)) return false;
  return row.length === 2 ? row[0] === "joint" : row.length === 4 && /^(length|direction)$/.test(row[0]!);
}

function areTexts(row: unknown): row is string[] {
  return Array.isArray(row) && row.every((one) => typeof one === "string");
}
