/** A linkage moved along a path of its drives: every group after the other, every step checked for continuity.
 *
 * The interpreter of the solving plan that Python flattens (`gruebler.page.model`), with the rules of
 * `core/src/motion`: placing, dyads, path. A step is halved until what is found is near what was foretold, so
 * that nothing jumps from one assembly mode to another; docs/theory/kinematics.md has the theorems. */

import {
  closeNearSingular,
  closing,
  closingRates,
  FARTHEST,
  factor,
  type GroupScratch,
  jet,
  newton,
  newtonResult,
  rotated,
  solveFactored,
  unwoundAngle,
} from "./closure";
import { Code, Kind, type Program } from "./program";

export const enum Status {
  DONE,
  LIMIT,
  SINGULAR,
  START,
}

const enum Verdict {
  GOOD,
  APPROACH,
  APART,
  LOST,
  MEET,
}

const FLAT = 1e-12;
const NEAR = 1e-3;
const LEAST = 1e-14;
const NEAREST = 1e-8;
const NOISE = 1e-14;
const KNOWN = 1e-3; // of the way: the least step on where nothing farther is known

/** Where a motion starts: the signs of its dyads and the unknowns of its larger groups. */
export interface State {
  signs: Float64Array;
  unknowns: Float64Array;
}

/** Rows of poses; arrays are indexed by row, then by link (or dyad, or unknown). */
export interface Rows {
  status: Status;
  reached: number;
  /** Where on the path it stopped, in rows. */
  at: number;
  /** The dyad at fault, or -1 minus the larger group. */
  fault: number;
  order: number;
  links: number;
  /** [((row * (order + 1)) + k) * 2 * links + 2 * link] */
  places: Float64Array;
  /** [row * 2 * links + 2 * link] */
  turns: Float64Array;
  /** [((row * order) + k) * links + link] */
  rates: Float64Array;
  roots: Float64Array;
  unknowns: Float64Array;
}

export class Kernel {
  readonly p: Program;
  private readonly links: number;
  private readonly dyads: number;
  private readonly unknownCount: number;
  private readonly groups: number;

  // the pose that is being placed
  /** [6 * link + 2 * order] */
  readonly places: Float64Array;
  /** [2 * link] */
  readonly turns: Float64Array;
  /** [2 * link + order - 1] */
  readonly rates: Float64Array;
  private readonly before: Float64Array;
  // six slots of a dyad
  private readonly points = new Float64Array(36);
  private readonly lines = new Float64Array(12);
  private readonly spins = new Float64Array(12);
  private readonly drives: Float64Array; // [order * drives + d]
  private readonly foretold: Float64Array;
  private readonly bodyTurns: Float64Array;
  private readonly bodyRates: Float64Array;
  private readonly bodyPlaces: Float64Array;
  private readonly s: GroupScratch;

  // the last poses, newest first; index 3 is the trial
  private readonly at = new Float64Array(4);
  private filled = 0;
  private readonly roots: Float64Array[];
  private readonly unknowns: Float64Array[];
  private readonly determinants: Float64Array[];
  private readonly signs: Float64Array;
  private readonly change: Float64Array;
  private readonly after: Float64Array;
  private readonly met: Float64Array;
  private readonly direction: Float64Array;
  private singular = 0;
  private unit = 1;
  private which = 0;

  private path: Float64Array = new Float64Array(0);
  private speeds: readonly Float64Array[] = [];
  private count = 0;

  constructor(p: Program) {
    this.p = p;
    const n = p.linkCount;
    this.links = n;
    this.dyads = p.dyads;
    const bodies = p.roots.length;
    this.groups = p.conditions.length - 1;
    const windings = p.windings.reduce((sum, first) => sum + (first >= 0 ? 2 : 0), 0);
    this.unknownCount = 3 * bodies + windings;
    this.places = new Float64Array(6 * n);
    this.turns = new Float64Array(2 * n);
    this.rates = new Float64Array(2 * n);
    this.before = new Float64Array(2 * n);
    this.drives = new Float64Array(3 * p.drives);
    const b = Math.max(bodies, 1);
    const c = Math.max(p.kinds.length, 1);
    this.foretold = new Float64Array(3 * b);
    this.bodyTurns = new Float64Array(2 * b);
    this.bodyRates = new Float64Array(2 * b);
    this.bodyPlaces = new Float64Array(6 * b);
    const W = 3 * b;
    this.s = {
      points: new Float64Array(12 * c),
      lines: new Float64Array(4 * c),
      spins: new Float64Array(4 * c),
      values: new Float64Array(8 * c),
      residual: new Float64Array(W + 2),
      jacobian: new Float64Array((W + 2) * W),
      normal: new Float64Array(W * W),
      pivots: new Int32Array(W + 2),
      turns: new Float64Array(2 * b),
      width: W,
    };
    const four = (size: number) => [0, 1, 2, 3].map(() => new Float64Array(size));
    this.roots = four(this.dyads);
    this.unknowns = four(this.unknownCount);
    this.determinants = four(this.groups);
    this.signs = new Float64Array(this.dyads).fill(1);
    this.change = new Float64Array(this.dyads).fill(NaN);
    this.after = new Float64Array(this.dyads).fill(1);
    this.met = new Float64Array(this.dyads).fill(NaN);
    this.direction = new Float64Array(2 * this.dyads);
  }

  /** Move along rows of drive values, (rows * drives,); speeds are those of the drives for order 1 and 2. */
  run(path: Float64Array, start: State, order = 0, speeds: readonly Float64Array[] = []): Rows {
    const D = this.p.drives;
    const n = this.links;
    const count = D ? path.length / D : 1;
    this.path = path;
    this.speeds = speeds.slice(0, order);
    this.count = count;
    const rows: Rows = {
      status: Status.DONE,
      reached: 0,
      at: 0,
      fault: 0,
      order,
      links: n,
      places: new Float64Array(count * (order + 1) * 2 * n),
      turns: new Float64Array(count * 2 * n),
      rates: new Float64Array(count * order * n),
      roots: new Float64Array(count * this.dyads),
      unknowns: new Float64Array(count * this.unknownCount),
    };
    this.filled = 0;
    this.signs.set(start.signs);
    this.change.fill(NaN);
    this.met.fill(NaN);
    this.singular = 0;
    this.unknowns[0]!.set(start.unknowns);
    this.setDrives(0);
    let verdict = this.tryPose(order, 0);
    for (let k = 0; verdict === Verdict.MEET && k <= this.dyads; k++) {
      this.meet(0);
      this.setDrives(0);
      verdict = this.tryPose(order, 0);
    }
    if (verdict !== Verdict.GOOD) {
      rows.status = Status.START;
      rows.fault = verdict === Verdict.LOST ? -1 - this.which : this.which;
      return rows;
    }
    this.before.set(this.turns);
    this.accept(0);
    this.record(0, rows);
    let step = 1;
    this.fault = Infinity;
    let row = 1;
    while (row < count) {
      const status = this.walkTo(row, step, rows);
      step = this.step;
      if (status !== Status.DONE) {
        rows.status = status;
        rows.reached = row;
        rows.at = this.stopAt;
        rows.fault = this.stopFault;
        return rows;
      }
      row += 1;
    }
    rows.reached = row;
    rows.at = row - 1;
    return rows;
  }

