/** Mechanisms that are drawn: the count of print, names, what joining, splitting and removing leaves. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  counted,
  type Drawing,
  documentOfDrawing,
  driven,
  EMPTY,
  joined,
  jointName,
  jointsOf,
  linksOf,
  moved,
  renamed,
  type Spot,
  split,
  withDyad,
  withGround,
  withLink,
  withoutLink,
  withSlider,
} from "../src/drawing";
import { setLanguage } from "../src/language";

const place = (x: number, y: number): Spot => ({ at: [x, y], knot: null, link: null });
const knot = (drawing: Drawing, number: number): Spot => ({ at: drawing.knots[number]!.at, knot: number, link: null });
const on = (link: string, x: number, y: number): Spot => ({ at: [x, y], knot: null, link });

/** A four-bar: a crank on the ground, then a dyad from its end to the ground. */
function fourBar(): Drawing {
  const one = withGround(EMPTY, place(0, 0));
  const two = withLink(one, knot(one, 0), place(0, 20));
  return withDyad(two, knot(two, 1), place(60, 40), on("frame", 70, 0));
}

test("a four-bar has F = 1, its dyad changes nothing", () => {
  const drawing = fourBar();
  assert.deepEqual(linksOf(drawing), ["frame", "1", "2", "3"]);
  assert.deepEqual(
    jointsOf(drawing).map((k) => jointName(drawing, k)),
    ["R(frame-1)", "R(1-2)", "R(2-3)", "R(frame-3)"],
  );
  assert.equal(counted(drawing), 1); // 3(4 - 1) - 2·4
  const six = withDyad(drawing, on("2", 30, 60), place(90, 90), on("frame", 120, 0));
  assert.equal(counted(six), 1); // 3(6 - 1) - 2·7: a dyad has no freedom
  assert.equal(linksOf(six).length, 6);
});

test("a slider-crank", () => {
  const one = withGround(EMPTY, place(0, 0));
  const two = withLink(one, knot(one, 0), place(0, 20));
  const three = withLink(two, knot(two, 1), place(70, 0));
  const whole = driven(withSlider(three, knot(three, 2)), 0);
  assert.equal(counted(whole), 1);
  const document = documentOfDrawing(whole, "mm");
  assert.equal(document.joints, "R(frame-1) R(1-2) R(2-3) P(frame-3)");
  assert.deepEqual(document.places, {
    "R(frame-1)": [0, 0],
    "R(1-2)": [0, 20],
    "R(2-3)": [70, 0],
    "P(frame-3)": [70, 0, 0],
  });
  assert.deepEqual(document.drives, ["R(frame-1)"]);
  const away = moved(whole, 2, [80, 5]); // the block goes with its pin
  assert.deepEqual(away.knots[3]!.at, [80, 5]);
});

test("three links in one joint count as two joints", () => {
  const drawing = fourBar();
  const third = withLink(drawing, knot(drawing, 2), place(100, 100));
  assert.equal(jointName(third, 2), "R(2-3-4)");
  assert.equal(counted(third), 2); // one link more, two freedoms less
});

test("joining and splitting are each other's way back", () => {
  const drawing = driven(fourBar(), 0);
  const open = split(drawing, 2, 5);
  assert.equal(counted(open), 3);
  assert.deepEqual(
    open.knots.slice(-2).map(({ links }) => links),
    [["2"], ["3"]],
  );
  const closed = joined(open, open.knots.length - 1, open.knots.length - 2)!;
  assert.equal(counted(closed), 1);
  assert.deepEqual(closed.drives, [0]);
  assert.equal(joined(drawing, 0, 1), null); // the crank would meet itself
});

test("a link that is removed leaves the ends of the others", () => {
  const drawing = driven(fourBar(), 0);
  const rest = withoutLink(drawing, "2");
  assert.deepEqual(linksOf(rest), ["frame", "1", "3"]);
  assert.equal(jointsOf(rest).length, 2);
  assert.deepEqual(rest.drives, [0]);
  assert.deepEqual(withoutLink(drawing, "1").drives, []);
});

test("names", () => {
  const drawing = fourBar();
  assert.equal(renamed(drawing, "1", "3"), null);
  assert.equal(renamed(drawing, "1", "a b"), null);
  const named = renamed(drawing, "1", "Kurbel")!;
  assert.equal(jointName(named, 1), "R(Kurbel-2)");
  assert.equal(renamed(drawing, "frame", "Gestell")!.frame, "Gestell");
});

test("open ends are points", () => {
  const two = withLink(EMPTY, place(0, 0), place(10, 0));
  assert.deepEqual(documentOfDrawing(two, "mm").points, {
    K1: { link: "1", at: [0, 0] },
    K2: { link: "1", at: [10, 0] },
  });
});

test("the ground has the name of the language in which it is drawn", () => {
  setLanguage("de");
  const drawn = withGround(EMPTY, place(0, 0));
  setLanguage("en");
  assert.equal(drawn.frame, "Gestell");
  assert.equal(withGround(drawn, place(9, 0)).frame, "Gestell");
  assert.equal(fourBar().frame, "frame");
});
