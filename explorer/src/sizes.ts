/** The sizes of a linkage: where its elements lie on their links. */

import type { ElementRecord, Model, PointRecord } from "./model";
import type { Pair } from "./rows";

/** Two lines of a slide, then the pin of either link. */
export type Cylinder = [number, number, number, number];

export class Sizes {
  /** (2 elements,): their places on their links. */
  readonly at: Float64Array;
  /** (elements,): their angles there, in radians. */
  readonly angles: Float64Array;
  /** The named points. */
  points: PointRecord[];
  /** Below this length two places are the same. */
  readonly near: number;

  readonly #ofJoints: readonly (readonly number[])[];
  readonly #onLinks: readonly (readonly number[])[];

  constructor(
    readonly model: Model,
    /** About how large the linkage is. */
    readonly unit: number,
  ) {
    this.at = Float64Array.from(model.elements.flatMap((e) => e.at));
    this.angles = Float64Array.from(model.elements.map((e) => e.angle));
    const numbered = (mine: (e: ElementRecord) => boolean) => model.elements.flatMap((e, k) => (mine(e) ? [k] : []));
    this.#ofJoints = model.joints.map((_, joint) => numbered((e) => e.joint === joint));
    this.#onLinks = model.links.map((_, link) => numbered((e) => e.link === link));
    this.points = copied(model.points);
    this.near = 1e-9 * unit;
  }

  /** A copy, to be set again. */
  snapshot(): { at: number[]; angles: number[]; points: PointRecord[] } {
    return { at: [...this.at], angles: [...this.angles], points: copied(this.points) };
  }

  restore(old: { at: number[]; angles: number[]; points: PointRecord[] }): void {
    this.at.set(old.at);
    this.angles.set(old.angles);
    this.points = copied(old.points);
  }

  // --- elements ------------------------------------------------------------------------------------------------------

  /** The elements of a joint, by their numbers. */
  elementsOf(joint: number): readonly number[] {
    return this.#ofJoints[joint] ?? [];
  }

  elementsOn(link: number): readonly number[] {
    return this.#onLinks[link] ?? [];
  }

  element(k: number): ElementRecord {
    return this.model.elements[k]!;
  }

  is(k: number, kind: ElementRecord["kind"]): boolean {
    return this.element(k).kind === kind;
  }

  /** Where an element lies on its link. */
  xy(k: number): Pair {
    return [this.at[2 * k]!, this.at[2 * k + 1]!];
  }

  put(k: number, x: number, y: number): void {
    this.at[2 * k] = x;
    this.at[2 * k + 1] = y;
  }

  shift(k: number, dx: number, dy: number): void {
    this.at[2 * k]! += dx;
    this.at[2 * k + 1]! += dy;
  }

  /** The direction of a line on its link. */
  line(k: number): Pair {
    return [Math.cos(this.angles[k]!), Math.sin(this.angles[k]!)];
  }

  // --- distances -----------------------------------------------------------------------------------------------------

  /** The distance of two elements of a link. */
  gap(k: number, m: number): number {
    const [x, y] = this.xy(k);
    const [u, v] = this.xy(m);
    return Math.hypot(x - u, y - v);
  }

  /** Whether two elements of a link lie at the same place. */
  together(k: number, m: number): boolean {
    return this.gap(k, m) <= this.near;
  }

  /** A length or a coordinate as it is shown: what rounding leaves of 0 is 0. */
  clean(value: number): number {
    return Math.abs(value) < this.near ? 0 : value;
  }

  /** How far a place of its link lies left of a line. */
  leftOf(line: number, x: number, y: number): number {
    const [c, s] = this.line(line);
    const [u, v] = this.xy(line);
    return c * (y - v) - s * (x - u);
  }

  /** Let a line pass through a point of its link, its own point moved across it only. */
  shiftLine(k: number, x: number, y: number): void {
    const [c, s] = this.line(k);
    const off = this.leftOf(k, x, y);
    this.shift(k, -(s * off), c * off);
  }

  /** The lines and the pins of a slide between moving links whose pins lie on it, such as a cylinder; else null. */
  cylinder(joint: number): Cylinder | null {
    const record = this.model.joints[joint]!;
    if (!record.pair.sliding || record.links.includes(this.model.frame)) return null;
    const lines = this.elementsOf(joint);
    const pins = lines.map((k) => this.elementsOn(this.element(k).link).filter((m) => m !== k));
    if (pins.some((mine) => mine.length !== 1 || !this.is(mine[0]!, "pin"))) return null;
    if (lines.some((k, side) => Math.abs(this.leftOf(k, ...this.xy(pins[side]![0]!))) > this.near)) return null;
    return [lines[0]!, lines[1]!, pins[0]![0]!, pins[1]![0]!];
  }
}

function copied(points: readonly PointRecord[]): PointRecord[] {
  return points.map((point) => ({ ...point, at: [...point.at] }));
}
