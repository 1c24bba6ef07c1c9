/** Lengths and directions between places of a drawing, and places, that stay while others are dragged or typed. */

import { DEGREE } from "./cycle";
import { type Drawing, isPin, type Keep, type Knot, knotName, linksOf, moved, placed, same } from "./drawing";
import { away } from "./hull";
import { type Distance, kept } from "./keeping";
import type { Pair } from "./rows";

/** How easily what is dragged leaves its place, against others. */
const DRAGGED = 1e-7;
const FAR = 100; // sizes of the drawing: to a place on the line of a slide

/** Two knots of a link that are apart; so many of each link that they fix it. */
export interface Span {
  readonly link: string;
  readonly ends: readonly [number, number];
}

export function spansOf(drawing: Drawing): Span[] {
  const { knots } = drawing;
  return linksOf(drawing).flatMap((link) => {
    const mine = [...knots.keys()].filter((k) => knots[k]!.links.includes(link) && isPin(knots[k]!));
    const own = mine.filter((k, m) => !mine.slice(0, m).some((other) => same(knots[k]!, knots[other]!)));
    return own.flatMap((k, m) => own.slice(0, Math.min(m, 2)).map((other): Span => ({ link, ends: [other, k] })));
  });
}

export function lengthOf({ knots }: Drawing, [one, two]: Span["ends"]): number {
  return away(knots[one]!.at, ...knots[two]!.at);
}

export function spanName(drawing: Drawing, ends: Span["ends"]): string {
  return ends.map((k) => knotName(drawing, k)).join("–");
}

function keepOf(drawing: Drawing, kind: Keep[0], knots: readonly number[]): Keep {
  return [kind, ...knots.map((k) => knotName(drawing, k)).sort()] as const;
}

export function isKept(drawing: Drawing, kind: Keep[0], knots: readonly number[]): boolean {
  const wanted = keepOf(drawing, kind, knots).join();
  return !!drawing.locks?.some((one) => one.join() === wanted);
}

/** Let a length, a direction or a place stay, or not any more. */
export function keeping(drawing: Drawing, kind: Keep[0], knots: readonly number[]): Drawing {
  const wanted = keepOf(drawing, kind, knots);
  const { locks = [] } = drawing;
  const others = locks.filter((one) => one.join() !== wanted.join());
  return { ...drawing, locks: others.length < locks.length ? others : [...locks, wanted] };
}

/** The places of a drawing, each once, and what is to hold between them. */
class Places {
  readonly at: Pair[] = [];
  readonly #numbers = new Map<string, number>();
  readonly distances: Distance[] = [];
  /** How easily each of them moves: what stands on the ground does not, nor what is kept there. */
  readonly ease: number[];

  constructor(
    private readonly drawing: Drawing,
    /** What is free to leave the line of its slide. */
    dragged: Knot | null,
    but?: Span,
  ) {
    const { frame, knots } = drawing;
    for (const { at } of knots) this.of(at);
    this.ease = this.at.map(() => 1);
    const numbers = new Map([...knots.keys()].map((k) => [knotName(drawing, k), k]));
    const here = dragged && this.of(dragged.at);
    const size = Math.max(1, ...this.at.map((one) => away(one, ...this.at[0]!)));
    for (const [k, knot] of knots.entries()) {
      const place = this.of(knot.at);
      if ((isPin(knot) && knot.links.includes(frame!)) || isKept(drawing, "joint", [k])) this.ease[place] = 0;
      if (knot.slide === undefined || !knot.links.includes(frame!) || place === here) continue;
      const way: Pair = [Math.cos(knot.slide * DEGREE), Math.sin(knot.slide * DEGREE)];
      const far = this.#add([knot.at[0] + FAR * size * way[0], knot.at[1] + FAR * size * way[1]]);
      this.distances.push([place, far, 0, way]);
    }
    for (const [kind, ...names] of drawing.locks ?? []) {
      const [one, two] = names.map((name) => numbers.get(name)) as [number?, number?];
      if (kind === "joint" || one === undefined || two === undefined) continue;
      if (!knots[one]!.links.some((link) => knots[two]!.links.includes(link))) continue;
      if (but && kind === "length" && [one, two].every((k) => but.ends.includes(k))) continue;
      this.hold([one, two], kind === "direction");
    }
  }

