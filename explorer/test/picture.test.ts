/** What the picture is made of, without a browser: hulls, the viewport, belts, the grid, plots, the slider. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { areaOf } from "../src/area";
import { TURN } from "../src/cycle";
import { gridStep } from "../src/grid";
import { clearAbout, convexHull, toHull } from "../src/hull";
import { Linkage } from "../src/linkage";
import { later } from "../src/player";
import { degreeValues, lineThrough, plotRange, roundValues, valueAt } from "../src/plot";
import { lapOf } from "../src/plots";
import type { Pair } from "../src/rows";
import { linesOf } from "../src/shapes";
import { Sizes } from "../src/sizes";
import { Span } from "../src/span";
import { evenly, numberPlaces, tip } from "../src/targets";
import { limitsOf, shownRange } from "../src/track";
import { Viewport } from "../src/viewport";
import { CRANK_ROCKER, fourBar } from "./fourbar";
import { close, near } from "./near";

const ROUND = new Linkage(fourBar(CRANK_ROCKER, 1)).cycle;
const RANGE = { ...ROUND, full: false, turns: 0, low: 1, high: 3 };

test("hulls and how far a point is from them", () => {
  const square = convexHull([
    [0, 0],
    [4, 0],
    [4, 4],
    [0, 4],
    [1, 2],
    [4, 4],
  ]);
  assert.equal(square.length, 4);
  assert.equal(toHull(square, 2, 3), 0);
  close(toHull(square, 7, 8), 5);
  close(toHull(square, 2, -3), 3);
  const bar = convexHull([
    [0, 0],
    [10, 0],
  ]);
  close(toHull(bar, 5, 2), 2);
  close(toHull(convexHull([[3, 4]]), 0, 0), 5);
});

test("places and pixels", () => {
  const viewport = new Viewport();
  viewport.width = 1000;
  viewport.height = 620;
  viewport.fit({ left: -10, right: 10, bottom: -5, top: 5 }, 1);
  close(viewport.scale, 44); // (1000 - 120) / 20; upright it would be 50
  near(viewport.screen(0, 0), [500, 310]);
  viewport.fit({ left: -10, right: 10, bottom: -5, top: 5 }, 1, undefined, [[10, 5]]);
  close(viewport.scale, 41.2); // beside the buttons
  viewport.fit({ left: -10, right: 10, bottom: -5, top: 5 }, 1);
  near(viewport.screen(10, 5), [940, 90]);
  near(viewport.world(...viewport.screen(3, -2)), [3, -2]);
  viewport.zoom(2, 940, 90);
  near(viewport.screen(10, 5), [940, 90]);
  close(viewport.scale, 88);
  assert.equal(viewport.fitted, false);
  viewport.pan(5, -7);
  near(viewport.screen(10, 5), [945, 83]);
});

test("lines of the grid are 1, 2 or 5 times a power of ten apart", () => {
  near([0.9, 1, 1.1, 3, 7, 12, 0.03].map(gridStep), [1, 1, 2, 5, 10, 20, 0.05]);
});

test("a belt goes with the centres of its wheels", () => {
  const model = fourBar(CRANK_ROCKER, 1);
  const belt = {
    link: 0,
    style: "belt",
    lines: [[0, 5, 70, 5]],
    between: [0, 0, 70, 0] as [number, number, number, number],
  };
  const sizes = new Sizes(model, 70);
  near(linesOf(sizes, belt)[0]!, [0, 5, 70, 5]);
  sizes.put(6, 0, 140); // a quarter turn, twice as long
  near(linesOf(sizes, belt)[0]!, [-10, 0, -10, 140]);
});

test("lines on links", () => {
  const model = fourBar(CRANK_ROCKER, 1);
  model.elements[1]!.angle = Math.PI / 4;
  const sizes = new Sizes(model, 70);
  close(sizes.leftOf(1, 0, 1), Math.SQRT1_2);
  close(sizes.leftOf(1, 1, 0), -Math.SQRT1_2);
  sizes.shiftLine(1, 2, 0);
  near(sizes.xy(1), [1, -1]);
  close(sizes.gap(0, 6), 70);
});

test("a plot shows all values, but not how rates grow without bound", () => {
  assert.deepEqual(plotRange(Float64Array.of(2, NaN, 5, 3)), { low: 2, high: 5 });
  assert.deepEqual(plotRange(Float64Array.of(4, 4, 4)), { low: 3, high: 5 });
  assert.deepEqual(plotRange(new Float64Array(0)), { low: 0, high: 1 });
  // 1 / x from 0.001 to 1, with more places next to 0: 1 / 0.95 to 1 / 0.05 but for five hundredths at either end
  const places = Float64Array.from({ length: 201 }, (_, k) => 0.001 ** (1 - k / 200));
  const pole = plotRange(
    places.map((x) => 1 / x),
    0,
    places,
  );
  close(pole.low, 1);
  assert.ok(Math.abs(pole.high - (1.5 / 0.05 - 0.5 / 0.95)) < 0.15 * pole.high);
  const deep = plotRange(
    places.map((x) => -1 / x),
    0,
    places,
  ); // the same downwards
  near([deep.low, deep.high], [-pole.high, -1]);
  const whole = plotRange(
    places.map((x) => 1 / x),
    0,
    places,
    0,
  ); // over time
  near([whole.low, whole.high], [1, 1000]);
  // a pulse that lasts longer is shown whole
  assert.deepEqual(plotRange(Float64Array.from({ length: 100 }, (_, k) => Number(k > 90))), { low: 0, high: 1 });
  const rounding = plotRange(Float64Array.of(4e-12, -3e-12, 0), 1e-9);
  near([rounding.low, rounding.high], [-1, 1]); // not a curve of its own
  assert.ok(plotRange(Float64Array.of(1, 1 - 4e-6, 1 + 4e-6)).low < 0.1); // what four digits read as one value
});

test("a line leaves out what is nearly straight, keeps corners and gaps", () => {
  const x = Float64Array.from({ length: 41 }, (_, k) => k);
  assert.equal(lineThrough(x, x), `M0 0${Array.from({ length: 10 }, (_, k) => `L${4 * k + 4} ${4 * k + 4}`).join("")}`);
  const bent = x.map((value) => (value === 22 ? 9 : 0));
  assert.ok(/L20 0L21 0L22 9L23 0L24 0/.test(lineThrough(x, bent)));
  const gap = x.map((value) => (value === 22 ? NaN : 0));
  assert.ok(/L20 0L21 0M23 0L24 0/.test(lineThrough(x, gap)));
  const saw = x.map((one) => (one * 5) % 60); // begins anew at 12, 24, 36
  assert.equal(lineThrough(x, saw).match(/M/g)!.length, 1);
  assert.deepEqual(lineThrough(x, saw, 30).match(/M[\d. ]+/g), ["M0 0", "M12 0", "M24 0", "M36 0"]);
  const wave = x.map((value) => 50 * Math.sin(value / 20)); // as a plot: 0.125 pixels at its top from point to point
  const kept = [...lineThrough(x, wave).matchAll(/[ML]([\d.]+) (-?[\d.]+)/g)].map(([, u, v]) => [Number(u), Number(v)]);
  for (const value of x) {
    const after = Math.max(
      1,
      kept.findIndex(([at]) => at! >= value),
    );
    const [[u, v], [p, q]] = [kept[after - 1], kept[after]] as [[number, number], [number, number]];
    close(v + ((q - v) * (value - u)) / (p - u), 50 * Math.sin(value / 20), 0.25); // 0.05 more by rounding
  }
});

test("full turns are plotted from 0 to 360 degrees", () => {
  const { drives, rows } = lapOf(ROUND);
  assert.equal(rows.length, ROUND.values.length);
  for (let k = 1; k < drives.length; k++) assert.ok(drives[k]! > drives[k - 1]!);
  assert.ok(drives[0]! >= 0 && drives[0]! < TURN / 360);
  close(drives[drives.length - 1]! - drives[0]!, TURN);
  assert.deepEqual(lapOf(RANGE).rows, [...RANGE.values.keys()]);
});

test("the slider", () => {
  near(limitsOf(ROUND), [0, TURN]);
  near(limitsOf(RANGE), [1, 3], 1e-6);
  near(shownRange([0, TURN], true), [0, TURN]);
  near(shownRange([1, 3], false), [0.76, 3.24]);
});

test("a drive goes on: full turns, or to and fro", () => {
  const near2 = ({ value, way }: { value: number; way: number }, wanted: [number, number]) =>
    near([value, way], wanted);
  near2(later(1, 1, 0.5, 12, ROUND, [0, TURN]), [1 + 0.1 * TURN, 1]); // 12 turns a minute
  near2(later(1, 1, 0.5, 12, RANGE, [1, 3]), [1.4, 1]); // a stroke is a half of to and fro
  near2(later(2.9, 1, 0.5, 12, RANGE, [1, 3]), [3, -1]);
  near2(later(1.1, -1, 0.5, 12, RANGE, [1, 3]), [1, 1]);
});

test("round values at an axis, and the value between two rows", () => {
  near(roundValues(-0.9, 0.65, 3), [-0.5, 0, 0.5]);
  near(roundValues(63.2, 143, 3), [80, 100, 120, 140]);
  near(roundValues(0, 1, 3), [0, 0.5, 1]);
  near(roundValues(240.00001, 329.99999, 4), [240, 260, 280, 300, 320]); // a range ends just before its stops
  near(degreeValues(-20, 380, 3), [0, 90, 180, 270, 360]);
  near(degreeValues(63, 92, 3), [70, 80, 90]); // quarters of a turn would be too few
  const [places, values] = [Float64Array.of(0, 1, 3), Float64Array.of(4, 6, 0)];
  close(valueAt(places, values, 0.5), 5);
  close(valueAt(places, values, 2), 3);
  close(valueAt(places, values, 3), 0);
  close(valueAt(places, values, 9), 0);
  close(valueAt(places, values, -1), 4);
  close(valueAt(Float64Array.of(0, 1), Float64Array.of(350, 30), 0.5, 360), 10);
  close(valueAt(Float64Array.of(0, 1), Float64Array.of(20, 340), 0.75, 360), 350);
});

test("a part of a range is enlarged about a place, shifted within the range, and whole again", () => {
  let changes = 0;
  const span = new Span(() => changes++);
  assert.ok(span.whole);
  span.zoom(4, 0.75); // three quarters of the plot stay where they are: 270 of 360
  near(span.of([0, 360]), [270 - 0.75 * 90, 270 + 0.25 * 90]);
  span.pan(1);
  near(span.of([0, 360]), [270, 360]); // no farther than its end
  span.zoom(1e9, 0);
  near(span.of([0, 360]), [270, 282]); // a thirtieth
  span.zoom(0, 0.2);
  assert.deepEqual([span.of([10, 20]), span.whole, changes], [[10, 20], true, 4]);
});

test("a curve that is drawn gives points evenly along it", () => {
  const square = [
    [0, 0],
    [10, 0],
    [10, 10],
    [0, 10],
    [0, 2],
  ]; // 38 long, its ends 2 apart
  const { closed, places } = evenly(square, 19);
  assert.ok(closed);
  assert.deepEqual(places.slice(0, 2), [
    [0, 0],
    [2, 0],
  ]);
  assert.deepEqual(places.at(-1), [0, 4]); // two before its end
  const open = evenly(square.slice(0, 3), 5);
  assert.ok(!open.closed);
  assert.deepEqual(open.places, [
    [0, 0],
    [5, 0],
    [10, 0],
    [10, 5],
    [10, 10],
  ]);
});

test("the number of a target stands beside its point, clear of the arrows of others", () => {
  const unit = 0.5;
  // behind the second the first one points at it, and the third one points at the first
  const rows = [
    [0, 0, 0],
    [14 * unit + 3, 0, 0],
    [-14 * unit - 3, 2, 0],
  ];
  const places = numberPlaces(rows, false, unit);
  places.forEach(([x, y], k) => {
    close(Math.hypot(x - rows[k]![0]!, y - rows[k]![1]!), 6 * unit);
    for (const row of rows) {
      const [u, v] = tip(row, unit) as [number, number];
      assert.ok(Math.hypot(x - u, y - v) > 5 * unit);
      const along = Math.min(Math.max(x, row[0]!), u);
      assert.ok(Math.hypot(x - along, y - v) > 5 * unit);
    }
  });
});

test("the number of a target keeps clear of the axes, of other targets and of their numbers", () => {
  const unit = 1;
  const rows = [
    [0, 0],
    [7, -7],
    [7, 7],
  ];
  const axes: Pair[][] = [
    [
      [-50, 0],
      [50, 0],
    ],
    [
      [0, -50],
      [0, 50],
    ],
  ];
  const places = numberPlaces(rows, false, unit, axes);
  places.forEach(([x, y], k) => {
    close(Math.hypot(x - rows[k]![0]!, y - rows[k]![1]!), 6);
    assert.ok(Math.min(Math.abs(x), Math.abs(y)) > 2);
    for (const [u, v] of [...rows, ...places].filter((_, other) => other % 3 !== k))
      assert.ok(Math.hypot(x - u!, y - v!) > 5);
  });
});

test("beside a joint of a bar and a plate its letter keeps clear of both, further away if it has to", () => {
  const bar: Pair[] = [
    [0, 0],
    [0, -80],
  ];
  const plate = convexHull([
    [0, 0],
    [90, 0],
    [90, 90],
  ]);
  const [x, y] = clearAbout([0, 0], -20, [bar, plate]);
  close(Math.hypot(x, y), 20);
  assert.ok(toHull(bar, x, y) > 18 && toHull(plate, x, y) > 18);
  // eight bars leave no room near their joint: 20 sin 22.5° = 7.7
  const star = Array.from({ length: 8 }, (_, k): Pair[] => [
    [0, 0],
    [80 * Math.cos((k * Math.PI) / 4), 80 * Math.sin((k * Math.PI) / 4)],
  ]);
  close(Math.hypot(...clearAbout([0, 0], -20, star, 4)), 44, 4);
});

test("a plane without a width of its own is as large as its places and their numbers", () => {
  Object.assign(globalThis, { window: { innerHeight: 1000 } });
  const places = [
    [1000, 0],
    [1200, 50],
  ];
  const { left, right, bottom, top, unit } = areaOf(-Infinity, 0.6, places, { clientWidth: 890 } as Element);
  // 45 pixels at each side of 800 for 200 mm; as high as 600 pixels are
  near([left, right], [1000 - 11.25, 1200 + 11.25]);
  near([(bottom + top) / 2, (top - bottom) / (right - left)], [25, 600 / 890]);
  close(unit, 3.2 / 4);
});
