/** All that a change may alter of a linkage, to be set again, and how two of them are compared. */

import type { Beside } from "./beside";
import type { PointRecord } from "./model";

export interface Snapshot {
  at: number[];
  angles: number[];
  points: PointRecord[];
  drives: number[];
  signs: number[];
  unknowns: number[];
  beside: Beside;
  loads: unknown;
}

/** Whether sizes, points and assembly mode are the same but for rounding. */
export function alike(one: Snapshot, two: Snapshot, size: number): boolean {
  const values = ({ at, angles, points, signs }: Snapshot) => [
    ...[...at, ...points.flatMap((point) => point.at)].map((value) => value / size),
    ...angles,
    ...signs,
  ];
  const [first, second] = [values(one), values(two)];
  const names = ({ loads, points }: Snapshot) => JSON.stringify([loads, points.map(({ name, link }) => [name, link])]);
  return (
    first.length === second.length &&
    names(one) === names(two) &&
    first.every((value, k) => Math.abs(value - second[k]!) < 1e-9)
  );
}

/** Whether a change of the sizes, the points or the assembly mode left everything as it was. */
export function sameSizes(one: Snapshot, two: Snapshot): boolean {
  const key = ({ at, loads, points, signs }: Snapshot) => JSON.stringify([at, loads, points, signs]);
  return one.beside === two.beside && key(one) === key(two);
}