  // --- what a walk hands from row to row -----------------------------------------------------------------------------
  private step = 1;
  private fault = Infinity;
  private stopAt = 0;
  private stopFault = 0;

  private stop(status: Status, at: number, step: number, number: number): Status {
    this.stopAt = at;
    this.step = step;
    this.stopFault = number;
    return status;
  }

  private walkTo(row: number, step: number, rows: Rows): Status {
    const unit = this.unitOf(row);
    this.unit = unit;
    let at = this.at[0]!;
    const longest = Math.min(1, unit);
    step = Math.min(step, longest); // it is measured in rows, and this row may be longer than the last one
    if (!this.remembered(row)) {
      this.filled = 1;
      step = Math.min(step, 0.01 * unit * this.leastRoot());
    }
    while (at < row) {
      const left = row - at;
      const full = step >= left * (1 - 1e-9);
      const trial = full ? row : at + step;
      this.setDrives(trial);
      let verdict = this.tryPose(full ? rows.order : 0, trial);
      if (verdict === Verdict.GOOD) {
        const number = this.reversed();
        if (number >= 0) {
          this.change[number] = at;
          this.after[number] = this.roots[3]![number]! > 0 ? -1 : 1;
          verdict = this.tryPose(full ? rows.order : 0, trial);
          if (verdict !== Verdict.GOOD || this.reversed() >= 0) return this.stop(Status.SINGULAR, at, step, number);
        }
        this.accept(trial);
        this.record(full ? row : -1, rows);
        at = trial;
        if (at >= this.fault) this.fault = Infinity;
        step = this.fault === Infinity ? Math.min(2 * step, longest) : (this.fault - at) / 2;
        if (step < LEAST * (1 + Math.abs(at)) && at < row) return this.stop(Status.LIMIT, at, step, this.which);
        continue;
      }
      const number = this.which;
      if (verdict === Verdict.APPROACH && Math.abs(this.roots[0]![number]!) < NEAR && this.fault === Infinity) {
        step = this.approach(step, number);
        continue;
      }
      if (verdict === Verdict.MEET) {
        this.meet(trial);
        continue;
      }
      if (verdict === Verdict.APART) this.fault = Math.min(this.fault, trial);
      step = Math.min(step, left) / 2;
      if (verdict === Verdict.LOST && this.straight(number) && this.cross(row, number, rows)) {
        const next = this.at[0]!;
        step = Math.max(next - at, longest / 64);
        at = next;
        continue;
      }
      if (step < LEAST * (1 + Math.abs(at))) {
        return verdict === Verdict.LOST
          ? this.stop(Status.SINGULAR, at, step, -1 - number)
          : this.stop(Status.LIMIT, at, step, number);
      }
    }
    this.step = step;
    return Status.DONE;
  }

  private setDrives(at: number): void {
    const D = this.p.drives;
    const row = Math.min(Math.floor(at), this.count - 1);
    const part = at - row;
    for (let d = 0; d < D; d++) {
      let value = this.path[row * D + d]!;
      if (part > 0) value += part * (this.path[(row + 1) * D + d]! - value);
      this.drives[d] = value;
    }
    if (part === 0) {
      for (let k = 0; k < this.speeds.length; k++)
        for (let d = 0; d < D; d++) this.drives[(k + 1) * D + d] = this.speeds[k]![row * D + d]!;
    }
  }

  private record(row: number, rows: Rows): void {
    this.before.set(this.turns);
    if (row < 0) return;
    const n = this.links;
    const order = rows.order;
    rows.turns.set(this.turns, row * 2 * n);
    for (let link = 0; link < n; link++) {
      for (let k = 0; k <= order; k++) {
        const to = (row * (order + 1) + k) * 2 * n + 2 * link;
        rows.places[to] = this.places[6 * link + 2 * k]!;
        rows.places[to + 1] = this.places[6 * link + 2 * k + 1]!;
      }
      for (let k = 0; k < order; k++) rows.rates[(row * order + k) * n + link] = this.rates[2 * link + k]!;
    }
    rows.roots.set(this.roots[3]!, row * this.dyads);
    rows.unknowns.set(this.unknowns[3]!, row * this.unknownCount);
    rows.reached = row + 1;
  }

  private leastRoot(): number {
    let least = 1;
    for (const value of this.roots[0]!) {
      const root = Math.abs(value);
      if (root > 0 && root < least) least = root;
    }
    return least;
  }

  private reversed(): number {
    for (const operation of this.p.operations) {
      if (operation[0] !== Code.RPR && !this.drivenArm(operation)) continue;
      const number = operation[9]!;
      const body = operation[7]!;
      if (this.change[number]! < Infinity && this.after[number] === this.signs[number]) continue;
      const dot =
        this.turns[2 * body]! * this.before[2 * body]! + this.turns[2 * body + 1]! * this.before[2 * body + 1]!;
      if (Math.abs(this.roots[3]![number]!) < NEAR && dot < 0) return number;
    }
    return -1;
  }

  private remembered(row: number): boolean {
    if (row < 2) return false;
    const D = this.p.drives;
    const path = this.path;
    let most = 0;
    let ratio = 0;
    let off = 0;
    for (let d = 0; d < D; d++) {
      const past = path[(row - 1) * D + d]! - path[(row - 2) * D + d]!;
      if (Math.abs(past) > most) {
        most = Math.abs(past);
        ratio = (path[row * D + d]! - path[(row - 1) * D + d]!) / past;
      }
    }
    for (let d = 0; d < D; d++) {
      const way = path[row * D + d]! - path[(row - 1) * D + d]!;
      const past = path[(row - 1) * D + d]! - path[(row - 2) * D + d]!;
      off = Math.max(off, Math.abs(way - ratio * past));
    }
    if (ratio === 0 || off > 1e-9 * most) return this.steady(row);
    for (let k = 0; k < this.filled; k++) this.at[k] = row - 1 + (this.at[k]! - (row - 1)) / ratio;
    if (this.filled > 1 && (this.at[0]! > row || (this.at[0]! < row - 1 && ratio < 0))) {
      this.copy(1, 0);
      this.copy(2, 1);
      this.filled -= 1;
    }
    return true;
  }

  /** Whether the drives go on to a row as they came, not back and not much faster: then the past foretells. */
  private steady(row: number): boolean {
    const D = this.p.drives;
    const path = this.path;
    let moved = false;
    for (let d = 0; d < D; d++) {
      const way = path[row * D + d]! - path[(row - 1) * D + d]!;
      const past = path[(row - 1) * D + d]! - path[(row - 2) * D + d]!;
      if (way * past < 0 || Math.abs(way) > 1.5 * Math.abs(past)) return false;
      moved ||= way !== 0;
    }
    return moved;
  }

  private unitOf(row: number): number {
    const D = this.p.drives;
    let out = 1e6;
    for (let d = 0; d < D; d++) {
      const way = Math.abs(this.path[row * D + d]! - this.path[(row - 1) * D + d]!);
      if (way * out > this.p.most[d]!) out = this.p.most[d]! / way;
    }
    return out;
  }

