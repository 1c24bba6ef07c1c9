/** What a pose says of a linkage: drive values, signs and unknowns.
 *
 * As `gruebler.mechanics.kinematics.reference_pose` reads them. */

import { type Rows, unwoundAngle } from "./kernel";
import type { Linkage } from "./linkage";
import { Code, Kind } from "./program";
import { direction, origin, type Pair, place, putOrigin, putTurn, turn } from "./rows";

/** Read the state of a linkage off a pose in which all its links lie. */
export function readState(linkage: Linkage, pose: Rows): void {
  readDrives(linkage, pose);
  readSigns(linkage, pose);
  readUnknowns(linkage, pose);
}

/** Where an element of the plan lies, and its direction. */
function reader({ program: p }: Linkage, pose: Rows): { point(e: number): Pair; line(e: number): Pair } {
  return {
    point: (e) => place(pose, 0, p.links[e]!, p.points[2 * e]!, p.points[2 * e + 1]!),
    line: (e) => direction(pose, 0, p.links[e]!, [p.lines[2 * e]!, p.lines[2 * e + 1]!]),
  };
}

/** The angle from one direction to another, in the lap nearest to a known one. */
function between([ax, ay]: Pair, [bx, by]: Pair, known: number): number {
  return unwoundAngle(ax * bx + ay * by, ax * by - ay * bx, known);
}

function readDrives(linkage: Linkage, pose: Rows): void {
  const { drives, model } = linkage;
  const { point, line } = reader(linkage, pose);
  model.reference.drives.forEach(([a, b, near, far], k) => {
    if (model.drives[k]?.turning ?? true) drives[k] = between(turn(pose, 0, a!), turn(pose, 0, b!), drives[k]!);
    else {
      const [lx, ly] = line(near!);
      const [px, py] = point(near!);
      const [qx, qy] = point(far!);
      drives[k] = lx * (qx - px) + ly * (qy - py);
    }
  });
}

function readSigns(linkage: Linkage, pose: Rows): void {
  const { point, line } = reader(linkage, pose);
  for (const operation of linkage.program.operations) {
    const kind: Code = operation[0]!;
    if (kind !== Code.RRR && kind !== Code.RRP && kind !== Code.RPR) continue;
    const [, outer, , inner, , , other] = operation as number[];
    const [ox, oy] = point(outer!);
    const [ix, iy] = point(inner!);
    const [tx, ty] = point(other!);
    let side: number;
    if (kind === Code.RRR) side = (tx - ox) * (iy - oy) - (ty - oy) * (ix - ox);
    else if (kind === Code.RRP) {
      const [lx, ly] = line(other!);
      side = lx * (ix - ox) + ly * (iy - oy);
    } else {
      const [lx, ly] = line(inner!);
      side = lx * (tx - ox) + ly * (ty - oy);
    }
    linkage.state.signs[operation[9]!] = side < 0 ? -1 : 1;
  }
}

function readUnknowns(linkage: Linkage, pose: Rows): void {
  const { reference } = linkage.model;
  const { point, line } = reader(linkage, pose);
  const y = linkage.state.unknowns;
  reference.bodies.forEach(([root, base], k) => {
    const [bx, by] = turn(pose, 0, base!);
    const [x, yy] = origin(pose, 0, root!);
    const [u, v] = origin(pose, 0, base!);
    const dx = x - u;
    const dy = yy - v;
    y[3 * k] = bx * dx + by * dy;
    y[3 * k + 1] = bx * dy - by * dx;
    y[3 * k + 2] = between([bx, by], turn(pose, 0, root!), y[3 * k + 2]!);
  });
  reference.windings.forEach(([kind, one, two], k) => {
    const at = windingAt(linkage, k);
    const [near, far] = [line(one!), line(two!)];
    if (kind === Kind.MESH) {
      const [px, py] = point(one!);
      const [qx, qy] = point(two!);
      const gap: Pair = [qx - px, qy - py];
      y[at] = between(gap, near, y[at]!);
      y[at + 1] = between(gap, far, y[at + 1]!);
    } else y[at] = between(near, far, y[at]!);
  });
}

/** Where the turns of a pair of wheels stand among the unknowns. */
export function windingAt({ model }: Linkage, winding: number): number {
  return 3 * model.reference.bodies.length + 2 * winding;
}

/** Where the blocks of pins in slots lie when the other links are placed: at the pin, turned with the slot. */
export function placeBlocks(linkage: Linkage, pose: Rows): void {
  const { model, program, sizes } = linkage;
  for (let block = model.own; block < model.links.length; block++) {
    const name = model.links[block]!.replace(/^block /, "");
    const joint = model.joints.findIndex((j) => j.name === name);
    const made = model.sources.some((source, e) => source < 0 && program.links[e] === block);
    if (joint < 0 || !made) continue;
    const lineFirst = (a: number, b: number) => Number(sizes.is(b, "line")) - Number(sizes.is(a, "line"));
    const [k, m] = [...sizes.elementsOf(joint)].sort(lineFirst) as [number, number];
    const [px, py] = linkage.elementAt(m, pose);
    putTurn(pose, block, ...turn(pose, 0, sizes.element(k).link));
    if (sizes.is(m, "line")) {
      const [x, y] = linkage.elementAt(k, pose);
      const [lx, ly] = direction(pose, 0, sizes.element(k).link, sizes.line(k));
      const way = lx * (px - x) + ly * (py - y);
      putOrigin(pose, block, x + way * lx, y + way * ly);
    } else putOrigin(pose, block, px, py);
  }
}
