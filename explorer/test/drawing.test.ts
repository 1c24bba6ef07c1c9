/** Mechanisms that are drawn: the count of print, names, what joining, splitting and removing leaves. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { gripAt, gripped, gripsOf } from "../src/backdrop";
import {
  counted,
  type Drawing,
  documentOfDrawing,
  driven,
  EMPTY,
  joined,
  joining,
  jointName,
  jointsOf,
  knotName,
  linksOf,
  moved,
  renamed,
  type Spot,
  split,
  traced,
  withCylinder,
  withDyad,
  withGears,
  withGround,
  withLink,
  without,
  withoutLink,
  withoutLoose,
  withSlider,
} from "../src/drawing";
import { setLanguage } from "../src/language";
import { guidelines, snapped } from "../src/snapping";
import { Viewport } from "../src/viewport";
import { near } from "./near";
import "./words";

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
  const held = withDyad(drawing, on("2", 30, 60), on("3", 65, 20), on("frame", 120, 0));
  assert.equal(counted(held), -1); // 3(6 - 1) - 2·8: its middle is pinned to the link that it lies on, too
});

test("a link joins spots on it, and one that is not on the frame gets a point", () => {
  const drawing = fourBar();
  assert.equal(joining(drawing, knot(drawing, 0), knot(drawing, 1)), "1");
  assert.equal(joining(drawing, on("2", 30, 30), knot(drawing, 2)), "2");
  assert.equal(joining(drawing, on("1", 0, 10), on("3", 65, 20)), undefined);
  assert.equal(joining(drawing, place(5, 5), place(9, 9)), undefined);
  const made = traced(drawing);
  assert.deepEqual(made.knots.at(-1)!.links, ["2"]); // the coupler, from (0, 20) to (60, 40)
  near(made.knots.at(-1)!.at, [30, 30], 1e-12); // on the bar, which stays one
  assert.equal(traced(made), made); // it has one
  const six = withDyad(drawing, on("2", 30, 30), place(30, 90), on("frame", 120, 0));
  near(traced(six).knots.at(-1)!.at, [15, 25], 1e-12); // a joint is in the middle of the coupler
  assert.equal(traced(EMPTY), EMPTY);
});

test("joints are called by letters, ends by their own names", () => {
  const drawing = {
    ...EMPTY,
    knots: Array.from({ length: 60 }, (_, k) => ({ at: [k, 0] as [number, number], links: ["1"] })),
  };
  const named = { ...drawing, knots: [{ ...drawing.knots[0]!, name: "tip" }, ...drawing.knots.slice(1)] };
  const names = [0, 1, 25, 26, 53].map((k) => knotName(named, k));
  assert.deepEqual(names, ["tip", "A", "Y", "Z", "A2"]);
  const knots = ["D", "A"].map((name, k) => ({ ...drawing.knots[k]!, name }));
  const more = { ...drawing, knots: [...knots, ...drawing.knots.slice(2, 5)] };
  assert.deepEqual(
    [0, 1, 2, 3, 4].map((k) => knotName(more, k)),
    ["D", "A", "B", "C", "E"],
  );
});

test("a slider-crank", () => {
  const one = withGround(EMPTY, place(0, 0));
  const two = withLink(one, knot(one, 0), place(0, 20));
  const three = withLink(two, knot(two, 1), place(70, 0));
  const whole = driven(withSlider(three, knot(three, 2)), 0);
  assert.equal(counted(whole), 1);
  const document = documentOfDrawing(whole);
  assert.equal(document.joints, "R(frame-1) R(1-2) R(2-3) P(frame-3)");
  assert.deepEqual(document.places, {
    "R(frame-1)": [0, 0],
    "R(1-2)": [0, 20],
    "R(2-3)": [70, 0],
    "P(frame-3)": [0, 0, 0], // counted from the pivot of the crank
  });
  const high = moved(whole, 2, [80, 5]);
  assert.deepEqual((documentOfDrawing(high).places as Record<string, unknown>)["P(frame-3)"], [0, 5, 0]);
  assert.deepEqual(document.drives, ["R(frame-1)"]);
  const away = moved(whole, 2, [80, 5]); // the block goes with its pin
  assert.deepEqual(away.knots[3]!.at, [80, 5]);
});

test("a driven joint of three links moves the first one beside the frame", () => {
  const drawing = fourBar();
  const third = driven(withLink(drawing, knot(drawing, 0), place(-50, 50)), 0);
  const [name] = documentOfDrawing(third).drives as string[];
  assert.equal(name, "R(frame-1-4):frame-1");
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

test("links are in the order of their numbers, whichever joint was there first", () => {
  const grounds = withGround(withGround(EMPTY, place(0, 0)), place(70, 0));
  const crank = withLink(grounds, knot(grounds, 0), place(0, 20));
  const drawing = withDyad(crank, knot(crank, 2), place(60, 40), knot(crank, 1));
  assert.deepEqual(
    jointsOf(drawing).map((k) => jointName(drawing, k)),
    ["R(frame-1)", "R(frame-3)", "R(1-2)", "R(2-3)"],
  );
  assert.deepEqual(linksOf(drawing), ["frame", "1", "2", "3"]);
});

test("a link that is removed leaves the ends of the others", () => {
  const drawing = driven(fourBar(), 0);
  const rest = withoutLink(drawing, "2");
  assert.deepEqual(linksOf(rest), ["frame", "1", "3"]);
  assert.equal(jointsOf(rest).length, 2);
  assert.deepEqual(rest.drives, [0]);
  assert.deepEqual(withoutLink(drawing, "1").drives, []);
});

test("links that lose all joints but one go with the joint, and letters stay", () => {
  const four = fourBar();
  const drawing = withDyad(four, on("2", 30, 60), place(90, 90), on("frame", 120, 0)); // E, F, G
  const left = (number: number) => {
    const rest = withoutLoose(drawing, without(drawing, number));
    return rest.knots.map(({ links }, k) => `${knotName(rest, k)} ${links.join("-")}`).sort();
  };
  assert.deepEqual(left(5), ["A frame-1", "B 1-2", "C 2-3", "D frame-3", "E 2", "G frame"]);
  // the coupler is held by B and E yet; the rocker by D alone
  assert.deepEqual(left(2), ["A frame-1", "B 1-2", "D frame", "E 2-4", "F 4-5", "G frame-5"]);
  const more = withLink(four, knot(four, 1), place(9, 90));
  const rest = withoutLoose(more, without(more, more.knots.length - 1)); // a bar without its end
  assert.deepEqual(linksOf(rest), linksOf(four));
});

test("wheels go with their mesh, one that meshes twice stays", () => {
  const pair = withGears(EMPTY, place(0, 0), place(60, 0), [20, 0])!;
  const mesh = pair.knots.findIndex(({ part }) => part !== undefined);
  assert.deepEqual(linksOf(withoutLoose(pair, without(pair, mesh))), ["frame"]);
  const three = withGears(pair, knot(pair, 1), place(120, 0), [90, 0])!;
  assert.deepEqual(linksOf(withoutLoose(three, without(three, mesh))), ["frame", "2", "3"]);
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
  assert.deepEqual(documentOfDrawing(two).points, {
    A: { link: "1", at: [0, 0] },
    B: { link: "1", at: [10, 0] },
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

test("a cylinder pushes a lever: four links, F = 1", () => {
  const lever = withLink(withGround(EMPTY, place(0, 0)), { at: [0, 0], knot: 0, link: null }, place(10, 40));
  const base = withGround(lever, place(60, 0));
  const drawing = withCylinder(base, knot(base, 2), knot(base, 1));
  assert.equal(counted(drawing), 1); // 3(4 - 1) - 2 * 4
  const { joints, places } = documentOfDrawing(driven(drawing, 3)) as { joints: string; places: object };
  assert.equal(joints, "R(frame-1) R(1-3) R(frame-2) P(2-3)");
  near((places as Record<string, number[]>)["P(2-3)"]!, [60, 0, (Math.atan2(40, -50) * 180) / Math.PI]);
  const other = moved(drawing, 1, [20, 50]); // its end goes along
  near(other.knots[3]!.between!.flat(), [60, 0, 20, 50]);
  near(other.knots[3]!.at, [40, 25]);
  assert.equal(counted(withoutLink(drawing, "2")), 2); // an open chain of the lever and what was its rod: 6 - 4
});

test("gears touch where they are put: 20 and 40 of 60", () => {
  const drawing = withGears(EMPTY, place(0, 0), place(60, 0), [22, 7])!;
  assert.equal(counted(drawing), 1); // 3(3 - 1) - 2 * 2 - 1
  const wheels = (one: Drawing) => (documentOfDrawing(one).places as Record<string, unknown>)["G(1-2)"];
  const touching = moved(drawing, jointsOf(drawing).at(-1)!, [20, -3]);
  assert.deepEqual(wheels(touching), { "1": { at: [0, 0], radius: 20 }, "2": { at: [60, 0], radius: 40 } });
  const wider = moved(touching, 1, [90, 0]); // the ratio stays
  assert.deepEqual(wheels(wider), { "1": { at: [0, 0], radius: 30 }, "2": { at: [90, 0], radius: 60 } });
  assert.equal(withGears(drawing, knot(drawing, 0), knot(drawing, 0), [1, 0]), null);
  const ring = moved(touching, jointsOf(drawing).at(-1)!, [90, 4]); // beyond the second centre: 90 about 30
  assert.deepEqual(wheels(ring), { "1": { at: [0, 0], radius: -90 }, "2": { at: [60, 0], radius: 30 } });
  const other = moved(touching, jointsOf(drawing).at(-1)!, [-30, 4]);
  assert.deepEqual(wheels(other), { "1": { at: [0, 0], radius: 30 }, "2": { at: [60, 0], radius: -90 } });
});

test("a picture is moved, sized about its middle and turned by its grips", () => {
  const picture = { href: "data:,", high: 0.5, at: [10, 20, 40, 90] }; // 40 wide, upright: its right side is above
  near(gripsOf(picture).turn, [10, 40]);
  near(gripsOf(picture).size, [20, 40]); // its lower right corner
  assert.equal(gripAt(picture, [20, 41], 3), "size");
  assert.equal(gripAt(picture, [10, 38], 3), "turn");
  assert.equal(gripAt(picture, [19, 5], 3), "move");
  assert.equal(gripAt(picture, [24, 20], 3), null); // 14 beside the middle, 10 is the edge
  near(gripped(picture, "move", [0, 0], [3, -4]).at as number[], [13, 16, 40, 90]);
  near(gripped(picture, "size", [20, 40], [30, 60]).at as number[], [10, 20, 80, 90]);
  near(gripped(picture, "turn", [10, 40], [50, 20.1]).at as number[], [10, 20, 40, 0]);
});

test("a place snaps to what is in line, to round angles and known lengths, else to the grid", () => {
  const around = {
    places: [
      [0, 0],
      [31, 17],
    ] as [number, number][],
    from: [],
    lengths: [],
  };
  const viewport = Object.assign(new Viewport(), { width: 900 });
  viewport.scale = 3.5; // lines of the grid every 20, a quarter of that to stop at; seven pixels are 2
  assert.deepEqual(snapped([29.5, 43], viewport, around), [31, 45]);
  assert.deepEqual(snapped([11.5, 43], viewport, around), [10, 45]);
  const linked = { places: [], from: [[0, 0]] as [number, number][], lengths: [40] };
  near(snapped([28, 29], viewport, linked), [40 * Math.SQRT1_2, 40 * Math.SQRT1_2]); // 45 degrees, 40 long
  near(snapped([3, 33], viewport, linked), [5, 35]); // 85 degrees, 33 long: neither
  const level = { ...linked, places: linked.from, lengths: [69.6] };
  assert.deepEqual(snapped([69.7, 0.6], viewport, level), [70, 0]); // not 69.6 long and a little off the axis
  near(snapped([67.8, 0.6], viewport, { ...level, lengths: [67.3] }), [67.3, 0]); // between two places of the grid
  viewport.scale = 1; // a place of the grid every 20
  const rocker = { places: [[0, 0]], from: [[60, 40]], lengths: [40] } as typeof linked;
  // level before 40 long at 75 degrees, which is (70.35, 1.36): where both lines meet
  near(snapped([70, 0.2], viewport, rocker), [60 + 40 * Math.tan(Math.PI / 12), 0]);
  viewport.scale = 3.5;
  const between = {
    ...linked,
    from: [
      [0, 0],
      [80, 0],
    ] as [number, number][],
  };
  near(snapped([79.4, 42.4], viewport, { ...between, lengths: [42] }), [80, 42]); // of both the nearer: upright
  assert.deepEqual(guidelines([31, 0], around.places), [
    [
      [31, 17],
      [31, 0],
    ],
    [
      [0, 0],
      [31, 0],
    ],
  ]);
});