  private copy(source: number, target: number): void {
    this.at[target] = this.at[source]!;
    this.roots[target]!.set(this.roots[source]!);
    this.unknowns[target]!.set(this.unknowns[source]!);
    this.determinants[target]!.set(this.determinants[source]!);
  }

  private accept(at: number): void {
    this.at[3] = at;
    this.copy(1, 2);
    this.copy(0, 1);
    this.copy(3, 0);
    this.filled = Math.min(this.filled + 1, 3);
    if ((this.at[0]! - this.at[1]!) * (this.at[1]! - this.at[2]!) <= 0) this.filled = Math.min(this.filled, 2);
    for (let number = 0; number < this.dyads; number++) {
      if (at >= this.change[number]!) {
        if (this.after[number] !== 0) this.signs[number] = this.after[number]!;
        this.change[number] = NaN;
      }
    }
  }

  // --- one pose ------------------------------------------------------------------------------------------------------

  private tryPose(order: number, at: number): Verdict {
    const p = this.p;
    for (let link = 0; link < this.links; link++) {
      this.turns[2 * link] = 1;
      this.turns[2 * link + 1] = 0;
    }
    this.places.fill(0);
    this.rates.fill(0);
    for (const operation of p.operations) {
      const kind: Code = operation[0]!;
      if (kind < Code.RRR) this.drive(operation, order);
      else if (kind < Code.GROUP) {
        for (let slot = 0; slot < 6; slot++)
          this.setElement(order, operation[1 + slot]!, slot, this.points, this.lines, this.spins);
        const number = operation[9]!;
        const driven = this.drivenArm(operation);
        const square = this.dyadSquare(kind, driven);
        const verdict =
          kind === Code.PRP || kind === Code.RPP ? this.sine(square, number) : this.root(square, number, at);
        if (verdict !== Verdict.GOOD) {
          this.which = number;
          return verdict;
        }
        const one = operation[7]!;
        const two = operation[8]!;
        if ((kind === Code.RRR || kind === Code.RPR || driven) && this.meeting(kind)) {
          if (this.met[number] !== at) {
            this.which = number;
            return Verdict.MEET;
          }
          this.turns[2 * one] = this.direction[2 * number]!;
          this.turns[2 * one + 1] = this.direction[2 * number + 1]!;
        }
        this.placeDyad(kind, this.roots[3]![number]!, one, two, driven);
        if (order > 0) this.rateDyad(kind, order, one, two);
      } else if (kind === Code.GROUP) {
        if (!this.group(operation[1]!, order, at)) {
          this.which = operation[1]!;
          return Verdict.LOST;
        }
      } else this.carry(order, operation[1]!, operation[2]!);
    }
    return Verdict.GOOD;
  }

  /** Put the jet of an element's point, its direction and the rates of that direction into a slot. */
  private setElement(
    order: number,
    e: number,
    slot: number,
    points: Float64Array,
    lines: Float64Array,
    spins: Float64Array,
  ): void {
    const p = this.p;
    const link = p.links[e]!;
    const tx = this.turns[2 * link]!;
    const ty = this.turns[2 * link + 1]!;
    const px = p.points[2 * e]!;
    const py = p.points[2 * e + 1]!;
    const lx = p.lines[2 * e]!;
    const ly = p.lines[2 * e + 1]!;
    const ax = tx * px - ty * py;
    const ay = tx * py + ty * px;
    const q = 6 * slot;
    const o = 6 * link;
    points[q] = this.places[o]! + ax;
    points[q + 1] = this.places[o + 1]! + ay;
    lines[2 * slot] = tx * lx - ty * ly;
    lines[2 * slot + 1] = tx * ly + ty * lx;
    if (order >= 1) {
      const w = this.rates[2 * link]!;
      points[q + 2] = this.places[o + 2]! - w * ay;
      points[q + 3] = this.places[o + 3]! + w * ax;
      spins[2 * slot] = w;
      if (order >= 2) {
        const a = this.rates[2 * link + 1]!;
        points[q + 4] = this.places[o + 4]! - w * w * ax - a * ay;
        points[q + 5] = this.places[o + 5]! - w * w * ay + a * ax;
        spins[2 * slot + 1] = a;
      }
    }
  }

  private drive(operation: readonly number[], order: number): void {
    const p = this.p;
    const D = p.drives;
    const [kind, d, one, other, sign] = operation as [number, number, number, number, number];
    const near = p.links[one]!;
    const far = p.links[other]!;
    this.setElement(order, one, 0, this.points, this.lines, this.spins);
    const point = [p.points[2 * other]!, p.points[2 * other + 1]!, 0, 0, 0, 0];
    if (kind === Code.TURN) {
      const angle = sign * this.drives[d]!;
      const cos = Math.cos(angle);
      const sin = Math.sin(angle);
      const nx = this.turns[2 * near]!;
      const ny = this.turns[2 * near + 1]!;
      const tx = nx * cos - ny * sin;
      const ty = nx * sin + ny * cos;
      this.turns[2 * far] = tx;
      this.turns[2 * far + 1] = ty;
      for (let k = 0; k < order; k++)
        this.rates[2 * far + k] = this.rates[2 * near + k]! + sign * this.drives[(k + 1) * D + d]!;
      const w = this.rates[2 * far]!;
      const a = this.rates[2 * far + 1]!;
      for (let k = 0; k <= order; k++) {
        rotated(k, tx, ty, w, a, point, 0);
        this.places[6 * far + 2 * k] = this.points[2 * k]! - jet.x;
        this.places[6 * far + 2 * k + 1] = this.points[2 * k + 1]! - jet.y;
      }
      return;
    }
    const lx = this.lines[0]!;
    const ly = this.lines[1]!;
    const ox = p.lines[2 * other]!;
    const oy = p.lines[2 * other + 1]!;
    const tx = lx * ox + ly * oy;
    const ty = ly * ox - lx * oy;
    this.turns[2 * far] = tx;
    this.turns[2 * far + 1] = ty;
    const way = [0, 0, 0, 0, 0, 0];
    for (let k = 0; k <= order; k++) way[2 * k] = sign < 0 ? -this.drives[k * D + d]! : this.drives[k * D + d]!;
    for (let k = 0; k < order; k++) this.rates[2 * far + k] = this.rates[2 * near + k]!;
    const w = this.rates[2 * near]!;
    const a = this.rates[2 * near + 1]!;
    for (let k = 0; k <= order; k++) {
      rotated(k, lx, ly, w, a, way, 0);
      const x = jet.x;
      const y = jet.y;
      rotated(k, tx, ty, w, a, point, 0);
      this.places[6 * far + 2 * k] = this.points[2 * k]! + x - jet.x;
      this.places[6 * far + 2 * k + 1] = this.points[2 * k + 1]! + y - jet.y;
    }
  }

