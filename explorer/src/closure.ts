/** Closing conditions of joints between bodies: residual, Jacobian, derivatives; Newton's method on them.
 * The same formulas as in `core/src/motion`: closure, closure_rates, newton. Orders up to 2. */

import { Kind, type Program } from "./program";

export const FARTHEST = 1.0;

/** The angle of a direction, with as many whole turns as bring it next to one near by. */
export function unwoundAngle(x: number, y: number, near: number): number {
  const angle = Math.atan2(y, x);
  return angle + 2 * Math.PI * Math.floor((near - angle) / (2 * Math.PI) + 0.5);
}

/** The last law that was evaluated: its value and its first two derivatives. */
export const law = { value: 0, slope: 1, curve: 0 };

/** A function of an angle; without pieces the angle itself. */
function evaluateLaw(
  pieces: readonly Float64Array[],
  first: number,
  count: number,
  advance: number,
  angle: number,
): void {
  if (count === 0) {
    law.value = angle;
    law.slope = 1;
    law.curve = 0;
    return;
  }
  const start = pieces[first]!;
  const turns = Math.floor((angle - start[0]! + start[1]!) / (2 * Math.PI));
  const place = angle - 2 * Math.PI * turns;
  let low = first;
  let high = first + count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    const piece = pieces[middle]!;
    if (place >= piece[0]! - piece[1]!) low = middle;
    else high = middle - 1;
  }
  const piece = pieces[low]!;
  const half = piece[1]!;
  const u = (place - piece[0]!) / half;
  let f0 = 0;
  let f1 = 0;
  let f2 = 0;
  for (let k = piece.length - 1; k > 1; k--) {
    f2 = f2 * u + 2 * f1;
    f1 = f1 * u + f0;
    f0 = f0 * u + piece[k]!;
  }
  law.value = f0 + turns * advance;
  law.slope = f1 / half;
  law.curve = f2 / (half * half);
}

/** Arrays of one larger group: its elements (two slots a condition), the Jacobian, the residual. */
export interface GroupScratch {
  points: Float64Array; // [6 * slot + 2 * order + part]
  lines: Float64Array; // [2 * slot + part]
  spins: Float64Array; // [2 * slot + order - 1]
  values: Float64Array; // [8 * condition + k]
  residual: Float64Array;
  jacobian: Float64Array; // rows of `width`
  normal: Float64Array;
  pivots: Int32Array;
  turns: Float64Array; // [2 * body + part]
  width: number;
}

