/** Dead centres, transmission angles and poles of a four-bar, against the law of cosines. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { TURN, wrapped } from "../src/cycle";
import { factsOf } from "../src/facts";
import { Linkage } from "../src/linkage";
import {
  deadCentres,
  leastTransmission,
  output,
  outputAlong,
  outputStandsStill,
  pole,
  transmission,
  unwrapped,
  zero,
} from "../src/measures";
import { readingsOf } from "../src/rulers";
import { A, angleBetween, angles, B, C, COUPLER, CRANK, CRANK_ROCKER, D, fourBar, sliderCrank } from "./fourbar";
import { close, near } from "./near";

/** A value and its two derivatives. */
type Three = [number, number, number];

test("dead centres are where crank and coupler are in line", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const stretched = angleBetween(70, 70 + 25, 40);
  const folded = Math.PI + angleBetween(70, 70 - 25, 40);
  const found = deadCentres(linkage)
    .map(({ value, output: psi }) => ({ value: wrapped(linkage.cycle, value), psi }))
    .sort((a, b) => a.value - b.value);
  near(
    found.map(({ value }) => value),
    [stretched, folded],
    1e-8,
  );
  near(
    found.map(({ psi }) => psi),
    [Math.PI - angleBetween(70, 40, 95), Math.PI - angleBetween(70, 40, 45)],
    1e-8,
  );
});

test("the transmission angle is that between coupler and rocker", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  for (const theta of [0.5, 2, 3.5, 5]) {
    assert.ok(linkage.moveTo(theta));
    const diagonal = Math.hypot(70 - 25 * Math.cos(theta), 25 * Math.sin(theta));
    const mu = angleBetween(70, 40, diagonal);
    close(transmission(linkage, linkage.pose, 0), Math.min(mu, Math.PI - mu));
  }
});

test("it is smallest where the crank lies along the frame", () => {
  const least = leastTransmission(new Linkage(fourBar(CRANK_ROCKER, 1)))!;
  close(least.mu, angleBetween(70, 40, 70 - 25), 1e-9);
  close(Math.sin(least.value), 0, 1e-5);
  assert.ok(Math.cos(least.value) > 0);
});

test("at the ends of a range it goes to zero", () => {
  const linkage = new Linkage(fourBar({ crank: 50, coupler: 60, rocker: 70, frame: 100 }, 1));
  const least = leastTransmission(linkage)!;
  close(least.mu, 0, 1e-6);
  close(Math.abs(least.value), angleBetween(50, 100, 130), 1e-6);
});

test("the output is the angle of the rocker, with its derivatives", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const at = (theta: number) => angles(CRANK_ROCKER, theta).psi;
  const step = 1e-4;
  for (const theta of [0.4, 2.2, 4.4]) {
    assert.ok(linkage.moveTo(theta));
    const [psi, first, second] = [0, 1, 2].map((order) => output(linkage, linkage.pose, 0, order)) as Three;
    close(psi, at(theta));
    close(first, (at(theta + step) - at(theta - step)) / (2 * step), 1e-7);
    close(second, (at(theta + step) - 2 * at(theta) + at(theta - step)) / step ** 2, 1e-6);
  }
});

test("the coupler of a parallelogram moves without turning, its crank turns", () => {
  const model = fourBar({ crank: 25, coupler: 70, rocker: 25, frame: 70 }, 1);
  for (const [link, still] of [
    [COUPLER, true],
    [CRANK, false],
  ] as const) {
    model.outputs[0]!.link = link;
    const linkage = new Linkage(model);
    const rows = Array.from({ length: linkage.cycle.values.length }, (_, row) => row);
    assert.equal(outputStandsStill(linkage, outputAlong(linkage, rows)), still);
  }
});

test("an output has no jumps, and its lap is that of the pose", () => {
  near(unwrapped(Float64Array.of(3, -3, 3, -3), 0), [3, TURN - 3, 3, TURN - 3]);
  near(unwrapped(Float64Array.of(3, -3, -2), 1), [3 - TURN, -3, -2]);
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const rows = [...linkage.cycle.values.keys()];
  const values = outputAlong(linkage, rows);
  close(values[0]!, angles(CRANK_ROCKER, 1).psi);
  for (const row of rows.slice(1)) assert.ok(Math.abs(values[row]! - values[row - 1]!) < 0.1);
});

test("the pole of the coupler is where crank and rocker meet, that of the crank is its joint", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const { x, y } = pole(linkage, linkage.pose, 0, COUPLER)!;
  const onLine = (one: number, other: number) => {
    const [ax, ay] = linkage.jointAt(one);
    const [bx, by] = linkage.jointAt(other);
    return ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / Math.hypot(bx - ax, by - ay);
  };
  near([onLine(A, B), onLine(D, C)], [0, 0], 1e-8);
  const fixed = pole(linkage, linkage.pose, 0, CRANK)!;
  near([fixed.x, fixed.y, fixed.dx, fixed.dy], [0, 0, 0, 0]);
  assert.equal(pole(linkage, linkage.pose, 0, 0), null); // the frame does not turn
});