  private carry(order: number, link: number, body: number): void {
    const l = 6 * link;
    const b = 6 * body;
    const tx = this.turns[2 * body]!;
    const ty = this.turns[2 * body + 1]!;
    const held = this.places.slice(l, l + 6);
    const w = order >= 1 ? this.rates[2 * body]! : 0;
    const a = order >= 2 ? this.rates[2 * body + 1]! : 0;
    for (let k = 0; k <= order; k++) {
      rotated(k, tx, ty, w, a, held, 0);
      this.places[l + 2 * k] = this.places[b + 2 * k]! + jet.x;
      this.places[l + 2 * k + 1] = this.places[b + 2 * k + 1]! + jet.y;
    }
    for (let k = 0; k < order; k++) this.rates[2 * link + k]! += this.rates[2 * body + k]!;
    const x = this.turns[2 * link]!;
    const y = this.turns[2 * link + 1]!;
    this.turns[2 * link] = x * tx - y * ty;
    this.turns[2 * link + 1] = x * ty + y * tx;
  }

  // --- dyads ---------------------------------------------------------------------------------------------------------

  /** The square of the number whose sign is the assembly mode; of PRP and RPP the sine between the lines. */
  private dyadSquare(kind: Code, driven: boolean): number {
    const P = this.points;
    const L = this.lines;
    const size = this.p.size;
    if (kind === Code.RRR) {
      const wx = P[30]! - P[0]!;
      const wy = P[31]! - P[1]!;
      const fx = P[12]! - P[6]!;
      const fy = P[13]! - P[7]!;
      const sx = P[18]! - P[24]!;
      const sy = P[19]! - P[25]!;
      const d = Math.sqrt(wx * wx + wy * wy);
      const r = Math.sqrt(fx * fx + fy * fy);
      const s = Math.sqrt(sx * sx + sy * sy);
      const square = ((r + s - d) * (s + d - r) * (d + r - s) * (d + r + s)) / (2 * r * s) ** 2;
      const noise = (4e-16 * (d + r + s) ** 2) / (r * s);
      return -noise < square && square < 0 ? 0 : square;
    }
    if (kind === Code.RRP) {
      const fx = P[12]! - P[6]!;
      const fy = P[13]! - P[7]!;
      this.turned(10, 8, P[18]! - P[24]!, P[19]! - P[25]!);
      const rx = P[30]! + jet.x - P[0]!;
      const ry = P[31]! + jet.y - P[1]!;
      const across = L[10]! * ry - L[11]! * rx;
      if (driven) return (fx * fx + fy * fy - across * across) / (size * size);
      return 1 - (across * across) / (fx * fx + fy * fy);
    }
    if (kind === Code.RPR) {
      const wx = P[30]! - P[0]!;
      const wy = P[31]! - P[1]!;
      const off = this.offset();
      return (wx * wx + wy * wy - off * off) / (size * size);
    }
    let x = L[0]!;
    let y = L[1]!;
    if (kind === Code.RPP) {
      this.turned(10, 8, L[6]!, L[7]!);
      x = jet.x;
      y = jet.y;
    }
    return x * L[11]! - y * L[10]!;
  }

  /** Whether a drive holds the two ends of the arm of an RRP, and changes its length. */
  private drivenArm(operation: readonly number[]): boolean {
    const p = this.p;
    return operation[0] === Code.RRP && p.links[operation[2]!] !== p.links[operation[3]!];
  }

  /** A vector times line `by` over line `from` (places in the array of lines). */
  private turned(by: number, from: number, x: number, y: number): void {
    const L = this.lines;
    const tx = L[by]! * L[from]! + L[by + 1]! * L[from + 1]!;
    const ty = L[by + 1]! * L[from]! - L[by]! * L[from + 1]!;
    jet.x = tx * x - ty * y;
    jet.y = tx * y + ty * x;
  }

  /** RPR: how far the second outer joint lies left of the first, seen along the slide. */
  private offset(): number {
    const P = this.points;
    const L = this.lines;
    const first = L[4]! * (P[7]! - P[13]!) - L[5]! * (P[6]! - P[12]!);
    const second = L[6]! * (P[25]! - P[19]!) - L[7]! * (P[24]! - P[18]!);
    return second - first;
  }

  private meeting(kind: Code): boolean {
    const P = this.points;
    const size = this.p.size;
    let wx = P[30]! - P[0]!;
    let wy = P[31]! - P[1]!;
    let near = 1e-13;
    if (kind !== Code.RRR) {
      let off: number;
      if (kind === Code.RRP) {
        const L = this.lines;
        this.turned(10, 8, P[18]! - P[24]!, P[19]! - P[25]!);
        off = L[10]! * (wy + jet.y) - L[11]! * (wx + jet.x);
        wx = P[12]! - P[6]!;
        wy = P[13]! - P[7]!;
      } else off = this.offset();
      if (off * off > 1e-26 * size * size) return false;
      near = 1e-7;
    }
    return wx * wx + wy * wy <= near * near * size * size;
  }

  private root(square: number, number: number, at: number): Verdict {
    const set = (value: number) => (this.roots[3]![number] = value);
    if (!(square >= -1e-13)) {
      set(0);
      return Verdict.APART;
    }
    const root = square > 0 ? Math.sqrt(square) : 0;
    let sign = this.signs[number]!;
    const change = this.change[number]!;
    if (!Number.isNaN(change)) {
      sign = at <= change ? sign : this.after[number]!;
      set(root * sign);
      return sign !== 0 ? Verdict.GOOD : Verdict.APPROACH;
    }
    set(root * sign);
    if (this.filled === 0) return Verdict.GOOD;
    const now = this.roots[0]![number]!;
    if (this.filled > 1) {
      const slope = (now - this.roots[1]![number]!) / (this.at[0]! - this.at[1]!);
      if (sign * (now + slope * (at - this.at[0]!)) < 0.5 * sign * now) return Verdict.APPROACH;
    }
    return root < 0.25 * Math.abs(now) ? Verdict.APPROACH : Verdict.GOOD;
  }

  private sine(sine: number, number: number): Verdict {
    this.roots[3]![number] = sine;
    if (!(Math.abs(sine) > 1e-12) || (this.filled > 0 && sine * this.roots[0]![number]! < 0)) return Verdict.APART;
    return Verdict.GOOD;
  }

  private setTurn(link: number, x: number, y: number): void {
    this.turns[2 * link] = x;
    this.turns[2 * link + 1] = y;
  }

  /** Place a link so that slot `inner` of it (against its origin) lies at x, y. */
  private hang(link: number, slot: number, x: number, y: number): void {
    const tx = this.turns[2 * link]!;
    const ty = this.turns[2 * link + 1]!;
    const px = this.points[6 * slot]!;
    const py = this.points[6 * slot + 1]!;
    this.places[6 * link] = x - (tx * px - ty * py);
    this.places[6 * link + 1] = y - (tx * py + ty * px);
  }