/** Write residual and Jacobian at the unknowns; returns the largest residual. */
export function closing(
  p: Program,
  from: number,
  to: number,
  y: Float64Array,
  base: number,
  n: number,
  s: GroupScratch,
): number {
  const J = s.jacobian;
  const W = s.width;
  const R = s.residual;
  const T = s.turns;
  for (let k = 0; 3 * k < n; k++) {
    T[2 * k] = Math.cos(y[base + 3 * k + 2]!);
    T[2 * k + 1] = Math.sin(y[base + 3 * k + 2]!);
  }
  let row = 0;
  for (let c = from; c < to; c++) {
    const slot = 2 * (c - from);
    const a = p.owners[2 * c]!;
    const b = p.owners[2 * c + 1]!;
    let hx = s.points[6 * slot]!;
    let hy = s.points[6 * slot + 1]!;
    let tx = s.points[6 * slot + 6]!;
    let ty = s.points[6 * slot + 7]!;
    let lx = s.lines[2 * slot]!;
    let ly = s.lines[2 * slot + 1]!;
    let ox = s.lines[2 * slot + 2]!;
    let oy = s.lines[2 * slot + 3]!;
    let armAx = 0;
    let armAy = 0;
    let armBx = 0;
    let armBy = 0;
    if (a >= 0) {
      const k = base + 3 * a;
      const cos = T[2 * a]!;
      const sin = T[2 * a + 1]!;
      armAx = cos * hx - sin * hy;
      armAy = sin * hx + cos * hy;
      const x = lx;
      lx = cos * x - sin * ly;
      ly = sin * x + cos * ly;
      hx = armAx + y[k]!;
      hy = armAy + y[k + 1]!;
    }
    if (b >= 0) {
      const k = base + 3 * b;
      const cos = T[2 * b]!;
      const sin = T[2 * b + 1]!;
      armBx = cos * tx - sin * ty;
      armBy = sin * tx + cos * ty;
      const x = ox;
      ox = cos * x - sin * oy;
      oy = sin * x + cos * oy;
      tx = armBx + y[k]!;
      ty = armBy + y[k + 1]!;
    }
    const gx = tx - hx;
    const gy = ty - hy;
    const kind: Kind = p.kinds[c]!;
    const rows = kind === Kind.PIN || kind === Kind.SLIDE ? 2 : 1;
    for (let k = row; k < row + rows; k++) J.fill(0, k * W, k * W + n);
    if (kind === Kind.PIN) {
      R[row] = gx;
      R[row + 1] = gy;
      if (a >= 0) {
        J[row * W + 3 * a] = J[(row + 1) * W + 3 * a + 1] = -1;
        J[row * W + 3 * a + 2] = armAy;
        J[(row + 1) * W + 3 * a + 2] = -armAx;
      }
      if (b >= 0) {
        J[row * W + 3 * b] = J[(row + 1) * W + 3 * b + 1] = 1;
        J[row * W + 3 * b + 2] = -armBy;
        J[(row + 1) * W + 3 * b + 2] = armBx;
      }
      row += 2;
      continue;
    }
    const v = 8 * (c - from);
    const one = s.values[v]!;
    const two = s.values[v + 1]!;
    const value = s.values[v + 2]!;
    const first = s.values[v + 5]!;
    const count = s.values[v + 6]!;
    const advance = s.values[v + 7]!;
    if (kind === Kind.SLIDE) {
      const real = lx * ox + ly * oy;
      const imag = lx * oy - ly * ox;
      R[row] = imag * p.size;
      if (a >= 0) J[row * W + 3 * a + 2]! -= real * p.size;
      if (b >= 0) J[row * W + 3 * b + 2]! += real * p.size;
      row += 1;
    }
    let turnA = 0;
    let turnB = 0;
    let mx = 0;
    let my = 0;
    if (kind === Kind.SLIDE || kind === Kind.RIDE) {
      mx = -ly;
      my = lx;
      R[row] = mx * gx + my * gy - value;
      turnA = mx * gy - my * gx;
    } else if (kind === Kind.REACH) {
      mx = gx / value;
      my = gy / value;
      R[row] = ((gx * gx + gy * gy) / value - value) / 2;
    } else if (kind === Kind.MESH) {
      const near1 = unwoundAngle(lx * gx + ly * gy, ly * gx - lx * gy, s.values[v + 3]!);
      const near2 = unwoundAngle(ox * gx + oy * gy, oy * gx - ox * gy, s.values[v + 4]!);
      evaluateLaw(p.pieces, first, count, advance, near1);
      R[row] = one * law.value + two * near2 - value;
      turnA = one * law.slope;
      turnB = two;
      const d = gx * gx + gy * gy;
      mx = ((turnA + two) * gy) / d;
      my = (-(turnA + two) * gx) / d;
    } else if (kind === Kind.POLAR) {
      const sx = lx * gx + ly * gy;
      const sy = lx * gy - ly * gx;
      evaluateLaw(p.pieces, first, count, advance, unwoundAngle(sx, sy, 0));
      R[row] = one * (Math.log(Math.hypot(sx, sy)) - law.value);
      const d = gx * gx + gy * gy;
      mx = (one * (gx + law.slope * gy)) / d;
      my = (one * (gy - law.slope * gx)) / d;
      turnA = one * law.slope;
    } else if (kind === Kind.FACE) {
      mx = -two * ly;
      my = two * lx;
      evaluateLaw(p.pieces, first, count, advance, unwoundAngle(-(mx * ox + my * oy), -(my * ox - mx * oy), 0));
      R[row] = mx * gx + my * gy - law.value;
      turnA = mx * gy - my * gx - law.slope;
      turnB = law.slope;
    } else {
      mx = two * lx;
      my = two * ly;
      const angle = unwoundAngle(lx * ox + ly * oy, lx * oy - ly * ox, s.values[v + 3]!);
      R[row] = one * angle + mx * gx + my * gy - value;
      turnA = mx * gy - my * gx - one;
      turnB = one;
    }
    if (a >= 0) {
      J[row * W + 3 * a]! -= mx;
      J[row * W + 3 * a + 1]! -= my;
      J[row * W + 3 * a + 2]! += turnA - (my * armAx - mx * armAy);
    }
    if (b >= 0) {
      J[row * W + 3 * b]! += mx;
      J[row * W + 3 * b + 1]! += my;
      J[row * W + 3 * b + 2]! += turnB + (my * armBx - mx * armBy);
    }
    row += 1;
  }
  let largest = 0;
  for (let k = 0; k < row; k++) if (!(Math.abs(R[k]!) <= largest)) largest = Math.abs(R[k]!);
  return largest;
}

