/** What a reader may do to the sizes: take joints elsewhere, give two joints of a link another distance. */

import { type Distance, kept } from "./keeping";
import type { Rows } from "./kernel";
import type { Linkage } from "./linkage";
import { Locks } from "./locks";
import { placeBlocks, readState } from "./reading";
import { Refused } from "./refused";
import { direction, move, oneRow, type Pair, place, putOrigin, putTurn, turn } from "./rows";
import type { Cylinder } from "./sizes";
import { type Mesh, meshesOf, onCircle, type Pivot, pivotOf, setPhases, shiftWheel } from "./wheels";

/** The distance of two elements of a link. */
export interface Length {
  link: number;
  first: number;
  second: number;
  /** 1 if one of them is the line of a slide, from which the other is so far off; else 0. */
  off: number;
  value: number;
}

export const LONGEST = 1e9;
/** How near two pins of a link are dragged to each other, in sizes of the linkage; nearer ones are typed. */
const NEAREST = 1e-3;
/** How easily the joint that is dragged leaves its place, against others. */
const DRAGGED = 1e-7;

export class Dragging {
  /** Of each joint: whether its place is given by what touches there. */
  readonly #locked: readonly boolean[];
  /** Of each link: the two pins between which its x axis runs, if it does. */
  readonly #axes: readonly (Pair | null)[];
  readonly #meshes: readonly Mesh[];
  /** Of each joint that is the centre of a wheel which can be moved around another one. */
  readonly #pivots: readonly (Pivot | null)[];
  /** What stays as it is while joints are dragged. */
  readonly locks: Locks;
  readonly #linkage: Linkage;

  constructor(linkage: Linkage) {
    this.#linkage = linkage;
    this.locks = new Locks(linkage);
    const { model, sizes } = linkage;
    const held = model.joints.map((_, joint) => this.#touches(joint));
    // an axis goes with those of wheels at the same place of its link
    const withWheel = (k: number) => (m: number) =>
      m !== k && held[sizes.element(m).joint]! && sizes.is(m, "pin") && sizes.together(k, m);
    const carried = (k: number) => sizes.elementsOn(sizes.element(k).link).some(withWheel(k));
    this.#locked = held.map((one, joint) => one || sizes.elementsOf(joint).some(carried));
    this.#axes = model.links.map((_, link) => this.#axisOf(link));
    this.#meshes = meshesOf(linkage);
    this.#pivots = model.joints.map((_, joint) => pivotOf(linkage, this.#meshes, joint));
  }

  /** Where wheels, cams and the like touch, places are not free. */
  #touches(joint: number): boolean {
    const { sizes } = this.#linkage;
    const mine = sizes.elementsOf(joint);
    if (!mine.some((k) => sizes.is(k, "pin"))) return true;
    if (mine.some((k) => sizes.is(k, "round"))) return true;
    const atRound = (k: number) => (other: number) => sizes.is(other, "round") && sizes.together(k, other);
    return mine.some((k) => sizes.elementsOn(sizes.element(k).link).some(atRound(k)));
  }

