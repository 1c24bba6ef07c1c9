/** By what angle a link in space is turned, against its rotation matrix. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { fitted, projection, seen, type Vector } from "../src/space/algebra";
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

test("what is fitted into a picture in space lies in its middle and fills it", () => {
  const places: Vector[] = [
    [300, 0, 0],
    [-40, 10, 0],
    [0, 200, 30],
    [20, -20, 150],
  ];
  for (const wide of [0.8, 1.5]) {
    const camera = { turn: 0.9, lift: 0.5, middle: [0, 0, 0] as Vector, distance: 1 };
    const view = projection(fitted(camera, wide, places), wide);
    const all = places.map((place) => seen(view, place));
    const ends = [0, 1].map((axis) => all.map((at) => at[axis]!)).map((at) => [Math.min(...at), Math.max(...at)]);
    for (const [low, high] of ends) assert.ok(Math.abs(low! + high!) < 0.02, `${low} ${high}`);
    assert.ok(Math.abs(Math.max(...ends.flat()) - 0.8) < 0.02);
  }
});
