/** The solver of linkages in space, on a four-bar in a plane whose rocker drives, against the law of cosines. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Solver } from "../src/space/solver";

const [CRANK, COUPLER, ROCKER, FRAME] = [25, 70, 40, 70];

/** The angle of the crank at an angle of the rocker, the coupler on the same side as before. */
function crankAt(rocker: number, side: number): number {
  const [x, y] = [FRAME + ROCKER * Math.cos(rocker), ROCKER * Math.sin(rocker)];
  const far = Math.hypot(x, y);
  return Math.atan2(y, x) + side * Math.acos((CRANK ** 2 + far ** 2 - COUPLER ** 2) / (2 * CRANK * far));
}

/** The linkage at an angle of its rocker. */
function driven(rocker: number, side: number): Solver {
  const crank = crankAt(rocker, side);
  const places = [
    [0, 0],
    [CRANK * Math.cos(crank), CRANK * Math.sin(crank)],
    [FRAME + ROCKER * Math.cos(rocker), ROCKER * Math.sin(rocker)],
    [FRAME, 0],
  ];
  const links: [number, number][] = [
    [0, 1],
    [1, 2],
    [2, 3],
    [0, 3],
  ];
  const joints = links.map((pair, k) => {
    const [x, y] = places[k]!;
    return { links: pair, frame: [1, 0, 0, x!, 0, 1, 0, y!, 0, 0, 1, 0], turns: "z", slides: "", pitch: 0 };
  });
  const drive = { joint: 3, axis: 2, turns: true, sign: 1, low: -4, high: 4, round: false };
  return new Solver({ frame: 0, joints, drives: [drive], gears: [] }, FRAME, [FRAME / 2, 0, 0], 4);
}

test("a rocker near its dead centre takes the crank along on its side", () => {
  // there crank and coupler are in line; a step from near it would go over to the other side, which is refused
  const reach = (FRAME ** 2 + ROCKER ** 2 - (COUPLER + CRANK) ** 2) / (2 * FRAME * ROCKER);
  for (const side of [1, -1])
    for (const near of [1e-3, 1e-2])
      for (const way of [0.08, 0.4]) {
        const start = Math.PI - Math.acos(reach) + near;
        const solver = driven(start, side);
        assert.ok(solver.drive([way]));
        const [c, , , , s] = solver.poses[1]!;
        const wanted = crankAt(start + way, side) - crankAt(start, side);
        assert.ok(Math.hypot(c! - Math.cos(wanted), s! - Math.sin(wanted)) < 1e-6, `${side} ${near} ${way}`);
      }
});
