/** Where the names of a picture stand: in or beside their bodies, else near them with a line; where these have no room,
 * numbers do. */

import type { Cycle } from "./cycle";
import { put, svg } from "./dom";
import { convexHull, middleOf, pathThrough, sidesOf, spotsAbout, toHull } from "./hull";
import { clearOf, type Label, labelsOf, namedLinks } from "./labels";
import { currentLanguage } from "./language";
import { type Boxed, boxed, clearBy, type Leader, leaderOf } from "./leaders";
import type { Legend } from "./legend";
import type { Linkage } from "./linkage";
import type { ShapeRecord } from "./model";
import { nearerBy } from "./names";
import { cornersOf } from "./quiet";
import { type Pair, place } from "./rows";
import { linesOf } from "./shapes";
import type { Viewport } from "./viewport";

const LINE = 15; // pixels that names are apart
const MOST_CLEAR = 40; // names that look for a place of their own in every picture
const TOP = 14; // pixels from the upper edge, in which a name would be cut
const LOW = 4; // and from the lower one
const NEAR = 16; // places of a letter of which others are twice as far
const RULE = 34; // from the left edge to where the numbers of the grid end
const JOINT = 11; // from the middle of a joint to that of a name
const BLOCK = 12; // from the middle of a joint to what may be its block
const BODY = 9; // from the middle of a bar to that of a name beside it
const AWAY = 30; // the same on a wheel, where it is not to be read as that of a bar
const INK = 8; // from a name to an arrow or a ground
const BACK = 8; // more room, for a name that stood farther off
const GAP = 5; // from the middle of a name to a ground beside which it still stands well
const FOOT = 22; // below which are the numbers of the grid
const WAITS = 5; // pictures in which no place is sought after none was found
const SHORT = 3; // letters of a name that stands everywhere

/** What is drawn beside bodies, in pixels, and whether curves are. */
export interface Around {
  arrows: Pair[][];
  grounds: Pair[][];
  joints: Pair[];
  curves: boolean;
  /** Whether arrows of forces are, which have numbers. */
  forces: boolean;
}
export const LEADERS = { fill: "var(--faint)", stroke: "var(--faint)" };

export class Naming {
  readonly element = svg("g", {});
  /** From names to bodies beside which they have no place. */
  readonly #leaders = svg("path", LEADERS);
  #labels: Label[] = [];
  /** Whether numbers stand for names, and in which cycles, widths and scales they do. */
  #numbered = false;
  readonly #known = new WeakMap<Cycle, Map<string, boolean>>();
  /** Names that have no place at their links. */
  #crowded = 0;
  /** Names that have their places. */
  #taken: { x: number; y: number; half: number }[] = [];
  /** What no other text is to cover. */
  #drawn: Pair[][] = [];

  constructor(
    private readonly viewport: Viewport,
    readonly legend: Legend,
  ) {}

