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
}

/** The heads of a place. */
export const PLACE = ["x [mm]", "y [mm]"];

export function wordsOf(kind: Kind): TaskWords {
  const words: Record<Kind, TaskWords> = {
    points: {
      name: t("Points"),
      hint: t(
        "Place points in the order in which a coupler point passes them: up to nine are met exactly if possible.",
      ),
      row: t("Point"),
      heads: PLACE,
    },
    positions: {
      name: t("Positions"),
      hint: t("Place three to five positions of the coupler; drag the end of an arrow to turn one."),
      row: t("Position"),
      heads: [...PLACE, "φ [°]"],
    },
    function: {
      name: t("Angles"),
      hint: t(
        "Pairs of angles that drive and output turn through together: " +
          "three to five are met exactly if possible, more only approximately.",
      ),
      row: t("Pair"),
      heads: [t("Drive [°]"), t("Output [°]")],
    },
    "dead-centres": {
      name: t("Dead centres"),
      hint: t("A crank drives a rocker; time ratio: slow stroke / quick stroke."),
      row: t("Dead centres"),
      heads: [t("Swing [°]"), t("Time ratio")],
    },
  };
  return words[kind];
}
