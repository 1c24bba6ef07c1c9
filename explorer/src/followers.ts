/** Followers of cams: the stem of one that slides with the guide beside it, and where names stand quietly. */

import type { Linkage } from "./linkage";
import { direction, type Pair, place } from "./rows";
import type { Sizes } from "./sizes";

const CLEAR = 0.1; // of the size of a linkage: from a roller or a plate to the guide
const GUIDE = 0.36; // the length of the guide
const END = 0.08; // of the stem past the guide, where it is lowest
const ROWS = 60; // of a cycle: enough for the travel

/** The stem of a follower that slides in the frame: its ends on its link, and the ends of its guide on the frame. */
export interface Stem {
  foot: Pair;
  top: Pair;
  guide: [Pair, Pair];
}

/** What the document says of an element that is round. */
export function givenOf({ model, sizes }: Linkage, k: number): Record<string, unknown> {
  const { joint, link } = sizes.element(k);
  const own = model.document.elements![model.links[link]!]!;
  return own[model.joints[joint]!.name] as Record<string, unknown>;
}

/** The cam that an element touches; -1 if it touches none. */
function camAt(linkage: Linkage, k: number): number {
  const { sizes } = linkage;
  if (k < 0) return -1;
  const others = sizes.elementsOf(sizes.element(k).joint).filter((m) => m !== k && sizes.is(m, "round"));
  return others.find((m) => "cam" in givenOf(linkage, m)) ?? -1;
}

/** Whether an element is a face that touches a cam: the body that has it has an outline of its own. */
export function isFace(linkage: Linkage, k: number): boolean {
  return linkage.sizes.is(k, "line") && camAt(linkage, k) >= 0;
}

/** The roller about a pin of a link, as an element; -1 if there is none. */
function rollerAt({ sizes }: Linkage, pin: number): number {
  const others = sizes.is(pin, "pin") ? sizes.elementsOf(sizes.element(pin).joint).filter((m) => m !== pin) : [];
  const rounds = others.flatMap((m) =>
    sizes.elementsOn(sizes.element(m).link).filter((r) => sizes.is(r, "round") && sizes.together(r, m)),
  );
  return rounds[0] ?? -1;
}

/** Of an arm with a roller its pins, that of the roller last, and the cam on which it rolls. */
export function armOf(linkage: Linkage, link: number): [number, number, number] | null {
  const { sizes } = linkage;
  const pins = sizes.elementsOn(link);
  const end = pins.find((k) => camAt(linkage, rollerAt(linkage, k)) >= 0);
  const from = pins.find((k) => k !== end);
  if (end === undefined || from === undefined || pins[2] !== undefined || !sizes.is(from, "pin")) return null;
  return [from, end, camAt(linkage, rollerAt(linkage, end))];
}

/** The element of a link that rolls on a cam, its radius, and the cam; null of another link. */
export function rollerOf(linkage: Linkage, link: number): [number, number, number] | null {
  const { sizes } = linkage;
  const own = sizes.elementsOn(link).find((k) => sizes.is(k, "round") && camAt(linkage, k) >= 0);
  const radius = own === undefined ? 0 : Number(givenOf(linkage, own).circle);
  return radius ? [own!, Math.abs(radius), camAt(linkage, own!)] : null;
}

/** The stem of a link that a cam pushes along a slide of the frame; null of another one. */
export function stemOf(linkage: Linkage, link: number): Stem | null {
  const { cycle, model, pose, sizes } = linkage;
  const mine = sizes.elementsOn(link);
  const slide = mine.find((k) => {
    const { links, pair } = model.joints[sizes.element(k).joint]!;
    return pair.sliding && links.length === 2 && links.includes(model.frame);
  });
  if (slide === undefined || link === model.frame || !sizes.is(slide, "line")) return null;
  const on = sizes.elementsOf(sizes.element(slide).joint).find((k) => k !== slide)!;
  let [cam, foot, near] = [-1, [0, 0] as Pair, 0];
  const along = sizes.line(slide);
  for (const k of mine) {
    const roller = rollerAt(linkage, k);
    cam = camAt(linkage, roller < 0 ? k : roller);
    if (cam < 0) continue;
    near = roller < 0 ? 0 : Math.abs(Number(givenOf(linkage, roller).circle)) || 0;
    const gap = roller < 0 ? faced(sizes, slide, k) : 0;
    if (gap === null) return null;
    foot = roller < 0 ? onward(sizes.xy(slide), along, gap) : sizes.xy(k);
    break;
  }
  if (cam < 0) return null;
  const [ax, ay] = linkage.elementAt(cam);
  const [fx, fy] = place(pose, 0, link, ...foot);
  const [dx, dy] = direction(pose, 0, link, along);
  const sign = dx * (fx - ax) + dy * (fy - ay) < 0 ? -1 : 1;
  const up: Pair = [sign * along[0], sign * along[1]];
  for (const { closed, lines = [], link: its } of model.shapes)
    if (its === link && closed)
      for (const line of lines)
        for (let k = 0; k < line.length; k += 2)
          near = Math.max(near, up[0] * (line[k]! - foot[0]) + up[1] * (line[k + 1]! - foot[1]));
  const [high, low] = travelOf(linkage, cycle.rows, on, link, foot, up);
  if (!(high >= low)) return null;
  const begins = high + near + CLEAR * sizes.unit;
  const ends = begins + GUIDE * sizes.unit;
  const here = linkage.toLocal(model.frame, ...place(pose, 0, link, ...foot));
  const way = linkage.toLocal(model.frame, ...place(pose, 0, link, foot[0] + up[0], foot[1] + up[1]));
  const there: Pair = [way[0] - here[0], way[1] - here[1]];
  const now = travelOf(linkage, pose, on, link, foot, up)[0];
  return {
    foot,
    top: onward(foot, up, ends - low + END * sizes.unit),
    guide: [onward(here, there, begins - now), onward(here, there, ends - now)],
  };
}

/** How far from the point of a slide, along it, a face of its link crosses it; null of one that hardly does. */
function faced(sizes: Sizes, slide: number, face: number): number | null {
  const [c, s] = sizes.line(face);
  const [u, v] = sizes.line(slide);
  const lean = c * v - s * u;
  return Math.abs(lean) < 0.3 ? null : -sizes.leftOf(face, ...sizes.xy(slide)) / lean;
}

/** How far a place of a link comes along its slide, at most and at least, from that of the frame. */
function travelOf(linkage: Linkage, rows: Linkage["pose"], on: number, link: number, foot: Pair, up: Pair): Pair {
  const count = rows === linkage.pose ? 1 : linkage.cycle.values.length;
  let [high, low] = [-Infinity, Infinity];
  for (let row = 0; row < count; row += Math.max(1, Math.floor(count / ROWS))) {
    const [x, y] = place(rows, row, link, ...foot);
    const [u, v] = linkage.elementAt(on, rows, row);
    const [dx, dy] = direction(rows, row, link, up);
    const way = dx * (x - u) + dy * (y - v);
    if (!Number.isFinite(way)) continue;
    high = Math.max(high, way);
    low = Math.min(low, way);
  }
  return [high, low];
}

function onward([x, y]: Pair, [c, s]: Pair, far: number): Pair {
  return [x + c * far, y + s * far];
}
