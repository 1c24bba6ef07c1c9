/** A design that plays over its targets: bodies of its links, and the curves of its points. */

import { groundMark, MARK, mark, markPlace } from "./area";
import { DEGREE } from "./cycle";
import { put, renew, svg, wantsStill } from "./dom";
import { BOX, DRIVEN, HATCH, RAIL, railOf } from "./ground";
import { away } from "./hull";
import type { Pair } from "./rows";

const ARROW = "M0 0H14M12.2 -1.8L16.4 0L12.2 1.8Z"; // as those of targets
const PACE = 48; // frames of a motion in a second

export interface Moving {
  /** Places of the joints, then of the points, evenly in time. */
  frames: Pair[][];
  /** With which of them it begins, that of its picture. */
  first?: number;
  /** Which of them each moving link has. */
  members: number[][];
  joints: number;
  /** How many points follow the joints; ends of slides stand behind them. */
  points?: number;
  /** The ends of the guides of slides. */
  rails?: number[][];
  /** How far the arrow of a position is turned that its point carries, in degrees. */
  turns?: number[];
  /** The joint that is driven. */
  drive?: number;
  /** It meets its targets in their order while its drive turns clockwise. */
  backward?: boolean;
  /** How far the bearings of joints are turned, in degrees. */
  bearings?: number[];
}

/** A line through places, of which y goes upward. */
export function pathOf(places: readonly (readonly number[])[]): string {
  return places.map(([x, y], k) => `${k ? "L" : "M"}${x} ${-y!}`).join("");
}

/** The bodies of links. */
export function bodiesOf(members: readonly number[][]): SVGPathElement[][] {
  return members.map((own) =>
    ["outline", "bar"].map((name) => svg("path", { class: own[2] ? `${name} plate` : name })),
  );
}

/** Put them where their joints and points are. */
export function putBodies(bodies: readonly SVGPathElement[][], members: readonly number[][], places: Pair[]): void {
  for (const [k, own] of members.entries())
    for (const part of bodies[k]!) put(part, { d: `${pathOf(own.map((one) => places[one]!))}Z` });
}

export class Ghost {
  readonly element = svg("g", { "data-ghost": "" });
  #frame = 0;

  /** It stands still while it is not seen. */
  constructor(private readonly seen: () => boolean) {}

  /** Pins are drawn in units of marks, which are so long; says which frame is shown. */
  play(moving: Moving | null, unit: number, shown: (frame: number) => void): void {
    cancelAnimationFrame(this.#frame);
    if (!moving) return renew(this.element);
    const { backward, bearings = [], drive, first: from = 0, frames, joints, points, rails = [], turns } = moving;
    const count = moving.members.length - rails.length; // blocks of slides stand behind the links
    const blocks = moving.members.slice(count);
    const members = moving.members.slice(0, count).sort((one, other) => other.length - one.length); // plates below
    const [first] = frames as [Pair[]];
    const curves = first
      .slice(joints, points && joints + points)
      .map((_, k) => svg("path.curve", { d: `${pathOf(frames.map((frame) => frame[joints + k]!))}Z` }));
    const pins = first.slice(0, joints).map(() => svg("circle.joint", { r: 1.5 * unit }));
    const still = (k: number) => frames.every((frame) => away(frame[k]!, ...first[k]!) < 1e-3 * unit);
    const pinned = (k: number) => members.some((own) => own.includes(k)) && still(k); // a slide may stand still, too
    const grounds = pins.flatMap((_, k) => (pinned(k) ? [groundMark(first[k]!, unit, bearings[k])] : []));
    // a block stands on its rail of the frame, a rod goes through it
    const guides = rails.map((ends) => {
      const rail = still(ends[0]!);
      const names = rail ? ["rail", "rail-hatch"] : ["rod-outline", "rod"];
      return { ends, far: rail ? [RAIL, RAIL + HATCH] : [0, 0], paths: names.map((name) => svg(`path.${name}`)) };
    });
    const bodies = bodiesOf(members);
    const boxes = blocks.map(() => mark("block", BOX, [0, 0], unit));
    const driven = drive === undefined ? [] : [mark("driven", DRIVEN, first[drive]!, unit, bearings[drive])];
    if (backward) for (const one of driven) put(one, { transform: `${one.getAttribute("transform")} scale(-1 1)` });
    // neither plates nor rods cover a curve
    const under = [...guides.map(({ paths }) => paths), ...bodies].flat();
    renew(this.element, ...under, ...boxes, ...grounds, ...curves, ...pins, ...driven);
    const arrow = svg("path.curve", { d: ARROW });
    if (turns) this.element.append(arrow);
    const calm = wantsStill();
    const begun = performance.now();
    const tick = (now: number) => {
      const gone = Math.floor((Math.max(0, now - begun) / 1000) * PACE) % frames.length;
      const frame = (from + (backward ? frames.length - gone : gone)) % frames.length;
      const places = frames[frame]!;
      putBodies(bodies, members, places);
      for (const { ends, far, paths } of guides) {
        const line = ends.map((k) => places[k]!) as [Pair, Pair];
        for (const [k, path] of paths.entries()) put(path, { d: pathOf(railOf(line, (far[k]! * unit) / MARK)) });
      }
      for (const [k, box] of boxes.entries()) {
        const [[x, y], [u, v]] = blocks[k]!.map((end) => places[end]!) as [Pair, Pair];
        put(box, { transform: markPlace([(x + u) / 2, (y + v) / 2], unit, Math.atan2(y - v, u - x) / DEGREE) });
      }
      for (const [k, pin] of pins.entries()) put(pin, { cx: places[k]![0], cy: -places[k]![1] });
      const [x, y] = places[joints] ?? [];
      if (turns) put(arrow, { transform: `translate(${x} ${-y!}) scale(${unit}) rotate(${-turns[frame]!})` });
      shown(frame);
      if (!calm && this.seen()) this.#frame = requestAnimationFrame(tick);
    };
    tick(begun);
  }
}