/** LU factors in place, with partial pivoting; returns the determinant. */
export function factor(matrix: Float64Array, W: number, n: number, pivots: Int32Array): number {
  let determinant = 1;
  for (let k = 0; k < n; k++) {
    let best = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(matrix[i * W + k]!) > Math.abs(matrix[best * W + k]!)) best = i;
    pivots[k] = best;
    if (best !== k) {
      determinant = -determinant;
      for (let m = 0; m < n; m++) {
        const held = matrix[k * W + m]!;
        matrix[k * W + m] = matrix[best * W + m]!;
        matrix[best * W + m] = held;
      }
    }
    const pivot = matrix[k * W + k]!;
    determinant *= pivot;
    if (pivot === 0) return 0;
    const from = k * W + k + 1;
    const count = n - k - 1;
    for (let i = k + 1; i < n; i++) {
      const to = i * W + k + 1;
      if (matrix[to - 1] === 0) continue;
      const share = matrix[to - 1]! / pivot;
      matrix[to - 1] = share;
      for (let m = 0; m < count; m++) matrix[to + m]! -= share * matrix[from + m]!;
    }
  }
  return determinant;
}

/** Solve in place with the factors of `factor`. */
export function solveFactored(
  matrix: Float64Array,
  W: number,
  n: number,
  pivots: Int32Array,
  target: Float64Array,
): void {
  for (let k = 0; k < n; k++) {
    const best = pivots[k]!;
    if (best !== k) {
      const held = target[k]!;
      target[k] = target[best]!;
      target[best] = held;
    }
  }
  for (let k = 0; k < n; k++) for (let i = k + 1; i < n; i++) target[i]! -= matrix[i * W + k]! * target[k]!;
  for (let k = n - 1; k >= 0; k--) {
    for (let m = k + 1; m < n; m++) target[k]! -= matrix[k * W + m]! * target[m]!;
    target[k]! /= matrix[k * W + k]!;
  }
}

/** The determinant of the last successful call of `newton`. */
export const newtonResult = { determinant: 0 };

/** Newton's method; returns whether it converged. */
export function newton(
  p: Program,
  from: number,
  to: number,
  y: Float64Array,
  base: number,
  n: number,
  s: GroupScratch,
): boolean {
  const size = p.size;
  newtonResult.determinant = 0;
  let last = Infinity;
  for (let step = 0; step < 8; step++) {
    const miss = closing(p, from, to, y, base, n, s);
    if (!(miss < 1e300)) return false;
    const determinant = factor(s.jacobian, s.width, n, s.pivots);
    if (determinant === 0) return miss < 1e-14 * size;
    solveFactored(s.jacobian, s.width, n, s.pivots, s.residual);
    let moved = 0;
    for (let k = 0; k < n; k++) {
      const scaled = Math.abs(s.residual[k]!) * (k % 3 === 2 ? size : 1);
      if (!(scaled <= moved)) moved = scaled;
    }
    // steps that grow lead nowhere near: the walk then takes a shorter one of its own
    if (!(moved < 10 * size) || moved > last) return false;
    last = moved;
    for (let k = 0; k < n; k++) y[base + k]! -= s.residual[k]!;
    if (moved < 1e-9 * size) {
      newtonResult.determinant = determinant;
      return true;
    }
  }
  return false;
}