  private placeDyad(kind: Code, root: number, one: number, two: number, driven: boolean): void {
    const P = this.points;
    const L = this.lines;
    const size = this.p.size;
    const ax = P[0]!;
    const ay = P[1]!;
    const bx = P[30]!;
    const by = P[31]!;
    if (kind === Code.RRR) {
      const wx = bx - ax;
      const wy = by - ay;
      const fx = P[12]! - P[6]!;
      const fy = P[13]! - P[7]!;
      const sx = P[18]! - P[24]!;
      const sy = P[19]! - P[25]!;
      const d = wx * wx + wy * wy;
      const l1 = fx * fx + fy * fy;
      const l2 = sx * sx + sy * sy;
      let armX: number;
      let armY: number;
      if (!this.meeting(kind)) {
        const cx = (d + l1 - l2) / (2 * d);
        const cy = (root * Math.sqrt(l1 * l2)) / d;
        armX = wx * cx - wy * cy;
        armY = wx * cy + wy * cx;
        this.setTurn(one, (armX * fx + armY * fy) / l1, (armY * fx - armX * fy) / l1);
      } else {
        const tx = this.turns[2 * one]!;
        const ty = this.turns[2 * one + 1]!;
        armX = tx * fx - ty * fy;
        armY = tx * fy + ty * fx;
      }
      const gx = armX - wx;
      const gy = armY - wy;
      this.setTurn(two, (gx * sx + gy * sy) / l2, (gy * sx - gx * sy) / l2);
    } else if (kind === Code.RRP) {
      const fx = P[12]! - P[6]!;
      const fy = P[13]! - P[7]!;
      const l1 = fx * fx + fy * fy;
      this.turned(10, 8, 1, 0);
      this.setTurn(two, jet.x, jet.y);
      this.turned(10, 8, P[18]! - P[24]!, P[19]! - P[25]!);
      const rx = bx + jet.x - ax;
      const ry = by + jet.y - ay;
      const way = root * (driven ? size : Math.sqrt(l1)) - (L[10]! * rx + L[11]! * ry);
      const vx = rx + way * L[10]!;
      const vy = ry + way * L[11]!;
      if (!(driven && this.meeting(kind))) this.setTurn(one, (vx * fx + vy * fy) / l1, (vy * fx - vx * fy) / l1);
      this.hang(two, 4, bx + way * L[10]!, by + way * L[11]!);
    } else if (kind === Code.RPR) {
      let lx: number;
      let ly: number;
      if (this.meeting(kind)) {
        const tx = this.turns[2 * one]!;
        const ty = this.turns[2 * one + 1]!;
        lx = tx * L[4]! - ty * L[5]!;
        ly = tx * L[5]! + ty * L[4]!;
      } else {
        const wx = bx - ax;
        const wy = by - ay;
        const cx = root * size;
        const cy = -this.offset();
        lx = wx * cx - wy * cy;
        ly = wx * cy + wy * cx;
        const length = Math.sqrt(lx * lx + ly * ly);
        lx /= length;
        ly /= length;
      }
      this.setTurn(one, lx * L[4]! + ly * L[5]!, ly * L[4]! - lx * L[5]!);
      this.setTurn(two, lx * L[6]! + ly * L[7]!, ly * L[6]! - lx * L[7]!);
    } else if (kind === Code.PRP) {
      this.turned(0, 2, 1, 0);
      this.setTurn(one, jet.x, jet.y);
      this.turned(10, 8, 1, 0);
      this.setTurn(two, jet.x, jet.y);
      this.turned(0, 2, P[12]! - P[6]!, P[13]! - P[7]!);
      const sx = ax + jet.x;
      const sy = ay + jet.y;
      this.turned(10, 8, P[18]! - P[24]!, P[19]! - P[25]!);
      const gx = bx + jet.x - sx;
      const gy = by + jet.y - sy;
      const sine = L[0]! * L[11]! - L[1]! * L[10]!;
      const m = (gx * L[11]! - gy * L[10]!) / sine;
      const n = (gx * L[1]! - gy * L[0]!) / sine;
      this.hang(one, 1, ax + L[0]! * m, ay + L[1]! * m);
      this.hang(two, 4, bx + L[10]! * n, by + L[11]! * n);
    } else {
      this.turned(10, 8, 1, 0);
      const tx = jet.x;
      const ty = jet.y;
      this.setTurn(two, tx, ty);
      const sx = tx * L[6]! - ty * L[7]!;
      const sy = tx * L[7]! + ty * L[6]!;
      const ux = sx * L[4]! + sy * L[5]!;
      const uy = sy * L[4]! - sx * L[5]!;
      this.setTurn(one, ux, uy);
      this.hang(one, 1, ax, ay);
      const dx = P[18]! - P[24]!;
      const dy = P[19]! - P[25]!;
      const mx = bx + tx * dx - ty * dy - this.places[6 * one]! - (ux * P[12]! - uy * P[13]!);
      const my = by + tx * dy + ty * dx - this.places[6 * one + 1]! - (ux * P[13]! + uy * P[12]!);
      const way = -(sx * my - sy * mx) / (sx * L[11]! - sy * L[10]!);
      this.hang(two, 4, bx + way * L[10]!, by + way * L[11]!);
    }
    if (kind === Code.RRR || kind === Code.RRP || kind === Code.RPR) this.hang(one, 1, ax, ay);
    if (kind === Code.RRR || kind === Code.RPR) this.hang(two, 4, bx, by);
  }

  private readonly between = new Float64Array(6);

  /** The k-th derivative of the vector from slot `from` to slot `to` of a body (`from` -1: from its origin). */
  private arm(k: number, body: number, from: number, to: number): void {
    const v = this.between;
    const P = this.points;
    for (let m = 0; m < 6; m++) v[m] = P[6 * to + m]! - (from < 0 ? 0 : P[6 * from + m]!);
    rotated(
      k,
      this.turns[2 * body]!,
      this.turns[2 * body + 1]!,
      this.rates[2 * body]!,
      this.rates[2 * body + 1]!,
      v,
      0,
    );
  }

