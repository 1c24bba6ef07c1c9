/** Springs and dampers between links: their ends, and how they are drawn. */

import type { Linkage } from "./linkage";
import type { End, Spring } from "./model";
import { type Pair, place } from "./rows";
import type { Viewport } from "./viewport";

/** Places at which a spring may end, with what they are called and their names: joints, then points. */
export function endsOf(linkage: Linkage): [End, string, string][] {
  const { model, sizes } = linkage;
  const joints = model.joints.flatMap(({ name }, joint): [End, string, string][] => {
    const pin = sizes.elementsOf(joint).find((k) => sizes.is(k, "pin"));
    return pin === undefined ? [] : [[[sizes.element(pin).link, ...sizes.xy(pin)], linkage.jointName(name), name]];
  });
  return [
    ...joints,
    ...sizes.points.map(({ at, link, name }): [End, string, string] => [[link, ...at], linkage.pointName(name), name]),
  ];
}

/** The lines, in pixels, of a coil, a piston in its cylinder, or a spiral about the joint of two links; none of a
 * spring that does not act yet. */
export function springLines(linkage: Linkage, viewport: Viewport, spring: Spring): Pair[][] {
  const { damping, ends, known, preload, stiffness, turning } = spring;
  if (!stiffness && !preload && !damping && typeof known !== "number") return [];
  const at = ([link, ...own]: End) => viewport.screen(...place(linkage.pose, 0, link, ...own));
  const [[x, y], [u, v]] = ends.map(at) as [Pair, Pair];
  if (turning) {
    const both = ({ links }: { links: number[] }) => ends.every(([link]) => links.includes(link));
    const joint = linkage.model.joints.findIndex(both);
    if (joint < 0) return [];
    const [cx, cy] = viewport.screen(...linkage.jointAt(joint));
    const arm = (k: number) => 8 + k / 4;
    return [Array.from({ length: 49 }, (_, k) => [cx + arm(k) * Math.cos(k / 4), cy - arm(k) * Math.sin(k / 4)])];
  }
  const far = Math.hypot(u - x, v - y) || 1;
  const line = (...places: Pair[]) =>
    places.map(([part, across]): Pair => {
      const off = across / far;
      return [x + (u - x) * part - (v - y) * off, y + (v - y) * part + (u - x) * off];
    });
  if (damping && !stiffness && known === null)
    return [
      line([0, 0], [0.5, 0]),
      line([0.5, 6], [0.5, -6]),
      line([0.35, 8], [0.7, 8], [0.7, -8], [0.35, -8]),
      line([0.7, 0], [1, 0]),
    ];
  const count = 2 * Math.max(3, Math.min(20, Math.round(far / 16)));
  const coils = Array.from({ length: count }, (_, k): Pair => [0.16 + (0.68 * k) / (count - 1), k % 2 ? 7 : -7]);
  return [line([0, 0], [0.13, 0], ...coils, [0.87, 0], [1, 0])];
}
