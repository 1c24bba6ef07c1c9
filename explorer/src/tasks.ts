/** The tasks of the synthesis: what each kind asks for, in the language of the page. */

import { t } from "./language";

export type Kind = "positions" | "points" | "function" | "dead-centres";

/** How many rows each kind has at least. */
export const FEWEST: Record<Kind, number> = { positions: 3, points: 5, function: 3, "dead-centres": 1 };

interface TaskWords {
  name: string;
  hint: string;
  /** What a row is called, and its numbers. */
  row: string;
  heads: string[];
  /** The name of a linkage for so many rows. */
  design: string;
}

export function wordsOf(kind: Kind, count = 0): TaskWords {
  const words: Record<Kind, TaskWords> = {
    points: {
      name: t("Points"),
      hint: t(
        "Put points in the order in which a coupler point passes them. " +
          "Five to nine are met exactly if possible, more as closely as possible.",
      ),
      row: t("Point"),
      heads: ["x", "y"],
      design: t("A design for {count} points", { count }),
    },
    positions: {
      name: t("Positions"),
      hint: t("Put three to five positions of the coupler; drag the end of an arrow to turn one."),
      row: t("Position"),
      heads: ["x", "y", "φ [°]"],
      design: t("A design for {count} positions", { count }),
    },
    function: {
      name: t("Angles"),
      hint: t("Three to five pairs of angles that crank and rocker turn through together."),
      row: t("Pair"),
      heads: [t("Crank [°]"), t("Rocker [°]")],
      design: t("A design for {count} pairs of angles", { count }),
    },
    "dead-centres": {
      name: t("Dead centres"),
      hint: t("A crank drives a rocker to and fro: its swing, and the slow time by the quick one."),
      row: t("Dead centres"),
      heads: [t("Swing [°]"), t("Time ratio")],
      design: t("A design for dead centres"),
    },
  };
  return words[kind];
}