  private rateDyad(kind: Code, order: number, one: number, two: number): void {
    const P = this.points;
    const L = this.lines;
    const S = this.spins;
    const Z = this.places;
    const W = this.rates;
    for (let k = order; k < 2; k++)
      for (let slot = 0; slot < 6; slot++) {
        P[6 * slot + 2 * (k + 1)] = P[6 * slot + 2 * (k + 1) + 1] = 0;
        S[2 * slot + k] = 0;
      }
    W[2 * one] = W[2 * one + 1] = W[2 * two] = W[2 * two + 1] = 0;
    const t1x = this.turns[2 * one]!;
    const t1y = this.turns[2 * one + 1]!;
    const t2x = this.turns[2 * two]!;
    const t2y = this.turns[2 * two + 1]!;
    const fx = t1x * (P[12]! - P[6]!) - t1y * (P[13]! - P[7]!);
    const fy = t1x * (P[13]! - P[7]!) + t1y * (P[12]! - P[6]!);
    const sx = t2x * (P[18]! - P[24]!) - t2y * (P[19]! - P[25]!);
    const sy = t2x * (P[19]! - P[25]!) + t2y * (P[18]! - P[24]!);
    const inner1x = Z[6 * one]! + t1x * P[12]! - t1y * P[13]!;
    const inner1y = Z[6 * one + 1]! + t1x * P[13]! + t1y * P[12]!;
    const slideX = t1x * L[4]! - t1y * L[5]!;
    const slideY = t1x * L[5]! + t1y * L[4]!;
    const way = [0, 0, 0, 0, 0, 0];
    const other = [0, 0, 0, 0, 0, 0]; // ways with their derivatives, imaginary parts 0
    if (kind === Code.RRP) way[0] = L[10]! * (inner1x - P[30]! - sx) + L[11]! * (inner1y - P[31]! - sy);
    else if (kind === Code.PRP) {
      way[0] = L[0]! * (inner1x - P[0]! - fx) + L[1]! * (inner1y - P[1]! - fy);
      other[0] = L[10]! * (inner1x - P[30]! - sx) + L[11]! * (inner1y - P[31]! - sy);
    } else if (kind === Code.RPR) {
      way[0] = slideX * (sx + P[30]! - P[0]! - fx) + slideY * (sy + P[31]! - P[1]! - fy);
    } else if (kind === Code.RPP) {
      const ox = Z[6 * two]! + t2x * P[24]! - t2y * P[25]!;
      const oy = Z[6 * two + 1]! + t2x * P[25]! + t2y * P[24]!;
      way[0] = L[10]! * (ox - P[30]!) + L[11]! * (oy - P[31]!);
      const ix = Z[6 * two]! + t2x * P[18]! - t2y * P[19]!;
      const iy = Z[6 * two + 1]! + t2x * P[19]! + t2y * P[18]!;
      other[0] = slideX * (ix - inner1x) + slideY * (iy - inner1y);
    }
    for (let k = 1; k <= order; k++) {
      let gx: number;
      let gy: number; // target
      const add = (sign: number) => {
        gx += sign * jet.x;
        gy += sign * jet.y;
      };
      const along = (slot: number, ways: number[], sign: number) => {
        rotated(k, L[2 * slot]!, L[2 * slot + 1]!, S[2 * slot]!, S[2 * slot + 1]!, ways, 0);
        add(sign);
      };
      const ends = () => {
        gx = P[30 + 2 * k]! - P[2 * k]!;
        gy = P[31 + 2 * k]! - P[2 * k + 1]!;
        this.arm(k, two, 4, 3);
        add(1);
        this.arm(k, one, 1, 2);
        add(-1);
      };
      if (kind === Code.RRR) {
        ends();
        solved(-fy, fx, sy, -sx, gx!, gy!);
        W[2 * one + k - 1] = pair.first;
        W[2 * two + k - 1] = pair.second;
      } else if (kind === Code.RRP) {
        W[2 * two + k - 1] = S[10 + k - 1]! - S[8 + k - 1]!;
        ends();
        along(5, way, 1);
        solved(-fy, fx, -L[10]!, -L[11]!, gx!, gy!);
        W[2 * one + k - 1] = pair.first;
        way[2 * k] = pair.second;
      } else if (kind === Code.RPR) {
        W[2 * one + k - 1] = -S[4 + k - 1]!;
        W[2 * two + k - 1] = -S[6 + k - 1]!;
        ends();
        const w = k > 1 ? W[2 * one]! + S[4]! : 0;
        rotated(k, slideX, slideY, w, 0, way, 0);
        add(-1);
        const dx = fx - sx + way[0]! * slideX;
        const dy = fy - sy + way[0]! * slideY;
        solved(-dy, dx, slideX, slideY, gx!, gy!);
        W[2 * one + k - 1]! += pair.first;
        W[2 * two + k - 1]! += pair.first;
        way[2 * k] = pair.second;
      } else if (kind === Code.PRP) {
        W[2 * one + k - 1] = S[k - 1]! - S[2 + k - 1]!;
        W[2 * two + k - 1] = S[10 + k - 1]! - S[8 + k - 1]!;
        ends();
        along(5, other, 1);
        along(0, way, -1);
        solved(L[0]!, L[1]!, -L[10]!, -L[11]!, gx!, gy!);
        way[2 * k] = pair.first;
        other[2 * k] = pair.second;
      } else {
        W[2 * two + k - 1] = S[10 + k - 1]! - S[8 + k - 1]!;
        W[2 * one + k - 1] = W[2 * two + k - 1]! + S[6 + k - 1]! - S[4 + k - 1]!;
        const w = W[2 * one]! + S[4]!;
        const a = k > 1 ? W[2 * one + 1]! + S[5]! : 0;
        ends();
        gx = -gx!;
        gy = -gy!;
        rotated(k, slideX, slideY, w, a, other, 0);
        add(1);
        along(5, way, -1);
        solved(L[10]!, L[11]!, -slideX, -slideY, gx, gy);
        way[2 * k] = pair.first;
        other[2 * k] = pair.second;
      }
      gx = P[2 * k]!;
      gy = P[2 * k + 1]!;
      this.arm(k, one, -1, 1);
      add(-1);
      if (kind === Code.PRP) along(0, way, 1);
      Z[6 * one + 2 * k] = gx;
      Z[6 * one + 2 * k + 1] = gy;
      gx = P[30 + 2 * k]!;
      gy = P[31 + 2 * k]!;
      this.arm(k, two, -1, 4);
      add(-1);
      if (kind === Code.PRP) along(5, other, 1);
      else if (kind === Code.RRP || kind === Code.RPP) along(5, way, 1);
      Z[6 * two + 2 * k] = gx;
      Z[6 * two + 2 * k + 1] = gy;
    }
  }

  // --- larger groups -------------------------------------------------------------------------------------------------

  private foretell(at: number, first: number, last: number): void {
    const t = this.at;
    let count = this.filled;
    if (count > 2 && Math.abs(t[0]! - t[2]!) < 1e-6 * Math.abs(t[0]! - t[1]!)) count = 2;
    const [y0, y1, y2, y3] = this.unknowns as [Float64Array, Float64Array, Float64Array, Float64Array];
    for (let k = first; k < last; k++) {
      let y = y0[k]!;
      if (count > 2 && this.singular > 0) y += ((y - y2[k]!) / (t[0]! - t[2]!)) * (at - t[0]!);
      else if (count > 1) {
        const d01 = (y - y1[k]!) / (t[0]! - t[1]!);
        y += d01 * (at - t[0]!);
        if (count > 2) {
          const d12 = (y1[k]! - y2[k]!) / (t[1]! - t[2]!);
          y += ((d01 - d12) / (t[0]! - t[2]!)) * (at - t[0]!) * (at - t[1]!);
        }
      }
      y3[k] = y;
    }
  }

  private zeroAhead(number: number): number {
    const now = this.determinants[0]![number]!;
    const past = this.determinants[1]![number]!;
    if (now * past <= 0 || Math.abs(now) >= Math.abs(past) || this.at[0]! <= this.at[1]!) return Infinity;
    return ((this.at[0]! - this.at[1]!) * now) / (past - now);
  }

