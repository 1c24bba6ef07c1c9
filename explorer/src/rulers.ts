/** Measurement lines: the distance of two joints or points and its direction, which follow the motion. */

import type { Ruler } from "./beside";
import { angle, number } from "./language";
import type { Linkage } from "./linkage";
import { type Pair, place } from "./rows";
import { endsOf } from "./springs";

/** What is read off in the pose that is shown. */
export interface Reading {
  name: string;
  text: string;
  ends: [Pair, Pair];
}

/** Of each measurement line whose ends are there. */
export function readingsOf(linkage: Linkage): Reading[] {
  const { rulers = [] } = linkage.beside;
  const known = rulers.length ? endsOf(linkage) : [];
  return rulers.flatMap((names) => {
    const found = names.flatMap((name) => known.filter((end) => end[2] === name));
    if (found.length < 2) return [];
    const ends = found.map(([[link, ...own]]) => place(linkage.pose, 0, link, ...own)) as [Pair, Pair];
    const [[x, y], [u, v]] = ends;
    const length = `${number(Math.hypot(u - x, v - y), 5)} ${linkage.model.unit}`.trim();
    const text = `${length}, ${angle(Math.atan2(v - y, u - x), 5)}`;
    return [{ name: `${found[0]![1]} ↔ ${found[1]![1]}`, text, ends }];
  });
}

/** A point has another name from now on; that of a place on a link once it is gone, where its loads still act. */
export function renameEnds(linkage: Linkage, old: string, name: string): void {
  const renamed = (one: string) => (one === old ? name : one);
  const rulers = linkage.beside.rulers?.map(([one, two]): Ruler => [renamed(one), renamed(two)]);
  linkage.beside = { ...linkage.beside, ...(rulers && { rulers }) };
  linkage.loads &&= JSON.parse(
    JSON.stringify(linkage.loads).replaceAll(JSON.stringify(old), JSON.stringify(name)),
  ) as unknown;
}
