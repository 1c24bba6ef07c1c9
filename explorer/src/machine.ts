/** A linkage on the page: its sizes, its pose, its cycle, and what changes them. */

import { unwoundAngle } from "./closure";
import { Kernel, type Rows, type State, Status } from "./kernel";
import { currentLanguage } from "./language";
import type { Leg, LinkageDocument, Model, Place, PointRecord, ShapeRecord } from "./model";
import { Code, Kind, type Program, programOf } from "./program";

const TURN = 2 * Math.PI;
/** The same angle between -180° and 180°. */
const principal = (angle: number): number => angle - TURN * Math.round(angle / TURN);
const MOST_TURNS = 8;
const MOST_WITH_WHEELS = 40;
const BACK = 1e-7; // how near a linkage is to where it was, after whole turns
const OPEN = 1e-9; // sizes and radians: redundant joints that are open by more are not closed
const STILL = 1e-9; // of the natural speed: an output that is never faster does not move
const DOUBTFUL = 1e-6; // below this root a pose may be wrong by more than that
const ENDLESS = 1.5; // sizes: how far a slide without limits is shown

export interface Stop {
  value: number;
  status: Status | "open";
  /** The form and the links of the group at fault, or the name of the open joint. */
  form: string;
  links: string[];
}

/** The whole motion of one drive, the others at rest. */
export interface Cycle {
  drive: number;
  values: Float64Array;
  rows: Rows;
  full: boolean;
  /** After how many turns everything repeats; 0 if the drive does not go round. */
  turns: number;
  low: number;
  high: number;
  stops: [Stop | null, Stop | null];
  /** The row of the pose from which it was found. */
  home: number;
}

export interface Snapshot {
  at: number[];
  angles: number[];
  points: PointRecord[];
  drives: number[];
  signs: number[];
  unknowns: number[];
}

/** Two lines, then the pin of either link. */
type Cylinder = [number, number, number, number];

export interface DeadCentre {
  value: number;
  output: number;
}

/** Two wheels that mesh: the number of the condition, and their elements. */
interface Mesh {
  condition: number;
  sides: readonly [number, number];
}

/** The wheel whose centre a joint is, and an element at the centre of what it meshes with. */
interface Pivot {
  wheel: number;
  about: number;
}

/** Why a change was refused. */
export class Refused extends Error {
  constructor(readonly stop: Stop | null) {
    super("refused");
  }
}

export class Machine {
  readonly model: Model;
  readonly program: Program;
  readonly size: number;
  points: PointRecord[];
  /** (2 elements,) and (elements,): those of the linkage as it was given. */
  readonly at: Float64Array;
  readonly angles: Float64Array;
  /** All drive values, held ones of idle rollers behind the others. */
  readonly drives: Float64Array;
  readonly state: State;
  /** The pose that is shown: one row with velocities and accelerations for speed 1 of the active drive. */
  pose: Rows;
  active = 0;
  cycle: Cycle;
  private readonly kernel: Kernel;
  private readonly offsets: Float64Array;
  private readonly locked: boolean[];
  private readonly axes: (readonly [number, number] | null)[];
  private readonly wheels: boolean;
  private readonly meshes: Mesh[];
  /** Of each joint that is the centre of a wheel which can be moved around another one. */
  private readonly pivots: (Pivot | null)[];

  constructor(model: Model) {
    this.model = model;
    const p = programOf(model.program);
    this.program = p;
    this.size = p.size;
    this.kernel = new Kernel(p);
    this.at = Float64Array.from(model.elements.flatMap((e) => e.at));
    this.angles = Float64Array.from(model.elements.map((e) => e.angle));
    this.points = model.points.map((point) => ({ ...point, at: [...point.at] }));
    this.offsets = Float64Array.from(
      model.sources,
      (source, k) => Math.atan2(p.lines[2 * k + 1]!, p.lines[2 * k]!) - (source < 0 ? 0 : this.angles[source]!),
    );
    this.drives = Float64Array.from(model.start.drives);
    this.state = { signs: Float64Array.from(model.start.signs), unknowns: Float64Array.from(model.start.unknowns) };
    this.wheels = model.elements.some((e) => e.kind === "round");
    const locked = model.joints.map((_, joint) => this.isLocked(joint));
    // an axis goes with those of wheels at the same place of its link
    this.locked = locked.map(
      (held, joint) =>
        held ||
        this.elementsOf(joint).some((k) =>
          this.elementsOn(model.elements[k]!.link).some(
            (m) =>
              locked[model.elements[m]!.joint] &&
              m !== k &&
              model.elements[m]!.kind === "pin" &&
              this.gap(k, m) <= 1e-9 * this.size,
          ),
        ),
    );
    this.axes = model.links.map((_, link) => this.axisOf(link));
    this.pose = this.solve(this.drives, this.state, 2);
    this.meshes = Array.from(p.kinds).flatMap((kind, condition) => {
      const sides = [model.sources[p.sides[2 * condition]!]!, model.sources[p.sides[2 * condition + 1]!]!] as const;
      const round = sides.every((k) => k >= 0 && model.elements[k]!.kind === "round");
      return kind === Kind.MESH && p.values[6 * condition + 4] === 0 && round ? [{ condition, sides }] : [];
    });
    this.pivots = model.joints.map((_, joint) => this.pivotOf(joint));
    this.cycle = this.findCycle();
  }

  // --- what the linkage is -------------------------------------------------------------------------------------------

  elementsOf(joint: number): number[] {
    return this.model.elements.flatMap((e, k) => (e.joint === joint ? [k] : []));
  }

  elementsOn(link: number): number[] {
    return this.model.elements.flatMap((e, k) => (e.link === link ? [k] : []));
  }

  /** Where wheels, cams and the like touch, places are not free. */
  private isLocked(joint: number): boolean {
    const mine = this.elementsOf(joint);
    if (!mine.some((k) => this.model.elements[k]!.kind === "pin")) return true;
    if (mine.some((k) => this.model.elements[k]!.kind === "round")) return true;
    return mine.some((k) =>
      this.elementsOn(this.model.elements[k]!.link).some(
        (other) => this.model.elements[other]!.kind === "round" && this.gap(k, other) <= 1e-9 * this.size,
      ),
    );
  }

  /** What a link is called in the reader's language. */
  linkName(link: number): string {
    return this.model.linkNames[currentLanguage()]?.[link] ?? this.model.links[link]!;
  }

  /** Links by their names in the linkage, as the reader calls them. */
  linkList(links: readonly string[]): string {
    return links.map((name) => this.linkName(this.model.links.indexOf(name)) ?? name).join(", ");
  }

  draggable(joint: number): boolean {
    return !this.locked[joint] || this.pivots[joint] !== null;
  }

  /** A wheel keeps its distance from the wheels that it meshes with: its centre moves on a circle about theirs. */
  private pivotOf(joint: number): Pivot | null {
    const pins = this.elementsOf(joint);
    const near = 1e-9 * this.size;
    const elements = this.model.elements;
    let found: Pivot | null = null;
    let centre = -1;
    for (const { sides } of this.meshes)
      for (const side of [0, 1] as const) {
        const mine = sides[side],
          about = sides[1 - side]!;
        const wheel = elements[mine]!.link;
        const pin = pins.find(
          (k) => elements[k]!.link === wheel && elements[k]!.kind === "pin" && this.gap(k, mine) <= near,
        );
        if (pin === undefined) continue;
        if (found && (found.wheel !== wheel || this.apart(found.about, about) > near)) return null;
        found = { wheel, about };
        centre = pin;
      }
    if (!found) return null;
    const meshing = new Set(this.meshes.flatMap(({ sides }) => sides));
    const { wheel, about } = found;
    if (
      this.elementsOn(wheel).some(
        (k) => elements[k]!.kind === "round" && (!meshing.has(k) || this.gap(k, centre) > near),
      )
    )
      return null;
    const carriers = pins.filter((k) => elements[k]!.link !== wheel);
    const bare = carriers.every((k) =>
      this.elementsOn(elements[k]!.link).every((m) => elements[m]!.kind !== "round" || this.gap(k, m) > near),
    );
    return bare && carriers.some((k) => this.holds(elements[k]!.link, about)) ? found : null;
  }

