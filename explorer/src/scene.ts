/** The SVG of the picture: links, joints, points, names, vectors. */

import { backdropElement, putBackdrop } from "./backdrop";
import { Bodies } from "./bodies";
import { put, renew, svg } from "./dom";
import type { Dragging } from "./dragging";
import type { Arrow } from "./forces";
import { DRIVEN, DRIVING, placed, STANDING, SUPPORT } from "./ground";
import { away, convexHull, pathThrough, spotsAbout, toHull } from "./hull";
import { pastEdges } from "./labels";
import { number as numberText } from "./language";
import type { Legend } from "./legend";
import type { Linkage } from "./linkage";
import { pole, wayEnds } from "./measures";
import { halfOf } from "./names";
import { type Around, dotAt, lettersAt, Naming } from "./naming";
import { type Push, pushOf } from "./pushed";
import { oneRow, origin, type Pair, place, turn } from "./rows";
import { readingsOf } from "./rulers";
import { ownColour, type Shown } from "./shown";
import { springLines } from "./springs";
import type { Viewport } from "./viewport";
import { rateUnit } from "./wording";

const LONGEST_ARROW = 90; // pixels
const LEAST_ARROW = 24; // pixels
const EDGE = 6; // from the end of an arrow to that of the picture
const BESIDE = 14; // pixels from the end of an arrow to its number
const RING = 6; // the radius of a target
const RAIL = 6; // half the width of a rail with its hatching, and some room
const CLEAR = 10; // pixels about a text in which nothing else is
const POSES = 24; // of a cycle, in which names must have places

