/** Where names of links stand: by hand, for triangles of whole numbers. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { namePlace, nameSpot } from "../src/names";
import type { Pair } from "../src/rows";
import { Viewport } from "../src/viewport";

test("the name of a thin body stands beside its longest side, away from it", () => {
  const thin: Pair[] = [
    [0, 0],
    [50, 5],
    [100, 0],
  ];
  const below = namePlace(thin, [], "coupler", 1);
  assert.deepEqual(below, { at: [50, 0], away: [0, -1] });
  const [x, y] = nameSpot(new Viewport(), below, "coupler"); // of a picture whose y grows downward
  assert.ok(x === 50 && y > 15);
});

test("a body with room has its name in its middle, but not if the picture is small", () => {
  const wide: Pair[] = [
    [0, 0],
    [300, 0],
    [150, 300],
  ];
  assert.deepEqual(namePlace(wide, [], "coupler", 1), { at: [150, 100], away: null });
  assert.ok(namePlace(wide, [], "coupler", 0.1).away);
});

test("a free point beside a bar leaves the name on the other side", () => {
  const bar: Pair[] = [
    [0, 0],
    [30, 0],
  ];
  assert.deepEqual(namePlace(bar, [[15, 40]], "coupler", 1), { at: [15, 0], away: [0, -1] });
  assert.deepEqual(namePlace(bar, [[15, -40]], "coupler", 1), { at: [15, 0], away: [0, 1] });
});

test("one place alone has its name above", () => {
  const pin: Pair[] = [
    [3, 4],
    [3, 4],
  ];
  assert.deepEqual(namePlace(pin, [], "block", 1), { at: [3, 4], away: [0, 1] });
});