  /** Whether the centre of a wheel is fixed on a link: by a joint of both, or one at the same place of a third link. */
  private holds(link: number, centre: number): boolean {
    const near = 1e-9 * this.size;
    const elements = this.model.elements;
    const pins = this.elementsOn(elements[centre]!.link).filter(
      (k) => elements[k]!.kind === "pin" && this.gap(k, centre) <= near,
    );
    return pins.some((pin) => {
      const joint = elements[pin]!.joint;
      if (this.elementsOf(joint).some((k) => elements[k]!.link === link)) return true;
      return this.elementsOn(link).some(
        (k) =>
          elements[k]!.kind === "pin" &&
          this.elementsOf(elements[k]!.joint).some((m) =>
            this.elementsOf(joint).some(
              (other) => elements[other]!.link === elements[m]!.link && this.gap(m, other) <= near,
            ),
          ),
      );
    });
  }

  /** The distance of two elements in the plane. */
  private apart(k: number, m: number): number {
    const [ax, ay] = this.elementAt(k),
      [bx, by] = this.elementAt(m);
    return Math.hypot(bx - ax, by - ay);
  }

  /** Where a joint comes to when it is dragged to a place. */
  permitted(joint: number, x: number, y: number): [number, number] {
    const pivot = this.pivots[joint];
    if (!pivot) return [x, y];
    const [cx, cy] = this.elementAt(pivot.about),
      [px, py] = this.jointAt(joint);
    const away = Math.hypot(x - cx, y - cy);
    if (!(away > 1e-9 * this.size)) return [px, py];
    const part = Math.hypot(px - cx, py - cy) / away;
    return [cx + part * (x - cx), cy + part * (y - cy)];
  }

  private gap(k: number, m: number): number {
    return Math.hypot(this.at[2 * k]! - this.at[2 * m]!, this.at[2 * k + 1]! - this.at[2 * m + 1]!);
  }

  /** The two pins between which a link's x axis runs, if it does. */
  private axisOf(link: number): readonly [number, number] | null {
    if (link === this.model.frame || link >= this.model.own) return null;
    const pins = this.elementsOn(link).filter((k) => this.model.elements[k]!.kind === "pin");
    const near = 1e-9 * this.size;
    const first = pins.find((k) => Math.hypot(this.at[2 * k]!, this.at[2 * k + 1]!) <= near);
    const other = pins.find((k) => k !== first && this.at[2 * k]! > near && Math.abs(this.at[2 * k + 1]!) <= near);
    return first === undefined || other === undefined ? null : [first, other];
  }

  private writeSizes(): void {
    const p = this.program;
    this.model.sources.forEach((source, k) => {
      if (source < 0) return;
      p.points[2 * k] = this.at[2 * source]!;
      p.points[2 * k + 1] = this.at[2 * source + 1]!;
      const angle = this.angles[source]! + this.offsets[k]!;
      p.lines[2 * k] = Math.cos(angle);
      p.lines[2 * k + 1] = Math.sin(angle);
    });
  }

  // --- poses ---------------------------------------------------------------------------------------------------------

  private speeds(count: number): Float64Array[] {
    const D = this.program.drives;
    const one = new Float64Array(count * D);
    for (let row = 0; row < count; row++) if (D) one[row * D + this.active] = 1;
    return [one, new Float64Array(count * D)];
  }

  private solve(drives: Float64Array, state: State, order: number): Rows {
    return this.kernel.run(drives, state, order, this.speeds(1));
  }

  /** Rows along values of the active drive, from a state at the first value; a slide stops where it is shortest. */
  private runAlong(values: Float64Array, state: State, order: number, drive = this.active): Rows {
    const D = this.program.drives;
    const rows: number[] = [];
    const asked: number[] = [];
    const special = this.shortest()
      .filter(([number]) => number === drive)
      .map(([, value]) => value);
    values.forEach((value, row) => {
      if (row > 0) {
        const last = values[row - 1]!;
        const passed = special
          .filter((s) => (s - last) * (s - value) < 0)
          .sort((a, b) => (a - b) * Math.sign(value - last));
        rows.push(...passed);
      }
      asked.push(rows.length);
      rows.push(value);
    });
    const path = new Float64Array(rows.length * D);
    rows.forEach((value, row) => {
      for (let d = 0; d < D; d++) path[row * D + d] = d === drive ? value : this.drives[d]!;
    });
    const found = this.kernel.run(path, state, order, this.speeds(rows.length));
    return asked.length === rows.length ? found : picked(found, asked, rows, values);
  }

  /** Where a driven slide brings the two joints of its body nearest; there steps could pass a limit unseen. */
  private shortest(): [number, number][] {
    if (this.model.shortest.length === 0) return [];
    const p = this.program;
    const out: [number, number][] = [];
    for (const operation of p.operations) {
      if (operation[0] !== Code.PUSH) continue;
      const [, k, near, far, sign] = operation as [number, number, number, number, number];
      const lx = p.lines[2 * near]!,
        ly = p.lines[2 * near + 1]!,
        fx = p.lines[2 * far]!,
        fy = p.lines[2 * far + 1]!;
      const tx = lx * fx + ly * fy,
        ty = ly * fx - lx * fy;
      for (const other of p.operations) {
        if (other[0] !== Code.RRR) continue;
        for (const at of [2, 4]) {
          let a = other[at]!,
            b = other[at + 1]!;
          const links = [p.links[near]!, p.links[far]!];
          if (!links.includes(p.links[a]!) || !links.includes(p.links[b]!) || p.links[a] === p.links[b]) continue;
          if (p.links[a] !== p.links[near]) [a, b] = [b, a];
          const dx = p.points[2 * b]! - p.points[2 * far]!,
            dy = p.points[2 * b + 1]! - p.points[2 * far + 1]!;
          const gx = p.points[2 * near]! + tx * dx - ty * dy - p.points[2 * a]!;
          const gy = p.points[2 * near + 1]! + tx * dy + ty * dx - p.points[2 * a + 1]!;
          out.push([k, -sign * (lx * gx + ly * gy)]);
        }
      }
    }
    return out;
  }

  /** A point of a link in a row of poses, or its velocity (1) or acceleration (2). */
  place(rows: Rows, row: number, link: number, x: number, y: number, k = 0): [number, number] {
    const n = rows.links;
    const tx = rows.turns[row * 2 * n + 2 * link]!,
      ty = rows.turns[row * 2 * n + 2 * link + 1]!;
    const ax = tx * x - ty * y,
      ay = tx * y + ty * x;
    const o = (row * (rows.order + 1) + k) * 2 * n + 2 * link;
    const ox = rows.places[o]!,
      oy = rows.places[o + 1]!;
    if (k === 0) return [ox + ax, oy + ay];
    const w = rows.rates[row * rows.order * n + link]!;
    if (k === 1) return [ox - w * ay, oy + w * ax];
    const a = rows.rates[(row * rows.order + 1) * n + link]!;
    return [ox - w * w * ax - a * ay, oy - w * w * ay + a * ax];
  }

  turn(rows: Rows, row: number, link: number): [number, number] {
    const at = row * 2 * rows.links + 2 * link;
    return [rows.turns[at]!, rows.turns[at + 1]!];
  }

  rate(rows: Rows, row: number, link: number, k = 1): number {
    return rows.rates[(row * rows.order + k - 1) * rows.links + link]!;
  }

  /** Where an element of the linkage lies. */
  elementAt(k: number, rows = this.pose, row = 0): [number, number] {
    return this.place(rows, row, this.model.elements[k]!.link, this.at[2 * k]!, this.at[2 * k + 1]!);
  }

  /** Where a joint lies: its pin, else the point of its line on the link that moves. */
  jointAt(joint: number, rows = this.pose, row = 0): [number, number] {
    const mine = this.elementsOf(joint);
    const pin = mine.find((k) => this.model.elements[k]!.kind === "pin");
    const moving = mine.find((k) => this.model.elements[k]!.link !== this.model.frame);
    return this.elementAt(pin ?? moving ?? mine[0]!, rows, row);
  }

