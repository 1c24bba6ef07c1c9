/** The picture of a machine in space: bodies on a canvas, names of points over them, what a pointer does to it. */

import { h, lowered, svg } from "../dom";
import { gridStep } from "../grid";
import { number } from "../language";
import { halfOf } from "../names";
import type { Pair } from "../rows";
import { zoomButtons } from "../shell";
import {
  axes,
  before,
  type Camera,
  cross,
  dot,
  fitted,
  type Margins,
  meeting,
  minus,
  moved,
  NATURAL,
  projection,
  ray,
  seen,
  type Vector,
} from "./algebra";
import { arrowsOf, headed, tipped } from "./arrows";
import { apart, middleOf, type Name, nameOf } from "./bodynames";
import type { Machine } from "./machine";
import type { Spot } from "./model";
import { type Drawn, Painter } from "./painter";

const ARM = 26; // pixels of the axes in the corner
const CORNER: Pair = [44, 46]; // from a corner of the picture to their origin
const CLEAR = 70; // pixels from there, across and down together
const ROOM = 16; // pixels around the machine
const FEW = 6; // bodies have names that stand in the picture
const ELSEWHERE = 8; // places of a body at which its name may stand instead
const AROUND: readonly Pair[] = [18, -18, 9, -9].map((far, k) => (k < 2 ? [far, 0] : [0, far])); // pixels
const ASIDE = [18, 28, 38]; // pixels from a place of a body to its name beside it
const SEEN = 150; // milliseconds for which these are taken to be hidden or not
const MOST_ROOM = 0.3; // of the picture
const DIRECTIONS = 160;
const POSES = 6; // in which it is tried from where its links are seen best
const OBLIQUE = 0.9; // radians
const LIFTS = [0.5, 0.25, 0.85]; // radians
const BROAD = 6; // a machine as broad as long in the picture is worth so many links seen half
const BETTER = 1.2; // so many times
const LEAST_WIDE = 1.3; // of the picture, for which that is sought: on a phone it is low beside what is read
const PALE = 0.3; // of the colour of the page
const STEEP = 1.5; // radians: no farther up or down

export interface SceneEvents {
  /** A link is taken, or one that was taken has moved. */
  taken(): void;
  pulled(): void;
  /** The view was turned by hand. */
  turned(): void;
  /** The mouse is over a link, or over none. */
  pointed(link: number | null): void;
}

