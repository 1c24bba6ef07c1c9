/** A linkage on the page: its sizes, its pose, its cycle; how it is solved and moved. */

import { type Beside, besideOf } from "./beside";
import { type Cycle, findCycle, stopOf, TURN } from "./cycle";
import { Kernel, type Rows, type State } from "./kernel";
import { currentLanguage, inLetters, spaced } from "./language";
import type { DriveRecord, Model } from "./model";
import { Code, type Program, programOf } from "./program";
import { Refused } from "./refused";
import { leastRoot, oneRow, origin, type Pair, picked, place, stateAt, turn } from "./rows";
import { Sizes } from "./sizes";
import type { Snapshot } from "./snapshot";

/** Below this root a row is no place from which to go on. */
const NEAR_CHANGE = 1e-5;
/** The least step of a quick search, in rows: what is shown does not tell it from the end. */
const QUICK = 1e-8;

export class Linkage {
  readonly sizes: Sizes;
  /** What the page shows beside it. */
  beside: Beside;
  /** What acts on it, as its document has it. */
  loads: unknown;
  readonly program: Program;
  /** All drive values, held ones of idle rollers behind the others. */
  readonly drives: Float64Array;
  readonly state: State;
  /** The pose that is shown: one row with velocities and accelerations for speed 1 of the active drive. */
  pose: Rows;
  active = 0;
  cycle: Cycle;
  /** The sizes with which it was made. */
  readonly opened: Snapshot;
  /** Whether it has wheels, whose turns are counted. */
  readonly wheels: boolean;
  /** Whether a joint or a point of it is being dragged. */
  dragged = false;
  /** Whether the drag moves: then ends of larger groups are found less exactly, and half as many rows of the cycle. */
  quick = false;
  /** Whether the cycle is still that of the step before, as in every second step of a drag where it takes long. */
  late = false;
  readonly #kernel: Kernel;
  /** Of each element of the plan: its direction against that of its element in the linkage. */
  readonly #offsets: Float64Array;