  /** The lines of a shape on its link; those of a belt between the centres where they are now. */
  linesOf(shape: ShapeRecord): number[][] {
    const { lines = [], between } = shape;
    if (!between) return lines;
    const [ax, ay, bx, by] = between;
    const nearest = (x: number, y: number) => {
      // the pin of the frame that was there
      let best = -1,
        least = Infinity;
      this.model.elements.forEach((e, k) => {
        if (e.link !== shape.link || e.kind !== "pin") return;
        const off = Math.hypot(e.at[0] - x, e.at[1] - y);
        if (off < least) [best, least] = [k, off];
      });
      return best;
    };
    const one = nearest(ax, ay),
      two = nearest(bx, by);
    const [cx, cy, dx, dy] = [this.at[2 * one]!, this.at[2 * one + 1]!, this.at[2 * two]!, this.at[2 * two + 1]!];
    const wide = (bx - ax) ** 2 + (by - ay) ** 2;
    const c = ((bx - ax) * (dx - cx) + (by - ay) * (dy - cy)) / wide,
      s = ((bx - ax) * (dy - cy) - (by - ay) * (dx - cx)) / wide;
    return lines.map((line) =>
      line.map((_, k) => {
        const u = line[k - (k % 2)]! - ax,
          v = line[k - (k % 2) + 1]! - ay;
        return k % 2 ? cy + s * u + c * v : cx + c * u - s * v;
      }),
    );
  }

  toLocal(link: number, x: number, y: number): [number, number] {
    const [c, s] = this.turn(this.pose, 0, link);
    const dx = x - this.pose.places[2 * link]!,
      dy = y - this.pose.places[2 * link + 1]!;
    return [c * dx + s * dy, c * dy - s * dx];
  }

  // --- the cycle -----------------------------------------------------------------------------------------------------

  get drive(): { name: string; turning: boolean; joint: number } | null {
    return this.model.drives[this.active] ?? null;
  }

  /** The motion of the active drive over its whole range, from the pose that is shown. */
  findCycle(order = 2): Cycle {
    const drive = this.active;
    // as `pose_at_reference`, so that what the library says of this pose has the same lap; wheels count their turns
    if (this.drive?.turning && !this.wheels) this.drives[drive] = principal(this.drives[drive]!);
    const start = this.drives[drive] ?? 0;
    const only = (): Cycle => ({
      drive,
      values: Float64Array.of(start),
      rows: this.pose,
      full: false,
      turns: 0,
      low: start,
      high: start,
      stops: [null, null],
      home: 0,
    });
    if (!this.drive) return only();
    let beyond: [number, Stop | null] | null = null; // the upper end, if the first turn came to it
    const endOf = (tried: Float64Array, rows: Rows, way: number): [number, Stop | null] | null => {
      const open = this.firstOpen(rows);
      if (open)
        return [
          tried[Math.max(0, open.row - 1)]!,
          { value: tried[open.row]!, status: "open", form: open.name, links: [] },
        ];
      if (rows.status === Status.DONE) return null;
      const row = Math.min(Math.floor(rows.at), tried.length - 2);
      const value = tried[row]! + (rows.at - row) * way;
      return [value, this.stopOf(rows, value)];
    };
    if (this.drive.turning) {
      const most = this.wheels ? MOST_WITH_WHEELS : MOST_TURNS;
      let turns = 1;
      let steps = 360;
      for (
        ;
        turns <= most;
        turns = turns === 1 && this.model.span.turns > 1 ? Math.min(this.model.span.turns, most) : turns + 1
      ) {
        if (turns > 1) steps = turns <= MOST_TURNS ? 120 : 60;
        const values = Float64Array.from({ length: turns * steps + 1 }, (_, k) => start + (k * TURN) / steps);
        const rows = this.runAlong(values, this.state, turns === 1 ? order : Math.min(order, 2));
        const end = endOf(values, rows, TURN / steps);
        if (end) {
          if (turns === 1) beyond = end;
          break;
        }
        if (this.same(rows, turns * steps)) {
          return {
            drive,
            values,
            rows,
            full: true,
            turns,
            low: start,
            high: start + turns * TURN,
            stops: [null, null],
            home: 0,
          };
        }
        if (turns === most) break;
      }
    }
    const far = this.drive.turning ? MOST_TURNS * TURN : 3 * this.size;
    const step = this.drive.turning ? TURN / 180 : this.size / 40;
    const search = (way: number): [number, Stop | null] => {
      // by parts, so that a near limit is not looked for far away
      let from = start;
      let state = this.state;
      while (Math.abs(from - start) < far - 1e-9) {
        const values = Float64Array.from({ length: 31 }, (_, k) => from + way * k * step);
        const rows = this.runAlong(values, state, 0);
        const end = endOf(values, rows, way * step);
        if (end) return end;
        from = values[30]!;
        state = this.stateAt(rows, 30);
      }
      return [from, null];
    };
    let [high, above] = beyond ?? search(1);
    let [low, below] = search(-1);
    if (!this.drive.turning) {
      if (!above) high = Math.min(high, start + ENDLESS * this.size);
      if (!below) low = Math.max(low, start - ENDLESS * this.size);
    }
    if (high - low < 2e-6 * (this.drive.turning ? 1 : this.size)) {
      return { ...only(), low, high, stops: [below, above] };
    }
    const count = this.drive.turning ? Math.max(181, Math.ceil((high - low) / (TURN / 60))) : 181;
    const all = Array.from(
      { length: count },
      (_, k) => low + (high - low) * Math.sin((Math.PI * (k + 0.5)) / (2 * count)) ** 2,
    );
    const up = all.filter((value) => value > start),
      down = all.filter((value) => value <= start).reverse();
    const one = this.runAlong(Float64Array.of(start, ...up), this.state, order);
    const two = this.runAlong(Float64Array.of(start, ...down), this.state, order);
    const home = Math.max(0, two.reached - 1);
    const values = Float64Array.from([
      ...down.slice(0, home).reverse(),
      start,
      ...up.slice(0, Math.max(0, one.reached - 1)),
    ]);
    return { drive, values, rows: joined(two, one), full: false, turns: 0, low, high, stops: [below, above], home };
  }

  private same(rows: Rows, row: number): boolean {
    const n = rows.links,
      stride = (rows.order + 1) * 2 * n;
    for (let k = 0; k < 2 * n; k++) {
      if (Math.abs(rows.places[row * stride + k]! - rows.places[k]!) > BACK * this.size) return false;
      if (Math.abs(rows.turns[row * 2 * n + k]! - rows.turns[k]!) > BACK) return false;
    }
    return true;
  }

  stateAt(rows: Rows, row: number): State {
    const dyads = this.program.dyads,
      unknowns = this.state.unknowns.length;
    return {
      signs: rows.roots.slice(row * dyads, (row + 1) * dyads).map((root) => (root < 0 ? -1 : 1)),
      unknowns: rows.unknowns.slice(row * unknowns, (row + 1) * unknowns),
    };
  }

  stopOf(rows: Rows, value: number): Stop {
    const dyad = rows.fault >= 0;
    const number = dyad ? rows.fault : -1 - rows.fault;
    const group = this.model.groups.find((g) => g.dyad === dyad && g.number === number);
    return { value, status: rows.status, form: group?.form ?? "", links: group?.links ?? [] };
  }

  /** The first row in which a redundant joint is open. */
  private firstOpen(rows: Rows): { row: number; name: string } | null {
    if (this.model.released.length === 0) return null;
    for (let row = 0; row < rows.reached; row++) {
      if (this.leastRoot(rows, row) < DOUBTFUL) continue;
      for (const joint of this.model.released)
        if (this.opening(rows, row, joint) > OPEN) return { row, name: this.model.joints[joint]!.name };
    }
    return null;
  }

