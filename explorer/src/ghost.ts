/** A design that plays over its targets: bodies of its links, and the curves of its points. */

import { groundMark, mark } from "./area";
import { put, renew, svg, wantsStill } from "./dom";
import { away } from "./hull";
import type { Pair } from "./rows";
import { DRIVEN } from "./scene";

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
    const { backward, drive, first: from = 0, frames, joints, points, rails = [], turns } = moving;
    const members = [...moving.members].sort((one, other) => other.length - one.length); // plates lie below bars
    const [first] = frames as [Pair[]];
    const curves = first
      .slice(joints, points && joints + points)
      .map((_, k) => svg("path.curve", { d: `${pathOf(frames.map((frame) => frame[joints + k]!))}Z` }));
    const pins = first.slice(0, joints).map(() => svg("circle.joint", { r: 1.5 * unit }));
    const still = (k: number) => frames.every((frame) => away(frame[k]!, ...first[k]!) < 1e-3 * unit);
    const grounds = pins.flatMap((_, k) => (still(k) ? [groundMark(first[k]!, unit)] : []));
    const hatched = (k: number) => (still(k) ? ["rail", "rail-hatch"] : ["rail"]).map((name) => svg(`path.${name}`));
    const bodies = [...rails.map(([end]) => hatched(end!)), ...bodiesOf(members)];
    const driven = drive === undefined ? [] : [mark("driven", DRIVEN, first[drive]!, unit)];
    if (backward) for (const one of driven) put(one, { transform: `${one.getAttribute("transform")} scale(-1 1)` });
    renew(this.element, ...bodies.flat(), ...grounds, ...curves, ...pins, ...driven); // plates cover no curve
    const arrow = svg("path.curve", { d: ARROW });
    if (turns) this.element.append(arrow);
    const calm = wantsStill();
    const begun = performance.now();
    const tick = (now: number) => {
      const gone = Math.floor((Math.max(0, now - begun) / 1000) * PACE) % frames.length;
      const frame = (from + (backward ? frames.length - gone : gone)) % frames.length;
      const places = frames[frame]!;
      putBodies(bodies, [...rails, ...members], places);
      for (const [k, pin] of pins.entries()) put(pin, { cx: places[k]![0], cy: -places[k]![1] });
      const [x, y] = places[joints] ?? [];
      if (turns) put(arrow, { transform: `translate(${x} ${-y!}) scale(${unit}) rotate(${-turns[frame]!})` });
      shown(frame);
      if (!calm && this.seen()) this.#frame = requestAnimationFrame(tick);
    };
    tick(begun);
  }
}
