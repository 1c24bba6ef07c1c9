/** Where a place that is pointed at is meant: in line with others, on the grid, at a round angle, at a known length. */

import { gridStep, stepOf } from "./grid";
import { away } from "./hull";
import type { Linkage } from "./linkage";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

const ROUND = Math.PI / 12;
const REACH = 7; // pixels

export interface Surroundings {
  /** The places with which it may be in line. */
  places: readonly Pair[];
  /** From where links lead to it, and lengths that links have already. */
  from: readonly Pair[];
  lengths: readonly number[];
}

/** What is in line, and places of the grid, go before round angles and known lengths. */
export function snapped([x, y]: Pair, viewport: Viewport, { places, from, lengths }: Surroundings): Pair {
  const reach = REACH / viewport.scale;
  const grid = gridStep(stepOf(viewport) / 5.01);
  const onGrid = (value: number) => grid * Math.round(value / grid);
  const nearest = (values: readonly number[], value: number) =>
    values.reduce((best, one) => (Math.abs(one - value) < Math.abs(best - value) ? one : best), Infinity);
  const other = [x, y].map((value, axis) =>
    nearest(
      places.map((place) => place[axis]!),
      value,
    ),
  );
  const [inX, inY] = [Math.abs(other[0]! - x) < reach, Math.abs(other[1]! - y) < reach];
  const part = (value: number) => (Math.abs(value) < 1e-12 ? 0 : value); // exactly upright, exactly level
  let found: Pair = [inX ? other[0]! : onGrid(x), inY ? other[1]! : onGrid(y)];
  if (away(found, x, y) < reach || (inX && inY)) return found;
  const meet = (place: Pair) => {
    if (away(place, x, y) < away(found, x, y)) found = place;
  };
  for (const [u, v] of from) {
    const [dx, dy] = [x - u, y - v];
    const far = Math.hypot(dx, dy);
    const angle = Math.atan2(dy, dx);
    const round = ROUND * Math.round(angle / ROUND);
    const length = nearest(lengths, far);
    const turned = far * Math.abs(angle - round) < reach;
    const known = Math.abs(length - far) < reach;
    if (inX || inY) {
      // level with a joint, or above it, it stays; there it may meet a round angle or a known length
      const off = inY ? other[1]! - v : other[0]! - u;
      const rest = Math.sqrt(length * length - off * off);
      const way = inY ? off / Math.tan(round) : off * Math.tan(round);
      for (const one of [rest, -rest, turned ? way : NaN]) meet(inY ? [u + one, other[1]!] : [other[0]!, v + one]);
      continue;
    }
    if (!turned && !known) continue;
    const [r, phi] = [known ? length : onGrid(far), turned ? round : angle];
    meet([u + r * part(Math.cos(phi)), v + r * part(Math.sin(phi))]);
  }
  return found;
}

/** Where a joint of a linkage is meant to come to, or a point: seen from the other joints of its links. */
export function snappedOn(linkage: Linkage, joint: number | null, at: Pair, viewport: Viewport): Pair {
  const { model, sizes } = linkage;
  const others = [...model.joints.keys()].filter((k) => k !== joint);
  const links = model.joints[joint ?? -1]?.links ?? [];
  const beside = others.filter((k) => model.joints[k]!.links.some((link) => links.includes(link)));
  const pins = (link: number) =>
    sizes.elementsOn(link).filter((k) => sizes.is(k, "pin") && sizes.element(k).joint !== joint);
  const lengths = [...model.links.keys()].flatMap((link) =>
    pins(link).flatMap((k, j, mine) => mine.slice(0, j).map((m) => sizes.gap(m, k))),
  );
  const placesOf = (joints: number[]) => joints.map((k) => linkage.jointAt(k));
  return snapped(at, viewport, { places: placesOf(others), from: placesOf(beside), lengths });
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