  private opening(rows: Rows, row: number, joint: number): number {
    const [first, ...others] = this.elementsOf(joint) as [number, ...number[]];
    const lineAt = (k: number) => {
      const [c, s] = this.turn(rows, row, this.model.elements[k]!.link);
      const a = this.angles[k]!;
      return [c * Math.cos(a) - s * Math.sin(a), c * Math.sin(a) + s * Math.cos(a)] as const;
    };
    let out = 0;
    for (const k of others) {
      const [ax, ay] = this.elementAt(first, rows, row),
        [bx, by] = this.elementAt(k, rows, row);
      const gx = (bx - ax) / this.size,
        gy = (by - ay) / this.size;
      const kinds = [this.model.elements[first]!.kind, this.model.elements[k]!.kind];
      const [lx, ly] = lineAt(kinds[0] === "line" ? first : k);
      const [ox, oy] = lineAt(k);
      const pair = this.model.joints[joint]!.pair;
      if (pair === "revolute") out = Math.max(out, Math.hypot(gx, gy));
      else if (pair === "roll_slide") out = Math.max(out, Math.abs(lx * gy - ly * gx));
      else if (pair === "double_slide") out = Math.max(out, Math.abs(lx * oy - ly * ox));
      else out = Math.max(out, Math.abs(lx * gy - ly * gx), Math.abs(lx * oy - ly * ox));
    }
    return out;
  }

  /** Bring the active drive to a value within its cycle; returns false where it cannot be reached. */
  moveTo(value: number): boolean {
    const cycle = this.cycle;
    if (!this.drive || cycle.values.length < 2) return false;
    if (cycle.full) {
      const period = cycle.turns * TURN;
      value = cycle.low + ((((value - cycle.low) % period) + period) % period);
    }
    const row = this.nearestRow(value);
    const rows = this.runAlong(Float64Array.of(cycle.values[row]!, value), this.stateAt(cycle.rows, row), 2);
    if (rows.reached < 2) return false;
    this.drives[this.active] = value;
    this.take(rows, 1);
    return true;
  }

