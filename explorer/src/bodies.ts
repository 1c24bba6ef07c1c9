/** The bodies of links in SVG: bars and plates, rails and blocks, cylinders. */

import { type Cycle, DEGREE } from "./cycle";
import { isFace, type Stem, stemOf } from "./followers";
import { BOX, HATCH, RAIL, railOf } from "./ground";
import { away, convexHull, middleOf, pathThrough } from "./hull";
import type { Rows } from "./kernel";
import type { Linkage } from "./linkage";
import { direction, type Pair } from "./rows";
import { linesOf } from "./shapes";

/** A line on its link and how far its partners travel along it. */
interface Band {
  x: number;
  y: number;
  c: number;
  s: number;
  low: number;
  high: number;
}

/** An element of the picture: its tag and its attributes, the same ones for all of a tag. */
type Drawn = [tag: "circle" | "path" | "rect", attributes: Record<string, string | number>];

export const SLOT = ["slot-outline", "slot"];
export const ROD = ["rod-outline", "rod"];
const SLOT_SIDE = 9; // pixels from the middle of a pin to the rail beside it
const BARREL = 0.86; // of a cylinder that is drawn in as far as it goes
const SEEN = 0.4; // of a rod beyond the round end of its barrel
const STROKE = 1.75; // of a cylinder drawn out to drawn in: barrel and rod have room in each other
const STEM = 8; // from the middle of a stem to the rail beside it
const FACE = 8; // from a face to the end of its stem, within its plate
const ROOM = 26; // pixels that a bar or a rail reaches beyond the middle of a block
const BEYOND = 1.2; // the same for a shape, in halves of its length
const FEW_ROWS = 60; // of a cycle: enough for its extent

export class Bodies {
  readonly #bands: ReadonlyMap<number, Band>;
  /** Of links that a cam pushes along a slide of the frame. */
  readonly #stems = new Map<number, Stem>();
  readonly #linkage: Linkage;
  /** Pixels a unit of length. */
  readonly #scale: number;
  /** Of links that are a barrel or a rod the path of it in the pose that is shown. */
  readonly stretched = new Map<number, () => string>();

  /** The ends of the rails that were drawn, in pixels from the origin of the frame. */
  readonly rails: Pair[][] = [];

  constructor(linkage: Linkage, scale: number) {
    this.#linkage = linkage;
    this.#scale = scale;
    this.#bands = bandsOf(linkage);
    for (const link of linkage.model.links.keys()) {
      const stem = stemOf(linkage, link);
      if (stem) this.#stems.set(link, stem);
    }
  }