  private expected(number: number, first: number, last: number, at: number): boolean {
    const size = this.p.size;
    let missed = 0;
    let moved = 0;
    for (let k = first; k < last; k++) {
      const scale = k % 3 === 2 ? size : 1;
      missed = Math.max(missed, scale * Math.abs(this.unknowns[3]![k]! - this.foretold[k - first]!));
      moved = Math.max(moved, scale * Math.abs(this.unknowns[3]![k]! - this.unknowns[0]![k]!));
    }
    if (this.singular === 1 + number) return missed <= 0.02 * moved;
    if (missed > 1e-7 * size && missed > (this.filled > 1 ? 0.25 * moved : 0.01 * size)) return false;
    const ahead = this.filled > 1 ? this.zeroAhead(number) : Infinity;
    if (at - this.at[0]! > 0.5 * ahead && ahead > NEAREST * this.unit) return false;
    return this.determinants[3]![number]! / this.determinants[0]![number]! > 0.1;
  }

  private wind(start: number, end: number, root: number): boolean {
    const p = this.p;
    const s = this.s;
    const y = this.unknowns[3]!;
    for (let c = start; c < end; c++) {
      const first = p.windings[c]!;
      if (first < 0) continue;
      const xs = [0, 0];
      const ys = [0, 0];
      const lxs = [0, 0];
      const lys = [0, 0];
      for (let side = 0; side < 2; side++) {
        const slot = 2 * (c - start) + side;
        const body = p.owners[2 * c + side]!;
        let x = s.points[6 * slot]!;
        let yy = s.points[6 * slot + 1]!;
        let lx = s.lines[2 * slot]!;
        let ly = s.lines[2 * slot + 1]!;
        if (body >= 0) {
          const k = 3 * (root + body);
          const cos = Math.cos(y[k + 2]!);
          const sin = Math.sin(y[k + 2]!);
          [x, yy] = [y[k]! + cos * x - sin * yy, y[k + 1]! + sin * x + cos * yy];
          [lx, ly] = [cos * lx - sin * ly, sin * lx + cos * ly];
        }
        xs[side] = x;
        ys[side] = yy;
        lxs[side] = lx;
        lys[side] = ly;
      }
      const near = [this.unknowns[0]![first]!, this.unknowns[0]![first + 1]!];
      if (p.kinds[c] === Kind.MESH) {
        const gx = xs[1]! - xs[0]!;
        const gy = ys[1]! - ys[0]!;
        for (let k = 0; k < 2; k++)
          y[first + k] = unwoundAngle(lxs[k]! * gx + lys[k]! * gy, lys[k]! * gx - lxs[k]! * gy, near[k]!);
      } else {
        y[first] = unwoundAngle(lxs[0]! * lxs[1]! + lys[0]! * lys[1]!, lxs[0]! * lys[1]! - lys[0]! * lxs[1]!, near[0]!);
        y[first + 1] = 0;
      }
      for (let k = 0; k < 2; k++) if (this.filled > 0 && Math.abs(y[first + k]! - near[k]!) > FARTHEST) return false;
    }
    return true;
  }

  private group(number: number, order: number, at: number): boolean {
    const p = this.p;
    const s = this.s;
    const start = p.conditions[number]!;
    const end = p.conditions[number + 1]!;
    const first = p.bodies[number]!;
    const last = p.bodies[number + 1]!;
    for (let slot = 0; slot < 2 * (end - start); slot++)
      this.setElement(order, p.sides[2 * start + slot]!, slot, s.points, s.lines, s.spins);
    const base = 3 * first;
    const n = 3 * (last - first);
    this.foretell(at, base, base + n);
    const y = this.unknowns[3]!;
    for (let k = 0; k < n; k++) this.foretold[k] = y[base + k]!;
    for (let c = start; c < end; c++) {
      const v = 8 * (c - start);
      for (let k = 0; k < 3; k++) {
        s.values[v + k] = p.values[6 * c + k]!;
        s.values[v + 5 + k] = p.values[6 * c + 3 + k]!;
      }
      const winding = p.windings[c]!;
      if (winding >= 0) {
        s.values[v + 3] = this.unknowns[0]![winding]!;
        s.values[v + 4] = this.unknowns[0]![winding + 1]!;
      }
    }
    const atIt = this.singular === -1 - number;
    if (atIt) closeNearSingular(p, start, end, y, base, n, s);
    else {
      const converged = newton(p, start, end, y, base, n, s);
      this.determinants[3]![number] = newtonResult.determinant;
      if (!converged || (this.filled > 0 && !this.expected(number, base, base + n, at))) return false;
    }
    if (!this.wind(start, end, first)) return false;
    const { bodyTurns: T, bodyRates: W, bodyPlaces: Z } = this;
    Z.fill(0);
    W.fill(0);
    for (let k = 0; k < last - first; k++) {
      T[2 * k] = Math.cos(y[base + 3 * k + 2]!);
      T[2 * k + 1] = Math.sin(y[base + 3 * k + 2]!);
      Z[6 * k] = y[base + 3 * k]!;
      Z[6 * k + 1] = y[base + 3 * k + 1]!;
    }
    if (order > 0) {
      closing(p, start, end, y, base, n, s);
      factor(s.jacobian, s.width, n, s.pivots);
      for (let k = 1; k <= order; k++) {
        closingRates(k, p, start, end, s, T, W, Z);
        solveFactored(s.jacobian, s.width, n, s.pivots, s.residual);
        for (let b = 0; b < last - first; b++) {
          Z[6 * b + 2 * k] = s.residual[3 * b]!;
          Z[6 * b + 2 * k + 1] = s.residual[3 * b + 1]!;
          W[2 * b + k - 1] = atIt ? NaN : s.residual[3 * b + 2]!;
        }
      }
    }
    for (let k = 0; k < last - first; k++) {
      const link = p.roots[first + k]!;
      this.setTurn(link, T[2 * k]!, T[2 * k + 1]!);
      for (let m = 0; m < 2 * (order + 1); m++) this.places[6 * link + m] = Z[6 * k + m]!;
      for (let m = 0; m < order; m++) this.rates[2 * link + m] = W[2 * k + m]!;
    }
    return true;
  }

  // --- near change points and limits ---------------------------------------------------------------------------------

  private squareAt(at: number, wanted: number): number {
    this.setDrives(at);
    this.roots[3]![wanted] = NaN;
    const verdict = this.tryPose(0, at);
    if ((verdict === Verdict.APPROACH || verdict === Verdict.APART) && this.which === wanted) {
      for (const operation of this.p.operations)
        if (operation[0]! >= 2 && operation[0]! < Code.GROUP && operation[9] === wanted)
          return this.dyadSquare(operation[0]!, this.drivenArm(operation));
    }
    return this.roots[3]![wanted]! ** 2; // it is known if only something behind it cannot be placed
  }

  private foundChange = { place: 0, negative: false };