  constructor(readonly model: Model) {
    const p = programOf(model.program);
    this.program = p;
    this.#kernel = new Kernel(p);
    this.sizes = new Sizes(model, p.size);
    this.beside = besideOf(model.document);
    this.loads = model.document.loads;
    this.#offsets = Float64Array.from(model.sources, (source, k) => {
      const angle = Math.atan2(p.lines[2 * k + 1]!, p.lines[2 * k]!);
      return angle - (source < 0 ? 0 : this.sizes.angles[source]!);
    });
    this.drives = Float64Array.from(model.start.drives);
    this.state = {
      signs: Float64Array.from(model.start.signs),
      unknowns: Float64Array.from(model.start.unknowns),
    };
    this.wheels = model.elements.some((e) => e.kind === "round");
    this.pose = this.solve();
    this.cycle = findCycle(this);
    this.opened = this.snapshot();
  }

  // --- what it is ----------------------------------------------------------------------------------------------------

  /** About how large it is. */
  get size(): number {
    return this.sizes.unit;
  }

  get drive(): DriveRecord | null {
    return this.model.drives[this.active] ?? null;
  }

  /** Its name in the reader's language. */
  get title(): string {
    return this.model.names[currentLanguage()] ?? this.model.name;
  }

  /** What a link is called in the reader's language. */
  linkName(link: number): string {
    return spaced(this.model.linkNames[currentLanguage()]?.[link] ?? this.model.links[link]!);
  }

  /** What a joint is called where it was drawn. */
  letterOf(joint: number): string | undefined {
    return this.beside.letters?.split(" ")[joint];
  }

  /** What the joint of this name is called for the reader: its letter, else its links, where they have no other. */
  jointName(name: string): string {
    const { joints } = this.model;
    const number = joints.findIndex((one) => one.name === name);
    const letter = this.letterOf(number);
    const links = joints[number]?.links;
    if (letter || !links) return letter ?? name;
    const alone = joints.every((one, k) => k === number || String(one.links) !== String(links));
    return alone ? links.map((link) => this.linkName(link)).join(" – ") : this.jointSymbol(name);
  }

  /** The same as in tables, with the sign of its kind. */
  jointSymbol(name: string): string {
    const number = this.model.joints.findIndex((one) => one.name === name);
    const links = this.model.joints[number]?.links.map((link) => this.linkName(link)).join("-");
    const signed = () => name.replace(/^(.*?)\(.*\)/, (_, sign: string) => `${inLetters(sign)}(${links})`);
    return this.letterOf(number) ?? (links ? signed() : name);
  }

  /** What a drive is called: as the link that it moves, of a cylinder its barrel, where that is a word; where the joint
   * has a letter by that. */
  driveName(number: number): string {
    const { drives, frame, joints } = this.model;
    const moved = ({ joint, turning }: DriveRecord) => {
      const { links } = joints[joint]!;
      const [one, other = one] = links.filter((own) => own !== frame);
      return links[2] === undefined ? (turning ? other : one)! : -1;
    };
    const drive = drives[number]!;
    const link = moved(drive);
    const plain = this.letterOf(drive.joint) || drives.filter((one) => moved(one) === link)[1];
    return plain || link < 0 || /^\d/.test(this.linkName(link)) ? this.jointName(drive.name) : this.linkName(link);
  }

  /** What a point is called in the reader's language. */
  pointName(name: string): string {
    return this.model.pointNames?.[currentLanguage()]?.[name] ?? name;
  }

  /** Links by their names in the linkage, as the reader calls them. */
  linkList(links: readonly string[]): string {
    const names = links.map((name) => this.linkName(this.model.links.indexOf(name)));
    return new Intl.ListFormat(currentLanguage()).format(names);
  }

  /** Where an element lies in the plane. */
  elementAt(k: number, rows = this.pose, row = 0): Pair {
    return place(rows, row, this.sizes.element(k).link, ...this.sizes.xy(k));
  }

  /** Where a joint lies: its pin, else the point of its line on the link that moves. */
  jointAt(joint: number, rows = this.pose, row = 0): Pair {
    const { sizes, model } = this;
    const mine = sizes.elementsOf(joint);
    const pin = mine.find((k) => sizes.is(k, "pin"));
    const moving = mine.find((k) => sizes.element(k).link !== model.frame);
    return this.elementAt(pin ?? moving ?? mine[0]!, rows, row);
  }

  /** Where a place in the plane lies on a link. */
  toLocal(link: number, x: number, y: number): Pair {
    const [c, s] = turn(this.pose, 0, link);
    const [ox, oy] = origin(this.pose, 0, link);
    const dx = x - ox;
    const dy = y - oy;
    return [c * dx + s * dy, c * dy - s * dx];
  }

  // --- solving -------------------------------------------------------------------------------------------------------

  /** The pose of the drive values; `reached` is 0 if there is none. */
  solve(state = this.state): Rows {
    return this.#kernel.run(this.drives, state, 2, this.#speeds(1));
  }

  /** Tell the plan the sizes. */
  writeSizes(): void {
    const { points, lines } = this.program;
    this.model.sources.forEach((source, k) => {
      if (source < 0) return;
      [points[2 * k], points[2 * k + 1]] = this.sizes.xy(source);
      const angle = this.sizes.angles[source]! + this.#offsets[k]!;
      lines[2 * k] = Math.cos(angle);
      lines[2 * k + 1] = Math.sin(angle);
    });
  }

  /** Speed 1 of the active drive, no acceleration. */
  #speeds(count: number): Float64Array[] {
    const D = this.program.drives;
    const one = new Float64Array(count * D);
    for (let row = 0; row < count; row++) if (D) one[row * D + this.active] = 1;
    return [one, new Float64Array(count * D)];
  }

  /** Rows along values of the active drive, from a state at the first value; a slide stops where it is shortest. */
  runAlong(values: Float64Array, state: State, order: number, quick = this.quick): Rows {
    const special = this.#shortest();
    if (special.length === 0) return this.#runThrough(values, state, order, quick);
    const rows: number[] = [];
    const asked: number[] = [];
    values.forEach((value, row) => {
      if (row > 0) {
        const last = values[row - 1]!;
        const way = Math.sign(value - last);
        rows.push(...special.filter((s) => (s - last) * (s - value) < 0).sort((a, b) => (a - b) * way));
      }
      asked.push(rows.length);
      rows.push(value);
    });
    const found = this.#runThrough(rows, state, order, quick);
    return asked.length === rows.length ? found : picked(found, asked, rows, values);
  }

  #runThrough(values: ArrayLike<number>, state: State, order: number, quick: boolean): Rows {
    const D = this.program.drives;
    const path = new Float64Array(values.length * D);
    for (let row = 0; row < values.length; row++) {
      path.set(this.drives, row * D);
      path[row * D + this.active] = values[row]!;
    }
    const speeds = order ? this.#speeds(values.length) : [];
    return this.#kernel.run(path, state, order, speeds, quick ? QUICK : undefined);
  }

  /** Where the driven slide brings the two joints of its body nearest; there steps could pass a limit unseen. */
  #shortest(): number[] {
    if (this.model.shortest.length === 0) return [];
    const { lines, links, operations, points } = this.program;
    const out: number[] = [];
    for (const operation of operations) {
      if (operation[0] !== Code.PUSH || operation[1] !== this.active) continue;
      const [, , near, far, sign] = operation as [number, number, number, number, number];
      const [lx, ly] = [lines[2 * near]!, lines[2 * near + 1]!];
      const [fx, fy] = [lines[2 * far]!, lines[2 * far + 1]!];
      const tx = lx * fx + ly * fy;
      const ty = ly * fx - lx * fy;
      for (const other of operations) {
        if (other[0] !== Code.RRR) continue;
        for (const at of [2, 4]) {
          let [a, b] = [other[at]!, other[at + 1]!];
          const body = [links[near]!, links[far]!];
          if (!body.includes(links[a]!) || !body.includes(links[b]!) || links[a] === links[b]) continue;
          if (links[a] !== links[near]) [a, b] = [b, a];
          const dx = points[2 * b]! - points[2 * far]!;
          const dy = points[2 * b + 1]! - points[2 * far + 1]!;
          const gx = points[2 * near]! + tx * dx - ty * dy - points[2 * a]!;
          const gy = points[2 * near + 1]! + tx * dy + ty * dx - points[2 * a + 1]!;
          out.push(-sign * (lx * gx + ly * gy));
        }
      }
    }
    return out;
  }

  // --- moving --------------------------------------------------------------------------------------------------------

  /** Bring the active drive to a value within its cycle; returns false where it cannot be reached. */
  moveTo(value: number): boolean {
    const rows = this.at(value);
    if (!rows) return false;
    this.drives[this.active] = this.#inCycle(value);
    this.#take(rows, 1);
    return true;
  }

  /** Two rows, of which the second has the active drive at a value within its cycle; null where it cannot be. */
  at(value: number): Rows | null {
    if (!this.drive || this.cycle.values.length < 2) return null;
    const goal = this.#inCycle(value);
    const rows = this.from(this.#nearestRow(goal), goal);
    return rows.reached < 2 ? null : rows;
  }

  /** The same value of the drive within the cycle. */
  #inCycle(value: number): number {
    const { full, low, turns } = this.cycle;
    const period = turns * TURN;
    return full ? low + ((((value - low) % period) + period) % period) : value;
  }

  /** Two rows: one of the cycle, and what the drive comes to from it. */
  from(row: number, value: number): Rows {
    const { rows, values } = this.cycle;
    return this.runAlong(Float64Array.of(values[row]!, value), stateAt(rows, row), 2);
  }

  /** The row of the cycle nearest to a value, but not one in which modes meet. */
  #nearestRow(value: number): number {
    const { values, rows } = this.cycle;
    let low = 0;
    let high = values.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (values[middle]! <= value) low = middle;
      else high = middle;
    }
    const row = value - values[low]! <= values[high]! - value ? low : high;
    if (leastRoot(rows, row) >= NEAR_CHANGE) return row;
    return leastRoot(rows, low) >= leastRoot(rows, high) ? low : high;
  }

  #take(rows: Rows, row: number): void {
    const state = stateAt(rows, row);
    this.state.signs.set(state.signs);
    this.state.unknowns.set(state.unknowns);
    this.pose = oneRow(rows, row);
  }

  /** Move another drive. */
  choose(active: number): void {
    this.active = active;
    this.restore(this.snapshot());
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  snapshot(): Snapshot {
    return {
      ...this.sizes.snapshot(),
      drives: [...this.drives],
      signs: [...this.state.signs],
      unknowns: [...this.state.unknowns],
      beside: this.beside,
      loads: this.loads,
    };
  }

  restore(old: Snapshot): void {
    this.#put(old);
    this.pose = this.solve();
    this.cycle = findCycle(this);
  }

  #put(old: Snapshot): void {
    this.sizes.restore(old);
    this.beside = old.beside;
    this.loads = old.loads;
    this.drives.set(old.drives);
    this.state.signs.set(old.signs);
    this.state.unknowns.set(old.unknowns);
    this.writeSizes();
  }

  /** Begin to drag, or end. */
  drag(on: boolean): void {
    this.rest();
    this.dragged = on;
  }

  /** The drag does not move, or is over: the cycle is exact again. */
  rest(): void {
    const was = this.quick;
    this.quick = false;
    if (was) this.cycle = findCycle(this);
  }

  /** Do something to the sizes; if it cannot be assembled then, everything is as before and `Refused` says why. */
  change(edit: () => void, assemble = () => this.solve()): void {
    const old = this.snapshot();
    try {
      edit();
      this.writeSizes();
      const rows = assemble();
      if (rows.reached === 0) throw new Refused(stopOf(this.sizes, rows, this.drives[this.active] ?? 0));
      this.#take(rows, 0);
    } catch (error) {
      this.#put(old);
      throw error;
    }
    this.late = this.quick && this.program.roots.length > 0 && !this.late;
    this.quick = this.dragged;
    if (!this.late) this.cycle = findCycle(this);
  }

  /** Change the sizes at the drive value nearest to the present one at which that is possible, if there is one. */
  elsewhere(edit: () => void): boolean {
    const old = this.snapshot();
    const { values } = this.cycle;
    const here = this.drives[this.active]!;
    const step = Math.max(1, Math.floor(values.length / 36));
    const tried = values.filter((_, row) => row % step === 0).sort((a, b) => Math.abs(a - here) - Math.abs(b - here));
    for (const value of tried)
      try {
        if (!this.moveTo(value)) continue;
        edit();
        return true;
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
      }
    this.restore(old);
    return false;
  }

  /** Other sizes at the same drive values, in small steps, so that larger groups stay on their branch. */
  changeSlowly(goal: Float64Array): void {
    const { at } = this.sizes;
    const start = new Float64Array(at);
    let state: State = { signs: new Float64Array(this.state.signs), unknowns: new Float64Array(this.state.unknowns) };
    const steps = this.program.roots.length ? 24 : 1;
    this.change(
      () => at.set(goal),
      () => {
        let rows = this.pose;
        for (let step = 1; step <= steps; step++) {
          for (let k = 0; k < goal.length; k++) at[k] = start[k]! + ((goal[k]! - start[k]!) * step) / steps;
          if (step === steps) at.set(goal);
          this.writeSizes();
          rows = this.solve(state);
          if (rows.reached === 0) return rows;
          state = stateAt(rows, 0);
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
      () => this.solve({ signs, unknowns: this.state.unknowns }),
    );
  }

  addPoint(link: number, x: number, y: number): void {
    const { points } = this.sizes;
    const taken = new Set([...points.map(({ name }) => name), ...this.model.links]);
    let number = 1;
    while (taken.has(`K${number}`)) number++;
    points.push({ name: `K${number}`, link, at: this.toLocal(link, x, y) });
  }
}