  /** What is drawn of a link, in its own coordinates. */
  of(link: number): Drawn[] {
    const { model, sizes } = this.#linkage;
    if (link >= model.own) return [];
    const out = this.#shapesOf(link);
    const nodes: Pair[] = [];
    const guides: number[] = [];
    const mine = sizes.elementsOn(link);
    for (const k of mine) {
      if (sizes.is(k, "pin")) nodes.push(sizes.xy(k));
      else if (sizes.is(k, "line") && this.#addLine(k, out, nodes)) guides.push(k);
    }
    if (link === model.frame) return out;
    for (const point of sizes.points) if (point.link === link) nodes.push(point.at);
    for (const k of mine) if (sizes.is(k, "round")) nodes.push(sizes.xy(k));
    // a guide is joined to the rest where it is nearest
    for (const k of guides) {
      const { x, y, c, s, low, high } = this.#bands.get(k)!;
      const [u, v] = middleOf(nodes);
      const room = ROOM / this.#scale;
      const way = Math.min(Math.max(c * (u - x) + s * (v - y), low - room), high + room);
      nodes.push([x + c * way, y + s * way]);
    }
    const hull = convexHull(nodes);
    if (hull.length > 1) {
      const closed = hull.length > 2;
      const d = this.#through(hull) + (closed ? "Z" : "");
      const wide = closed ? " plate" : "";
      out.unshift(["path", { class: `outline${wide}`, d }]);
      out.splice(this.#stems.has(link) ? out.length : 1, 0, ["path", { class: `bar${wide}`, d }]);
    }
    // a plate and its rod are one body
    const outlined = ([, { class: name }]: Drawn) => +/outline/.test(String(name));
    return out.sort((one, other) => outlined(other) - outlined(one));
  }

  #px(value: number): string {
    return (value * this.#scale).toFixed(2);
  }

  #through(places: readonly Pair[]): string {
    return pathThrough(this.#pixels(places));
  }

  #pixels(places: readonly Pair[]): Pair[] {
    return places.map(([x, y]) => [x * this.#scale, -y * this.#scale]);
  }

  #place(x: number, y: number): string {
    return `${this.#px(x)} ${this.#px(-y)}`;
  }

  #shapesOf(link: number): Drawn[] {
    const { model, sizes } = this.#linkage;
    const out: Drawn[] = [];
    for (const shape of model.shapes) {
      if (shape.link !== link) continue;
      if (this.#stems.has(link) && !shape.closed) continue; // rods of where its guide is drawn elsewhere
      const style = shape.style === "block" ? "block" : `shape ${shape.style}`;
      if (shape.circle) {
        const [x, y, r] = shape.circle;
        out.push(["circle", { class: style, cx: this.#px(x), cy: this.#px(-y), r: this.#px(r) }]);
      }
      // one path, so that a ring is filled between its two lines
      let d = "";
      for (const line of linesOf(sizes, shape)) {
        for (let k = 0; k + 1 < line.length; k += 2) d += `${k ? "L" : "M"}${this.#place(line[k]!, line[k + 1]!)}`;
        if (shape.closed) d += "Z";
      }
      if (d) out.push(["path", { class: shape.closed ? style : `${style} open`, d }]);
    }
    return out;
  }

  /** Draw the line of a slide: a cylinder, rails, a bar or a block; add the places that the body reaches to. Returns
   * whether it is the bar of a link that moves. */
  #addLine(k: number, out: Drawn[], nodes: Pair[]): boolean {
    const linkage = this.#linkage;
    const { model, sizes } = linkage;
    const { link } = sizes.element(k);
    const cylinder = this.#cylinder(k);
    if (cylinder) {
      out.push(...cylinder);
      return false;
    }
    const stem = this.#stems.get(link);
    if (stem) {
      const { foot, top } = stem;
      const [dx, dy] = [top[0] - foot[0], top[1] - foot[1]];
      const plated = sizes.elementsOn(link).every((m) => !sizes.is(m, "pin"));
      const part = plated ? FACE / this.#scale / Math.hypot(dx, dy) : 0;
      nodes.push([foot[0] + part * dx, foot[1] + part * dy], top);
      return false;
    }
    if (isFace(linkage, k)) return false; // it has an outline
    const ends = this.#ends(k);
    if (!ends) {
      const here = sizes.xy(k);
      nodes.push(here);
      if (this.#sliding(k)) return false; // it has a shape of its own
      const turn = `rotate(${-sizes.angles[k]! / DEGREE})`;
      const transform = `translate(${this.#place(...here)}) ${turn}`;
      out.push(["path", { class: "block", d: BOX, transform }]);
      return false;
    }
    const frame = link === model.frame;
    if (frame) out.push(...this.#rails(k, ends));
    else for (const style of this.#pinned(k) ? SLOT : ROD) out.push(this.#stroke(style, ends));
    return !frame;
  }

  /** Rails of the frame: a block stands on one, so that what is hinged to it swings freely; between two go pins, and
   * blocks with a shape of their own. */
  #rails(k: number, ends: [Pair, Pair]): Drawn[] {
    const [, wide] = this.#sliding(k) ?? [];
    const block = this.#pinned(k) ? SLOT_SIDE : RAIL;
    const along = wide ? wide * this.#scale + 2 : block;
    const half = this.#stemOn(k) ? STEM : along;
    const sides = half === RAIL ? [1] : [1, -1];
    return sides.flatMap((side) => {
      const [rail, hatch] = [half, half + HATCH].map((off) => railOf(ends, (side * off) / this.#scale));
      this.rails.push(this.#pixels(hatch!));
      return [this.#stroke("rail", rail!), this.#stroke("rail-hatch", hatch!)];
    });
  }

  /** The stem that slides along a line of the frame. */
  #stemOn(line: number): Stem | undefined {
    const { model, sizes } = this.#linkage;
    const { joint, link } = sizes.element(line);
    const others = model.joints[joint]!.links.filter((one) => one !== link);
    return link === model.frame ? this.#stems.get(others[0]!) : undefined;
  }

  /** Half the length and half the width of the shape that slides along a line; none of a block. */
  #sliding(line: number): Pair | undefined {
    const { model, sizes } = this.#linkage;
    return model.joints[sizes.element(line).joint]!.sliding;
  }

  #stroke(name: string, ends: readonly Pair[]): Drawn {
    return ["path", { class: name, d: this.#through(ends) }];
  }

  /** The ends of rods and slots that move, each with its link. */
  get rods(): [link: number, at: Pair][] {
    const { model, sizes } = this.#linkage;
    return [...this.#bands.keys()]
      .flatMap((k) => {
        const { link } = sizes.element(k);
        const ends = link === model.frame || link >= model.own || this.#cylinder(k) ? null : this.#ends(k);
        return (ends ?? []).map((at): [number, Pair] => [link, at]);
      })
      .concat(
        [...this.#stems].flatMap(([link, { guide, top }]): [number, Pair][] => [
          [link, top],
          [model.frame, guide[1]],
        ]),
      );
  }

  /** Where what slides on a line begins and ends; null for a block, whose partner bears that. */
  #ends(k: number): [Pair, Pair] | null {
    const { model, sizes } = this.#linkage;
    const { joint, link } = sizes.element(k);
    const frame = link === model.frame;
    if (!frame && !this.#pinned(k) && model.joints[joint]!.guide !== link) return null;
    const stem = this.#stemOn(k);
    if (stem) return stem.guide;
    const { x, y, c, s, low, high } = this.#bands.get(k)!;
    const [long = 0] = (frame && this.#sliding(k)) || [];
    const room = BEYOND * long || ROOM / this.#scale;
    return [low - room, high + room].map((way) => [x + c * way, y + s * way]) as [Pair, Pair];
  }

  /** Whether a pin slides along a line. */
  #pinned(line: number): boolean {
    const { sizes } = this.#linkage;
    return sizes.elementsOf(sizes.element(line).joint).some((m) => m !== line && sizes.is(m, "pin"));
  }

  /** A cylinder's barrel, or its rod, from its pin towards the other; null if the slide is no cylinder. */
  #cylinder(k: number): Drawn[] | null {
    const linkage = this.#linkage;
    const { sizes } = linkage;
    const { joint, link } = sizes.element(k);
    const found = cylinderOf(linkage, joint);
    if (!found) return null;
    const { ends, near, far } = found;
    const barrel = sizes.elementsOf(joint)[0] === k;
    const [own, other] = (barrel ? ends : [...ends].reverse()) as Pair;
    const [whole, part] = barrel ? [BARREL * near, BARREL] : [Math.min(far - 0.62 * near, 0.95 * near), 0.95];
    const path = () => {
      const [x, y] = sizes.xy(own);
      const [u, v] = linkage.toLocal(link, ...linkage.elementAt(other));
      const reach = Math.min(whole / (away([x, y], u, v) || 1), part); // drawn in farther than it can, it telescopes
      return this.#through([
        [x, y],
        [x + (u - x) * reach, y + (v - y) * reach],
      ]);
    };
    this.stretched.set(link, path);
    return (barrel ? SLOT : ROD).map((style) => ["path", { class: style, d: path() }]);
  }
}

/** Where the barrel of a cylinder ends, or some way on, where its rod is seen. */
export function mouthOf(linkage: Linkage, { ends, near }: { ends: number[]; near: number }, rod: boolean): Pair {
  const [[x, y], [u, v]] = ends.map((k) => linkage.elementAt(k)) as [Pair, Pair];
  const mouth = BARREL * Math.min(near / (away([x, y], u, v) || 1), 1);
  const reach = rod ? mouth + SEEN * (1 - mouth) : mouth;
  return [x + (u - x) * reach, y + (v - y) * reach];
}

/** The pins of a cylinder and how far they come apart, at least and at most; null if the slide is none. */
export function cylinderOf(linkage: Linkage, joint: number): { ends: number[]; near: number; far: number } | null {
  const ends = linkage.sizes.cylinder(joint)?.slice(2);
  if (!ends) return null;
  let [near, far] = [Infinity, 0];
  for (const [rows, row] of fewRows(linkage.cycle)) {
    const [one, other] = ends.map((k) => linkage.elementAt(k, rows, row)) as [Pair, Pair];
    const gap = away(one, ...other);
    if (!Number.isFinite(gap)) continue;
    near = Math.min(near, gap);
    far = Math.max(far, gap);
  }
  const meant = linkage.letterOf(joint) || linkage.model.drives.some((drive) => drive.joint === joint);
  // a rod cannot be drawn in by so much: a block on a bar
  return far > STROKE * near && !meant ? null : { ends, near: Math.max(near, far / STROKE), far };
}

/** Of a free motion those of the cycle, too, on whose guides it goes. */
function* fewRows({ rows, values, whole }: Cycle): Generator<[Rows, number]> {
  const step = Math.max(1, Math.floor(values.length / FEW_ROWS));
  for (let row = 0; row < values.length; row += step) yield [rows, row];
  if (whole) yield* fewRows(whole);
}

/** How far the partners of each line travel along it. */
function bandsOf(linkage: Linkage): Map<number, Band> {
  const { sizes } = linkage;
  const bands = new Map<number, Band>();
  linkage.model.elements.forEach((e, k) => {
    if (e.kind !== "line") return;
    const [c, s] = sizes.line(k);
    const [x, y] = sizes.xy(k);
    let [low, high] = [Infinity, -Infinity];
    const partners = sizes.elementsOf(e.joint).filter((m) => m !== k);
    for (const [rows, row] of fewRows(linkage.cycle))
      for (const m of partners) {
        const [ax, ay] = linkage.elementAt(k, rows, row);
        const [px, py] = linkage.elementAt(m, rows, row);
        const [lx, ly] = direction(rows, row, e.link, [c, s]);
        const way = lx * (px - ax) + ly * (py - ay);
        if (!Number.isFinite(way)) continue;
        low = Math.min(low, way);
        high = Math.max(high, way);
      }
    if (!(high >= low)) [low, high] = [0, 0];
    bands.set(k, { x, y, c, s, low, high });
  });
  return bands;
}