/** Close a group near a singular position and leave what its Jacobian does not hold as it is: damped steps. */
export function closeNearSingular(
  p: Program,
  from: number,
  to: number,
  y: Float64Array,
  base: number,
  n: number,
  s: GroupScratch,
): void {
  const { jacobian: J, normal: N, residual: R, width: W } = s;
  const right = new Float64Array(n);
  for (let round = 0; round < 4; round++) {
    closing(p, from, to, y, base, n, s);
    let trace = 0;
    for (let i = 0; i < n; i++) {
      for (let k = 0; k < n; k++) {
        if (i % 3 === 2) J[k * W + i]! /= p.size;
        trace += J[k * W + i]! ** 2;
      }
    }
    for (let i = 0; i < n; i++) {
      for (let m = 0; m < n; m++) {
        let sum = i === m ? 1e-12 * trace : 0;
        for (let k = 0; k < n; k++) sum += J[k * W + i]! * J[k * W + m]!;
        N[i * W + m] = sum;
      }
    }
    for (let i = 0; i < n; i++) {
      let sum = 0;
      for (let k = 0; k < n; k++) sum += J[k * W + i]! * R[k]!;
      right[i] = sum;
    }
    factor(N, W, n, s.pivots);
    solveFactored(N, W, n, s.pivots, right);
    for (let i = 0; i < n; i++) y[base + i]! -= right[i]! / (i % 3 === 2 ? p.size : 1);
  }
}

/** Numbers of one condition in `closingRates`; made once, since it runs for every pose. */
const rateScratch = { gap: new Float64Array(6), spun: new Float64Array(4), line: new Float64Array(4) };

/** What is known of the derivatives of that order (1 or 2), beside the Jacobian times the unknown rates.
 * `turns` (2 numbers a body), `places` (6 numbers a body) and `rates` (2 a body) hold what lower orders gave. */
