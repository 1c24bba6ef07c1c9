/** Where a place that is pointed at is meant: in line with others, on the grid, at a round angle, at a known length. */

import type { Pair } from "./rows";

const ROUND = Math.PI / 12;

export interface Surroundings {
  /** The places with which it may be in line. */
  places: readonly Pair[];
  /** From where a link leads to it, if one does, and lengths that links have already. */
  from: Pair | undefined;
  lengths: readonly number[];
  /** Between lines of the grid. */
  grid: number;
  /** How near is near. */
  reach: number;
}

export function snapped([x, y]: Pair, { places, from, lengths, grid, reach }: Surroundings): Pair {
  const nearest = (values: readonly number[], value: number) =>
    values.reduce((best, one) => (Math.abs(one - value) < Math.abs(best - value) ? one : best), Infinity);
  const onAxis = (value: number, axis: 0 | 1) => {
    const other = nearest(
      places.map((place) => place[axis]),
      value,
    );
    if (Math.abs(other - value) < reach) return other;
    return grid * Math.round(value / grid);
  };
  const found: Pair = [onAxis(x, 0), onAxis(y, 1)];
  if (!from) return found;
  const [dx, dy] = [x - from[0], y - from[1]];
  const far = Math.hypot(dx, dy);
  const angle = Math.atan2(dy, dx);
  const round = ROUND * Math.round(angle / ROUND);
  const length = nearest(lengths, far);
  const turned = far * Math.abs(angle - round) < reach;
  const known = Math.abs(length - far) < reach;
  if (!turned && !known) return found;
  const [r, phi] = [known ? length : far, turned ? round : angle];
  const part = (value: number) => (Math.abs(value) < 1e-12 ? 0 : value); // exactly upright, exactly level
  const polar: Pair = [from[0] + r * part(Math.cos(phi)), from[1] + r * part(Math.sin(phi))];
  const away = ([u, v]: Pair) => Math.hypot(u - x, v - y);
  return away(polar) < away(found) ? polar : found;
}

/** Lines from a place to the nearest others that lie level with it or above it. */
export function guidelines([x, y]: Pair, places: readonly Pair[]): [Pair, Pair][] {
  return ([0, 1] as const).flatMap((axis) => {
    const inLine = places.filter((place) => Math.abs(place[axis] - (axis ? y : x)) < 1e-9);
    const far = (place: Pair) => Math.abs(place[1 - axis]! - (axis ? x : y));
    const [first] = inLine.filter((place) => far(place) > 1e-9).sort((one, two) => far(one) - far(two));
    return first ? [[first, [x, y]] as [Pair, Pair]] : [];
  });
}
