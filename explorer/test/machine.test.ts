/** By what angle a link in space is turned, against its rotation matrix. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { turnOf } from "../src/space/machine";

test("small, large and half turns about each axis are told", () => {
  for (const phi of [1e-7, 1e-3, 1.2, 3.1, Math.PI]) {
    const [c, s] = [Math.cos(phi), Math.sin(phi)];
    for (const pose of [
      [1, 0, 0, 4, 0, c, -s, 5, 0, s, c, 6],
      [c, 0, s, 4, 0, 1, 0, 5, -s, 0, c, 6],
      [c, -s, 0, 4, s, c, 0, 5, 0, 0, 1, 6],
    ])
      assert.ok(Math.abs(turnOf(pose) - phi) < 1e-9 * phi, `${phi}: ${turnOf(pose)}`);
  }
  assert.equal(turnOf([1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6]), 0);
});