export function closingRates(
  order: number,
  p: Program,
  from: number,
  to: number,
  s: GroupScratch,
  turns: Float64Array,
  rates: Float64Array,
  places: Float64Array,
): void {
  let row = 0;
  const { gap: g, spun, line } = rateScratch;
  for (let c = from; c < to; c++) {
    g.fill(0);
    const slot0 = 2 * (c - from);
    for (let k = 0; k < 4; k++) line[k] = s.lines[2 * slot0 + k]!;
    for (let side = 0; side < 2; side++) {
      const slot = slot0 + side;
      const sign = 2 * side - 1;
      const body = p.owners[2 * c + side]!;
      spun[2 * side] = s.spins[2 * slot]!;
      spun[2 * side + 1] = s.spins[2 * slot + 1]!;
      const q = 6 * slot;
      if (body < 0) {
        for (let k = 0; k <= order; k++) {
          g[2 * k]! += sign * s.points[q + 2 * k]!;
          g[2 * k + 1]! += sign * s.points[q + 2 * k + 1]!;
        }
        continue;
      }
      const w = rates[2 * body]!;
      const al = rates[2 * body + 1]!;
      for (let k = 0; k <= order; k++) {
        rotated(k, turns[2 * body]!, turns[2 * body + 1]!, w, al, s.points, q);
        g[2 * k]! += sign * (places[6 * body + 2 * k]! + jet.x);
        g[2 * k + 1]! += sign * (places[6 * body + 2 * k + 1]! + jet.y);
      }
      spun[2 * side]! += w;
      spun[2 * side + 1]! += al;
      const tx = turns[2 * body]!;
      const ty = turns[2 * body + 1]!;
      const x = line[2 * side]!;
      const yy = line[2 * side + 1]!;
      line[2 * side] = tx * x - ty * yy;
      line[2 * side + 1] = tx * yy + ty * x;
    }
    const w = spun[0]!;
    const al = spun[1]!;
    const difference = spun[2 + order - 1]! - spun[order - 1]!;
    const kind: Kind = p.kinds[c]!;
    const R = s.residual;
    if (kind === Kind.PIN) {
      R[row] = -g[2 * order]!;
      R[row + 1] = -g[2 * order + 1]!;
      row += 2;
      continue;
    }
    if (kind === Kind.SLIDE) {
      R[row] = -difference * p.size;
      row += 1;
    }
    const v = 8 * (c - from);
    const one = s.values[v]!;
    const two = s.values[v + 1]!;
    if (kind === Kind.REACH) {
      let rate = 2 * (g[0]! * g[2 * order]! + g[1]! * g[2 * order + 1]!);
      if (order === 2) rate += 2 * (g[2]! ** 2 + g[3]! ** 2);
      R[row] = -rate / (2 * s.values[v + 2]!);
      row += 1;
      continue;
    }
    const d = g[0]! ** 2 + g[1]! ** 2;
    const log1x = (g[2]! * g[0]! + g[3]! * g[1]!) / d;
    const log1y = (g[3]! * g[0]! - g[2]! * g[1]!) / d;
    const log2x = (g[4]! * g[0]! + g[5]! * g[1]!) / d - (log1x * log1x - log1y * log1y);
    const log2y = (g[5]! * g[0]! - g[4]! * g[1]!) / d - 2 * log1x * log1y;
    let first = 1;
    if (kind === Kind.MESH || kind === Kind.POLAR) first = log1y - w;
    else if (kind === Kind.FACE) first = w - spun[2]!;
    let bent = 0;
    let slope = 1;
    if (s.values[v + 6]! > 0 || kind === Kind.MESH) {
      let angle: number;
      const lx = line[0]!;
      const ly = line[1]!;
      const ox = line[2]!;
      const oy = line[3]!;
      if (kind === Kind.MESH) {
        angle = unwoundAngle(lx * g[0]! + ly * g[1]!, ly * g[0]! - lx * g[1]!, s.values[v + 3]!);
        first = -first;
      } else if (kind === Kind.POLAR) angle = unwoundAngle(lx * g[0]! + ly * g[1]!, lx * g[1]! - ly * g[0]!, 0);
      else {
        const mx = -two * ly;
        const my = two * lx;
        angle = unwoundAngle(-(mx * ox + my * oy), -(my * ox - mx * oy), 0);
      }
      evaluateLaw(p.pieces, s.values[v + 5]!, s.values[v + 6]!, s.values[v + 7]!, angle);
      slope = law.slope;
      if (order === 2) bent = law.curve * first * first;
    }
    if (kind === Kind.MESH) {
      const turning = order === 1 ? log1y : log2y;
      R[row] = -one * (slope * (spun[order - 1]! - turning) + bent) - two * (spun[2 + order - 1]! - turning);
    } else if (kind === Kind.POLAR) {
      const real = order === 1 ? log1x : log2x;
      const imag = order === 1 ? log1y : log2y;
      R[row] = one * (slope * (imag - spun[order - 1]!) + bent - real);
    } else {
      rotated(order, line[0]!, -line[1]!, -w, -al, g, 0);
      if (kind === Kind.RACK) R[row] = -(one * difference + two * jet.x);
      else if (kind === Kind.FACE) R[row] = bent - slope * difference - two * jet.y;
      else R[row] = -jet.y;
    }
    row += 1;
  }
}

/** What `rotated` returned. */
export const jet = { x: 0, y: 0 };

/** The derivative of that order of turn(t) * b(t); b stands with its derivatives in an array from `at` on. */
export function rotated(
  order: number,
  tx: number,
  ty: number,
  w: number,
  a: number,
  b: ArrayLike<number>,
  at: number,
): void {
  let x = b[at]!;
  let y = b[at + 1]!;
  if (order === 1) {
    const x0 = x;
    const y0 = y;
    x = b[at + 2]! - w * y0;
    y = b[at + 3]! + w * x0;
  } else if (order === 2) {
    const x0 = x;
    const y0 = y;
    x = b[at + 4]! - 2 * w * b[at + 3]! - w * w * x0 - a * y0;
    y = b[at + 5]! + 2 * w * b[at + 2]! - w * w * y0 + a * x0;
  }
  jet.x = tx * x - ty * y;
  jet.y = tx * y + ty * x;
}