  /** The row of the cycle nearest to a value, but not one in which modes meet. */
  private nearestRow(value: number): number {
    const { values, rows } = this.cycle;
    let low = 0,
      high = values.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (values[middle]! <= value) low = middle;
      else high = middle;
    }
    let row = value - values[low]! <= values[high]! - value ? low : high;
    if (this.leastRoot(rows, row) < 1e-5) row = this.leastRoot(rows, low) >= this.leastRoot(rows, high) ? low : high;
    return row;
  }

  /** How far a row is from a change point or limit of a dyad: at most 1. */
  private leastRoot(rows: Rows, row: number): number {
    const dyads = this.program.dyads;
    let out = 1;
    for (let m = 0; m < dyads; m++) out = Math.min(out, Math.abs(rows.roots[row * dyads + m]!));
    return out;
  }

  private take(rows: Rows, row: number): void {
    const state = this.stateAt(rows, row);
    this.state.signs.set(state.signs);
    this.state.unknowns.set(state.unknowns);
    this.pose = oneRow(rows, row);
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  snapshot(): Snapshot {
    return {
      at: [...this.at],
      angles: [...this.angles],
      points: this.points.map((p) => ({ ...p, at: [...p.at] })),
      drives: [...this.drives],
      signs: [...this.state.signs],
      unknowns: [...this.state.unknowns],
    };
  }

  restore(old: Snapshot, order = 2): void {
    this.at.set(old.at);
    this.angles.set(old.angles);
    this.points = old.points.map((p) => ({ ...p, at: [...p.at] }));
    this.drives.set(old.drives);
    this.state.signs.set(old.signs);
    this.state.unknowns.set(old.unknowns);
    this.writeSizes();
    this.pose = this.solve(this.drives, this.state, 2);
    this.cycle = this.findCycle(order);
  }

  /** Do something to the sizes; if it cannot be assembled then, everything is as before and `Refused` says why. */
  private change(edit: () => void, assemble: () => Rows): void {
    const old = this.snapshot();
    edit();
    this.writeSizes();
    const rows = assemble();
    if (rows.reached === 0) {
      const stop = this.stopOf(rows, this.drives[this.active] ?? 0);
      this.at.set(old.at);
      this.angles.set(old.angles);
      this.points = old.points;
      this.drives.set(old.drives);
      this.state.signs.set(old.signs);
      this.state.unknowns.set(old.unknowns);
      this.writeSizes();
      throw new Refused(stop);
    }
    this.take(rows, 0);
    this.cycle = this.findCycle();
  }

  /**
   * Take a joint to a place in the plane. All other joints stay where they are: the links of this joint change.
   * The centre of a wheel goes around those that it meshes with.
   */
  dragJoint(joint: number, toX: number, toY: number): void {
    if (!this.draggable(joint)) return;
    const poses = oneRow(this.pose, 0);
    const pivot = this.pivots[joint];
    const [x, y] = this.permitted(joint, toX, toY);
    const cylinders = this.model.joints.map((_, k) => this.cylinder(k)).filter((found) => found !== null);
    this.change(
      () => {
        const kept = new Set(cylinders.flatMap(([, , one, two]) => [one, two]));
        if (pivot) this.shiftWheel(poses, pivot.wheel, joint, x, y);
        for (const k of this.elementsOf(joint)) {
          if (!kept.has(k) && this.model.elements[k]!.link !== pivot?.wheel) this.moveElement(k, x, y, cylinders);
        }
        for (const cylinder of cylinders) this.straighten(poses, cylinder, joint, x, y);
        for (const [link, axis] of this.axes.entries()) if (axis) this.align(poses, link, axis);
        this.writeSizes();
        this.placeBlocks(poses);
        this.readState(poses);
        this.setPhases(poses);
      },
      () => this.solve(this.drives, this.state, 2),
    );
  }

  /** Move a wheel with its centre; its other joints stay where they are in the plane. */
  private shiftWheel(poses: Rows, wheel: number, joint: number, x: number, y: number): void {
    const [px, py] = this.jointAt(joint);
    const [c, s] = this.turn(poses, 0, wheel);
    const dx = x - px,
      dy = y - py;
    poses.places[2 * wheel]! += dx;
    poses.places[2 * wheel + 1]! += dy;
    for (const k of this.elementsOn(wheel)) {
      if (this.model.elements[k]!.joint === joint || this.model.elements[k]!.kind === "round") continue;
      this.at[2 * k]! -= c * dx + s * dy;
      this.at[2 * k + 1]! -= c * dy - s * dx;
    }
  }

  /** Let wheels mesh in a pose: their turns are counted from it, as the library does from that of the document. */
  private setPhases(poses: Rows): void {
    const p = this.program,
      reference = this.model.reference;
    for (const { condition, sides } of this.meshes) {
      const [one, two] = [p.sides[2 * condition]!, p.sides[2 * condition + 1]!];
      const k = reference.windings.findIndex(([, a, b]) => a === one && b === two);
      if (k < 0) continue;
      const at = 3 * reference.bodies.length + 2 * k;
      const [first, second, value] = p.values.subarray(6 * condition, 6 * condition + 3) as unknown as [
        number,
        number,
        number,
      ];
      const open = first * this.state.unknowns[at]! + second * this.state.unknowns[at + 1]! - value;
      this.angles[sides[1]]! -= open / second;
    }
    if (this.meshes.length === 0) return;
    this.writeSizes();
    this.readState(poses);
  }

  private moveElement(k: number, x: number, y: number, cylinders: Cylinder[]): void {
    const e = this.model.elements[k]!;
    const [u, v] = this.toLocal(e.link, x, y);
    const ou = this.at[2 * k]!,
      ov = this.at[2 * k + 1]!;
    if (e.kind === "line") {
      this.shiftLine(k, u, v);
      return;
    }
    this.at[2 * k] = u;
    this.at[2 * k + 1] = v;
    if (e.link === this.model.frame) return;
    // a slide through the pin goes on through it, on both of its links
    for (const m of this.elementsOn(e.link)) {
      if (this.model.elements[m]!.kind !== "line" || this.model.elements[m]!.joint === e.joint) continue;
      const a = this.angles[m]!;
      const off = Math.cos(a) * (ov - this.at[2 * m + 1]!) - Math.sin(a) * (ou - this.at[2 * m]!);
      if (Math.abs(off) > 1e-9 * this.size || cylinders.some(([one, two]) => one === m || two === m)) continue;
      for (const other of this.elementsOf(this.model.elements[m]!.joint)) {
        if (this.model.elements[other]!.kind === "line")
          this.shiftLine(other, ...this.toLocal(this.model.elements[other]!.link, x, y));
      }
    }
  }

  /** Let a line pass through a point of its link, its own point moved across it only. */
  private shiftLine(k: number, u: number, v: number): void {
    const a = this.angles[k]!,
      c = Math.cos(a),
      s = Math.sin(a);
    const off = c * (v - this.at[2 * k + 1]!) - s * (u - this.at[2 * k]!);
    this.at[2 * k]! -= s * off;
    this.at[2 * k + 1]! += c * off;
  }

  /** The lines and the pins of a slide between moving links whose pins lie on it, such as a cylinder; else null. */
  cylinder(joint: number): Cylinder | null {
    const record = this.model.joints[joint]!;
    if (record.pair !== "prismatic" || record.links.includes(this.model.frame)) return null;
    const lines = this.elementsOf(joint);
    const pins = lines.map((k) => this.elementsOn(this.model.elements[k]!.link).filter((m) => m !== k));
    if (pins.some((mine) => mine.length !== 1 || this.model.elements[mine[0]!]!.kind !== "pin")) return null;
    if (lines.some((k, side) => Math.abs(this.offLine(k, pins[side]![0]!)) > 1e-9 * this.size)) return null;
    return [lines[0]!, lines[1]!, pins[0]![0]!, pins[1]![0]!];
  }

  /** A cylinder whose end is dragged keeps its links, and turns into the line of its pins. */
  private straighten(poses: Rows, [one, two, pinOne, pinTwo]: Cylinder, dragged: number, x: number, y: number): void {
    const ends = [pinOne, pinTwo].map((k) =>
      this.model.elements[k]!.joint === dragged ? ([x, y] as const) : this.elementAt(k),
    );
    if (![pinOne, pinTwo].some((k) => this.model.elements[k]!.joint === dragged)) return;
    const dx = ends[1]![0] - ends[0]![0],
      dy = ends[1]![1] - ends[0]![1];
    for (const [line, pin, end] of [
      [one, pinOne, ends[0]!],
      [two, pinTwo, ends[1]!],
    ] as const) {
      const link = this.model.elements[line]!.link;
      const [tx, ty] = this.turn(poses, 0, link);
      const a = this.angles[line]!;
      const along =
        (tx * Math.cos(a) - ty * Math.sin(a)) * dx + (tx * Math.sin(a) + ty * Math.cos(a)) * dy < 0 ? -1 : 1;
      this.setPose(poses, link, Math.atan2(along * dy, along * dx) - a, pin, end[0], end[1]);
    }
  }

  private setPose(poses: Rows, link: number, angle: number, pin: number, x: number, y: number): void {
    const c = Math.cos(angle),
      s = Math.sin(angle),
      u = this.at[2 * pin]!,
      v = this.at[2 * pin + 1]!;
    poses.turns[2 * link] = c;
    poses.turns[2 * link + 1] = s;
    poses.places[2 * link] = x - (c * u - s * v);
    poses.places[2 * link + 1] = y - (s * u + c * v);
  }

  /** Give a link its x axis back, from pin to pin; nothing moves in the plane. */
  private align(poses: Rows, link: number, [first, other]: readonly [number, number]): void {
    const x = this.at[2 * first]!,
      y = this.at[2 * first + 1]!;
    const dx = this.at[2 * other]! - x,
      dy = this.at[2 * other + 1]! - y;
    const length = Math.hypot(dx, dy);
    if (!(length > 0) || (x === 0 && y === 0 && dy === 0 && dx > 0)) return;
    const c = dx / length,
      s = dy / length;
    const to = (u: number, v: number): [number, number] => [c * (u - x) + s * (v - y), c * (v - y) - s * (u - x)];
    for (const k of this.elementsOn(link)) {
      [this.at[2 * k], this.at[2 * k + 1]] = to(this.at[2 * k]!, this.at[2 * k + 1]!);
      if (this.model.elements[k]!.kind !== "pin") this.angles[k]! -= Math.atan2(s, c);
    }
    this.at[2 * first] = this.at[2 * first + 1] = this.at[2 * other + 1] = 0;
    this.at[2 * other] = length;
    for (const point of this.points) if (point.link === link) point.at = to(...point.at);
    const [tx, ty] = this.turn(poses, 0, link);
    poses.places[2 * link]! += tx * x - ty * y;
    poses.places[2 * link + 1]! += tx * y + ty * x;
    poses.turns[2 * link] = tx * c - ty * s;
    poses.turns[2 * link + 1] = tx * s + ty * c;
  }

  /** Drive values, signs and unknowns of a pose, as `gruebler.mechanics.kinematics.reference_pose` reads them. */
  private readState(poses: Rows): void {
    const p = this.program,
      reference = this.model.reference;
    const point = (e: number) => this.place(poses, 0, p.links[e]!, p.points[2 * e]!, p.points[2 * e + 1]!);
    const line = (e: number): [number, number] => {
      const [c, s] = this.turn(poses, 0, p.links[e]!);
      const x = p.lines[2 * e]!,
        y = p.lines[2 * e + 1]!;
      return [c * x - s * y, c * y + s * x];
    };
    reference.drives.forEach(([a, b, near, far], k) => {
      const [ax, ay] = this.turn(poses, 0, a!),
        [bx, by] = this.turn(poses, 0, b!);
      if (this.model.drives[k]?.turning ?? true)
        this.drives[k] = unwoundAngle(ax * bx + ay * by, ax * by - ay * bx, this.drives[k]!);
      else {
        const [lx, ly] = line(near!),
          [px, py] = point(near!),
          [qx, qy] = point(far!);
        this.drives[k] = lx * (qx - px) + ly * (qy - py);
      }
    });
    for (const operation of p.operations) {
      const kind: Code = operation[0]!;
      if (kind !== Code.RRR && kind !== Code.RRP && kind !== Code.RPR) continue;
      const [, outer, , inner, , , other] = operation as number[];
      const [ox, oy] = point(outer!),
        [ix, iy] = point(inner!),
        [tx, ty] = point(other!);
      let side: number;
      if (kind === Code.RRR) side = (tx - ox) * (iy - oy) - (ty - oy) * (ix - ox);
      else if (kind === Code.RRP) {
        const [lx, ly] = line(other!);
        side = lx * (ix - ox) + ly * (iy - oy);
      } else {
        const [lx, ly] = line(inner!);
        side = lx * (tx - ox) + ly * (ty - oy);
      }
      this.state.signs[operation[9]!] = side < 0 ? -1 : 1;
    }
    const y = this.state.unknowns;
    reference.bodies.forEach(([root, base], k) => {
      const [bx, by] = this.turn(poses, 0, base!),
        [rx, ry] = this.turn(poses, 0, root!);
      const dx = poses.places[2 * root!]! - poses.places[2 * base!]!,
        dy = poses.places[2 * root! + 1]! - poses.places[2 * base! + 1]!;
      y[3 * k] = bx * dx + by * dy;
      y[3 * k + 1] = bx * dy - by * dx;
      y[3 * k + 2] = unwoundAngle(bx * rx + by * ry, bx * ry - by * rx, y[3 * k + 2]!);
    });
    reference.windings.forEach(([kind, one, two], k) => {
      const at = 3 * reference.bodies.length + 2 * k;
      const [lx, ly] = line(one!),
        [ox, oy] = line(two!);
      if (kind === Kind.MESH) {
        const [px, py] = point(one!),
          [qx, qy] = point(two!);
        const gx = qx - px,
          gy = qy - py;
        y[at] = unwoundAngle(lx * gx + ly * gy, ly * gx - lx * gy, y[at]!);
        y[at + 1] = unwoundAngle(ox * gx + oy * gy, oy * gx - ox * gy, y[at + 1]!);
      } else y[at] = unwoundAngle(lx * ox + ly * oy, lx * oy - ly * ox, y[at]!);
    });
  }

  /** The sizes that a panel shows: for each link the distances of its joints, for slides of the frame their angle. */
  lengths(): { link: number; first: number; second: number; value: number }[] {
    const out: { link: number; first: number; second: number; value: number }[] = [];
    for (let link = 0; link < this.model.own; link++) {
      const mine = this.elementsOn(link).filter((k) => this.model.elements[k]!.kind !== "round");
      // each joint against the first two of its link: these distances fix the link
      for (let j = 1; j < mine.length; j++)
        for (let i = 0; i < Math.min(j, 2); i++) {
          const [a, b] = [mine[i]!, mine[j]!];
          const lines = [a, b].filter((k) => this.model.elements[k]!.kind === "line");
          if (lines.length === 2) continue;
          const value = lines.length ? Math.abs(this.offLine(lines[0]!, lines[0] === a ? b : a)) : this.gap(a, b);
          if (lines.length && value < 1e-9 * this.size && link !== this.model.frame) continue;
          if (this.locked[this.model.elements[a]!.joint] && this.locked[this.model.elements[b]!.joint]) continue;
          out.push({ link, first: a, second: b, value });
        }
    }
    return out;
  }

  /** How far a pin lies left of a line of its link. */
  private offLine(line: number, pin: number): number {
    const a = this.angles[line]!;
    return (
      Math.cos(a) * (this.at[2 * pin + 1]! - this.at[2 * line + 1]!) -
      Math.sin(a) * (this.at[2 * pin]! - this.at[2 * line]!)
    );
  }

  /** Give two joints of a link another distance: the second moves on the line through both. */
  setLength(first: number, second: number, length: number): void {
    if (!(length >= 0) || !(length < 1e9)) throw new Refused(null);
    const goal = new Float64Array(this.at);
    const kinds = [this.model.elements[first]!.kind, this.model.elements[second]!.kind];
    if (kinds.includes("line")) {
      const [line, pin] = kinds[0] === "line" ? [first, second] : [second, first];
      const off = this.offLine(line, pin),
        more = (off < 0 ? -length : length) - off,
        a = this.angles[line]!;
      goal[2 * line]! += Math.sin(a) * more;
      goal[2 * line + 1]! -= Math.cos(a) * more;
    } else {
      if (length < 1e-9 * this.size) throw new Refused(null);
      const dx = this.at[2 * second]! - this.at[2 * first]!,
        dy = this.at[2 * second + 1]! - this.at[2 * first + 1]!;
      const now = Math.hypot(dx, dy);
      goal[2 * second] = this.at[2 * first]! + (dx / now) * length;
      goal[2 * second + 1] = this.at[2 * first + 1]! + (dy / now) * length;
    }
    this.changeSlowly(goal);
  }

  /** Other sizes at the same drive values, in small steps, so that larger groups stay on their branch. */
  changeSlowly(goal: Float64Array): void {
    const start = new Float64Array(this.at);
    const state: State = { signs: new Float64Array(this.state.signs), unknowns: new Float64Array(this.state.unknowns) };
    const steps = this.program.roots.length ? 24 : 1;
    this.change(
      () => this.at.set(goal),
      () => {
        let rows = this.pose;
        for (let step = 1; step <= steps; step++) {
          for (let k = 0; k < goal.length; k++) this.at[k] = start[k]! + ((goal[k]! - start[k]!) * step) / steps;
          if (step === steps) this.at.set(goal);
          this.writeSizes();
          rows = this.solve(this.drives, state, 2);
          if (rows.reached === 0) return rows;
          Object.assign(state, this.stateAt(rows, 0));
        }
        return rows;
      },
    );
  }

  /** Assemble one dyad the other way at this drive value. */
  switchMode(number: number): void {
    const signs = new Float64Array(this.state.signs);
    signs[number]! *= -1;
    this.change(
      () => undefined,
      () => this.solve(this.drives, { signs, unknowns: this.state.unknowns }, 2),
    );
  }

  addPoint(name: string, link: number, x: number, y: number): void {
    this.points.push({ name, link, at: this.toLocal(link, x, y) });
  }

  /** The linkage as `gruebler.files` reads it; its reference pose is the one that is shown, or a row of others. */
  document(rows = this.pose, row = 0): LinkageDocument {
    const { model } = this;
    const out = structuredClone(model.document);
    const degrees = (angle: number) => (angle * 180) / Math.PI;
    model.elements.forEach((e, k) => {
      if (e.kind === "round") {
        (out.elements![model.links[e.link]!]![model.joints[e.joint]!.name] as { at: number[] }).at = [
          this.at[2 * k]!,
          this.at[2 * k + 1]!,
        ];
        return;
      }
      const place: number[] = [this.at[2 * k]!, this.at[2 * k + 1]!];
      if (e.kind === "line") place.push(degrees(this.angles[k]!));
      out.elements![model.links[e.link]!]![model.joints[e.joint]!.name] = place;
    });
    out.points = Object.fromEntries(this.points.map((p) => [p.name, { link: model.links[p.link]!, at: [...p.at] }]));
    delete out.home;
    out.reference_pose = Object.fromEntries(
      model.links.slice(0, model.own).map((name, link) => {
        const [c, s] = this.turn(rows, row, link);
        return [name, [...this.place(rows, row, link, 0, 0), degrees(Math.atan2(s, c))]];
      }),
    );
    return out;
  }

  /** Take sizes and pose from the document of a linkage of the same structure. */
  apply(document: LinkageDocument, drive?: number): void {
    const { model } = this;
    const degrees = Math.PI / 180;
    const numbers = (raw: unknown, count: number): number[] => {
      if (!Array.isArray(raw) || raw.length !== count) throw new Refused(null);
      // angles may have more digits than a number
      const found = raw.map((v) => (typeof v === "string" ? parseFloat(v) : v) as number);
      if (!found.every((v) => Number.isFinite(v))) throw new Refused(null);
      return found;
    };
    const poses = oneRow(this.pose, 0);
    if (drive !== undefined && Number.isFinite(drive)) this.drives[this.active] = drive;
    this.change(
      () => {
        model.elements.forEach((e, k) => {
          const given = document.elements?.[model.links[e.link]!]?.[model.joints[e.joint]!.name];
          const raw =
            e.kind === "round"
              ? numbers((given as { at?: unknown } | undefined)?.at, 2)
              : numbers(given, e.kind === "line" ? 3 : 2);
          this.at[2 * k] = raw[0]!;
          this.at[2 * k + 1] = raw[1]!;
          if (e.kind === "line") this.angles[k] = raw[2]! * degrees;
        });
        this.points = Object.entries(document.points ?? {}).map(([name, { link, at }]) => {
          const [x, y] = numbers(at, 2) as [number, number];
          const number = model.links.indexOf(link);
          if (number < 0 || number >= model.own) throw new Refused(null);
          return { name, link: number, at: [x, y] };
        });
        this.writeSizes();
        model.links.slice(0, model.own).forEach((name, link) => {
          const [x, y, angle] = numbers((document.reference_pose ?? document.home)?.[name], 3) as [
            number,
            number,
            number,
          ];
          poses.places[2 * link] = x;
          poses.places[2 * link + 1] = y;
          poses.turns[2 * link] = Math.cos(angle * degrees);
          poses.turns[2 * link + 1] = Math.sin(angle * degrees);
        });
        this.placeBlocks(poses);
        this.readState(poses);
        this.setPhases(poses);
      },
      () => this.solve(this.drives, this.state, 2),
    );
  }

  /** Where the blocks of pins in slots lie when the other links are placed: at the pin, turned with the slot. */
  private placeBlocks(poses: Rows): void {
    const p = this.program,
      { model } = this;
    for (let block = model.own; block < model.links.length; block++) {
      const mine = model.sources.flatMap((source, e) => (source < 0 && p.links[e] === block ? [e] : []));
      const name = model.links[block]!.replace(/^block /, "");
      const joint = model.joints.findIndex((j) => j.name === name);
      if (joint < 0 || !mine.length) continue;
      const [k, m] = this.elementsOf(joint).sort(
        (a, b) => Number(model.elements[b]!.kind === "line") - Number(model.elements[a]!.kind === "line"),
      );
      const slot = this.turn(poses, 0, model.elements[k!]!.link);
      const [x, y] = this.elementAt(k!, poses),
        [px, py] = this.elementAt(m!, poses);
      let [u, v] = [px, py];
      if (model.elements[m!]!.kind === "line") {
        const a = this.angles[k!]!;
        const lx = slot[0] * Math.cos(a) - slot[1] * Math.sin(a),
          ly = slot[0] * Math.sin(a) + slot[1] * Math.cos(a);
        const way = lx * (px - x) + ly * (py - y);
        [u, v] = [x + way * lx, y + way * ly];
      }
      poses.turns[2 * block] = slot[0];
      poses.turns[2 * block + 1] = slot[1];
      poses.places[2 * block] = u;
      poses.places[2 * block + 1] = v;
    }
  }

  // --- measures ------------------------------------------------------------------------------------------------------

  /** The output and its first two derivatives by the drive, in a row. */
  output(rows: Rows, row: number): [number, number, number] {
    const record = this.model.outputs[0];
    if (!record) return [NaN, NaN, NaN];
    if (record.joint === null) {
      const [c, s] = this.turn(rows, row, record.link);
      return [Math.atan2(s, c), this.rate(rows, row, record.link, 1), this.rate(rows, row, record.link, 2)];
    }
    const mine = this.elementsOf(record.joint);
    const line = mine.find((k) => this.model.elements[k]!.link === this.model.frame) ?? mine[0]!;
    const other = mine.find((k) => k !== line)!;
    const link = this.model.elements[line]!.link;
    const [c, s] = this.turn(rows, row, link);
    const a = this.angles[line]!;
    const lx = c * Math.cos(a) - s * Math.sin(a),
      ly = c * Math.sin(a) + s * Math.cos(a);
    const gap = [0, 1, 2].map((k) => {
      const [px, py] = this.place(rows, row, link, this.at[2 * line]!, this.at[2 * line + 1]!, k);
      const [qx, qy] = this.place(
        rows,
        row,
        this.model.elements[other]!.link,
        this.at[2 * other]!,
        this.at[2 * other + 1]!,
        k,
      );
      return [qx - px, qy - py] as const;
    }) as [readonly [number, number], readonly [number, number], readonly [number, number]];
    const dot = (k: 0 | 1 | 2) => lx * gap[k][0] + ly * gap[k][1];
    const across = (k: 0 | 1 | 2) => lx * gap[k][1] - ly * gap[k][0];
    const w = this.rate(rows, row, link, 1),
      al = this.rate(rows, row, link, 2);
    return [dot(0), dot(1) + w * across(0), dot(2) + 2 * w * across(1) + al * across(0) - w * w * dot(0)];
  }

  /** The output at rows of the cycle that follow one another. An angle has no jumps, and lies between -180° and 180°
   * where the cycle was found, as the library measures it from a reference pose. */
  outputAlong(rows: number[]): Float64Array {
    const values = Float64Array.from(rows, (row) => this.output(this.cycle.rows, row)[0]);
    if (this.model.outputs[0]?.joint !== null) return values;
    let turns = 0;
    const laps = values.map((value, k) => (turns -= k ? Math.round((value - values[k - 1]!) / TURN) : 0));
    const home = laps[rows.indexOf(this.cycle.home)] ?? 0;
    return values.map((value, k) => value + (laps[k]! - home) * TURN);
  }

  /** The transmission angle, at most pi/2; with several legs the smallest; NaN where there is none. */
  transmission(rows: Rows, row: number): number {
    const legs = this.model.outputs[0]?.legs ?? [];
    let out = legs.length ? Infinity : NaN;
    for (const leg of legs) {
      const [real, imag] = this.forceAndWay(rows, row, leg);
      out = Math.min(out, Math.atan2(Math.abs(real), Math.abs(imag)));
    }
    return out;
  }

  /** Cosine and sine between the force of a leg and the way of the point on which it acts. */
  private forceAndWay(rows: Rows, row: number, leg: Leg): [number, number] {
    const outer = this.legPlace(rows, row, leg.outer),
      inner = this.legPlace(rows, row, leg.inner);
    const acts = leg.form === "RP" ? outer : inner;
    let fx = inner.x - outer.x,
      fy = inner.y - outer.y;
    if (leg.form === "RP") [fx, fy] = [-inner.ly, inner.lx];
    else if (leg.form === "PR") [fx, fy] = [-outer.ly, outer.lx];
    let wx: number, wy: number;
    if (leg.guide) {
      const [kind, ...place] = leg.guide;
      const held = this.legPlace(rows, row, place);
      [wx, wy] = kind === "P" ? [held.lx, held.ly] : [held.y - acts.y, acts.x - held.x];
    } else [wx, wy] = this.wayOf(rows, row, leg.pushed, [acts.x, acts.y], leg.form === "RP" ? leg.outer : leg.inner);
    const length = Math.hypot(fx, fy) * Math.hypot(wx, wy);
    return [(fx * wx + fy * wy) / length, (fx * wy - fy * wx) / length];
  }

  private legPlace(rows: Rows, row: number, place: Place): { x: number; y: number; lx: number; ly: number } {
    const [link, px, py, dx, dy, element] = place;
    const p = this.program;
    const [u, v] = element < 0 ? [px, py] : [p.points[2 * element]!, p.points[2 * element + 1]!];
    const [a, b] = element < 0 ? [dx, dy] : [p.lines[2 * element]!, p.lines[2 * element + 1]!];
    const [x, y] = this.place(rows, row, link, u, v);
    const [c, s] = this.turn(rows, row, link);
    return { x, y, lx: c * a - s * b, ly: s * a + c * b };
  }

  /** The velocity of the place of a link where a point is; at rest the way in which it leaves. */
  private wayOf(rows: Rows, row: number, link: number, point: [number, number], place: Place): [number, number] {
    const n = rows.links,
      o = row * (rows.order + 1) * 2 * n + 2 * link;
    const dx = point[0] - rows.places[o]!,
      dy = point[1] - rows.places[o + 1]!;
    const w = this.rate(rows, row, link, 1),
      a = this.rate(rows, row, link, 2);
    const vx = rows.places[o + 2 * n]! - w * dy,
      vy = rows.places[o + 2 * n + 1]! + w * dx;
    let fastest = 0;
    for (let k = 0; k < n; k++) {
      const at = row * (rows.order + 1) * 2 * n + 2 * n + 2 * k;
      fastest = Math.max(
        fastest,
        Math.hypot(rows.places[at]!, rows.places[at + 1]!),
        this.size * Math.abs(this.rate(rows, row, k)),
      );
    }
    if (Math.hypot(vx, vy) >= 1e-7 * fastest) return [vx, vy];
    const [px, py] = this.place(rows, row, place[0], ...this.legPoint(place), 1);
    const rx = px - rows.places[o + 2 * n]!,
      ry = py - rows.places[o + 2 * n + 1]!;
    return [rows.places[o + 4 * n]! - a * dy - w * ry, rows.places[o + 4 * n + 1]! + a * dx + w * rx];
  }

  private legPoint([, px, py, , , element]: Place): [number, number] {
    const p = this.program;
    return element < 0 ? [px, py] : [p.points[2 * element]!, p.points[2 * element + 1]!];
  }

  /** Where the output turns back: zeros of its velocity, to 1e-9 of a radian or size. */
  deadCentres(): DeadCentre[] {
    const { values, rows } = this.cycle;
    const speed = Array.from(values, (_, row) => this.output(rows, row)[1]);
    const usual = Math.max(0, ...speed.map((v) => (Number.isFinite(v) ? Math.abs(v) : 0)));
    const out: DeadCentre[] = [];
    const natural = (this.model.outputs[0]?.joint === null ? 1 : this.size) / (this.drive?.turning ? 1 : this.size);
    if (!(usual > STILL * natural)) return out;
    const still = 1e-9 * usual;
    let last = -1;
    for (let row = 0; row < values.length; row++) {
      if (!(Math.abs(speed[row]!) > still)) continue;
      if (last >= 0 && speed[last]! * speed[row]! < 0 && row - last <= 2) {
        const found = this.zero(values[last]!, values[row]!, last, (one) => this.output(one.rows, one.row)[1]);
        if (found !== null) out.push(found);
      }
      last = row;
    }
    return out;
  }

  private at1(value: number, row: number): { rows: Rows; row: number } | null {
    const rows = this.runAlong(Float64Array.of(this.cycle.values[row]!, value), this.stateAt(this.cycle.rows, row), 2);
    return rows.reached < 2 ? null : { rows, row: 1 };
  }

  private zero(a: number, b: number, row: number, f: (one: { rows: Rows; row: number }) => number): DeadCentre | null {
    const at = (value: number) => {
      const one = this.at1(value, row);
      return one === null ? NaN : f(one);
    };
    let fa = at(a),
      fb = at(b);
    for (let k = 0; k < 60 && Math.abs(b - a) > 1e-11 * (1 + Math.abs(a)); k++) {
      let middle = k % 3 === 2 ? (a + b) / 2 : a - (fa * (b - a)) / (fb - fa);
      if (!(middle > Math.min(a, b) && middle < Math.max(a, b))) middle = (a + b) / 2;
      const fm = at(middle);
      if (Number.isNaN(fm)) return null;
      if (fm === 0) {
        a = b = middle;
        break;
      }
      if (fa * fm < 0) [b, fb] = [middle, fm];
      else [a, fa] = [middle, fm];
    }
    const one = this.at1((a + b) / 2, row);
    if (one && this.leastRoot(one.rows, one.row) < 1e-5) return null; // next to a change point velocities have no sign
    return one === null ? null : { value: (a + b) / 2, output: this.output(one.rows, one.row)[0] };
  }

  /** The smallest transmission angle over the cycle and where it is; at the ends of a range its limit counts. */
  leastTransmission(): { value: number; mu: number } | null {
    if (!this.model.outputs[0]?.legs.length) return null;
    const { values, rows, full } = this.cycle;
    const angles = Array.from(values, (_, row) => this.transmission(rows, row));
    const known = angles.filter(Number.isFinite).sort(ascending);
    if (!known.length) return null;
    const median = known[known.length >> 1]!;
    const spread = known.map((one) => Math.abs(one - median)).sort(ascending);
    if (spread[Math.floor(0.9 * (spread.length - 1))]! <= 1e-8) return { value: values[0]!, mu: median };
    let best = -1,
      mu = Infinity;
    angles.forEach((now, row) => {
      if (now < mu) [best, mu] = [row, now];
    });
    let found = { value: values[best]!, mu };
    let low = values[Math.max(0, best - 1)]!,
      high = values[Math.min(values.length - 1, best + 1)]!;
    const f = (value: number) => {
      const one = this.at1(value, best);
      return one === null ? Infinity : this.transmission(one.rows, one.row);
    };
    const ratio = 0.6180339887498949;
    let a = high - ratio * (high - low),
      b = low + ratio * (high - low);
    let fa = f(a),
      fb = f(b);
    for (let k = 0; k < 40; k++) {
      if (fa <= fb) {
        [high, b, fb] = [b, a, fa];
        a = high - ratio * (high - low);
        fa = f(a);
      } else {
        [low, a, fa] = [a, b, fb];
        b = low + ratio * (high - low);
        fb = f(b);
      }
    }
    for (const [value, angle] of [
      [a, fa],
      [b, fb],
    ] as const)
      if (angle < found.mu) found = { value, mu: angle };
    if (!full && values.length > 2) {
      for (const upper of [false, true]) {
        const end = this.transmissionAtEnd(upper);
        if (end < found.mu) found = { value: upper ? this.cycle.high : this.cycle.low, mu: end };
      }
    }
    return found;
  }

  /** The transmission angle at an end of the range, where poses are ill-conditioned: in t, with the drive at
   * middle - cos t times half the width, it is analytic and extrapolated from t up to 0.3 by a polynomial. */
  private transmissionAtEnd(upper: boolean): number {
    const { values, low, high } = this.cycle;
    const half = (high - low) / 2,
      nodes = 10;
    const row = upper ? values.length - 2 : 1;
    let out = Infinity;
    for (const leg of this.model.outputs[0]!.legs) {
      let re = 0,
        im = 0,
        sum = 0;
      for (let k = 0; k < nodes; k++) {
        const angle = ((2 * k + 1) * Math.PI) / (2 * nodes);
        const t = 0.15 * (1 - Math.cos(angle));
        const from = half * 2 * Math.sin(t / 2) ** 2;
        const one = this.at1(upper ? high - from : low + from, row);
        if (one === null) return Infinity;
        const weight = ((k % 2 ? -1 : 1) * Math.sin(angle)) / t;
        const [x, y] = this.forceAndWay(one.rows, one.row, leg);
        re += weight * x;
        im += weight * y;
        sum += weight;
      }
      out = Math.min(out, Math.atan2(Math.abs(re / sum), Math.abs(im / sum)));
    }
    return out;
  }

  /** The pole of a link and the diameter of its inflection circle in a row; null where it does not turn. */
  pole(rows: Rows, row: number, link: number): { x: number; y: number; dx: number; dy: number } | null {
    const w = this.rate(rows, row, link);
    const n = rows.links,
      o = row * (rows.order + 1) * 2 * n + 2 * link;
    const vx = rows.places[o + 2 * n]!,
      vy = rows.places[o + 2 * n + 1]!;
    if (Math.abs(w) * 1e4 * this.size <= Math.hypot(vx, vy) || !(Math.abs(w) > 1e-12)) return null;
    const px = -vy / w,
      py = vx / w; // from the link's origin
    if (rows.order < 2) return { x: rows.places[o]! + px, y: rows.places[o + 1]! + py, dx: 0, dy: 0 };
    const a = this.rate(rows, row, link, 2);
    const ax = rows.places[o + 4 * n]! - w * w * px - a * py,
      ay = rows.places[o + 4 * n + 1]! - w * w * py + a * px;
    return { x: rows.places[o]! + px, y: rows.places[o + 1]! + py, dx: ax / (w * w), dy: ay / (w * w) };
  }
}