  private lookForChange(reach: number, turn: number, number: number): void {
    const found = (place: number, negative: boolean) => {
      this.foundChange.place = place;
      this.foundChange.negative = negative;
    };
    let low = this.at[0]!;
    let high = reach;
    const ratio = 0.6180339887498949;
    let inner = high - ratio * (high - low);
    let outer = low + ratio * (high - low);
    let atInner = this.squareAt(inner, number);
    let atOuter = this.squareAt(outer, number);
    let at = reach;
    let least = Infinity;
    let far = low;
    let beyond = -Infinity; // the farthest place at which all before this dyad is placed, and the square there
    for (let k = 0; k < 200; k++) {
      if (atInner < least) [at, least] = [inner, atInner];
      if (atOuter < least) [at, least] = [outer, atOuter];
      if (inner > far && !Number.isNaN(atInner)) [far, beyond] = [inner, atInner];
      if (outer > far && !Number.isNaN(atOuter)) [far, beyond] = [outer, atOuter];
      if (atInner < -FLAT) return found(inner, true);
      if (atOuter < -FLAT) return found(outer, true);
      if (high - low < 1e-9 * (reach - this.at[0]!) || high - low < 1e-15 * (1 + Math.abs(high))) break;
      if (!(atInner > atOuter)) {
        // or one of them is NaN: what cannot be placed lies farther on
        [high, outer, atOuter] = [outer, inner, atInner];
        inner = high - ratio * (high - low);
        atInner = this.squareAt(inner, number);
      } else {
        [low, inner, atInner] = [inner, outer, atOuter];
        outer = low + ratio * (high - low);
        atOuter = this.squareAt(outer, number);
      }
    }
    const end = this.squareAt(reach, number);
    if (Number.isNaN(end)) {
      if (beyond <= 1.5 * least + NOISE)
        // nothing is decided as far as anything is known
        return found(Math.max(far, this.at[0]! + KNOWN * (reach - this.at[0]!)), false);
    } else if (end <= 1.5 * least + NOISE)
      return found(reach === turn ? reach : this.at[0]! + 0.9 * (reach - this.at[0]!), false);
    this.change[number] = at;
    this.after[number] = least < FLAT ? -this.signs[number]! : this.signs[number]!;
    return found(at, false);
  }

  private turnAhead(at: number, reach: number): number {
    const D = this.p.drives;
    const path = this.path;
    let row = Math.floor(at) + 1;
    while (row < this.count - 1 && row < reach) {
      let forth = 0;
      for (let d = 0; d < D; d++)
        forth += (path[(row + 1) * D + d]! - path[row * D + d]!) * (path[row * D + d]! - path[(row - 1) * D + d]!);
      if (forth <= 0) return row;
      row += 1;
    }
    return this.count - 1;
  }

  private approach(step: number, number: number): number {
    const at = this.at[0]!;
    const now = this.roots[0]![number]!;
    const past = this.roots[1]![number]!;
    const slope = (now - past) / (at - this.at[1]!);
    const ahead = slope !== 0 ? Math.abs(now / slope) : step;
    this.change[number] = NaN;
    const turn = this.turnAhead(at, at + 4 * ahead);
    if (now * now < NOISE && at + ahead < turn) {
      this.change[number] = at + ahead;
      this.after[number] = -this.signs[number]!;
      return Math.max(2 * ahead, 1e-12);
    }
    const reach = Math.min(at + Math.max(4 * ahead, 1e-13 * (1 + at)), turn);
    this.lookForChange(reach, turn, number);
    const { place, negative } = this.foundChange;
    if (negative) {
      this.fault = place;
      return place - at;
    }
    if (!Number.isNaN(this.change[number]!)) return Math.max(2 * (place - at), 1e-12);
    this.change[number] = place;
    this.after[number] = 0;
    return place - at;
  }

  private meet(at: number): void {
    const number = this.which;
    let body = 0;
    for (const operation of this.p.operations)
      if (operation[0]! >= 2 && operation[0]! < Code.GROUP && operation[9] === number) body = operation[7]!;
    const weights = [3, -3, 1];
    let tx = 0;
    let ty = 0;
    for (let k = 0; k < 3; k++) {
      if (this.count > 1) {
        const row = Math.max(1, Math.ceil(at));
        const step = Math.min(0.3, 1e-3 * this.unitOf(row)) * (k + 1);
        const place = at < 1 && at - step < 0 ? at + step : at - step;
        this.setDrives(place);
        if (this.tryPose(0, place) === Verdict.GOOD) {
          tx += weights[k]! * this.turns[2 * body]!;
          ty += weights[k]! * this.turns[2 * body + 1]!;
          continue;
        }
      }
      tx = at > 0 ? this.before[2 * body]! : 1;
      ty = at > 0 ? this.before[2 * body + 1]! : 0;
      break;
    }
    const length = Math.hypot(tx, ty);
    this.direction[2 * number] = tx / length;
    this.direction[2 * number + 1] = ty / length;
    this.met[number] = at;
    this.setDrives(at);
  }

  private straight(number: number): boolean {
    const ahead = this.zeroAhead(number) / this.unit;
    if (this.filled < 3 || !(10 * NEAREST < ahead && ahead < 1e-3)) return false;
    const t = this.at;
    const y = this.unknowns;
    const d = this.determinants;
    const growth = (d[2]![number]! - d[0]![number]!) / (d[0]![number]! + d[1]![number]!);
    let bend = 0;
    let slope = 0;
    for (let k = 3 * this.p.bodies[number]!; k < 3 * this.p.bodies[number + 1]!; k++) {
      const scale = k % 3 === 2 ? this.p.size : 1;
      const late = (y[0]![k]! - y[1]![k]!) / (t[0]! - t[1]!);
      const early = (y[1]![k]! - y[2]![k]!) / (t[1]! - t[2]!);
      bend = Math.max(bend, scale * Math.abs(late - early));
      slope = Math.max(slope, scale * Math.abs(early));
    }
    return growth > 0.05 && bend < 0.1 * growth * slope;
  }

  private cross(row: number, number: number, rows: Rows): boolean {
    const D = this.p.drives;
    const path = this.path;
    const at = this.at[0]!;
    const unit = this.unit;
    const order = rows.order;
    const ahead = this.zeroAhead(number);
    const left = row - at;
    const inside = left < 6 * ahead;
    if (inside && ahead > 3e-5 * unit) return false;
    const beyond = inside ? row + Math.min(1e-2 * unit, 0.5) : Math.min(at + 8 * ahead, row);
    const full = beyond === row;
    this.singular = 1 + number;
    if (inside) {
      for (let d = 0; d < D; d++)
        this.drives[d] = path[row * D + d]! + (beyond - row) * (path[row * D + d]! - path[(row - 1) * D + d]!);
    } else this.setDrives(beyond);
    let verdict = this.tryPose(full ? order : 0, beyond);
    this.singular = 0;
    if (verdict === Verdict.GOOD) {
      this.accept(beyond);
      if (!inside) {
        this.record(full ? row : -1, rows);
        return true;
      }
    } else if (!inside || row < this.count - 1) return false;
    this.singular = -1 - number;
    this.setDrives(row);
    verdict = this.tryPose(order, row);
    this.singular = 0;
    if (verdict !== Verdict.GOOD) return false;
    if (this.at[0]! < row) this.accept(row);
    this.record(row, rows);
    return true;
  }
}

/** What `solved` found. */
const pair = { first: 0, second: 0 };

/** The real p, q with p * left + q * right = target. */
function solved(lx: number, ly: number, rx: number, ry: number, tx: number, ty: number): void {
  const sine = lx * ry - ly * rx;
  pair.first = (tx * ry - ty * rx) / sine;
  pair.second = (lx * ty - ly * tx) / sine;
}
