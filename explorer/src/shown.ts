/** What of a linkage is shown, and in which colours. */

import type { Arrow } from "./forces";
import type { Linkage } from "./linkage";
import type { Spring } from "./model";

export interface Shown {
  curves: boolean;
  velocities: boolean;
  accelerations: boolean;
  hodographs: boolean;
  poles: boolean;
  inflection: boolean;
  labels: boolean;
  grid: boolean;
  /** Whether what is dragged stops in line with others, at round angles and lengths. */
  snap: boolean;
  /** The link whose poles are shown. */
  link: number;
  /** Whether the way of the output is drawn, from where it is measured. */
  way: boolean;
  /** The link that a click chose. */
  chosen: number | null;
  /** Where the drive is, or at another value of it. */
  forces: (drive?: number) => Arrow[];
  springs: (linkage: Linkage) => readonly Spring[];
}

const PALETTE = ["--motion", "--accent", "--green", "--purple"] as const;

/** The colour of a point and its curve, as a variable of the style sheet. */
export function ownColour(point: number): string {
  return PALETTE[point % PALETTE.length]!;
}

/** What is shown of a linkage before somebody chooses. */
export const AT_FIRST: Omit<Shown, "forces" | "springs"> = {
  curves: true,
  velocities: false,
  accelerations: false,
  hodographs: false,
  poles: false,
  inflection: false,
  labels: true,
  grid: true,
  snap: false,
  link: 0,
  way: false,
  chosen: null,
};