const ascending = (a: number, b: number): number => a - b;

function oneRow(rows: Rows, row: number): Rows {
  const n = rows.links,
    wide = (rows.order + 1) * 2 * n;
  const roots = rows.roots.length / Math.max(1, rows.turns.length / (2 * n));
  const unknowns = rows.unknowns.length / Math.max(1, rows.turns.length / (2 * n));
  return {
    ...rows,
    status: Status.DONE,
    reached: 1,
    at: 0,
    places: rows.places.slice(row * wide, (row + 1) * wide),
    turns: rows.turns.slice(row * 2 * n, (row + 1) * 2 * n),
    rates: rows.rates.slice(row * rows.order * n, (row + 1) * rows.order * n),
    roots: rows.roots.slice(row * roots, (row + 1) * roots),
    unknowns: rows.unknowns.slice(row * unknowns, (row + 1) * unknowns),
  };
}

const WIDE = ["places", "turns", "rates", "roots", "unknowns"] as const;

/** Some rows of others; `at` is a place between the rows asked for. */
function picked(rows: Rows, asked: number[], all: number[], values: Float64Array): Rows {
  const count = all.length;
  const reached = asked.filter((row) => row < rows.reached).length;
  const out = { ...rows, reached };
  for (const key of WIDE) {
    const wide = rows[key].length / count;
    const made = new Float64Array(wide * asked.length);
    for (const [k, row] of asked.entries()) made.set(rows[key].subarray(row * wide, (row + 1) * wide), k * wide);
    out[key] = made;
  }
  if (rows.status !== Status.DONE) {
    const low = Math.min(Math.floor(rows.at), count - 1),
      high = Math.min(low + 1, count - 1);
    const value = all[low]! + (rows.at - low) * (all[high]! - all[low]!);
    const last = Math.max(0, reached - 1),
      next = Math.min(last + 1, values.length - 1);
    out.at = last + (next === last ? 0 : (value - values[last]!) / (values[next]! - values[last]!));
  }
  return out;
}

/** Rows that go down from a pose, turned round, then those that go up; the pose itself once. */
function joined(down: Rows, up: Rows): Rows {
  const out = { ...up, reached: down.reached - 1 + up.reached, status: Status.DONE };
  for (const key of WIDE) {
    const countUp = up.turns.length / (2 * up.links);
    const wide = up[key].length / countUp;
    const made = new Float64Array(wide * out.reached);
    for (let row = 1; row < down.reached; row++)
      made.set(down[key].subarray(row * wide, (row + 1) * wide), (down.reached - 1 - row) * wide);
    made.set(up[key].subarray(0, up.reached * wide), (down.reached - 1) * wide);
    out[key] = made;
  }
  return out;
}