test("a point of the inflection circle goes straight on", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const { x, y, dx, dy } = pole(linkage, linkage.pose, 0, COUPLER)!;
  const [bx, by] = linkage.jointAt(B);
  const { phi } = angles(CRANK_ROCKER, 1);
  // the point opposite to the pole, on the coupler
  const [gx, gy] = [x + dx - bx, y + dy - by];
  const [u, v] = [gx * Math.cos(phi) + gy * Math.sin(phi), gy * Math.cos(phi) - gx * Math.sin(phi)];
  const at = (theta: number) => {
    const angle = angles(CRANK_ROCKER, theta).phi;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    return [25 * Math.cos(theta) + c * u - s * v, 25 * Math.sin(theta) + s * u + c * v] as const;
  };
  const step = 1e-3;
  const [before, here, after] = [at(1 - step), at(1), at(1 + step)];
  const [vx, vy] = [(after[0] - before[0]) / (2 * step), (after[1] - before[1]) / (2 * step)];
  const ax = (after[0] - 2 * here[0] + before[0]) / step ** 2;
  const ay = (after[1] - 2 * here[1] + before[1]) / step ** 2;
  assert.ok(Math.hypot(dx, dy) > 10);
  close((vx * ay - vy * ax) / (vx * vx + vy * vy), 0, 1e-3);
});

test("a slider-crank: way, velocity, acceleration, transmission angle, dead centres", () => {
  const [crank, rod, line] = [30, 100, 0.3];
  const linkage = new Linkage(sliderCrank(crank, rod, line, 1));
  const at = (theta: number) => {
    const beta = theta - line;
    return crank * Math.cos(beta) + Math.sqrt(rod ** 2 - (crank * Math.sin(beta)) ** 2);
  };
  const step = 1e-4;
  for (const theta of [0.5, 2, 3.6, 5.5]) {
    assert.ok(linkage.moveTo(theta));
    const [way, first, second] = [0, 1, 2].map((order) => output(linkage, linkage.pose, 0, order)) as Three;
    close(way, at(theta));
    close(first, (at(theta + step) - at(theta - step)) / (2 * step), 1e-6);
    close(second, (at(theta + step) - 2 * at(theta) + at(theta - step)) / step ** 2, 1e-4);
    const lean = Math.asin((crank * Math.abs(Math.sin(theta - line))) / rod);
    close(transmission(linkage, linkage.pose, 0), Math.PI / 2 - lean);
  }
  const dead = deadCentres(linkage).map(({ value, output: way }) => [wrapped(linkage.cycle, value), way] as const);
  dead.sort(([one], [other]) => one - other);
  near(dead.flat(), [line, rod + crank, line + Math.PI, rod - crank], 1e-6);
  close(leastTransmission(linkage)!.mu, Math.PI / 2 - Math.asin(crank / rod));
});

test("a cycle that begins where the output turns back has that dead centre once", () => {
  for (const theta of [0, Math.PI, 1e-12, -0.02, 0.02]) {
    const linkage = new Linkage(sliderCrank(25, 70, 0, theta));
    const dead = deadCentres(linkage).map(({ value, output: way }) => [wrapped(linkage.cycle, value), way] as const);
    dead.sort(([one], [other]) => one - other);
    near(dead.flat(), [0, 95, Math.PI, 45], 1e-6);
  }
});

test("an output that is 0 but for rounding is told as 0", () => {
  for (const theta of [1.7, 2, 2.5, 3, 4, 4.5]) {
    const linkage = new Linkage(sliderCrank(70, 70, 0, theta)); // folded: its slider is on the pivot of the crank
    const [told] = factsOf(linkage, { dead: [], travel: null, least: null }, (angle) => angle);
    assert.ok(told!.text.startsWith("0 "), told!.text);
  }
});

test("zeros of functions", () => {
  close(zero((x) => x * x - 2, 0, 2)!, Math.SQRT2);
  assert.equal(
    zero((x) => x - 1, 0, 2),
    1,
  );
  assert.equal(
    zero((x) => (x > 0.4 && x < 0.6 ? NaN : x - 0.5), 0, 1),
    null,
  );
});

test("a measurement line is read off with the unit of the linkage, if it has one", () => {
  for (const [unit, text] of [
    ["mm", "70 mm, 0°"],
    ["", "70, 0°"],
  ] as const) {
    const linkage = new Linkage({ ...fourBar(CRANK_ROCKER, 1), unit });
    linkage.beside = {
      rulers: [
        ["R(frame-crank)", "R(frame-rocker)"],
        ["R(frame-crank)", "gone"],
      ],
    };
    assert.deepEqual(
      readingsOf(linkage).map((each) => each.text),
      [text],
    );
  }
});
