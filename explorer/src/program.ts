/** What the kernel gets from Python: the flattened solving plan of a linkage. The codes are those of
 * `gruebler.mechanics.kinematics.kernel_records`; complex arrays are given as real and imaginary parts in turn. */

export const enum Code {
  TURN,
  PUSH,
  RRR,
  RRP,
  RPR,
  PRP,
  RPP,
  GROUP,
  CARRY,
}

export const enum Kind {
  PIN,
  SLIDE,
  RIDE,
  REACH,
  MESH,
  RACK,
  POLAR,
  FACE,
}

export interface Program {
  readonly operations: readonly (readonly number[])[];
  readonly links: Int32Array;
  /** (2 elements,): x and y of each element in its link; these change when joints are dragged. */
  readonly points: Float64Array;
  /** (2 elements,): the directions. */
  readonly lines: Float64Array;
  readonly conditions: Int32Array;
  readonly kinds: Int32Array;
  readonly sides: Int32Array;
  readonly owners: Int32Array;
  readonly bodies: Int32Array;
  readonly roots: Int32Array;
  readonly most: Float64Array;
  size: number;
  /** (6 conditions,) */
  readonly values: Float64Array;
  readonly windings: Int32Array;
  readonly pieces: readonly Float64Array[];
  readonly linkCount: number;
  readonly drives: number;
  readonly dyads: number;
}

export interface ProgramRecord {
  operations: number[][];
  links: number[];
  points: number[];
  lines: number[];
  conditions: number[];
  kinds: number[];
  sides: number[];
  owners: number[];
  bodies: number[];
  roots: number[];
  most: number[];
  size: number;
  values: number[];
  windings: number[];
  pieces: number[][];
  linkCount: number;
  drives: number;
  dyads: number;
}

export function programOf(record: ProgramRecord): Program {
  return {
    operations: record.operations,
    links: Int32Array.from(record.links),
    points: Float64Array.from(record.points),
    lines: Float64Array.from(record.lines),
    conditions: Int32Array.from(record.conditions),
    kinds: Int32Array.from(record.kinds),
    sides: Int32Array.from(record.sides),
    owners: Int32Array.from(record.owners),
    bodies: Int32Array.from(record.bodies),
    roots: Int32Array.from(record.roots),
    most: Float64Array.from(record.most),
    size: record.size,
    values: Float64Array.from(record.values),
    windings: Int32Array.from(record.windings),
    pieces: record.pieces.map((row) => Float64Array.from(row)),
    linkCount: record.linkCount,
    drives: record.drives,
    dyads: record.dyads,
  };
}