export class Scene {
  #links: SVGGElement[] = [];
  /** Where those that move lie, and which of them over which. */
  #bodies!: SVGElement;
  #order = "";
  /** Barrels and rods of cylinders, with what their paths are in a pose. */
  #stretched: [SVGElement, () => string][] = [];
  /** The ends of the rails of the frame, in pixels from its origin. */
  #rails: Pair[][] = [];
  /** The length of the longest arrow; 0 until it is found. */
  #longest = 0;
  #pins: { element: SVGGElement; joint: number }[] = [];
  /** Arrows of slides that are driven. */
  readonly #pushes = svg("g", {});
  #pushed: [SVGElement, (viewport: Viewport) => Push][] = [];
  #marks: { element: SVGGElement; point: number }[] = [];
  readonly #names: Naming;
  #backdrop: SVGElement | null = null;
  /** Whether the pole is to be shown but lies outside of the picture. */
  poleAside = false;
  readonly #arrows = (["force", "force.load", "velocity", "acceleration"] as const).map((kind) =>
    svg(`path.${kind}`, {}),
  );
  /** Over them the chosen one. */
  readonly #thick = svg("path.force", {});
  /** Beside arrows, how much they are, or their signs; which places they took. */
  readonly #values = svg("g", {});
  readonly #beside: number[] = [];
  readonly #springs = svg("path.spring-path", {});
  readonly #rulers = svg("path.ruler", { fill: "var(--accent)" });
  readonly #circle = svg("circle.inflection", { r: 0 });
  readonly #pole = svg("circle.pole", { r: 4 });

  constructor(
    private readonly root: SVGSVGElement,
    /** Where bodies are drawn, below the curves. */
    private readonly under: SVGSVGElement,
    private readonly viewport: Viewport,
    private readonly keys: Record<"joint" | "point", (event: KeyboardEvent, number: number) => void>,
    legend: Legend,
  ) {
    this.#names = new Naming(viewport, legend);
    this.#thick.style.strokeWidth = "3.8";
  }

  /** Whether names of links stand in a list. */
  get listed(): boolean {
    return this.#names.legend.listed;
  }

  /** The joints that are drawn. */
  get joints(): number[] {
    return this.#pins.map(({ joint }) => joint);
  }

  /** Names look for their best places, wherever they stood while it moved. */
  settle(): void {
    this.#names.settle();
  }

  /** Choose between names of links and numbers; how high the list of names is then. */
  choose(linkage: Linkage, shown: Shown): number {
    return shown.labels
      ? this.#names.choose(linkage, () => this.poses(linkage, () => this.#around(linkage, shown, [], [])))
      : 0;
  }

  /** What is found in poses all along the cycle, of values of the drive. */
  private *poses<Found>(linkage: Linkage, found: (value: number) => Found): Generator<Found> {
    const { cycle, pose } = linkage;
    const step = Math.ceil(cycle.values.length / POSES);
    try {
      for (let row = 0; row < cycle.values.length; row += step) {
        linkage.pose = oneRow(cycle.rows, row);
        yield found(cycle.values[row]!);
      }
    } finally {
      linkage.pose = pose;
    }
  }

  /** Find how long the longest arrow may be, so that in all poses they stay in a picture that shows everything. */
  #measure(linkage: Linkage, shown: Shown): void {
    const { fitted, height } = this.viewport;
    this.#longest = Math.min(LONGEST_ARROW, height / 4);
    if (!fitted) return;
    for (const arrows of this.poses(linkage, (value) => this.#vectors(linkage, shown, value).flat()))
      for (const one of arrows) {
        const out = () => {
          const [x, y, dx, dy] = this.#scaled(...one);
          const [u, v] = [x + dx, y + dy];
          return Math.min(u, v, height - v, this.viewport.right(v) - u) < EDGE;
        };
        while (this.#longest > LEAST_ARROW && out()) this.#longest--;
      }
  }

  /** Give one link a class, or none. */
  mark(marked: number | null, name: "chosen" | "hovered"): void {
    for (const [link, { classList }] of this.#links.entries()) classList.toggle(name, link === marked);
    const shown = [...this.#links.keys()].filter((link) => /chosen|hovered/.test(this.#links[link]!.classList.value));
    this.#names.legend.mark(shown);
  }

  focus(joint: number): void {
    this.#pins.find((pin) => pin.joint === joint)?.element.focus({ preventScroll: true });
  }

  // --- the parts -----------------------------------------------------------------------------------------------------

  /** Make the elements anew: after another linkage, another point, other options. */
  build(linkage: Linkage, dragging: Dragging, shown: Shown): void {
    const { model, sizes } = linkage;
    const [back, bodies, marks, front] = ["back", "bodies", "marks", "front"].map((name) =>
      svg("g", { class: name }),
    ) as [SVGGElement, SVGGElement, SVGGElement, SVGGElement];
    this.#bodies = bodies;
    this.#links = model.links.map((name, link) => {
      const group = svg("g", { class: link === model.frame ? "link ground" : "link", "data-link": name });
      return group;
    });
    back.append(this.#links[model.frame]!);
    this.#order = "";
    this.#pins = [...model.joints.keys()]
      .filter((joint) => sizes.elementsOf(joint).some((k) => sizes.is(k, "pin")))
      .map((joint) => ({ element: this.#pin(linkage, joint, dragging), joint }));
    front.append(...this.#pins.map(({ element }) => element));
    this.#marks = sizes.points.map(({ name }, number) => {
      const element = svg(
        "g.coupler-point",
        {
          "data-mark": name,
          tabindex: 0,
          role: "button",
          "aria-label": linkage.pointName(name),
          onkeydown: (event: KeyboardEvent) => this.keys.point(event, number),
        },
        svg("circle.halo", { r: 13 }),
        svg("circle.dot", { r: 4.2 }),
      );
      element.style.setProperty("--own", `var(${ownColour(number)})`);
      marks.append(element);
      return { element, point: number };
    });
    front.append(
      this.#pushes,
      this.#names.element,
      ...this.#arrows,
      this.#thick,
      this.#values,
      this.#springs,
      this.#rulers,
      this.#circle,
      this.#pole,
    );
    this.#names.build(linkage, shown.labels);
    const { picture } = linkage.beside;
    this.#backdrop = picture ? backdropElement(picture) : null;
    renew(this.under, ...(this.#backdrop ? [this.#backdrop] : []), back, bodies);
    renew(this.root, marks, front);
  }

  #pin(linkage: Linkage, number: number, dragging: Dragging): SVGGElement {
    const { model } = linkage;
    const joint = model.joints[number]!;
    const held = dragging.locks.held.has(number);
    const free = held || dragging.draggable(number);
    const ground = joint.links.includes(model.frame) && joint.pair.turning;
    const element = svg("g", {
      class: `pin${free ? " free" : ""}${held ? " held" : ""}`,
      "data-joint": joint.name,
      tabindex: free ? 0 : -1,
      role: free ? "button" : "img",
      "aria-label": linkage.jointName(joint.name),
      "aria-pressed": free ? String(held) : null,
      onkeydown: (event: KeyboardEvent) => this.keys.joint(event, number),
    });
    const transform = `rotate(${model.bearings[number]})`;
    if (ground) element.append(svg("path.support", { d: SUPPORT, transform }));
    element.append(svg("circle.halo", { r: 13 }), svg("circle.joint", { r: ground ? 5.5 : 4.6 }));
    if (model.drives.some((drive) => drive.turning && drive.joint === number))
      element.append(
        svg("path.driven", { d: DRIVEN, transform: transform + (linkage.beside.backward ? " scale(-1 1)" : "") }),
      );
    return element;
  }

  /** Draw the bodies of the links and find where their names stand on them, after their sizes or the scale changed. */
  sized(linkage: Linkage): void {
    this.#names.sized();
    this.#longest = 0;
    const { frame } = linkage.model;
    const bodies = new Bodies(linkage, this.viewport.scale);
    this.#stretched = [];
    for (const [link, group] of this.#links.entries()) {
      const made = bodies.of(link);
      while (group.childElementCount > made.length) group.lastChild!.remove();
      made.forEach(([tag, attributes], k) => {
        const old = group.children[k];
        if (old?.tagName === tag)
          put(old, attributes); // most links stay as they are
        else if (old) old.replaceWith(svg(tag, attributes));
        else group.append(svg(tag, attributes));
      });
      const path = bodies.stretched.get(link);
      if (path)
        for (const part of group.querySelectorAll<SVGElement>("[class^=slot],[class^=rod]"))
          this.#stretched.push([part, path]);
    }
    this.#rails = bodies.rails;
    this.#pushed = linkage.model.drives.flatMap(({ joint, turning }): [SVGElement, (viewport: Viewport) => Push][] => {
      if (turning) return [];
      const [d, at] = pushOf(linkage, joint);
      return [[svg("path.driven", { d }), at]];
    });
    this.#pushes.replaceChildren(...this.#pushed.map(([element]) => element));
    // plates first; a bar with a joint between others goes on over what ends there, a barrel over its rod
    const has = (link: number, what: string) => !!this.#links[link]!.querySelector(what);
    const rank = (link: number) =>
      (has(link, ".plate,.shape:not(.open)") ? 0 : 99) +
      linkage.sizes.elementsOn(link).length +
      +(bodies.stretched.has(link) && has(link, ".slot"));
    const order = [...this.#links.keys()]
      .filter((link) => link !== frame)
      .sort((one, other) => rank(one) - rank(other));
    if (order.join() === this.#order) return;
    this.#order = order.join();
    for (const link of order) this.#bodies.append(this.#links[link]!);
  }

  // --- the pose ------------------------------------------------------------------------------------------------------

  /** Put everything where the pose has it. */
  draw(linkage: Linkage, shown: Shown): void {
    const { pose, sizes } = linkage;
    const { viewport } = this;
    this.#links.forEach((group, link) => {
      const [c, s] = turn(pose, 0, link);
      const [x, y] = viewport.screen(...origin(pose, 0, link));
      const [cosine, minus, sine] = [c.toFixed(6), (-s).toFixed(6), s.toFixed(6)];
      put(group, { transform: `matrix(${cosine} ${minus} ${sine} ${cosine} ${x.toFixed(2)} ${y.toFixed(2)})` });
    });
    for (const [part, path] of this.#stretched) put(part, { d: path() });
    if (this.#backdrop && linkage.beside.picture) putBackdrop(this.#backdrop, linkage.beside.picture, viewport);
    const pixels = (joint: number) => viewport.screen(...linkage.jointAt(joint));
    for (const { element, joint } of this.#pins) move(element, pixels(joint));
    for (const { element, point } of this.#marks) {
      const record = sizes.points[point];
      if (record) move(element, viewport.screen(...place(pose, 0, record.link, ...record.at)));
    }
    for (const [element, at] of this.#pushed) put(element, { transform: at(viewport).transform });
    const visibility = linkage.cycle.whole ? "hidden" : "inherit"; // nothing drives a free motion
    for (const one of this.root.querySelectorAll(".driven")) put(one, { visibility });
    if (!this.#longest) this.#measure(linkage, shown);
    const kinds = this.#vectors(linkage, shown).map((all) => all.map((one) => this.#scaled(...one)));
    const springs = shown.springs(linkage).map((spring) => springLines(linkage, viewport, spring));
    const hung = springs.map((parts) => parts.flat()).filter((all) => all[0]);
    const covered = this.#names.place(linkage, this.#around(linkage, shown, kinds, hung));
    kinds.forEach((all, k) => {
      put(this.#arrows[k]!, { d: all.map((one) => arrow(...one)).join("") });
    });
    const chosen = kinds[0]!.find((one) => one[7]);
    put(this.#thick, { d: chosen ? arrow(...chosen) + dotAt(rootOf(chosen), 2 * RING) : "" }); // however short it is
    // a number may stand upon a plate, but not across its edges or on a pin
    const pins = this.#pins.map(({ joint }) => {
      const [x, y] = pixels(joint);
      return lettersAt(x, y + 4, RING);
    });
    this.#putValues(kinds, [...covered, ...pins, ...pastEdges(viewport.width, viewport.height)]);
    const rings = hung.flatMap((all) => [all[0]!, all.at(-1)!]).map((at) => dotAt(at, 3));
    put(this.#springs, { d: [...springs.flat().map(pathThrough), ...rings].join("") });
    const lines: Pair[][] = readingsOf(linkage).map(({ ends }) => ends);
    const way = shown.way ? wayEnds(linkage) : [];
    const rulers = [...lines, way].map((ends) => pathThrough(ends.map((at) => viewport.screen(...at))));
    rulers.push(...way.slice(0, 1).map((at) => dotAt(viewport.screen(...at), 4)));
    put(this.#rulers, { d: rulers.join("") });
    this.#drawPole(linkage, shown);
  }

  /** What is drawn beside the bodies, of which names keep clear. */
  #around(linkage: Linkage, { curves }: Shown, kinds: Arrow[][], springs: Pair[][]): Around {
    const { model, pose } = linkage;
    const { viewport } = this;
    const pixels = (joint: number) => viewport.screen(...linkage.jointAt(joint));
    const arrows = kinds.flatMap((all) =>
      all.map(([x, y, dx, dy]): Pair[] => [
        [x, y],
        [x + dx, y + dy],
      ]),
    );
    arrows.push(...springs.map(convexHull));
    const grounds = this.#pins
      .filter(({ joint }) => model.joints[joint]!.links.includes(model.frame))
      .map(({ joint }) => placed(STANDING, pixels(joint), model.bearings[joint]));
    const turned = model.drives.filter(({ turning }) => turning);
    grounds.push(...turned.map(({ joint }) => placed(DRIVING, pixels(joint), model.bearings[joint])));
    for (const [, at] of this.#pushed) if (at(viewport).covers[0]) grounds.push(at(viewport).covers);
    for (const [x, y] of linkage.beside.targets ?? []) {
      const [u, v] = viewport.screen(x, y);
      grounds.push([-RING, RING].map((d): Pair => [u + d, v]));
    }
    const [c, s] = turn(pose, 0, model.frame);
    const [ox, oy] = viewport.screen(...origin(pose, 0, model.frame));
    const fixed = (x: number, y: number): Pair => [ox + c * x + s * y, oy - s * x + c * y];
    for (const ends of this.#rails)
      grounds.push(
        convexHull(ends.flatMap(([x, y]) => [-RAIL, RAIL].flatMap((d) => [fixed(x + d, y + d), fixed(x + d, y - d)]))),
      );
    const joints = this.#pins.map(({ joint }) => pixels(joint));
    const forces = viewport.height < 300 && kinds.slice(0, 2).some((all) => all.length);
    return { arrows, grounds, joints, curves, forces };
  }

  /** An arrow in pixels; of a moment its circle reaches so far to the right, if it is positive, or to the left. */
  #scaled(...[x, y, dx, dy, amount, unit, sign = null, chosen]: Arrow): Arrow {
    const long = unit.includes("N·m") ? this.#longest / 3 : this.#longest;
    const [left, top] = this.viewport.screen(x, y);
    const [right, down] = [long * dx, -long * dy];
    const off = sign ? RING / (Math.hypot(right, down) || 1) : 0; // that of a joint begins at the rim of its ring
    return [left + off * right, top + off * down, right, down, amount, unit, sign, !!chosen];
  }

  /** Forces of joints, loads, velocities, accelerations; forces where the drive is, or at another value of it. */
  #vectors(linkage: Linkage, { accelerations, forces, velocities }: Shown, drive?: number): Arrow[][] {
    const all = forces(drive);
    const [joints, loads] = [all.filter((one) => one[6]), all.filter((one) => !one[6])];
    return [joints, loads, this.#rates(linkage, 1, velocities), this.#rates(linkage, 2, accelerations)];
  }

  /** Velocities (1) or accelerations (2) of all joints and points that move. */
  #rates(linkage: Linkage, k: 1 | 2, wanted: boolean): Arrow[] {
    if (!wanted) return [];
    const { model, pose, sizes } = linkage;
    const places: Arrow[] = [];
    const add = (link: number, u: number, v: number) => {
      const [dx, dy] = place(pose, 0, link, u, v, k);
      places.push([...place(pose, 0, link, u, v), dx, dy, Math.hypot(dx, dy), rateUnit(linkage, k, false)]);
    };
    model.joints.forEach((joint, number) => {
      if (joint.links.includes(model.frame) && joint.pair.turning) return;
      const moves = (e: number) => sizes.element(e).link !== model.frame && !sizes.is(e, "round");
      const element = sizes.elementsOf(number).find(moves);
      if (element !== undefined) add(sizes.element(element).link, ...sizes.xy(element));
    });
    for (const point of sizes.points) add(point.link, ...point.at);
    const most = Math.max(...places.map((one) => one[4]).filter(Number.isFinite), 1e-12);
    return places.map(([x, y, dx, dy, ...more]): Arrow => [x, y, dx / most, dy / most, ...more]);
  }

  /** Beside the tips of arrows: of loads, and of the longest of each other kind how much they are; of joint forces their
   * signs, with which they are listed, of the chosen one both. The longest texts choose first. */
  #putValues(kinds: Arrow[][], drawn: (readonly Pair[])[]): void {
    const texts: Element[] = [];
    const tips = kinds.flat().filter((one) => one[7] || arrow(...one));
    const long = ([, , dx, dy]: Arrow) => Math.hypot(dx, dy);
    const longest = kinds.slice(2).flatMap((all) => [...all].sort((one, other) => long(other) - long(one)).slice(0, 1));
    const joints = [...kinds[0]!].sort((one, other) => +!!other[7] - +!!one[7]);
    for (const [n, one] of [...kinds[1]!, ...longest, ...joints].entries()) {
      const [x, y, dx, dy, amount, unit, sign, chosen] = one;
      if (!tips.includes(one)) continue;
      const told = sign && !chosen ? "" : `${numberText(amount, 3)} ${unit}`;
      const said = `${sign ?? ""} ${told}`.trim();
      const half = halfOf(said);
      const parts = Math.ceil(half / CLEAR);
      const tip: Pair = [x + dx, y + dy];
      const near = drawn.filter((hull) => toHull(hull, ...tip) < 3 * BESIDE + 2 * half);
      const apart = (at: Pair, [u, v, du, dv]: Arrow) => away(at, u + du, v + dv);
      const spots = spotsAbout(tip, BESIDE, half, Math.atan2(dy, dx));
      const before = this.#beside[n] ?? 0;
      let [taken, most] = [before, -Infinity];
      for (const k of [before, ...spots.keys()]) {
        const at = spots[k]!;
        const [left, top] = at;
        const astray = tips.some((other) => apart(at, other) < apart(at, one) - CLEAR);
        const same = k === before ? 2 : 0; // it jumps less
        const more = same - (k >> 4) * 4 - (astray ? 2 * CLEAR : 0);
        let [lines, solid] = [CLEAR, CLEAR];
        for (const hull of near) {
          for (let d = -half; d <= half; d += half / parts) {
            const gap = toHull(hull, left + d, top);
            if (hull[2]) solid = Math.min(solid, gap);
            else lines = Math.min(lines, gap); // may lie below it if need be
          }
        }
        const value = 4 * solid + lines + more;
        if (value > most) [taken, most] = [k, value];
        if (most >= 5 * CLEAR) break; // none is better
      }
      this.#beside[n] = taken;
      if (sign && !chosen && most < CLEAR) continue; // the list tells which it is once its row is chosen
      const [left, top] = spots[taken]!;
      texts.push(svg("text", { "data-arrow": "", "text-anchor": "middle", x: left, y: top + 4 }, said));
      drawn.push(lettersAt(left, top + 4, half));
    }
    this.#values.replaceChildren(...texts);
  }

  #drawPole(linkage: Linkage, shown: Shown): void {
    const { viewport } = this;
    const found = shown.poles || shown.inflection ? pole(linkage, linkage.pose, 0, shown.link) : null;
    put(this.#pole, { r: found ? 4 : 0 });
    this.poleAside = false;
    put(this.#circle, { r: 0 });
    if (!found) return;
    const [x, y] = viewport.screen(found.x, found.y);
    this.poleAside = !(Math.min(x, y, viewport.width - x, viewport.height - y) >= 0);
    put(this.#pole, { cx: x.toFixed(1), cy: y.toFixed(1) });
    const radius = (Math.hypot(found.dx, found.dy) / 2) * viewport.scale;
    if (!shown.inflection || !(radius < 1e5)) return;
    const [cx, cy] = viewport.screen(found.x + found.dx / 2, found.y + found.dy / 2);
    put(this.#circle, { cx: cx.toFixed(1), cy: cy.toFixed(1), r: radius.toFixed(1) });
  }
}

function move(element: SVGElement, [x, y]: Pair): void {
  put(element, { transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})` });
}

/** The place of a joint from which a force begins, at the rim of its ring. */
function rootOf([x, y, dx, dy]: Arrow): Pair {
  const off = RING / (Math.hypot(dx, dy) || 1);
  return [x - off * dx, y - off * dy];
}

/** An arrow with its head, in pixels; nothing if it is too short for one. Of a moment three quarters of a circle. */
function arrow(...[x, y, dx, dy, , unit]: Arrow): string {
  const length = Math.hypot(dx, dy);
  if (!(length > 3) || !Number.isFinite(length)) return "";
  if (unit.includes("N·m")) {
    const head = arrow(x, y + length, 9 * Math.sign(dx), 0, 0, "");
    return `M${x + dx} ${y}A${length} ${length} 0 1 ${Number(dx < 0)} ${x} ${y + length}${head}`;
  }
  const [ux, uy] = [dx / length, dy / length];
  const [ex, ey] = [x + dx, y + dy];
  const at = (u: number, v: number) => `${u.toFixed(1)} ${v.toFixed(1)}`;
  const [back, wide] = [Math.min(8, length), Math.min(4, length / 2)];
  const left = at(ex - back * ux - wide * uy, ey - back * uy + wide * ux);
  const right = at(ex - back * ux + wide * uy, ey - back * uy - wide * ux);
  return `M${at(x, y)}L${at(ex, ey)}M${left}L${at(ex, ey)}L${right}`;
}
