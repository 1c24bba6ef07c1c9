/** Why a change of sizes is refused. */

import type { Stop } from "./cycle";

/** Why a change was refused. */
export class Refused extends Error {
  constructor(
    readonly stop: Stop | null,
    /** Why not, where nothing stops: joints of a link meet, or what is kept does not allow it. */
    readonly reason: "" | "near" | "kept" = "",
  ) {
    super("refused");
  }
}