  /** The number of a place. */
  of(at: Pair): number {
    const key = at.join();
    const number = this.#numbers.get(key) ?? this.at.length;
    if (number === this.at.length) this.at.push([...at]);
    this.#numbers.set(key, number);
    return number;
  }

  #add(at: Pair): number {
    this.ease.push(0);
    return this.at.push(at) - 1;
  }

  /** Let two knots stay so far apart, or another length, or in their direction. */
  hold(ends: Span["ends"], straight = false, length = lengthOf(this.drawing, ends)): void {
    const [[x, y], [u, v]] = ends.map((k) => this.drawing.knots[k]!.at) as [Pair, Pair];
    const [one, two] = [this.of([x, y]), this.of([u, v])];
    if (one === two) return;
    this.distances.push(straight ? [one, two, length, [(u - x) / length, (v - y) / length]] : [one, two, length]);
  }

  /** The drawing with a place elsewhere, others as far from there as they must; null if that is not possible. */
  moved(dragged: number, to: Pair, ease: number, others?: number): Drawing | null {
    const { drawing } = this;
    const here = this.of(drawing.knots[dragged]!.at);
    const from = this.at.map((at, k): Pair => (k === here ? to : at));
    const own = this.ease.map((one, k) => (k === here ? ease : (others ?? one)));
    const moving = this.distances.filter(([one, two]) => [one, two].some((k) => k === here || own[k]));
    const places = moving.length ? kept(from, moving, own) : from;
    if (!places) return null;
    const put = (at: Pair) => places[this.of(at)] ?? at;
    const knots = drawing.knots.map((knot) => {
      if (!knot.between) return { ...knot, at: put(knot.at) };
      return placed({ ...knot, between: [put(knot.between[0]), put(knot.between[1])] });
    });
    return { ...drawing, knots };
  }
}

/** Move a knot while what is kept stays; it comes near where it cannot come to, unless it must; null if nothing can. */
export function movedKept(drawing: Drawing, number: number, at: Pair, must = false): Drawing | null {
  if (isKept(drawing, "joint", [number])) return null;
  if (!drawing.locks?.some(([kind]) => kind !== "joint") || !isPin(drawing.knots[number]!))
    return moved(drawing, number, at);
  const places = new Places(drawing, drawing.knots[number]!);
  return places.moved(number, at, 0) ?? (must ? null : places.moved(number, at, DRAGGED));
}

/** Give two knots of a link another distance: the second one moves, unless it alone stands on the ground or is kept;
 * of a plate its other lengths stay if they can. Null if what is kept does not allow it. */
export function withLength(drawing: Drawing, span: Span, value: number): Drawing | null {
  const { frame, knots } = drawing;
  const stands = (k: number) =>
    isKept(drawing, "joint", [k]) || (span.link !== frame && knots[k]!.links.includes(frame!));
  const [one, two] = span.ends;
  const [from, end] = stands(two) && !stands(one) ? [two, one] : [one, two];
  const part = value / lengthOf(drawing, span.ends);
  if (!(part > 0 && part < Infinity) || isKept(drawing, "joint", [end])) return null;
  const [[x, y], [u, v]] = [knots[from]!.at, knots[end]!.at];
  const to: Pair = [x + part * (u - x), y + part * (v - y)];
  const held = () => {
    const places = new Places(drawing, null, span);
    places.hold(span.ends, false, value);
    return places;
  };
  const plate = held();
  const others = spansOf(drawing).filter((own) => own.link === span.link && own !== span && own.ends.includes(end));
  for (const own of others) if (own.ends.join() !== span.ends.join()) plate.hold(own.ends);
  const found = plate.moved(end, to, 1, 0) ?? held().moved(end, to, 1);
  return found ?? (drawing.locks?.length ? null : moved(drawing, end, to));
}