  /** The names of a linkage; none if they are not wanted. */
  build(linkage: Linkage, wanted: boolean): void {
    const numbered = this.#numbered;
    this.#labels = wanted ? labelsOf(linkage, numbered) : [];
    this.legend.build(linkage, numbered && wanted ? namedLinks(linkage) : []);
    this.element.replaceChildren(this.#leaders, ...this.#labels.map(({ element }) => element), this.legend.element);
  }

  /** Choose between names and numbers, so that it holds for all of these poses; how high the list of names is then. */
  choose(linkage: Linkage, poses: () => Iterable<Around>): number {
    const { height, scale, width } = this.viewport;
    const known = this.#known.get(linkage.cycle) ?? new Map<string, boolean>();
    this.#known.set(linkage.cycle, known);
    const key = [width, height, Math.round(8 * Math.log(scale)), currentLanguage()].join();
    const long = namedLinks(linkage).some((link) => linkage.linkName(link).length > SHORT);
    const take = (numbers: boolean) => {
      this.#numbered = numbers;
      this.build(linkage, true);
      this.sized();
    };
    let numbered = known.get(key) ?? false;
    if (!known.has(key) && long) {
      take(false);
      for (const around of poses()) {
        this.place(linkage, around);
        numbered = this.#crowded > 0;
        if (numbered) break;
      }
    }
    known.set(key, numbered);
    if (numbered !== this.#numbered) take(numbered);
    return this.legend.lay(this.viewport);
  }

  /** After sizes or the scale changed. */
  sized(): void {
    for (const label of this.#labels) label.sized?.(this.viewport.scale);
  }

  /** Names look for their best places, wherever they stood while it moved. */
  settle(): void {
    for (const label of this.#labels) Object.assign(label, { taken: 0, leader: undefined, waits: 0 });
  }

  /** Put all names where they have room; what other texts are to keep clear of, names included. */
  place(linkage: Linkage, { arrows, curves, forces, grounds, joints }: Around): Pair[][] {
    const { viewport } = this;
    const untold = !this.legend.lay(viewport) && this.#numbered;
    const hulls = this.#labels.map(({ hull }) => (hull && this.#labels.length < MOST_CLEAR ? hull(viewport) : []));
    const bodies = hulls.filter((hull) => hull.length);
    const still = [...arrows, ...grounds, this.#buttons];
    this.#taken = [];
    this.#crowded = 0;
    this.#drawn = [...bodies, ...still];
    const order = [...this.#labels.entries()].sort(([, one], [, other]) => +!!one.many - +!!other.many);
    const pins = joints.map((at) => boxed([at]));
    const [stands, drawn] = [grounds.map(boxed), still.map(boxed)];
    const far: [number, Label][] = [];
    for (const [k, label] of order) {
      const { element, half, sized, spots } = label;
      // a number says nothing without the list
      if (untold && sized) {
        put(element, { display: "none" });
        continue;
      }
      const places = spots(viewport);
      const clear = (of: Pair[][]) => (at: Pair) =>
        !this.#touching(half, at) && of.every((one) => clearOf(one, half, at));
      const apart = clear(hulls[k]!.length ? arrows : this.#drawn);
      const free = (at: Pair) => this.#seen(half, at) && apart(at);
      if (hulls[k]!.length) {
        // of a plate upon which it lies only the edges are others
        const mine = middleOf(hulls[k]!);
        const others = hulls.flatMap((one, other) => {
          if (other === k) return [];
          return toHull(one, ...mine) ? [one] : sidesOf(one);
        });
        const wide = label.leader === undefined ? half : half + BACK; // back it comes where there is more room
        const quiet = clear(grounds);
        const boxes = others.map(boxed);
        const near = (at: Pair, room: number, ink = boxes) => {
          const middle: Pair = [at[0], at[1] - 4];
          const own = hulls[k]!.length > 2 && !toHull(hulls[k]!, ...middle); // on its plate
          return (
            clearBy(JOINT, pins, wide, middle) &&
            (own || clearBy(BODY, ink, wide, middle)) &&
            clearBy(GAP, stands, wide, middle) &&
            free(at) &&
            (room < 0 || nearerBy(at, wide, hulls[k]!, others) > room)
          );
        };
        const wheel = label.wheel?.(viewport);
        const spokes = wheel && [...boxes, ...wheel.spokes.map(boxed)];
        // a long name interrupts a spoke
        const good = (at: Pair) =>
          (wheel ? near(at, -1, spokes) && clearBy(AWAY, boxes, wide, at) : near(at, INK - 2 + wide - half)) &&
          quiet(at);
        const fair = (at: Pair) => near(at, wheel ? -1 : wide - half);
        const from = wheel?.places ?? places;
        const chosen = pickedBy(from, label.taken, [good, fair]);
        label.taken = Math.max(0, chosen);
        if (chosen < 0) {
          far.push([k, label]);
          continue;
        }
        label.leader = undefined;
        this.#stands(label, from[chosen]!);
        continue;
      }
      if (label.taken >= NEAR || !free(places[label.taken]!)) label.taken = Math.max(0, places.findIndex(free));
      this.#stands(label, places[label.taken]!);
    }
    const more = far.length && curves ? curvesOf(linkage, viewport) : [];
    // in a low picture they give way to numbers
    if (forces && viewport.narrow) for (const [, { element }] of far.splice(0)) put(element, { display: "none" });
    more.push(...joints.map((at) => ringAbout(at, BLOCK)));
    this.#putFar(linkage, hulls, far, [...drawn, ...more.map(boxed)]);
    // upon a plate they may stand, but not across its edges
    return [...bodies.flatMap(sidesOf), ...this.#drawn.slice(bodies.length)];
  }

  /** Those that have no place beside their bodies: first the ones that may stay where they were. */
  #putFar(linkage: Linkage, hulls: Pair[][], far: [number, Label][], ink: readonly Boxed[]): void {
    const { height } = this.viewport;
    const boxes = hulls.map(boxed);
    const more = far.length ? outlinesOf(linkage, this.viewport) : [];
    const lines: [Pair, Pair][] = [];
    const hangs = (label: Label, found: Leader | null) => {
      label.leader = found?.chosen ?? -1;
      if (found) this.#takes(label, found.at);
      if (found?.line) lines.push(found.line);
      return !!found;
    };
    const anew: (() => void)[] = [];
    for (const [k, label] of far) {
      const { half, link, spots } = label;
      const others = boxes.filter(([hull], other) => other !== k && hull.length);
      others.push(...more.flatMap(([its, box]) => (its === link ? [] : [box])));
      const homes = more.flatMap(([its, box]) => (its === link && box[0].length > 2 ? [box] : []));
      const spokes = (label.wheel?.(this.viewport).spokes ?? []).map(boxed);
      // the widest one
      const home = homes.sort((one, other) => other[2] - other[1] - one[2] + one[1])[0]?.[0] ?? [];
      const free = ([u, v]: Pair) =>
        this.#seen(half, [u, v]) &&
        v > TOP &&
        v < height - FOOT &&
        !this.#touching(half, [u, v]) &&
        clearBy(INK, spokes.length ? [...ink, ...spokes] : ink, half, [u, v - 4]);
      const find = leaderOf(boxes[k]!, home, others, half, free, lines, this.#taken);
      if (!hangs(label, find(label.leader ?? -1)))
        anew.push(() => {
          if (label.waits) label.waits--;
          else if (hangs(label, find())) return;
          else label.waits = WAITS;
          this.#crowded++;
          this.#stands(label, spots(this.viewport)[Math.max(0, label.taken)]!);
        });
    }
    for (const find of anew) find();
    put(this.#leaders, { d: leadersThrough(lines) });
  }

  /** At its place beside its body, though something is there. */
  #stands(label: Label, [left, top]: Pair): void {
    const { half } = label;
    const right = this.viewport.right(top);
    const x = Math.max(half + 2, Math.min(right - half - 2, left)); // it is not cut
    let y = top;
    let other = this.#touching(half, [x, y]);
    const way = y < (other?.y ?? 0) ? -LINE : LINE;
    for (; other; other = this.#touching(half, [x, y])) y = other.y + way;
    const { height, narrow } = this.viewport;
    if (narrow && (x + half > this.viewport.right(y) || y < TOP || y > height - LOW))
      put(label.element, { display: "none" });
    else this.#takes(label, [x, y]);
  }

  #takes({ element, half }: Label, [x, y]: Pair): void {
    put(element, { display: "inline", transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})` });
    this.#taken.push({ x, y, half });
    this.#drawn.push(lettersAt(x, y, half));
  }

  #touching(half: number, [u, v]: Pair) {
    return this.#taken.find(({ half: its, x, y }) => half + its + 4 > Math.abs(u - x) && Math.abs(v - y) < LINE - 0.01);
  }

  #seen(half: number, [x, y]: Pair): boolean {
    return x > half + RULE && x + half < this.viewport.right(y) && y < this.viewport.height - FOOT;
  }

  get #buttons(): Pair[] {
    const { beside, tools, width } = this.viewport;
    return convexHull(
      [0, tools - 12].flatMap((y): Pair[] => [
        [width - beside + 2, y],
        [width, y],
      ]),
    );
  }
}

/** Which of some places is taken: the one before as long as no other is better, by tests of which the best is first; -1
 * if none passes. */
function pickedBy(places: readonly Pair[], before: number, tests: ((at: Pair) => boolean)[]): number {
  for (const passes of tests) {
    if (places[before] && passes(places[before])) return before;
    const found = places.findIndex(passes);
    if (found >= 0) return found;
  }
  return -1;
}

/** The corners of a text that stands upon a line. */
export function lettersAt(x: number, y: number, half: number): Pair[] {
  return convexHull([-half, half].flatMap((side) => [-9, 1].map((rise): Pair => [x + side, y + rise])));
}

/** Places on the coupler curves, in pixels. */
function curvesOf({ cycle, sizes }: Linkage, viewport: Viewport): Pair[][] {
  const row = (k: number) => Math.floor((k * cycle.values.length) / 60);
  return sizes.points.flatMap(({ at, link }) =>
    Array.from({ length: 60 }, (_, k): Pair[] => [viewport.screen(...place(cycle.rows, row(k), link, ...at))]),
  );
}

/** What wheels, blocks and the like cover, in pixels: hulls, of what is open the pieces. */
function outlinesOf({ model, pose, sizes }: Linkage, viewport: Viewport): [link: number, hull: Boxed][] {
  const solid = model.shapes.filter(({ style }) => style !== "hatch" && style !== "dead");
  return solid.flatMap((shape) => outlineOf(shape).map((hull): [number, Boxed] => [shape.link, boxed(hull)]));

  function outlineOf(shape: ShapeRecord): Pair[][] {
    const at = (x: number, y: number) => viewport.screen(...place(pose, 0, shape.link, x, y));
    if (shape.circle) {
      const [x, y, radius] = shape.circle;
      return [ringAbout([x, y], radius).map((one) => at(...one))];
    }
    return linesOf(sizes, shape).flatMap((line) => {
      const step = Math.ceil(line.length / 96);
      const few = cornersOf([line]).filter((_, k) => !(k % step));
      const places = few.map((one) => at(...one));
      return shape.closed ? [convexHull(places)] : sidesOf(places).slice(0, -1);
    });
  }
}

/** Places of a circle. */
function ringAbout(at: Pair, radius: number): Pair[] {
  return spotsAbout(at, radius).slice(0, 16);
}

export function leadersThrough(lines: readonly [Pair, Pair][]): string {
  return lines.map((line) => `${pathThrough(line)}${dotAt(line[0])}`).join("");
}

/** The end of a line on a body. */
export function dotAt([x, y]: Pair, far = 1.5): string {
  const half = `a${far} ${far} 0 1 0 `;
  return `M${(x - far).toFixed(1)} ${y.toFixed(1)}${half}${2 * far} 0${half}${-2 * far} 0`;
}