  #axisOf(link: number): Pair | null {
    const { model, sizes } = this.#linkage;
    if (link === model.frame || link >= model.own) return null;
    const pins = sizes.elementsOn(link).filter((k) => sizes.is(k, "pin"));
    const first = pins.find((k) => Math.hypot(...sizes.xy(k)) <= sizes.near);
    const other = pins.find((k) => {
      const [x, y] = sizes.xy(k);
      return k !== first && x > sizes.near && Math.abs(y) <= sizes.near;
    });
    return first === undefined || other === undefined ? null : [first, other];
  }

  draggable(joint: number): boolean {
    return !this.locks.held.has(joint) && (!this.#locked[joint] || this.#pivots[joint] !== null);
  }

  /** Where a joint comes to when it is dragged to a place. */
  permitted(joint: number, x: number, y: number): Pair {
    const pivot = this.#pivots[joint];
    return pivot ? onCircle(this.#linkage, pivot, joint, x, y) : [x, y];
  }

  // --- joints --------------------------------------------------------------------------------------------------------

  /**
   * Take a joint to a place in the plane. All other joints stay where they are: the links of this joint change.
   * The centre of a wheel goes around those that it meshes with.
   */
  dragJoint(joint: number, toX: number, toY: number): void {
    if (!this.draggable(joint)) return;
    const linkage = this.#linkage;
    const { model, sizes } = linkage;
    const pose = oneRow(linkage.pose, 0);
    const pivot = this.#pivots[joint];
    const places = this.#placesWith(joint, ...this.permitted(joint, toX, toY));
    this.#keepApart(places);
    const rigid = model.links.map((_, link) => this.#isKept(link));
    const cylinders = model.joints.map((_, k) => sizes.cylinder(k)).filter((found) => found !== null);
    const ends = new Set(cylinders.flatMap(([, , one, two]) => [one, two]));
    linkage.change(() => {
      if (pivot) shiftWheel(linkage, pose, pivot.wheel, joint, ...places.get(joint)!);
      for (const [moved, [x, y]] of places)
        for (const k of sizes.elementsOf(moved)) {
          const { link } = sizes.element(k);
          if (!ends.has(k) && !rigid[link] && link !== pivot?.wheel) this.#moveElement(k, x, y, cylinders);
        }
      for (const [link, whole] of rigid.entries()) if (whole) this.#carry(pose, link, places);
      for (const cylinder of cylinders) this.#straighten(pose, cylinder, places);
      for (const [link, axis] of this.#axes.entries()) if (axis) this.#align(pose, link, axis);
      linkage.writeSizes();
      placeBlocks(linkage, pose);
      readState(linkage, pose);
      setPhases(linkage, this.#meshes, pose);
    });
  }

  /** Where joints come to when one is dragged: others follow where lengths and directions are kept, and move as little
   * as they can. */
  #placesWith(joint: number, x: number, y: number): Map<number, Pair> {
    const { locks } = this;
    const linkage = this.#linkage;
    const { model, sizes } = linkage;
    const directions = locks.pairs("direction");
    if (!locks.pairs("length").length && !directions.length) return new Map([[joint, [x, y]]]);
    const before = model.joints.map((_, k) => linkage.jointAt(k));
    const joints = ([one, two]: Pair) => [sizes.element(one).joint, sizes.element(two).joint] as const;
    const distances = [
      ...locks.pairs("length").map((pair): Distance => [...joints(pair), sizes.gap(...pair)]),
      ...directions.map((pair): Distance => {
        const [[px, py], [qx, qy]] = [linkage.elementAt(pair[0]), linkage.elementAt(pair[1])];
        const far = Math.hypot(qx - px, qy - py);
        return [...joints(pair), far, [(qx - px) / far, (qy - py) / far]];
      }),
    ];
    const ease = before.map((_, k): number => (locks.held.has(k) || this.#locked[k] ? 0 : 1));
    const moving = distances.filter(([one, two]) => one === joint || two === joint || ease[one]! + ease[two]! > 0);
    const from = before.map((at, k): Pair => (k === joint ? [x, y] : at));
    const eased = (own: number) =>
      kept(
        from,
        moving,
        ease.map((one, k) => (k === joint ? own * one : one)),
      );
    const places = eased(0) ?? eased(DRAGGED); // where it cannot come to, it comes near
    if (!places) throw new Refused(null, "kept");
    const others = places.map((at, k): [number, Pair] => [k, at]);
    return new Map(others.filter(([k, [u, v]]) => k === joint || u !== before[k]![0] || v !== before[k]![1]));
  }

  /** Refuse places at which two pins of a link would all but meet. */
  #keepApart(places: ReadonlyMap<number, Pair>): void {
    const linkage = this.#linkage;
    const { sizes } = linkage;
    const least = NEAREST * linkage.size;
    const placeOf = (k: number) => places.get(sizes.element(k).joint) ?? linkage.elementAt(k);
    const pins = [...places.keys()].flatMap((moved) => sizes.elementsOf(moved)).filter((k) => sizes.is(k, "pin"));
    for (const k of pins)
      for (const m of sizes.elementsOn(sizes.element(k).link)) {
        if (m === k || !sizes.is(m, "pin") || sizes.gap(k, m) < least) continue;
        const [[x, y], [u, v]] = [placeOf(k), placeOf(m)];
        if (Math.hypot(u - x, v - y) < least) throw new Refused(null, "near");
      }
  }

  /** Whether all of a link is kept: it has pins only, and all their distances stay. */
  #isKept(link: number): boolean {
    const { model, sizes } = this.#linkage;
    const mine = sizes.elementsOn(link);
    const pairs = mine.flatMap((k, j) => mine.slice(0, j).map((m) => this.locks.keeps("length", m, k)));
    // a triangle is fixed by its sides; what has more pins by the distances from the first two
    const wanted = mine.length < 2 ? Infinity : 2 * mine.length - 3;
    return link !== model.frame && mine.every((k) => sizes.is(k, "pin")) && pairs.filter(Boolean).length >= wanted;
  }

  /** Take a link along as a whole, by two of its pins. */
  #carry(pose: Rows, link: number, places: ReadonlyMap<number, Pair>): void {
    const linkage = this.#linkage;
    const { sizes } = linkage;
    const [one, two] = sizes.elementsOn(link) as [number, number];
    const placeOf = (k: number) => places.get(sizes.element(k).joint) ?? linkage.elementAt(k);
    const [from, to, was, end] = [placeOf(one), placeOf(two), linkage.elementAt(one), linkage.elementAt(two)];
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]) - Math.atan2(end[1] - was[1], end[0] - was[0]);
    const [c, s] = turn(pose, 0, link);
    const [dc, ds] = [Math.cos(angle), Math.sin(angle)];
    putTurn(pose, link, c * dc - s * ds, s * dc + c * ds);
    const [rx, ry] = direction(pose, 0, link, sizes.xy(one));
    putOrigin(pose, link, from[0] - rx, from[1] - ry);
    // Newton's method may have turned a triangle over
    for (const k of sizes.elementsOn(link)) {
      const [x, y] = placeOf(k);
      const [u, v] = place(pose, 0, link, ...sizes.xy(k));
      if (!(Math.hypot(u - x, v - y) < 1e-9 * sizes.unit)) throw new Refused(null, "kept");
    }
  }

  #moveElement(k: number, x: number, y: number, cylinders: readonly Cylinder[]): void {
    const linkage = this.#linkage;
    const { model, sizes } = linkage;
    const { joint, link } = sizes.element(k);
    const [u, v] = linkage.toLocal(link, x, y);
    if (sizes.is(k, "line")) {
      sizes.shiftLine(k, u, v);
      return;
    }
    const before = sizes.xy(k);
    sizes.put(k, u, v);
    if (link === model.frame) return;
    // a slide through the pin goes on through it, on both of its links
    for (const m of sizes.elementsOn(link)) {
      if (!sizes.is(m, "line") || sizes.element(m).joint === joint) continue;
      if (Math.abs(sizes.leftOf(m, ...before)) > sizes.near) continue;
      if (cylinders.some(([one, two]) => one === m || two === m)) continue;
      for (const other of sizes.elementsOf(sizes.element(m).joint)) {
        if (!sizes.is(other, "line")) continue;
        sizes.shiftLine(other, ...linkage.toLocal(sizes.element(other).link, x, y));
      }
    }
  }

  /** A cylinder whose end is dragged keeps its links, and turns into the line of its pins. */
  #straighten(pose: Rows, cylinder: Cylinder, places: ReadonlyMap<number, Pair>): void {
    const linkage = this.#linkage;
    const { sizes } = linkage;
    const [one, two, pinOne, pinTwo] = cylinder;
    const moved = (pin: number) => places.get(sizes.element(pin).joint);
    if (!moved(pinOne) && !moved(pinTwo)) return;
    const endAt = (pin: number): Pair => moved(pin) ?? linkage.elementAt(pin);
    const ends = [endAt(pinOne), endAt(pinTwo)] as const;
    const dx = ends[1][0] - ends[0][0];
    const dy = ends[1][1] - ends[0][1];
    for (const [line, pin, end] of [
      [one, pinOne, ends[0]],
      [two, pinTwo, ends[1]],
    ] as const) {
      const { link } = sizes.element(line);
      const [lx, ly] = direction(pose, 0, link, sizes.line(line));
      const along = lx * dx + ly * dy < 0 ? -1 : 1;
      const angle = Math.atan2(along * dy, along * dx) - sizes.angles[line]!;
      putTurn(pose, link, Math.cos(angle), Math.sin(angle));
      const [rx, ry] = direction(pose, 0, link, sizes.xy(pin));
      putOrigin(pose, link, end[0] - rx, end[1] - ry);
    }
  }

  /** Give a link its x axis back, from pin to pin; nothing moves in the plane. */
  #align(pose: Rows, link: number, [first, other]: Pair): void {
    const { sizes } = this.#linkage;
    const [x, y] = sizes.xy(first);
    const [ox, oy] = sizes.xy(other);
    const dx = ox - x;
    const dy = oy - y;
    const length = Math.hypot(dx, dy);
    if (!(length > 0) || (x === 0 && y === 0 && dy === 0 && dx > 0)) return;
    const c = dx / length;
    const s = dy / length;
    const to = (u: number, v: number): Pair => [c * (u - x) + s * (v - y), c * (v - y) - s * (u - x)];
    for (const k of sizes.elementsOn(link)) {
      sizes.put(k, ...to(...sizes.xy(k)));
      if (!sizes.is(k, "pin")) sizes.angles[k]! -= Math.atan2(s, c);
    }
    sizes.put(first, 0, 0);
    sizes.put(other, length, 0);
    for (const point of sizes.points) if (point.link === link) point.at = to(...point.at);
    const [tx, ty] = turn(pose, 0, link);
    move(pose, link, tx * x - ty * y, tx * y + ty * x);
    putTurn(pose, link, tx * c - ty * s, tx * s + ty * c);
  }

  // --- lengths -------------------------------------------------------------------------------------------------------

  /** The sizes that a panel shows: for each link the distances of its joints, then how far joints are off slides. */
  lengths(): Length[] {
    const { model, sizes } = this.#linkage;
    const out: Length[] = [];
    for (let link = 0; link < model.own; link++) {
      const mine = sizes.elementsOn(link).filter((k) => !sizes.is(k, "round"));
      // each joint against the first two of its link: these distances fix the link
      for (let j = 1; j < mine.length; j++)
        for (let i = 0; i < Math.min(j, 2); i++) {
          const length = this.#length(link, mine[i]!, mine[j]!);
          if (length) out.push(length);
        }
    }
    return out.sort((one, other) => one.off - other.off);
  }

  /** The distance of two elements of a link, null where it is no size. */
  #length(link: number, first: number, second: number): Length | null {
    const { model, sizes } = this.#linkage;
    const lines = [first, second].filter((k) => sizes.is(k, "line"));
    if (lines.length === 2) return null;
    let value: number;
    if (lines.length) {
      const [line, pin] = this.#lineFirst(first, second);
      value = Math.abs(sizes.leftOf(line, ...sizes.xy(pin)));
      if (value < 1e3 * sizes.near && link !== model.frame) return null;
    } else value = sizes.gap(first, second);
    if (this.#locked[sizes.element(first).joint] && this.#locked[sizes.element(second).joint]) return null;
    return { link, first, second, off: lines.length, value: value < 1e3 * sizes.near ? 0 : value };
  }

  #lineFirst(first: number, second: number): Pair {
    return this.#linkage.sizes.is(first, "line") ? [first, second] : [second, first];
  }

  /** Give two joints of a link another distance: the second moves on the line through both. */
  setLength(first: number, second: number, length: number): void {
    if (!(length >= 0) || !(length < LONGEST)) throw new Refused(null);
    const { sizes } = this.#linkage;
    const goal = new Float64Array(sizes.at);
    if (sizes.is(first, "line") || sizes.is(second, "line")) {
      const [line, pin] = this.#lineFirst(first, second);
      const off = sizes.leftOf(line, ...sizes.xy(pin));
      const more = (off < 0 ? -length : length) - off;
      const [c, s] = sizes.line(line);
      goal[2 * line]! += s * more;
      goal[2 * line + 1]! -= c * more;
    } else {
      if (length < sizes.near) throw new Refused(null, "near");
      const [x, y] = sizes.xy(first);
      const [u, v] = sizes.xy(second);
      const now = Math.hypot(u - x, v - y);
      this.#putPin(goal, first, second, [x + ((u - x) / now) * length, y + ((v - y) / now) * length], length);
    }
    this.#linkage.changeSlowly(goal);
  }

  /** Put a pin elsewhere on its link; other pins of it follow as far as lengths are kept. */
  #putPin(goal: Float64Array, first: number, second: number, at: Pair, length: number): void {
    const { sizes } = this.#linkage;
    const mine = sizes.elementsOn(sizes.element(first).link).filter((k) => sizes.is(k, "pin"));
    const number = (k: number) => mine.indexOf(k);
    const others = this.locks
      .pairs("length")
      .filter(([one, two]) => number(one) >= 0 && (one !== first || two !== second));
    const distances = others.map(([one, two]): Distance => [number(one), number(two), sizes.gap(one, two)]);
    const places = kept(
      mine.map((k) => (k === second ? at : sizes.xy(k))),
      [[number(first), number(second), length], ...distances],
      mine.map((k) => (k === first ? 0 : 1)),
    );
    if (!places) throw new Refused(null, "kept");
    for (const [m, k] of mine.entries()) goal.set(places[m]!, 2 * k);
  }
}
