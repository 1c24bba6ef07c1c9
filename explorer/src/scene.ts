/** The SVG of the picture: links, joints, points, names, vectors. */

import { backdropElement, putBackdrop } from "./backdrop";
import { Bodies } from "./bodies";
import { put, renew, svg } from "./dom";
import type { Dragging } from "./dragging";
import type { Arrow } from "./forces";
import { DRIVEN, DRIVING, placed, STANDING, SUPPORT } from "./ground";
import { clearAbout, convexHull, middleOf, pathThrough, sidesOf, spotsAbout, toHull } from "./hull";
import { clearOf, type Label, labelsOf, pastEdges } from "./labels";
import { number as numberText } from "./language";
import { clearBy, type Leader, leaderOf } from "./leaders";
import type { Linkage } from "./linkage";
import { pole } from "./measures";
import type { ShapeRecord } from "./model";
import { clearSpot, halfOf, nearerBy } from "./names";
import { origin, type Pair, place, turn } from "./rows";
import { readingsOf } from "./rulers";
import { linesOf } from "./shapes";
import { ownColour, type Shown } from "./shown";
import { springLines } from "./springs";
import type { Viewport } from "./viewport";
import { rateUnit } from "./wording";

const LONGEST_ARROW = 90; // pixels
const LINE = 15; // pixels that names are apart
const MOST_CLEAR = 40; // names that look for a place of their own in every picture
const TOOLS = 218; // down to where names are clear of the buttons over the picture
const BESIDE = 56; // from the right edge of the picture to the left one of these
const NARROW = 500; // pixels: pictures in which a name that would be cut is left out
const NEAR = 16; // places of a letter of which others are twice as far
const RULE = 34; // from the left edge to where the numbers of the grid end
const RING = 6; // the radius of a target
const JOINT = 11; // from the middle of a joint to that of a name
const BODY = 9; // from the middle of a bar to that of a name beside it
const INK = 8; // from a name to an arrow or a ground
const BACK = 8; // more room, for a name that stood farther off
const GAP = 5; // from the middle of a name to a ground beside which it still stands well
const FOOT = 26; // below which are the numbers of the grid
const RAIL = 6; // half the width of a rail with its hatching, and some room

