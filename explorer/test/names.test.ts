/** Where names of links stand: by hand, for triangles of whole numbers. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { convexHull, toHull } from "../src/hull";
import { clearSpot, halfOf, namePlace, nameSpots } from "../src/names";
import type { Pair } from "../src/rows";
import { apart } from "../src/space/bodynames";
import { Viewport } from "../src/viewport";

test("the name of a thin body stands beside its longest side, away from it", () => {
  const thin: Pair[] = [
    [0, 0],
    [50, 5],
    [100, 0],
  ];
  const below = namePlace(thin, [], "coupler", 1);
  assert.deepEqual([below.at, below.away, below.bar], [[[50, 0]], [0, -1], false]);
  const [[x, y]] = nameSpots(new Viewport(), below, "coupler") as [Pair]; // of a picture whose y grows downward
  assert.ok(x === 50 && y > 15);
});

test("a body with room has its name in its middle, but not if the picture is small", () => {
  const wide: Pair[] = [
    [0, 0],
    [300, 0],
    [150, 300],
  ];
  const { at, away } = namePlace(wide, [], "coupler", 1);
  assert.deepEqual([at[0], away], [[150, 100], null]);
  assert.ok(namePlace(wide, [], "coupler", 0.1).away);
});

test("a body with room has its name beside a bar that lies on its middle", () => {
  const viewport = new Viewport();
  const corners: Pair[] = [
    [0, 0],
    [300, 0],
    [150, 300],
  ];
  const spots = nameSpots(viewport, namePlace(corners, [], "coupler", 1), "coupler");
  const put = (places: Pair[]) => places.map((at) => viewport.screen(...at));
  const plate = convexHull(put(corners));
  const bar = put([
    [150, 20],
    [150, 180],
  ]);
  const [x, y] = spots[clearSpot(spots, "coupler", [plate, [bar]], () => true)]!;
  for (const side of [-1, 0, 1]) {
    const at: Pair = [x + side * halfOf("coupler"), y - 4];
    assert.ok(toHull(bar, ...at) > 6);
    assert.equal(toHull(plate, ...at), 0);
  }
});

test("a free point beside a bar leaves the name on the other side", () => {
  const bar: Pair[] = [
    [0, 0],
    [30, 0],
  ];
  assert.deepEqual(namePlace(bar, [[15, 40]], "coupler", 1).away, [0, -1]);
  assert.deepEqual(namePlace(bar, [[15, -40]], "coupler", 1).away, [0, 1]);
});

test("one place alone has its name above", () => {
  const pin: Pair[] = [
    [3, 4],
    [3, 4],
  ];
  assert.deepEqual(namePlace(pin, [], "block", 1), { at: [[3, 4]], away: [0, 1] });
});

test("between its rail and a force across it the name of a block stands in a corner", () => {
  const viewport = new Viewport();
  const [x, y] = viewport.screen(0, 0);
  const spots = nameSpots(viewport, { at: [[0, 0]], away: [0, 1] }, "slider");
  // the rail goes to both sides, the force up and down: neither is met by the letters
  const free = (at: Pair) => Math.abs(at[1] - 4 - y) > 12 && Math.abs(at[0] - x) > halfOf("slider");
  const block: Pair[] = [[x, y]];
  const [u, v] = spots[clearSpot(spots, "slider", [block, []], free)]!;
  assert.ok(free([u, v]));
  assert.ok(Math.hypot(u - x, v - 4 - y) < 22 + 2 * halfOf("slider"));
});

test("the name of a bar is nearer to it than to another, however sharp the angle between them", () => {
  const viewport = new Viewport();
  for (let degrees = -170; degrees <= 180; degrees += 5) {
    if (Math.abs(degrees) < 15) continue; // one covers the other
    const [bar, other] = [0, degrees].map((turn): Pair[] => {
      const phi = ((turn + 20) * Math.PI) / 180;
      return [viewport.screen(0, 0), viewport.screen(150 * Math.cos(phi), 150 * Math.sin(phi))];
    }) as [Pair[], Pair[]];
    const joints = bar.map((at) => viewport.world(...at));
    const spots = nameSpots(viewport, namePlace(joints, [], "coupler", 1), "coupler");
    const [x, y] = spots[clearSpot(spots, "coupler", [bar, [other]], () => true)]!;
    for (const side of [-1, 0, 1]) {
      const at: Pair = [x + side * halfOf("coupler"), y - 4];
      assert.ok(toHull(bar, ...at) < toHull(other, ...at), `${degrees} degrees`);
    }
  }
});

test("a name beside an edge of a picture in space stands within it, one that is far out nowhere", () => {
  const [text, size]: [string, Pair] = ["coupler", [400, 300]];
  const half = halfOf(text);
  const placed = (x: number) => apart([[{ text, at: [x, 100] }]], [], size).map(({ at }) => at);
  const [[left, top]] = placed(10) as [Pair];
  assert.ok(left > half && left < half + 20 && top === 100);
  assert.deepEqual(placed(200), [[200, 100]]);
  assert.deepEqual(placed(-2 * half), []);
});