export class Scene {
  readonly element = h("div.stage", {});
  /** Whether floor, paths and names of points are shown. */
  readonly shown = { floor: true, paths: true, names: true };
  /** The link that stands out. */
  marked: number | null = null;
  readonly canvas = h("canvas", { "aria-hidden": "true" });
  readonly root = svg("svg", { role: "application", tabindex: "0" });
  readonly #hint = h("div.hint", {});
  #tools = h("div.tools", {});
  readonly #painter: Painter | null = null;
  #camera: Camera;
  #whole = true;
  /** What is kept in the picture, and whether below the buttons rather than beside them. */
  #places: Vector[] = [];
  #below = 0;
  /** Where the axes stand. */
  #corner = CORNER;
  /** From where it is seen obliquely: from where it is seen best, once that is known. */
  oblique: Pair = [OBLIQUE, LIFTS[0]!];
  #isKnown = false;
  /** The lowest and the highest coordinates of what stands on the floor. */
  #extent: [Vector, Vector] = [
    [0, 0, 0],
    [0, 0, 0],
  ];
  #step = 1;
  /** Of each body, what is seen through last, its link, its farthest places and the corners of its triangles. */
  #reach: { link: number; places: Vector[]; corners: Float64Array; middle: Vector; radius: number; glass: boolean }[] =
    [];
  /** Of each body where its name stands, and where else it may if that is hidden. */
  #spots: Vector[][] = [];
  /** Those of them where it is on or next to that body alone. */
  #open: Vector[][] = [];
  /** So many pixels beside the first of these a name stands clear of all bodies. */
  #aside: Pair[] = [];
  #due = 0;
  #later = 0;
  readonly #colours = new Map<string, Vector>();
  readonly #fingers = new Map<number, PointerEvent>();
  #pulling = false;
  #links: string[] = [];

  constructor(
    private machine: Machine,
    private readonly events: SceneEvents,
  ) {
    const { bodies, glass, middle, size } = machine.data;
    const [turn, lift] = this.oblique;
    this.#camera = { turn, lift, middle, distance: 5 * size, opening: NATURAL };
    try {
      this.#painter = new Painter(this.canvas, bodies, glass);
    } catch {
      // it is said when the page is arranged
    }
    this.#measure();
    const { root } = this;
    root.addEventListener("pointerdown", (event) => this.#down(event));
    root.addEventListener("pointermove", (event) => this.#move(event));
    for (const name of ["pointerup", "pointercancel"] as const)
      root.addEventListener(name, ({ pointerId }) => {
        this.#fingers.delete(pointerId);
        this.#pulling = false;
      });
    root.addEventListener("pointerleave", () => this.mark(null));
    root.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(-event.deltaY / 900));
      },
      { passive: false },
    );
    root.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => (this.#whole ? this.fit() : this.draw())).observe(this.element);
    lowered(this.element);
  }

  /** Show another machine in place of this one, from the same side. */
  take(machine: Machine): void {
    this.machine = machine;
    this.#painter?.load(machine.data.bodies, machine.data.glass);
    this.marked = null;
    this.#due = 0;
    this.#measure();
    if (this.#whole) this.fit();
  }

  /** How large it is, and what its grid shows. */
  #measure(): void {
    const { bodies, glass, size } = this.machine.data;
    this.#step = gridStep(size / 6);
    this.#reach = [...bodies.map((body, link) => ({ ...body, link })), ...glass].map((body, k) => {
      const { link, triangles, vertices } = body;
      const places = farthest(vertices);
      const middle = middleOf(places);
      const radius = 1.05 * Math.max(0, ...places.map((place) => Math.hypot(...minus(place, middle))));
      const corners = new Float64Array(triangles.flatMap((corner) => vertices.slice(3 * corner, 3 * corner + 3)));
      return { link, places, corners, middle, radius, glass: k >= bodies.length };
    });
    // of the frame its last foot, since it has no middle that one sees
    this.#spots = bodies.map(({ vertices }, link) => {
      const { corners, middle, places } = this.#reach[link]!;
      const first = this.machine.moves(link) ? nameOf(corners, middle, size / 35) : (vertices.slice(-3) as Vector);
      const others = places.filter((_, k) => k % Math.ceil(places.length / ELSEWHERE) === 0);
      const halves = this.machine.moves(link)
        ? others.map((at) => at.map((v, n) => (v + middle[n]!) / 2) as Vector)
        : [];
      return [first, ...halves, ...others];
    });
    const corners = this.#corners();
    const ends = (least: typeof Math.min) =>
      [0, 1, 2].map((k) => corners.reduce((a, at) => least(a, at[k]!), corners[0]![k]!));
    this.#extent = [ends(Math.min) as Vector, ends(Math.max) as Vector];
  }

  /** Lay it out anew, in the language of the page. */
  arrange(title: string, links: string[], words: Record<string, string>, unit: string): void {
    const hint = words[this.machine.drive ? "hint" : "turn"]!;
    this.#links = links;
    this.root.setAttribute("aria-label", `${title}. ${hint}`);
    this.#hint.textContent = hint;
    const grid = unit ? `${words.grid} ${number(this.#step)} ${unit}` : "";
    this.#tools = h("div.tools", {}, ...zoomButtons(this));
    const picture = this.#painter ? [this.canvas, this.root] : [h("p.note.flat", { role: "alert" }, words.flat)];
    this.element.replaceChildren(...picture, this.#tools, this.#hint, h("div.hint.unit", {}, grid));
  }

  // --- where from ----------------------------------------------------------------------------------------------------

  /** The farthest places of all bodies in poses, those that are reached at first. */
  #corners(reached = this.machine.reached): Vector[] {
    return reached.flatMap((poses) =>
      this.#reach.flatMap(({ link, places }) => places.map((place) => moved(poses[link]!, place))),
    );
  }

  fit(): void {
    this.#whole = true;
    if (!this.#wide) return; // it is not laid out yet
    const reached = this.machine.reached;
    const { near } = axes(this.#camera);
    this.#places = [
      ...this.#corners(reached),
      ...reached.flatMap((poses) => arrowsOf(this.machine, poses, near).flat()),
    ];
    if (this.few && !this.#isKnown) this.oblique = this.#sought;
    if (!this.#isKnown) [this.#camera.turn, this.#camera.lift] = this.oblique;
    this.#isKnown = true;
    const cameras = this.#margins.map((room) => this.#fitted(room));
    this.#below = Number(cameras[0]!.distance >= cameras[1]!.distance);
    this.#camera = cameras[this.#below]!;
    if (!this.element.classList.contains("low")) this.#corner = this.#free; // where they are not shown
    this.draw();
  }

  /** The corner of the picture that the machine leaves to the axes, first the upper left one. */
  get #free(): Pair {
    const { clientHeight: high, clientWidth: wide } = this.element;
    const view = projection(this.#camera, this.#wide);
    const places = this.#places.map((at) => this.#pixel(view, at));
    const [x, y] = CORNER;
    const low = high - this.#hint.offsetHeight - y;
    // what lies between places is as far along the diagonal as they are
    const corners = [CORNER, [x, low] as Pair, [wide - x, low] as Pair].map((at) => ({
      at,
      room: places.reduce(
        (least, [u, v]) =>
          Math.min(least, (u - at[0]) * Math.sign(wide / 2 - at[0]) + (v - at[1]) * Math.sign(high / 2 - at[1])),
        Infinity,
      ),
    }));
    const [most] = [...corners].sort((one, other) => other.room - one.room);
    return (corners.find(({ room }) => room > CLEAR) ?? most!).at;
  }

  /** From where its links are large, long, apart and not hidden, on the whole and at worst: as at first, unless that is
   * much better elsewhere. */
  get #sought(): Pair {
    const { data, reached } = this.machine;
    const some = reached.filter((_, k) => k % Math.ceil(reached.length / POSES) === 0);
    const moving = this.#spots.flatMap((spots, link) => {
      if (!this.machine.moves(link)) return [];
      const { middle, places } = this.#reach[link]!;
      const far = (at: Vector) => Math.hypot(...minus(at, middle));
      const end = places.reduce((a, b) => (far(b) > far(a) ? b : a));
      // where its name may stand: in the middle and on the way to the ends
      return { link, spots: spots.slice(0, ELSEWHERE + 1).filter((_, k) => k % 4 === 0), middle, end, long: far(end) };
    });
    const room = this.#margins[Number(this.#wide < 1)]!;
    const worthOf = ([turn, lift]: Pair): number => {
      const camera = { ...this.#camera, turn, lift };
      const { distance, middle } = fitted(camera, Math.max(this.#wide, LEAST_WIDE), this.#places, room);
      const { eye, near, right, up } = axes({ ...camera, distance, middle });
      const parts = moving.map(({ link, spots, middle: from, end, long }) => {
        const lengths = some.map((poses) => {
          const pose = poses[link]!;
          const open = spots.filter((spot) => !this.#isBehind(link, eye, moved(pose, spot), poses)).length;
          const seenLong = Math.hypot(...cross(minus(moved(pose, end), moved(pose, from)), near)) / long;
          return (open / spots.length) * seenLong;
        });
        return lengths.reduce((a, b) => a + b) / some.length + Math.min(...lengths);
      });
      const broad = some.map((poses) =>
        breadth(
          moving.flatMap(({ link, middle: from, end }) =>
            [from, end].map((at): Pair => {
              const place = moved(poses[link]!, at);
              return [dot(right, place), dot(up, place)];
            }),
          ),
        ),
      );
      const opened = (BROAD * broad.reduce((a, b) => a + b)) / (some.length * data.size);
      return parts.reduce((a, b) => a + b, opened) / distance;
    };
    const sides = LIFTS.flatMap((lift) =>
      [0, 1, 2, 3, 4, 5, 6, 7].map((k): Pair => [OBLIQUE + (k * Math.PI) / 4, lift]),
    );
    const values = sides.map(worthOf);
    const most = Math.max(...values);
    return most > BETTER * values[0]! ? sides[values.indexOf(most)]! : sides[0]!;
  }

  #fitted(room: Margins): Camera {
    return fitted(this.#camera, this.#wide, this.#places, room);
  }

  /** What is beside the machine: words below, buttons to the right or above; of a small picture a third at most. */
  get #margins(): Margins[] {
    const { clientHeight, clientWidth } = this.element;
    const [across, down] = [clientWidth, clientHeight].map(
      (whole) => (pixels: number) => Math.min(pixels / Math.max(whole, 1), MOST_ROOM),
    ) as [(pixels: number) => number, (pixels: number) => number];
    const told = this.#hint.offsetHeight + ROOM;
    const [left, top, bottom] = [across(ROOM), down(ROOM), down(told)];
    return [
      { left, right: Math.min((this.#tools.offsetWidth + 2 * ROOM) / Math.max(clientWidth, 1), 0.5), top, bottom },
      // as high as fingers need them
      {
        left,
        right: left,
        top: Math.min((this.#tools.offsetHeight + 2 * ROOM) / Math.max(clientHeight, 1), 0.5),
        bottom,
      },
    ];
  }

  zoom(factor: number): void {
    this.#whole = false;
    this.#camera.distance /= factor;
    this.draw();
  }

  /** Look from another side: angles in radians; along an axis from afar. */
  look(turn: number, lift: number, opening = NATURAL): void {
    Object.assign(this.#camera, { turn, lift, opening });
    this.fit();
  }

  #round(turn: number, lift: number): void {
    this.#camera.distance *= NATURAL / this.#camera.opening;
    this.#camera.opening = NATURAL;
    this.#camera.turn += turn;
    this.#camera.lift = Math.min(Math.max(this.#camera.lift + lift, -STEEP), STEEP);
    this.events.turned();
    if (this.#whole) this.#camera = this.#fitted(this.#margins[this.#below]!); // with the same room: it does not jump
    this.draw();
  }

  get #wide(): number {
    return this.element.clientWidth / Math.max(this.element.clientHeight, 1);
  }

  // --- drawing -------------------------------------------------------------------------------------------------------

  draw(): void {
    const { canvas, element, machine } = this;
    const painter = this.#painter;
    if (!painter || !element.clientWidth) return;
    const ratio = Math.min(devicePixelRatio, 2);
    const [width, height] = [Math.round(element.clientWidth * ratio), Math.round(element.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const view = projection(this.#camera, this.#wide);
    const { eye, right, up, near } = axes(this.#camera);
    const lamp = near.map((n, k) => 0.62 * n + 0.66 * up[k]! - 0.42 * right[k]!) as Vector;
    const { poses } = machine;
    if (machine.data.live) this.#sink(poses);
    const [accent, paper] = [this.#colour("--accent"), this.#colour("--paper")];
    const lines: Drawn[] = this.shown.floor
      ? [{ colour: this.#colour("--grid"), pairs: true, places: this.#floor() }]
      : [];
    if (this.shown.paths) lines.push(...machine.paths.map((places) => ({ colour: accent, pairs: false, places })));
    // those of the other drives lie between the bodies, pale: seen over all they would be of none
    const pale = accent.map((v, k) => v + PALE * (paper[k]! - v)) as Vector;
    for (const [drive, places] of arrowsOf(machine, poses, near).entries())
      if (drive !== machine.active)
        lines.push({ colour: pale, pairs: false, places: tipped(places, near, machine.data.size) });
    const colours = { paper, ink: this.#colour("--ink"), marked: this.marked };
    painter.paint({ view, eye, lamp }, poses, lines, colours);
    this.#over(view, poses, [right, up, near]);
  }

  /** Where a place is on the picture, in pixels. */
  #pixel(view: Float32Array, at: Vector): Pair {
    const { clientHeight, clientWidth } = this.element;
    const [x, y] = seen(view, at);
    return [((x + 1) * clientWidth) / 2, ((1 - y) * clientHeight) / 2];
  }

  /** Arrows of the drives, names of points, and the axes in the corner. */
  #over(view: Float32Array, poses: ArrayLike<number>[], [right, up, near]: [Vector, Vector, Vector]): void {
    const { clientWidth, clientHeight } = this.element;
    const size: Pair = [clientWidth, clientHeight];
    this.root.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    const pixel = (at: Vector) => this.#pixel(view, at);
    const parts: SVGElement[] = arrowsOf(this.machine, poses, near)
      .filter((_, drive) => drive === this.machine.active)
      .map((places) => headed(places.map(pixel)));
    const [ox, oy] = this.#corner;
    const named = [-22, 0, 22].map((down): Name => ({ text: "x y z", at: [ox, oy + down] })); // keeps clear of them
    for (const { link, at, name = this.#links[link] } of this.machine.spots) {
      const [px, py] = pixel(moved(poses[link]!, at));
      parts.push(svg("circle.spot", { cx: px, cy: py, r: 4.5 }));
      named.push({ text: "", at: [px, py + 5] });
      const side = Math.sign(clientWidth / 2 - px) * (9 + halfOf(name!));
      if (!this.shown.names) continue;
      for (const placed of apart(
        [[-7, 19].map((down) => ({ text: name!, at: [px + side, py + down] }))],
        named,
        size,
      )) {
        const [x, y] = placed.at;
        parts.push(svg("text.mark", { x, y, "text-anchor": "middle" }, name!));
        named.push(placed);
      }
    }
    parts.push(...this.#names(poses, pixel, named));
    ["x", "y", "z"].forEach((axis, k) => {
      const [dx, dy] = [ARM * right[k]!, -ARM * up[k]!];
      parts.push(svg("line", { class: `axis ${axis}`, x1: ox, y1: oy, x2: ox + dx, y2: oy + dy }));
      if (Math.hypot(dx, dy) < ARM / 3) return; // it points at the reader: its letter would be on another one
      parts.push(svg("text.axis", { x: ox + 1.45 * dx - 4, y: oy + 1.45 * dy + 4 }, axis));
    });
    this.root.replaceChildren(...parts);
  }

  /** The names of the bodies at their places: of few all, else of the one that stands out. */
  #names(poses: ArrayLike<number>[], pixel: (at: Vector) => Pair, others: Name[]): SVGElement[] {
    const { machine, marked, shown } = this;
    const pulled = machine.traced?.link; // which has its name at its spot
    const isNamed = (link: number) => link === marked || (this.few && shown.names && link !== pulled);
    if (this.few && shown.names) this.#uncover(poses, pixel);
    const names = this.#links.map((name, link) => {
      const spots = [...(this.#open[link] ?? []), ...(link === marked ? this.#spots[link]! : [])];
      const text = shortened(name);
      return (isNamed(link) ? spots : []).map((spot, k) => {
        const [x, y] = pixel(moved(poses[link]!, spot));
        const [right, down] = (!k && this.#aside[link]) || [0, 0];
        return { link, text, at: [x + right, y + down] as Pair };
      });
    });
    const { clientHeight, clientWidth } = this.element;
    return apart(names, others, [clientWidth, clientHeight]).map(({ link, text, at: [x, y] }) =>
      svg(link === marked ? "text.mark" : "text.mark.body", { x, y, "text-anchor": "middle" }, text),
    );
  }

  /** Which places of names are not hidden now: it takes a while, so that not every picture asks anew. */
  #uncover(poses: ArrayLike<number>[], pixel: (at: Vector) => Pair): void {
    clearTimeout(this.#later);
    if (performance.now() < this.#due) {
      this.#later = setTimeout(() => this.draw(), SEEN);
      return;
    }
    const { eye } = axes(this.#camera);
    const { clientHeight, clientWidth } = this.element;
    const under = (x: number, y: number) => this.#hit((2 * x) / clientWidth - 1, 1 - (2 * (y - 4)) / clientHeight);
    this.#open = this.#spots.map((spots, link) =>
      spots.filter((spot) => {
        const at = moved(poses[link]!, spot);
        if (this.#isBehind(link, eye, at)) return false;
        const [x, y] = pixel(at);
        const around = AROUND.map(([right, down]) => under(x + right, y + down));
        const own = around.filter((hit) => hit?.link === link).length;
        return around.filter((hit) => hit && hit.link !== link).length <= own;
      }),
    );
    this.#aside = this.#open.map(([spot], link) => {
      if (!spot) return [0, 0];
      const [x, y] = pixel(moved(poses[link]!, spot));
      const half = halfOf(shortened(this.#links[link]!));
      const corners = [-half - 2, 0, half + 2].flatMap((right) => [-8, 9].map((down): Pair => [right, down]));
      const places = ASIDE.flatMap((far): Pair[] => [
        [0, -far],
        [0, far],
        [far + half - 8, 0],
        [8 - far - half, 0],
      ]);
      const last = this.#aside[link] ?? [0, 0]; // it jumps less
      const isClear = ([right, down]: Pair) => corners.every(([u, v]) => !under(x + right + u, y + down + v));
      return [last, ...places].find(isClear) ?? [0, 0];
    });
    this.#due = performance.now() + SEEN;
  }

  /** Whether all names have room in the picture. */
  get few(): boolean {
    return this.machine.data.bodies.length <= FEW;
  }

  /** The lines of the floor. */
  #floor(): Vector[] {
    const step = this.#step;
    const [low, high] = this.#extent;
    const level = low[2] - 0.01 * this.machine.data.size;
    const ends = [low, high].map((end, k) => end.map((v) => Math.round(v / step) + 2 * k - 1));
    const [[left, front], [right, back]] = ends as [Vector, Vector];
    const places: Vector[] = [];
    for (let k = left; k <= right; k++) places.push([k * step, front * step, level], [k * step, back * step, level]);
    for (let k = front; k <= back; k++) places.push([left * step, k * step, level], [right * step, k * step, level]);
    return places;
  }

  /** Where several drives may go is not known before: the floor goes down by whole steps. */
  #sink(poses: ArrayLike<number>[]): void {
    const [low] = this.#extent;
    const deep = this.#corners([poses]).reduce((z, at) => Math.min(z, at[2]), low[2]);
    low[2] -= this.#step * Math.ceil((low[2] - deep) / this.#step);
  }

  /** A colour of the style sheet; to ask for one makes the browser apply all of it. */
  #colour(name: string): Vector {
    const known = this.#colours.get(name);
    if (known) return known;
    const text = getComputedStyle(this.element).getPropertyValue(name).trim();
    const found = [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16) / 255) as Vector;
    this.#colours.set(name, found);
    return found;
  }

  /** The page is light or dark now. */
  recoloured(): void {
    this.#colours.clear();
    this.draw();
  }

  // --- pointer and keys ----------------------------------------------------------------------------------------------

  /** Where an event is on the picture, -1 to 1. */
  #placed({ clientX, clientY }: MouseEvent): [number, number] {
    const box = this.root.getBoundingClientRect();
    return [(2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height];
  }

  /** The link under a place, and where on it. */
  #hit(x: number, y: number): Spot | null {
    const { from, along } = ray(this.#camera, this.#wide, x, y);
    return this.#met(from, along);
  }

  /** Whether a place of a link is behind the body of another one. */
  #isBehind(link: number, eye: Vector, at: Vector, poses = this.machine.poses): boolean {
    const met = this.#met(eye, minus(at, eye), true, poses);
    return met !== null && met.link !== link && met.far < 1;
  }

  /** What a ray meets first, of glass or not, and how far along it. */
  #met(from: Vector, along: Vector, through = false, poses = this.machine.poses): (Spot & { far: number }) | null {
    let best: (Spot & { far: number }) | null = null;
    let nearest = Infinity;
    for (const { corners, glass, link, middle, radius } of this.#reach) {
      const pose = poses[link]!;
      const start = before(pose, from);
      const end = before(pose, from.map((v, k) => v + along[k]!) as Vector);
      const way = end.map((v, k) => v - start[k]!) as Vector;
      const off = Math.hypot(...cross(minus(middle, start), way));
      if ((through && glass) || off > radius * Math.hypot(...way)) continue;
      for (let k = 0; k < corners.length; k += 9) {
        const far = meeting(start, way, corners, k);
        if (far < nearest) [nearest, best] = [far, { far, link, at: start.map((v, n) => v + far * way[n]!) as Vector }];
      }
    }
    return best;
  }

  mark(link: number | null): void {
    if (link === this.marked) return;
    this.marked = link;
    this.draw();
  }

  #down(event: PointerEvent): void {
    this.root.setPointerCapture(event.pointerId);
    this.#fingers.set(event.pointerId, event);
    this.#pulling = false;
    this.marked = null;
    if (this.#fingers.size > 1) return;
    const spot = this.#hit(...this.#placed(event));
    if (!spot || !this.machine.moves(spot.link)) return;
    this.#pulling = true;
    this.machine.take(spot);
    this.events.taken();
  }

  #move(event: PointerEvent): void {
    const old = this.#fingers.get(event.pointerId);
    if (!old) {
      if (event.pointerType !== "mouse") return;
      const link = this.#hit(...this.#placed(event))?.link ?? null;
      this.root.style.cursor = link !== null && this.machine.moves(link) ? "move" : "";
      this.mark(link);
      this.events.pointed(link);
      return;
    }
    const was = between(this.#fingers);
    this.#fingers.set(event.pointerId, event);
    if (this.#fingers.size > 1) return this.zoom(between(this.#fingers) / Math.max(was, 1));
    if (this.#pulling) {
      this.machine.pull(this.#camera, this.#wide, ...this.#placed(event));
      return this.events.pulled();
    }
    this.#round((old.clientX - event.clientX) / 150, (event.clientY - old.clientY) / 150);
  }

  #key(event: KeyboardEvent): void {
    const ways: Record<string, [number, number]> = {
      ArrowLeft: [0.1, 0],
      ArrowRight: [-0.1, 0],
      ArrowUp: [0, 0.1],
      ArrowDown: [0, -0.1],
    };
    const way = ways[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    this.#round(...way);
  }
}

/** The places of a body that are farthest in many directions, evenly spread: enough to tell how far it reaches. */
function farthest(vertices: number[]): Vector[] {
  const found = new Set<number>();
  for (let n = 0; vertices.length && n < DIRECTIONS; n++) {
    const z = (2 * n + 1) / DIRECTIONS - 1;
    const [x, y] = [Math.cos, Math.sin].map((part) => part(2.4 * n) * Math.sqrt(1 - z * z)) as [number, number];
    let [best, most] = [0, -Infinity];
    for (let k = 0; k < vertices.length; k += 3) {
      const far = x * vertices[k]! + y * vertices[k + 1]! + z * vertices[k + 2]!;
      if (far > most) [best, most] = [k, far];
    }
    found.add(best);
  }
  return [...found].map((k) => vertices.slice(k, k + 3) as Vector);
}

/** How broad places of the picture lie about the line that they are nearest to: the lesser of their two spreads. */
function breadth(places: Pair[]): number {
  const mean = (value: (at: Pair) => number) => places.reduce((sum, at) => sum + value(at), 0) / places.length;
  const [x, y] = [mean(([u]) => u), mean(([, v]) => v)];
  const [xx, yy] = [mean(([u]) => (u - x) ** 2), mean(([, v]) => (v - y) ** 2)];
  const xy = mean(([u, v]) => (u - x) * (v - y));
  return Math.sqrt(Math.max((xx + yy) / 2 - Math.hypot((xx - yy) / 2, xy), 0));
}

/** How far apart two fingers are. */
function between(fingers: Map<number, PointerEvent>): number {
  const [one, two] = [...fingers.values()];
  return one && two ? Math.hypot(one.clientX - two.clientX, one.clientY - two.clientY) : 0;
}

/** The name of a body without what explains it. */
function shortened(name: string): string {
  return name.replace(/ \(.*/, "");
}