export class Scene {
  #links: SVGGElement[] = [];
  /** Where those that move lie, and which of them over which. */
  #bodies!: SVGElement;
  #order = "";
  /** Barrels and rods of cylinders, with what their paths are in a pose. */
  #stretched: [SVGElement, () => string][] = [];
  /** The ends of the rails of the frame, in pixels from its origin. */
  #rails: Pair[][] = [];
  #pins: { element: SVGGElement; joint: number }[] = [];
  #marks: { element: SVGGElement; point: number }[] = [];
  #labels: Label[] = [];
  #backdrop: SVGElement | null = null;
  /** Whether the pole is to be shown but lies outside of the picture. */
  poleAside = false;
  readonly #arrows = (["force", "force.load", "velocity", "acceleration"] as const).map((kind) =>
    svg(`path.${kind}`, {}),
  );
  /** Beside arrows, how much they are. */
  readonly #values = svg("g", {});
  /** From names to bodies beside which they have no place. */
  readonly #leaders = svg("path", { fill: "var(--faint)", stroke: "var(--faint)" });
  readonly #springs = svg("path.spring-path", {});
  readonly #rulers = svg("path.ruler", {});
  readonly #circle = svg("circle.inflection", { r: 0 });
  readonly #pole = svg("circle.pole", { r: 4 });

  constructor(
    private readonly root: SVGSVGElement,
    /** Where bodies are drawn, below the curves. */
    private readonly under: SVGSVGElement,
    private readonly viewport: Viewport,
    private readonly keys: Record<"joint" | "point", (event: KeyboardEvent, number: number) => void>,
  ) {}

  /** The joints that are drawn. */
  get joints(): number[] {
    return this.#pins.map(({ joint }) => joint);
  }

  /** The length of the longest arrow: in a low picture others would be covered by it. */
  get longest(): number {
    return Math.min(LONGEST_ARROW, (this.viewport.narrow ? 0.2 : 0.3) * this.viewport.height);
  }

  /** Names look for their best places, wherever they stood while it moved. */
  settle(): void {
    for (const label of this.#labels) Object.assign(label, { taken: 0, leader: undefined });
  }

  /** Give one link a class, or none. */
  mark(marked: number | null, name: "chosen" | "hovered"): void {
    for (const [link, { classList }] of this.#links.entries())
      if (classList.contains(name) !== (link === marked)) classList.toggle(name);
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
    this.#labels = shown.labels ? labelsOf(linkage) : [];
    front.append(
      this.#leaders,
      ...this.#labels.map(({ element }) => element),
      ...this.#arrows,
      this.#values,
      this.#springs,
      this.#rulers,
      this.#circle,
      this.#pole,
    );
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
    if (model.drives.some((drive) => drive.joint === number))
      element.append(
        svg("path.driven", { d: DRIVEN, transform: transform + (linkage.beside.backward ? " scale(-1 1)" : "") }),
      );
    return element;
  }

  /** Draw the bodies of the links and find where their names stand on them, after their sizes or the scale changed. */
  sized(linkage: Linkage): void {
    for (const label of this.#labels) label.sized?.(this.viewport.scale);
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
    const { model, pose, sizes } = linkage;
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
    const taken: { x: number; y: number; half: number }[] = [];
    const hulls = this.#labels.map(({ hull }) => (hull && this.#labels.length < MOST_CLEAR ? hull(viewport) : []));
    const forces = shown.forces();
    const kinds = [
      forces.filter((one) => !one[6]),
      forces.filter((one) => one[6]),
      this.#vectors(linkage, 1, shown.velocities),
      this.#vectors(linkage, 2, shown.accelerations),
    ].map((all) => all.map((one) => this.#scaled(...one)));
    const arrows = kinds.flatMap((all) =>
      all.map(([x, y, dx, dy]): Pair[] => [
        [x, y],
        [x + dx, y + dy],
      ]),
    );
    const springs = shown.springs(linkage).map((spring) => springLines(linkage, viewport, spring));
    arrows.push(...springs.map((parts) => convexHull(parts.flat())).filter((hull) => hull.length));
    const grounds = this.#pins
      .filter(({ joint }) => model.joints[joint]!.links.includes(model.frame))
      .map(({ joint }) => placed(STANDING, pixels(joint), model.bearings[joint]));
    grounds.push(...model.drives.map(({ joint }) => placed(DRIVING, pixels(joint), model.bearings[joint])));
    for (const [x, y] of linkage.beside.targets ?? []) {
      const [u, v] = viewport.screen(x, y);
      grounds.push([-RING, RING].map((d): Pair => [u + d, v]));
    }
    const { height, width } = viewport;
    const low = height < 2 * TOOLS ? 72 : TOOLS; // a low picture has one button only
    const buttons = convexHull(
      [0, low - 12].flatMap((y): Pair[] => [
        [width - 54, y],
        [width, y],
      ]),
    );
    const [c, s] = turn(pose, 0, model.frame);
    const [ox, oy] = viewport.screen(...origin(pose, 0, model.frame));
    const fixed = (x: number, y: number): Pair => [ox + c * x + s * y, oy - s * x + c * y];
    for (const ends of this.#rails)
      grounds.push(
        convexHull(ends.flatMap(([x, y]) => [-RAIL, RAIL].flatMap((d) => [fixed(x + d, y + d), fixed(x + d, y - d)]))),
      );
    const drawn = [...hulls.filter((hull) => hull.length), ...arrows, ...grounds, buttons];
    const order = [...this.#labels.entries()].sort(([, one], [, other]) => +!!one.many - +!!other.many);
    const far: [number, Label][] = []; // names that have no place beside their bodies
    const right = (v: number) => width - (v < low ? BESIDE : 0);
    const offJoints = clearBy(
      JOINT,
      this.#pins.map(({ joint }) => [pixels(joint)]),
    );
    const offGrounds = clearBy(GAP, grounds);
    const touchingOne = (half: number) => (at: Pair) =>
      taken.find(
        (other) => half + other.half + 4 > Math.abs(at[0] - other.x) && Math.abs(at[1] - other.y) < LINE - 0.01,
      );
    const takes = ({ element, half }: Label, [x, y]: Pair) => {
      put(element, { display: "inline" });
      taken.push({ x, y, half });
      drawn.push(lettersAt(x, y, half));
      move(element, [x, y]);
    };
    /** At its place beside its body, though something is there. */
    const stands = (label: Label, [left, top]: Pair) => {
      const { element, half } = label;
      const touching = touchingOne(half);
      const x = Math.max(half + 2, Math.min(right(top) - half - 2, left)); // it is not cut
      let y = top;
      const way = y < (touching([x, y])?.y ?? 0) ? -1 : 1;
      for (let other = touching([x, y]); other; other = touching([x, y])) y = other.y + way * LINE;
      if (width < NARROW && x + half > right(y)) put(element, { display: "none" });
      else takes(label, [x, y]);
    };
    for (const [k, label] of order) {
      const { half, name, spots } = label;
      const places = spots(viewport);
      const touching = touchingOne(half);
      const clear = (of: Pair[][]) => (at: Pair) => !touching(at) && of.every((one) => clearOf(one, half, at));
      const seen = ([u, v]: Pair) => u > half + RULE && u + half < right(v);
      const free = clear(hulls[k]!.length ? arrows : drawn);
      if (hulls[k]!.length) {
        // of a plate upon which it lies only the edges are others
        const mine = middleOf(hulls[k]!);
        const others = hulls.flatMap((one, other) => {
          if (other === k) return [];
          return toHull(one, ...mine) ? [one] : sidesOf(one);
        });
        label.taken = clearSpot(
          places,
          name,
          [hulls[k]!, others],
          free,
          label.taken,
          (at) => seen(at) && clear(grounds)(at),
        );
        const [x, y] = places[label.taken]!;
        const own = hulls[k]!.length > 2 && !toHull(hulls[k]!, x, y - 4); // on its plate
        const wide = label.leader === undefined ? half : half + BACK; // back it comes where there is more room
        const alone = offJoints(wide, [x, y - 4]) && (own || clearBy(BODY, others)(wide, [x, y - 4]));
        const off = offGrounds(wide, [x, y - 4]) && seen([x, y]) && free([x, y]);
        if (!alone || !off || !(nearerBy([x, y], wide, hulls[k]!, others) > wide - half)) {
          far.push([k, label]);
          continue;
        }
        label.leader = undefined;
      } else if (label.taken >= NEAR || !free(places[label.taken]!)) label.taken = Math.max(0, places.findIndex(free));
      stands(label, places[label.taken]!);
    }
    const outlines = far.length ? outlinesOf(linkage, viewport) : [];
    const curves = far.length && shown.curves ? curvesOf(linkage, viewport) : [];
    const offInk = clearBy(INK, [...arrows, ...grounds, buttons, ...curves]);
    const lines: [Pair, Pair][] = [];
    const hangs = (label: Label, found: Leader | null) => {
      label.leader = found?.chosen ?? -1;
      if (found) takes(label, found.at);
      if (found?.line) lines.push(found.line);
      return !!found;
    };
    const anew: (() => void)[] = []; // after those that stay where they were
    for (const [k, label] of far) {
      const { half, link, spots } = label;
      const others = hulls.filter((hull, other) => other !== k && hull.length);
      others.push(...outlines.flatMap(([its, outline]) => (its === link ? [] : [outline])));
      const wide = (outline: Pair[]) => Math.max(...outline.map(([x]) => x)) - Math.min(...outline.map(([x]) => x));
      const homes = outlines.flatMap(([its, outline]) => (its === link && outline.length > 2 ? [outline] : []));
      const home = homes.sort((one, other) => wide(other) - wide(one))[0] ?? [];
      const free = ([u, v]: Pair) =>
        u > half + RULE &&
        u + half < right(v) &&
        v > 14 &&
        v < height - FOOT &&
        !taken.some((one) => half + one.half + 4 > Math.abs(u - one.x) && Math.abs(v - one.y) < LINE) &&
        offInk(half, [u, v - 4]);
      const find = leaderOf(hulls[k]!, home, others, half, free, lines, taken);
      if (!hangs(label, find(label.leader ?? -1)))
        anew.push(() => {
          if (!hangs(label, find())) stands(label, spots(viewport)[label.taken]!);
        });
    }
    for (const find of anew) find();
    put(this.#leaders, { d: lines.map((line) => `${pathThrough(line)}${dotAt(line[0])}`).join("") });
    kinds.forEach((all, k) => {
      put(this.#arrows[k]!, { d: all.map((one) => arrow(...one)).join("") });
    });
    // a number may stand upon a plate, but not across its edges
    const edges = [...hulls.flatMap(sidesOf), ...drawn.slice(hulls.filter((hull) => hull.length).length)];
    edges.push(...pastEdges(width, height));
    this.#putValues(kinds, edges);
    put(this.#springs, { d: springs.flat().map(pathThrough).join("") });
    const rulers = readingsOf(linkage).map(({ ends }) => pathThrough(ends.map((at) => viewport.screen(...at))));
    put(this.#rulers, { d: rulers.join("") });
    this.#drawPole(linkage, shown);
  }

  /** An arrow in pixels; of a moment its circle reaches so far to the right, if it is positive, or to the left. */
  #scaled(...[x, y, dx, dy, amount, unit]: Arrow): Arrow {
    const long = unit === "N·m" ? this.longest / 3 : this.longest;
    return [...this.viewport.screen(x, y), long * dx, -long * dy, amount, unit];
  }

  /** Velocities (1) or accelerations (2) of all joints and points that move. */
  #vectors(linkage: Linkage, k: 1 | 2, wanted: boolean): Arrow[] {
    const { model, pose, sizes } = linkage;
    const places: Arrow[] = [];
    const add = (link: number, u: number, v: number) => {
      const [dx, dy] = place(pose, 0, link, u, v, k);
      places.push([...place(pose, 0, link, u, v), dx, dy, Math.hypot(dx, dy), rateUnit(linkage, k, false)]);
    };
    model.joints.forEach((joint, number) => {
      if (!wanted || (joint.links.includes(model.frame) && joint.pair.turning)) return;
      const moves = (e: number) => sizes.element(e).link !== model.frame && !sizes.is(e, "round");
      const element = sizes.elementsOf(number).find(moves);
      if (element !== undefined) add(sizes.element(element).link, ...sizes.xy(element));
    });
    if (wanted) for (const point of sizes.points) add(point.link, ...point.at);
    const most = Math.max(...places.map((one) => one[4]).filter(Number.isFinite), 1e-12);
    return places.map(([x, y, dx, dy, ...more]): Arrow => [x, y, dx / most, dy / most, ...more]);
  }

  /** Beside the longest arrow of each kind, and beside other forces where there is room, how much they are. */
  #putValues(kinds: Arrow[][], drawn: (readonly Pair[])[]): void {
    const texts: Element[] = [];
    for (const [k, all] of kinds.entries()) {
      const largest = all.filter((one) => one[4] > 0).sort((a, b) => b[4] - a[4]);
      for (const [n, [x, y, dx, dy, amount, unit]] of largest.entries()) {
        if (n && k > 1) break;
        const said = `${numberText(amount, 3)} ${unit}`.trim();
        const half = halfOf(said);
        const less = n > 0 || k === 1; // only where it is near and clear
        const [left, top] = clearAbout([x + dx, y + dy], 18, drawn, half, less ? 16 : 32);
        if (less && !drawn.every((one) => clearOf(one, half, [left, top + 4]))) continue;
        texts.push(svg("text", { "data-arrow": "", "text-anchor": "middle", x: left, y: top + 4 }, said));
        drawn.push(lettersAt(left, top + 4, half));
      }
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
    this.poleAside = !(x >= 0 && y >= 0 && x <= viewport.width && y <= viewport.height);
    put(this.#pole, { cx: x.toFixed(1), cy: y.toFixed(1) });
    const radius = (Math.hypot(found.dx, found.dy) / 2) * viewport.scale;
    if (!shown.inflection || !(radius < 1e5)) return;
    const [cx, cy] = viewport.screen(found.x + found.dx / 2, found.y + found.dy / 2);
    put(this.#circle, { cx: cx.toFixed(1), cy: cy.toFixed(1), r: radius.toFixed(1) });
  }
}

/** Places on the coupler curves, in pixels. */
function curvesOf({ cycle, sizes }: Linkage, viewport: Viewport): Pair[][] {
  const step = Math.ceil(cycle.values.length / 60);
  return sizes.points.flatMap(({ at, link }) => {
    const places: Pair[][] = [];
    for (let row = 0; row < cycle.values.length; row += step)
      places.push([viewport.screen(...place(cycle.rows, row, link, ...at))]);
    return places;
  });
}

/** What wheels, blocks and the like cover, in pixels: hulls, of what is open the pieces. */
function outlinesOf({ model, pose, sizes }: Linkage, viewport: Viewport): [link: number, hull: Pair[]][] {
  const solid = model.shapes.filter(({ style }) => style !== "hatch" && style !== "dead");
  return solid.flatMap((shape) => outlineOf(shape).map((hull): [number, Pair[]] => [shape.link, hull]));

  function outlineOf(shape: ShapeRecord): Pair[][] {
    const at = (x: number, y: number) => viewport.screen(...place(pose, 0, shape.link, x, y));
    if (shape.circle) {
      const [x, y, radius] = shape.circle;
      return [
        spotsAbout([x, y], radius)
          .slice(0, 16)
          .map((one) => at(...one)),
      ];
    }
    return linesOf(sizes, shape).flatMap((line) => {
      const step = 2 * Math.ceil(line.length / 96);
      const places: Pair[] = [];
      for (let k = 0; k + 1 < line.length; k += step) places.push(at(line[k]!, line[k + 1]!));
      return shape.closed ? [convexHull(places)] : sidesOf(places).slice(0, -1);
    });
  }
}

/** The corners of a text that stands upon a line. */
function lettersAt(x: number, y: number, half: number): Pair[] {
  return convexHull([-half, half].flatMap((side) => [-9, 1].map((rise): Pair => [x + side, y + rise])));
}

/** The end of a line on a body. */
function dotAt([x, y]: Pair): string {
  return `M${(x - 1.5).toFixed(1)} ${y.toFixed(1)}a1.5 1.5 0 1 0 3 0a1.5 1.5 0 1 0 -3 0`;
}

function move(element: SVGElement, [x, y]: Pair): void {
  put(element, { transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})` });
}

/** An arrow with its head, in pixels; nothing if it is too short for one. Of a moment three quarters of a circle. */
function arrow(...[x, y, dx, dy, , unit]: Arrow): string {
  const length = Math.hypot(dx, dy);
  if (!(length > 3) || !Number.isFinite(length)) return "";
  if (unit === "N·m")
    return `M${x + dx} ${y}A${length} ${length} 0 1 ${Number(dx < 0)} ${x} ${y + length}${arrow(x, y + length, 9 * Math.sign(dx), 0, 0, "")}`;
  const [ux, uy] = [dx / length, dy / length];
  const [ex, ey] = [x + dx, y + dy];
  const at = (u: number, v: number) => `${u.toFixed(1)} ${v.toFixed(1)}`;
  const left = at(ex - 8 * ux - 4 * uy, ey - 8 * uy + 4 * ux);
  const right = at(ex - 8 * ux + 4 * uy, ey - 8 * uy - 4 * ux);
  return `M${at(x, y)}L${at(ex, ey)}M${left}L${at(ex, ey)}L${right}`;
}
