/** What Python says of a linkage in space (`gruebler.page.space_page.space_model`). */

import type { Language } from "../language";
import type { Vector } from "./algebra";
import type { Live } from "./solver";

export interface Body {
  colour: Vector;
  vertices: number[];
  triangles: number[];
}

/** A place of a link, by its coordinates in the reference pose. */
export interface Spot {
  name?: string;
  link: number;
  at: Vector;
}

export interface Motion {
  /** The number of its drive. */
  drive: number;
  round: boolean;
  unit: string;
  /** (rows) of the drive. */
  values: number[];
  /** (rows, links, 12). */
  poses: number[][][];
  /** A place and a direction of a link, about or along which another one is driven. */
  arrow: { link: number; at: Vector; along: Vector };
}

/** A joint in which the second link turns about or shifts along an axis of a frame, which is given by rows. */
export interface ReadJoint {
  links: [number, number];
  frame: number[];
  axis: 0 | 1 | 2;
  turns: boolean;
  sign: number;
  /** Among the joints that are solved. */
  number: number;
}

/** A joint in the reference pose: a point of it, and the axes that it needs. */
export type Placed = Partial<Record<"at" | "x" | "y" | "z", number[]>>;

interface Texts {
  title: string;
  drives: string[];
  links: string[];
  /** What points are whose name is a letter; pages that were kept have none. */
  letters?: Record<string, string>;
  joints: string[];
  /** What only this page says, by short keys. */
  words: Record<string, string>;
}

export interface Model {
  /** Whether the page with the other views lies above it. */
  home: boolean;
  /** Whether there is a server that makes files; whether it makes other sizes. */
  asks: boolean;
  resizable: boolean;
  /** Chain, frame and drives as text. */
  text: string;
  texts: Record<Language, Texts>;
  /** Of the links, in the document. */
  names: string[];
  unit: string;
  middle: Vector;
  size: number;
  /** One of each link. */
  bodies: Body[];
  /** What is seen through, on its link. */
  glass: (Body & { link: number })[];
  points: Spot[];
  /** The linkage as the library reads it. */
  document: { screws: { joints: Record<string, Placed> } };
  /** Values of the drives in place of all that they can reach: radians or lengths. */
  between?: [number, number] | null;
  /** The links of each joint. */
  ends: number[][];
  /** The machine of the catalog that has a drive, where this one has none. */
  driven: { id: string; titles: Record<Language, string> } | null;
  /** Of links with two joints: how far these are apart, and the angle of their axes in degrees. */
  sizes: { link: number; distance: number | null; angle: number | null }[];
  /** The links whose motion is wanted, and the joint with the frame by which one is read, if there is one. */
  outputs: { link: number; joint: ReadJoint | null }[];
  joints: ReadJoint[];
  motions: Motion[];
  /** What moves several drives together; with one drive its motion is there. */
  live: Live | null;
}
