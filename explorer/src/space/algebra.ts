// Rays, rigid motions (twelve numbers by rows) and projections, on plain arrays.

export type Vector = [number, number, number];

export const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** A point after a rigid motion. */
export function moved(pose: ArrayLike<number>, p: Vector): Vector {
  const row = (k: number): number => pose[k]! * p[0] + pose[k + 1]! * p[1] + pose[k + 2]! * p[2] + pose[k + 3]!;
  return [row(0), row(4), row(8)];
}

/** A point before a rigid motion. */
export function before(pose: ArrayLike<number>, p: Vector): Vector {
  const d: Vector = [p[0] - pose[3]!, p[1] - pose[7]!, p[2] - pose[11]!];
  const column = (k: number): number => pose[k]! * d[0] + pose[k + 4]! * d[1] + pose[k + 8]! * d[2];
  return [column(0), column(1), column(2)];
}

/** How far along a ray it meets the triangle of nine coordinates from `k` on; Infinity beside it (Möller and Trumbore,
 * 1997). In numbers alone: a picture asks for it a hundred thousand times. */
export function meeting(from: Vector, along: Vector, corners: Float64Array, k: number): number {
  const ax = corners[k]!;
  const ay = corners[k + 1]!;
  const az = corners[k + 2]!;
  const ux = corners[k + 3]! - ax;
  const uy = corners[k + 4]! - ay;
  const uz = corners[k + 5]! - az;
  const vx = corners[k + 6]! - ax;
  const vy = corners[k + 7]! - ay;
  const vz = corners[k + 8]! - az;
  const dx = along[0];
  const dy = along[1];
  const dz = along[2];
  const px = dy * vz - dz * vy;
  const py = dz * vx - dx * vz;
  const pz = dx * vy - dy * vx;
  const sx = from[0] - ax;
  const sy = from[1] - ay;
  const sz = from[2] - az;
  const determinant = ux * px + uy * py + uz * pz;
  const x = (sx * px + sy * py + sz * pz) / determinant;
  if (!(x >= 0 && x <= 1)) return Infinity; // most are beside it
  const qx = sy * uz - sz * uy;
  const qy = sz * ux - sx * uz;
  const qz = sx * uy - sy * ux;
  const y = (dx * qx + dy * qy + dz * qz) / determinant;
  const t = (vx * qx + vy * qy + vz * qz) / determinant;
  return y >= 0 && x + y <= 1 && t > 0 ? t : Infinity;
}

/** A camera that goes round a middle: angles in radians, distance in lengths. */
export interface Camera {
  turn: number;
  lift: number;
  distance: number;
  middle: Vector;
  /** The cotangent of half the angle of view. */
  opening: number;
}

export const NATURAL = 3; // the opening of a view in perspective
export const FLAT = 600; // from so far that what is parallel is seen so
const STEPS = 12; // to a camera that fits: each leaves a tenth of what is missing, along a slender machine two thirds

/** The eye, and unit vectors to the right, up and towards the eye. */
export function axes(camera: Camera): { eye: Vector; right: Vector; up: Vector; near: Vector } {
  const [c, s] = [Math.cos(camera.lift), Math.sin(camera.lift)];
  const near: Vector = [c * Math.cos(camera.turn), c * Math.sin(camera.turn), s];
  const right: Vector = [-Math.sin(camera.turn), Math.cos(camera.turn), 0];
  const eye = camera.middle.map((m, k) => m + camera.distance * near[k]!) as Vector;
  return { eye, right, up: cross(near, right), near };
}

/** The projection as a matrix by columns, for a picture so many times as wide as high. */
export function projection(camera: Camera, wide: number): Float32Array {
  const { opening } = camera;
  const { eye, right, up, near } = axes(camera);
  const depth = opening > NATURAL ? 1.2 : 50; // from afar the machine is thin
  const [close, far] = [camera.distance / depth, camera.distance * depth];
  const [a, b] = [(far + close) / (close - far), (2 * far * close) / (close - far)];
  const rows = [
    [...right.map((v) => (v * opening) / Math.max(wide, 1)), (-dot(right, eye) * opening) / Math.max(wide, 1)],
    [...up.map((v) => v * opening * Math.min(wide, 1)), -dot(up, eye) * opening * Math.min(wide, 1)],
    [...near.map((v) => v * a), -dot(near, eye) * a + b],
    [...near.map((v) => -v), dot(near, eye)],
  ];
  return new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]!)));
}

/** Where a point is on the picture, -1 to 1 to the right and up. */
export function seen(matrix: Float32Array, p: Vector): [number, number] {
  const row = (k: number): number =>
    matrix[k]! * p[0] + matrix[k + 4]! * p[1] + matrix[k + 8]! * p[2] + matrix[k + 12]!;
  return [row(0) / row(3), row(1) / row(3)];
}

/** Parts of the picture that are kept free at its edges. */
export interface Margins {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** A camera from the same side that has all places in the middle of the free room of a picture so many times as wide as
 * high. */
export function fitted(camera: Camera, wide: number, places: Vector[], margins: Margins): Camera {
  const { opening } = camera;
  const { right, up, near } = axes(camera);
  const all = places.map((place) => [right, up, near].map((axis) => dot(axis, place)) as Vector);
  const ends = (value: (place: Vector) => number): [number, number] =>
    all.map(value).reduce(([least, most], one) => [Math.min(least, one), Math.max(most, one)], [Infinity, -Infinity]);
  let [h, v, n] = [0, 1, 2].map((k) => sum(ends((at) => at[k]!)) / 2) as Vector;
  const nearest = ends(([, , z]) => z)[1] - n; // the eye stays twice as far, or this would be seen much larger
  const scales = [opening / Math.max(wide, 1), opening * Math.min(wide, 1)];
  const room = [2 - 2 * (margins.left + margins.right), 2 - 2 * (margins.top + margins.bottom)];
  const wanted = [margins.left - margins.right, margins.bottom - margins.top];
  let distance = Math.max(20 * ends(([x, y, z]) => Math.hypot(x - h, y - v, z - n))[1], 1e-9);
  for (let k = 0; k < STEPS; k++) {
    const gap = distance - nearest; // steps by the whole distance would overshoot where the eye is near
    // what is near is seen larger: the middle of the picture is not that of the places
    const spans = [0, 1].map((axis) =>
      ends((at) => (scales[axis]! * (at[axis]! - [h, v][axis]!)) / (distance - at[2] + n)),
    );
    const [x, y] = spans.map((both, axis) => ((sum(both) / 2 - wanted[axis]!) * gap) / scales[axis]!);
    [h, v] = [h + x!, v + y!];
    const part = Math.max(...spans.map(([from, to], axis) => (to - from) / room[axis]!));
    distance = Math.max(nearest + gap * part, 2 * nearest, 1e-9);
  }
  const middle = right.map((r, k) => h * r + v * up[k]! + n * near[k]!) as Vector;
  return { ...camera, middle, distance };
}

const sum = ([low, high]: [number, number]): number => low + high;

/** The ray through a place of the picture. */
export function ray(camera: Camera, wide: number, x: number, y: number): { from: Vector; along: Vector } {
  const { opening } = camera;
  const { eye, right, up, near } = axes(camera);
  const [h, v] = [(x * Math.max(wide, 1)) / opening, y / (opening * Math.min(wide, 1))];
  return { from: eye, along: near.map((n, k) => h * right[k]! + v * up[k]! - n) as Vector };
}
