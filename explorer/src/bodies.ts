/** The bodies of links in SVG: bars and plates, rails and blocks, cylinders. */

import { DEGREE } from "./cycle";
import { convexHull } from "./hull";
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

const FEW_ROWS = 60; // of a cycle: enough for its extent

export class Bodies {
  readonly #bands: ReadonlyMap<number, Band>;
  readonly #linkage: Linkage;
  /** Pixels a unit of length. */
  readonly #scale: number;

  constructor(linkage: Linkage, scale: number) {
    this.#linkage = linkage;
    this.#scale = scale;
    this.#bands = bandsOf(linkage);
  }

  /** What is drawn of a link, in its own coordinates. */
  of(link: number): Drawn[] {
    const { model, sizes } = this.#linkage;
    if (link >= model.own) return [];
    const out = this.#shapesOf(link);
    const nodes: Pair[] = [];
    const mine = sizes.elementsOn(link);
    for (const k of mine) {
      if (sizes.is(k, "pin")) nodes.push(sizes.xy(k));
      else if (sizes.is(k, "line")) this.#addLine(k, out, nodes);
    }
    if (link === model.frame) return out;
    for (const point of sizes.points) if (point.link === link) nodes.push(point.at);
    for (const k of mine) if (sizes.is(k, "round")) nodes.push(sizes.xy(k));
    const hull = convexHull(nodes);
    if (hull.length > 1) {
      const closed = hull.length > 2;
      const d = hull.map(([x, y], k) => `${k ? "L" : "M"}${this.#place(x, y)}`).join("") + (closed ? "Z" : "");
      const wide = closed ? " plate" : "";
      out.unshift(["path", { class: `outline${wide}`, d }], ["path", { class: `bar${wide}`, d }]);
    }
    return out;
  }

  #px(value: number): string {
    return (value * this.#scale).toFixed(2);
  }

  #place(x: number, y: number): string {
    return `${this.#px(x)} ${this.#px(-y)}`;
  }

  #shapesOf(link: number): Drawn[] {
    const { model, sizes } = this.#linkage;
    const out: Drawn[] = [];
    for (const shape of model.shapes) {
      if (shape.link !== link) continue;
      const style = `shape ${shape.style}`;
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

  /** Draw the line of a slide: a cylinder, a rail, a bar or a block; add the places that the body reaches to. */
  #addLine(k: number, out: Drawn[], nodes: Pair[]): void {
    const { model, sizes } = this.#linkage;
    const { joint, link } = sizes.element(k);
    const cylinder = this.#cylinder(k);
    if (cylinder) {
      out.push(...cylinder);
      return;
    }
    const frame = link === model.frame;
    const band = this.#bands.get(k)!;
    const pinned = sizes.elementsOf(joint).some((m) => m !== k && sizes.is(m, "pin"));
    if (!frame && !pinned && !this.#carries(link, joint)) {
      const here = sizes.xy(k);
      const turn = `rotate(${-sizes.angles[k]! / DEGREE})`;
      const transform = `translate(${this.#place(...here)}) ${turn}`;
      out.push(["rect", { class: "block", x: -15, y: -9, width: 30, height: 18, rx: 3, transform }]);
      nodes.push(here);
      return;
    }
    const room = 26 / this.#scale;
    const pins = frame ? [] : this.#pinsAlong(k, band);
    const at = (way: number): Pair => [band.x + band.c * way, band.y + band.s * way];
    const from = Math.min(band.low - room, ...pins);
    const to = Math.max(band.high + room, ...pins);
    const d = `M${this.#place(...at(from))}L${this.#place(...at(to))}`;
    let styles = pinned ? ["slot-outline", "slot"] : ["rod-outline", "rod"];
    if (frame) styles = ["rail", "rail-hatch"];
    for (const style of styles) out.push(["path", { class: style, d }]);
    if (frame || pins.length) return;
    nodes.push(at((band.low + band.high) / 2));
  }

  /** Where along a line the pins of its link lie that are on it. */
  #pinsAlong(line: number, { x, y, c, s }: Band): number[] {
    const { sizes } = this.#linkage;
    return sizes
      .elementsOn(sizes.element(line).link)
      .filter((m) => sizes.is(m, "pin"))
      .map((m) => sizes.xy(m))
      .filter((at) => Math.abs(sizes.leftOf(line, ...at)) < 1e-6 * sizes.unit)
      .map(([u, v]) => c * (u - x) + s * (v - y));
  }

  /** Whether of the two links of a slide this one has the bar: the frame, the one with more joints and points;
   * of equal ones that which is not called a block, as in pictures of the library. */
  #carries(link: number, joint: number): boolean {
    const { model, sizes } = this.#linkage;
    const [one, two] = model.joints[joint]!.links as Pair;
    const called = (k: number) => /block|slider|piston|stein|kolben/i.test(model.links[k]!); // a block
    const carried = (k: number) => sizes.elementsOn(k).length + sizes.points.filter((point) => point.link === k).length;
    const rank = (k: number) => (k === model.frame ? 100 : 0) + 2 * carried(k) - Number(called(k));
    return link === (rank(one) < rank(two) ? two : one);
  }

  /** A cylinder's barrel, or its rod, from its pin towards the other; null if the slide is no cylinder. */
  #cylinder(k: number): Drawn[] | null {
    const linkage = this.#linkage;
    const { sizes } = linkage;
    const { joint, link } = sizes.element(k);
    const found = sizes.cylinder(joint);
    if (!found) return null;
    const [one, , pinOne, pinTwo] = found;
    const barrel = one === k;
    const [own, other] = barrel ? [pinOne, pinTwo] : [pinTwo, pinOne];
    const { rows, values } = linkage.cycle;
    let [near, far] = [Infinity, 0];
    for (const row of fewRows(values.length)) {
      const [ax, ay] = linkage.elementAt(own, rows, row);
      const [bx, by] = linkage.elementAt(other, rows, row);
      const gap = Math.hypot(bx - ax, by - ay);
      if (!Number.isFinite(gap)) continue;
      near = Math.min(near, gap);
      far = Math.max(far, gap);
    }
    if (far > 1.9 * near) return null; // a rod cannot be drawn in by so much: a block on a bar
    const [u, v] = linkage.toLocal(link, ...linkage.elementAt(other));
    const [x, y] = sizes.xy(own);
    const length = Math.hypot(u - x, v - y) || 1;
    const reach = barrel ? 0.86 * near : Math.min(far - 0.62 * near, 0.95 * near);
    const end = this.#place(x + ((u - x) / length) * reach, y + ((v - y) / length) * reach);
    const styles = barrel ? ["slot-outline", "slot"] : ["rod-outline", "rod"];
    return styles.map((style) => ["path", { class: style, d: `M${this.#place(x, y)}L${end}` }]);
  }
}

function* fewRows(count: number): Generator<number> {
  const step = Math.max(1, Math.floor(count / FEW_ROWS));
  for (let row = 0; row < count; row += step) yield row;
}

/** How far the partners of each line travel along it. */
function bandsOf(linkage: Linkage): Map<number, Band> {
  const { sizes } = linkage;
  const { rows, values } = linkage.cycle;
  const bands = new Map<number, Band>();
  linkage.model.elements.forEach((e, k) => {
    if (e.kind !== "line") return;
    const [c, s] = sizes.line(k);
    const [x, y] = sizes.xy(k);
    let [low, high] = [Infinity, -Infinity];
    const partners = sizes.elementsOf(e.joint).filter((m) => m !== k);
    for (const row of fewRows(values.length))
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
