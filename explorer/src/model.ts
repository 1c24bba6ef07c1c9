/** What Python says of a linkage (`gruebler.page.model.model_of`). */

import type { ProgramRecord } from "./program";
import type { Pair } from "./rows";

export interface ElementRecord {
  joint: number;
  link: number;
  kind: "pin" | "line" | "round";
  at: [number, number];
  angle: number;
}

export interface DriveRecord {
  name: string;
  turning: boolean;
  joint: number;
}

export interface PointRecord {
  name: string;
  link: number;
  at: [number, number];
}

/** Link, point, direction, number of the plan's element (-1: none). */
export type Place = [number, number, number, number, number, number];

/** A link that pushes another: across a slide, or from one pin along the line to the other. */
export interface Leg {
  /** What pushes: a link, or a body of several. */
  links: number[];
  from: Place;
  across: boolean;
  /** Whether it is a cam: the end that is not on its follower is its axis. */
  cam: boolean;
  pin: Place;
  pushed: number;
  /** The joint by which the link that is pushed hangs on the frame, if it is one. */
  guide: { slides: boolean; at: Place } | null;
}

export interface OutputRecord {
  link: number;
  joint: number | null;
  legs: Leg[];
  /** Whether crank and coupler lie in line where it turns back. */
  inLine?: boolean;
  /** Places that are marked in its plot: the drive in radians, the output in degrees, as they are plotted. */
  marks?: Pair[];
  note: Record<string, string>;
}

export interface ShapeRecord {
  link: number;
  style: string;
  circle?: [number, number, number];
  lines?: number[][];
  closed?: boolean;
  /** Of a belt: where the centres of its wheels were; its lines go with them. */
  between?: [number, number, number, number];
}

export interface GroupRecord {
  dyad: boolean;
  number: number;
  form: string;
  links: string[];
  modes: boolean;
}

export type LinkageDocument = Record<string, unknown> & {
  joints?: string;
  elements?: Record<string, Record<string, unknown>>;
  points?: Record<string, { link: string; at: number[] }>;
  reference_pose?: Record<string, unknown>;
  /** What the library keeps for the page (beside.ts). */
  page?: unknown;
  /** The former name of reference_pose: links that were copied before. */
  home?: Record<string, unknown>;
};

/** What a pair is, and the freedoms that it leaves in the plane: to turn, along its line, across it. */
export interface PairRecord {
  turning: boolean;
  sliding: boolean;
  contours: boolean;
  free: { turn: boolean; along: boolean; across: boolean };
}

/** A place that is to be met; of a position its angle in degrees, too. */
export type Target = [number, number, number?];

/** A link and a place there. */
export type End = [link: number, x: number, y: number];

/** A spring or damper as the library knows it: angles in radians; of a torsion spring the places of its ends say
 * nothing. */
export interface Spring {
  turning: boolean;
  ends: [End, End];
  stiffness: number;
  /** The length or angle at which only the preload acts. */
  free: number;
  preload: number;
  damping: number;
  /** The number of a spring of the library that has a law of its own, such as that of a gas. */
  known: number | null;
}

export interface Model {
  version: number;
  name: string;
  /** Whether it moves from the start. */
  plays?: boolean;
  /** Whether it has other sizes than what its name and its source stand for. */
  changed?: boolean;
  /** The name in several languages, if it has such. */
  names: Record<string, string>;
  source: string;
  document: LinkageDocument;
  links: string[];
  /** The names of the links of the linkage by languages. */
  linkNames: Record<string, string[]>;
  /** The names of points that are words, by languages. */
  pointNames?: Record<string, Record<string, string>>;
  own: number;
  frame: number;
  unit: string;
  /** Of a slide the link that is its guide, and half the length and half the width of a block with an outline. */
  joints: { name: string; pair: PairRecord; links: number[]; guide?: number; sliding?: [number, number] }[];
  /** How far the bearings of joints are turned from standing below, in degrees. */
  bearings: number[];
  elements: ElementRecord[];
  points: PointRecord[];
  drives: DriveRecord[];
  program: ProgramRecord;
  sources: number[];
  reference: { drives: number[][]; bodies: number[][]; windings: number[][] };
  groups: GroupRecord[];
  shortest: [number, number][];
  released: number[];
  start: { drives: number[]; signs: number[]; unknowns: number[] };
  /** Where it is used: between two values of its drive, or between the stops of each of several. */
  span: { turns: number; between: Pair | null; stops?: (Pair | null)[] };
  outputs: OutputRecord[];
  shapes: ShapeRecord[];
  /** Those that act on it as it was opened. */
  springs?: Spring[];
}

/** The chain of a linkage as text, with its frame and its drives. */
export function chainText(model: Model): string {
  const drives = model.drives.map((drive) => `; drive=${drive.name}`).join("");
  return `${String(model.document.joints)}; frame=${model.links[model.frame]}${drives}`;
}
