/** Wheels that mesh: which centres can be dragged, on what circle, and how the teeth meet afterwards. */

import type { Rows } from "./kernel";
import type { Linkage } from "./linkage";
import { Kind } from "./program";
import { readState, windingAt } from "./reading";
import { move, type Pair, turn } from "./rows";

/** Two wheels that mesh: the number of the condition, and their elements. */
export interface Mesh {
  condition: number;
  sides: readonly [number, number];
}

/** The wheel whose centre a joint is, and an element at the centre of what it meshes with. */
export interface Pivot {
  wheel: number;
  about: number;
}

/** Numbers of a condition in the plan, and which of them says how many pieces its law has. */
const VALUES = 6;
const PIECES = 4;

export function meshesOf({ model, program: p, sizes }: Linkage): Mesh[] {
  return Array.from(p.kinds).flatMap((kind, condition) => {
    const sides = [model.sources[p.sides[2 * condition]!]!, model.sources[p.sides[2 * condition + 1]!]!] as const;
    const round = sides.every((k) => k >= 0 && sizes.is(k, "round"));
    return kind === Kind.MESH && p.values[VALUES * condition + PIECES] === 0 && round ? [{ condition, sides }] : [];
  });
}

/** A wheel keeps its distance from the wheels that it meshes with: its centre moves on a circle about theirs. */
export function pivotOf(linkage: Linkage, meshes: readonly Mesh[], joint: number): Pivot | null {
  const { sizes } = linkage;
  const pins = sizes.elementsOf(joint);
  let found: Pivot | null = null;
  let centre = -1;
  for (const { sides } of meshes)
    for (const side of [0, 1] as const) {
      const mine = sides[side];
      const about = sides[1 - side]!;
      const wheel = sizes.element(mine).link;
      const pin = pins.find((k) => sizes.element(k).link === wheel && sizes.is(k, "pin") && sizes.together(k, mine));
      if (pin === undefined) continue;
      if (found && (found.wheel !== wheel || apart(linkage, found.about, about) > sizes.near)) return null;
      found = { wheel, about };
      centre = pin;
    }
  if (!found) return null;
  const meshing = new Set(meshes.flatMap(({ sides }) => sides));
  const { wheel, about } = found;
  const rounds = (link: number) => sizes.elementsOn(link).filter((k) => sizes.is(k, "round"));
  if (rounds(wheel).some((k) => !meshing.has(k) || !sizes.together(k, centre))) return null;
  const carriers = pins.filter((k) => sizes.element(k).link !== wheel);
  const bare = carriers.every((k) => rounds(sizes.element(k).link).every((m) => !sizes.together(k, m)));
  return bare && carriers.some((k) => holds(linkage, sizes.element(k).link, about)) ? found : null;
}

/** Whether the centre of a wheel is fixed on a link: by a joint of both, or one at the same place of a third link. */
function holds({ sizes }: Linkage, link: number, centre: number): boolean {
  const linkOf = (k: number) => sizes.element(k).link;
  const jointOf = (k: number) => sizes.element(k).joint;
  const pinsOn = (number: number) => sizes.elementsOn(number).filter((k) => sizes.is(k, "pin"));
  const pins = pinsOn(linkOf(centre)).filter((k) => sizes.together(k, centre));
  return pins.some((pin) => {
    const here = sizes.elementsOf(jointOf(pin));
    if (here.some((k) => linkOf(k) === link)) return true;
    const meets = (m: number) => here.some((other) => linkOf(other) === linkOf(m) && sizes.together(m, other));
    return pinsOn(link).some((k) => sizes.elementsOf(jointOf(k)).some(meets));
  });
}

/** The distance of two elements in the plane. */
function apart(linkage: Linkage, k: number, m: number): number {
  const [ax, ay] = linkage.elementAt(k);
  const [bx, by] = linkage.elementAt(m);
  return Math.hypot(bx - ax, by - ay);
}

/** The place on the circle of a wheel's centre that is nearest to one in the plane. */
export function onCircle(linkage: Linkage, pivot: Pivot, joint: number, x: number, y: number): Pair {
  const [cx, cy] = linkage.elementAt(pivot.about);
  const [px, py] = linkage.jointAt(joint);
  const away = Math.hypot(x - cx, y - cy);
  if (!(away > linkage.sizes.near)) return [px, py];
  const part = Math.hypot(px - cx, py - cy) / away;
  return [cx + part * (x - cx), cy + part * (y - cy)];
}

/** Move a wheel with its centre; its other joints stay where they are in the plane. */
export function shiftWheel(linkage: Linkage, pose: Rows, wheel: number, joint: number, x: number, y: number): void {
  const { sizes } = linkage;
  const [px, py] = linkage.jointAt(joint);
  const [c, s] = turn(pose, 0, wheel);
  const dx = x - px;
  const dy = y - py;
  move(pose, wheel, dx, dy);
  for (const k of sizes.elementsOn(wheel)) {
    if (sizes.element(k).joint === joint || sizes.is(k, "round")) continue;
    sizes.shift(k, -(c * dx + s * dy), -(c * dy - s * dx));
  }
}

/** Let wheels mesh in a pose: their turns are counted from it, as the library does from that of the document. */
export function setPhases(linkage: Linkage, meshes: readonly Mesh[], pose: Rows): void {
  const { model, program: p, sizes, state } = linkage;
  for (const { condition, sides } of meshes) {
    const [one, two] = [p.sides[2 * condition]!, p.sides[2 * condition + 1]!];
    const k = model.reference.windings.findIndex(([, a, b]) => a === one && b === two);
    if (k < 0) continue;
    const at = windingAt(linkage, k);
    const [first, second, value] = p.values.subarray(VALUES * condition) as unknown as [number, number, number];
    const open = first * state.unknowns[at]! + second * state.unknowns[at + 1]! - value;
    sizes.angles[sides[1]]! -= open / second;
  }
  if (meshes.length === 0) return;
  linkage.writeSizes();
  readState(linkage, pose);
}
