/** Lengths of a drawing that are typed and kept, and directions and places that are. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { dimensionsOf } from "../src/dimensions";
import { called, type Drawing, documentOfDrawing, turned, withPoint } from "../src/drawing";
import { keeping, lengthOf, movedKept, type Span, spansOf, withLength } from "../src/lengths";
import { halfOf } from "../src/names";
import type { Pair } from "../src/rows";
import { Viewport } from "../src/viewport";
import { close, near } from "./near";

// a slider-crank: A on the ground, B the crank pin, C the block with its slide D
const CRANK: Drawing = {
  frame: "f",
  drives: [0],
  knots: [
    { at: [0, 0], links: ["f", "1"] },
    { at: [0, 20], links: ["1", "2"] },
    { at: [80, 0], links: ["2", "3"] },
    { at: [80, 0], links: ["f", "3"], slide: 0 },
  ],
};
const ROD: Span = { link: "2", ends: [1, 2] };

test("of each link so many lengths are told as fix it", () => {
  const plate = withPoint(withPoint(CRANK, "2", [30, 40]), "2", [50, 40]);
  const of = (drawing: Drawing) => spansOf(drawing).map(({ link, ends }) => `${link} ${ends.join("-")}`);
  assert.deepEqual(of(CRANK), ["1 0-1", "2 1-2"]); // a slide is no pin
  assert.deepEqual(of(plate), ["1 0-1", "2 1-2", "2 1-4", "2 2-4", "2 1-5", "2 2-5"]); // 2·4 - 3
});

test("a typed length leaves a block on its slide, and a crank that is kept as long as it is", () => {
  const longer = withLength(CRANK, ROD, 101)!;
  near(longer.knots[1]!.at, [0, 20]);
  near(longer.knots[2]!.at, [Math.sqrt(101 * 101 - 400), 0]);
  near(longer.knots[3]!.at, longer.knots[2]!.at); // its slide goes along
  assert.equal(withLength(CRANK, ROD, 0), null);
  assert.equal(withLength(CRANK, ROD, Number.NaN), null);
  const fixed = keeping(keeping(CRANK, "joint", [2]), "joint", [1]);
  assert.equal(withLength(fixed, ROD, 50), null);
});

test("what is kept stays while a joint is dragged", () => {
  const rod = keeping(CRANK, "length", [2, 1]);
  assert.deepEqual(rod.locks, [["length", "B", "C"]]);
  const before = lengthOf(rod, ROD.ends);
  const moved = movedKept(rod, 1, [0, 30])!;
  near(moved.knots[1]!.at, [0, 30]);
  near(moved.knots[2]!.at, [Math.sqrt(before * before - 900), 0]); // along its slide
  const both = keeping(rod, "length", [0, 1]);
  const turnedAway = movedKept(both, 1, [40, 40])!; // it cannot come there: near it
  close(Math.hypot(...turnedAway.knots[1]!.at), 20, 1e-6);
  assert.equal(movedKept(both, 1, [40, 40], true), null); // what is typed must hold
  const upright = keeping(CRANK, "direction", [0, 1]);
  near(movedKept(upright, 1, [9, 33])!.knots[1]!.at, [0, 33], 1e-4);
  assert.equal(movedKept(keeping(CRANK, "joint", [1]), 1, [1, 1]), null);
  assert.deepEqual(keeping(rod, "length", [1, 2]).locks, []); // not any more
});

test("a lock goes along where a joint is called otherwise, and into the document", () => {
  const named = called(keeping(keeping(CRANK, "length", [1, 2]), "joint", [0]), 1, "pin")!;
  assert.deepEqual(named.locks, [
    ["length", "C", "pin"],
    ["joint", "A"],
  ]);
  assert.equal(called(CRANK, 1, "A"), null);
  const { page } = documentOfDrawing(named) as { page: { locks: unknown } };
  assert.deepEqual(page.locks, [
    ["length", "2", "R(2-3)", "R(1-2)"],
    ["joint", "R(f-1)"],
  ]);
  close(turned(CRANK, 3, 405).knots[3]!.slide!, 45);
});

test("dimension lines of a joint do not cross each other", () => {
  const viewport = Object.assign(new Viewport(), { width: 900 });
  const turn = (p: Pair, q: Pair, r: Pair) => (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  const cross = ([a, b]: readonly Pair[], [c, d]: readonly Pair[]) =>
    turn(a!, b!, c!) * turn(a!, b!, d!) < 0 && turn(c!, d!, a!) * turn(c!, d!, b!) < 0;
  // two links at an acute angle, and a third one that takes the middle of all to another place
  for (const [x, y] of [
    [60, 400],
    [300, -300],
    [800, 200],
    [800, 600],
  ] as const) {
    const drawing: Drawing = {
      frame: null,
      drives: [],
      knots: [
        { at: [100, 100], links: ["1", "3"] },
        { at: [300, 180], links: ["1", "2"] },
        { at: [240, 270], links: ["2"] },
        { at: [x, y], links: ["3"] },
      ],
    };
    const [one, two] = dimensionsOf({ drawing, viewport, chosen: { knot: 1, link: null } });
    assert.ok(!cross(one!.line, two!.line), `${x} ${y}`);
  }
});

test("figures of lengths keep apart, also where both are level", () => {
  // a coupler and a ternary link of a six-bar on a phone
  const drawing: Drawing = {
    frame: "f",
    drives: [],
    knots: [
      { at: [0, 20], links: ["1", "2"] },
      { at: [60, 40], links: ["2", "3"] },
      { at: [70, 0], links: ["f", "3"] },
      { at: [92, 32], links: ["3", "4"] },
      { at: [30, 60], links: ["2"] },
    ],
  };
  const viewport = Object.assign(new Viewport(), { width: 390, height: 440, scale: 2 });
  const all = dimensionsOf({ drawing, viewport, chosen: { knot: 1, link: null } });
  assert.equal(all.length, 3);
  for (const one of all)
    for (const other of all)
      assert.ok(
        one === other ||
          Math.abs(one.at[0] - other.at[0]) > halfOf(one.text) + halfOf(other.text) ||
          Math.abs(one.at[1] - other.at[1]) > 13,
        `${one.text} ${other.text}`,
      );
});

test("a chosen link has all its lengths, outside of it", () => {
  const drawing = withPoint(CRANK, "2", [30, 60]);
  const viewport = Object.assign(new Viewport(), { width: 900, height: 700, scale: 5 });
  const all = dimensionsOf({ drawing, viewport, chosen: { knot: null, link: "2" } });
  assert.equal(all.length, 3);
  const [[ax, ay], [bx, by]] = [viewport.screen(0, 20), viewport.screen(80, 0)];
  // that of the base is below it, on the other side of the point
  const below = ([x, y]: Pair) => (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
  assert.ok(below(all[0]!.at) && !below(viewport.screen(30, 60)));
});
