/** A four-bar that moves, against triangles. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { denseAtEnds, principal, TURN, wrapped } from "../src/cycle";
import { documentOf } from "../src/document";
import type { Rows } from "../src/kernel";
import { Linkage } from "../src/linkage";
import { OtherModes } from "../src/modes";
import { place, rate } from "../src/rows";
import { A, angleBetween, angles, B, C, COUPLER, CRANK_ROCKER, D, fourBar, ROCKER } from "./fourbar";
import { close, near } from "./near";

/** Its drive cannot go round: the sum of the shortest and the longest link is more than that of the others. */
const DOUBLE_ROCKER = { crank: 50, coupler: 60, rocker: 70, frame: 100 };

test("joints lie where the triangle has them", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  for (const theta of [1, 2.5, 4, 6.1]) {
    assert.ok(linkage.moveTo(theta));
    const { phi, psi } = angles(CRANK_ROCKER, theta);
    const [x, y] = [25 * Math.cos(theta), 25 * Math.sin(theta)];
    near(linkage.jointAt(A), [0, 0]);
    near(linkage.jointAt(B), [x, y]);
    near(linkage.jointAt(C), [70 + 40 * Math.cos(psi), 40 * Math.sin(psi)]);
    near(linkage.jointAt(D), [70, 0]);
    near(place(linkage.pose, 0, COUPLER, 35, 0), [x + 35 * Math.cos(phi), y + 35 * Math.sin(phi)]);
  }
});

test("velocities are those of the loop of vectors", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  for (const theta of [0.3, 1.7, 3.3, 5]) {
    assert.ok(linkage.moveTo(theta));
    const { phi, psi } = angles(CRANK_ROCKER, theta);
    // a sin(theta - phi) = c psi' sin(psi - phi), a sin(theta - psi) = -b phi' sin(phi - psi)
    close(rate(linkage.pose, 0, ROCKER), (25 * Math.sin(theta - phi)) / (40 * Math.sin(psi - phi)));
    close(rate(linkage.pose, 0, COUPLER), -(25 * Math.sin(theta - psi)) / (70 * Math.sin(phi - psi)));
    near(place(linkage.pose, 0, 1, 25, 0, 1), [-25 * Math.sin(theta), 25 * Math.cos(theta)]);
    near(place(linkage.pose, 0, 1, 25, 0, 2), [-25 * Math.cos(theta), -25 * Math.sin(theta)]);
  }
});

test("a crank goes round", () => {
  const { cycle } = new Linkage(fourBar(CRANK_ROCKER, 1));
  assert.equal(cycle.full, true);
  assert.equal(cycle.turns, 1);
  near([cycle.low, cycle.high], [1, 1 + TURN]);
  assert.deepEqual(cycle.stops, [null, null]);
});

test("the range of a rocker ends where coupler and other rocker are in line", () => {
  const { cycle } = new Linkage(fourBar(DOUBLE_ROCKER, 1));
  const most = angleBetween(50, 100, 60 + 70);
  assert.equal(cycle.full, false);
  near([cycle.low, cycle.high], [-most, most], 1e-7);
  for (const stop of cycle.stops) {
    assert.equal(stop?.form, "RRR");
    assert.deepEqual(stop?.links, ["coupler", "rocker"]);
  }
  // a machine that is used in a part of it has measures and plots of that part, said here a turn farther on
  const used = fourBar(DOUBLE_ROCKER, 1);
  used.span.between = [0.5 + TURN, 1.2 + TURN];
  const part = new Linkage(used).cycle;
  near([part.low, part.high], [0.5, 1.2]);
  assert.deepEqual(part.stops, [null, null]);
  assert.ok(part.values.every((value) => value > 0.5 && value < 1.2));
});

test("a drive that goes round comes back, one that does not stays in its range", () => {
  const round = new Linkage(fourBar(CRANK_ROCKER, 1));
  assert.ok(round.moveTo(1.5 + 2 * TURN));
  close(round.drives[0]!, 1.5);
  const rocker = new Linkage(fourBar(DOUBLE_ROCKER, 1));
  assert.equal(rocker.moveTo(2.5), false);
  close(rocker.drives[0]!, 1);
});

test("the other assembly mode is the mirror image at the line from B to D", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, Math.PI / 2));
  const [x, y] = linkage.jointAt(C);
  linkage.switchMode(0);
  const [u, v] = linkage.jointAt(C);
  // the line from B (0, 25) to D (70, 0) has the normal (25, 70)
  close(25 * ((x + u) / 2) + 70 * ((y + v) / 2), 25 * 70, 1e-7);
  close(70 * (x - u) - 25 * (y - v), 0, 1e-7);
  assert.ok(Math.hypot(x - u, y - v) > 10);
  assert.equal(linkage.state.signs[0], -1);
});

test("other assembly modes follow in every second step of a drag, and at once where it rests", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const modes = new OtherModes();
  const step = (long: number) => linkage.change(() => linkage.sizes.put(2, long, 0));
  assert.deepEqual(modes.beside(linkage), []); // nothing is dragged
  linkage.drag(true);
  const seen = [31, 32, 33, 34, 35].map((long) => {
    step(long);
    return modes.beside(linkage)[0];
  });
  assert.equal(seen[0], undefined); // none stands there from the drag before
  assert.ok(seen[1] && seen[3] && seen[1] !== seen[3]);
  assert.equal(seen[2], seen[1]);
  assert.equal(seen[4], seen[3]);
  linkage.rest();
  const [rested] = modes.beside(linkage) as [Rows];
  // C lies as far from B as the coupler is long, and mirrored at the line from B to D, (70, 0)
  const [x, y] = linkage.jointAt(C, rested, 0);
  const [u, v] = linkage.jointAt(C, linkage.cycle.rows, 0);
  const [bx, by] = linkage.jointAt(B, rested, 0);
  close(Math.hypot(x - bx, y - by), Math.hypot(u - bx, v - by));
  close((x - u) * (70 - bx) - (y - v) * by, 0, 1e-7);
  assert.ok(Math.hypot(x - u, y - v) > 10);
  linkage.drag(false);
  assert.deepEqual(modes.beside(linkage), []);
});

test("a drag that moves has half as many rows, one that rests all of them", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  linkage.drag(true);
  linkage.change(() => linkage.sizes.put(2, 31, 0));
  const { rows, values } = linkage.cycle;
  assert.equal(values.length, 181);
  linkage.rest();
  assert.equal(linkage.cycle.values.length, 361);
  for (const row of [0, 60, 180]) near(linkage.jointAt(C, rows, row), linkage.jointAt(C, linkage.cycle.rows, 2 * row));
});

test("what was is restored", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, 1));
  const old = linkage.snapshot();
  const before = documentOf(linkage);
  linkage.sizes.put(2, 30, 0);
  linkage.addPoint(COUPLER, 1, 2);
  linkage.restore(old);
  assert.deepEqual(documentOf(linkage), before);
  assert.equal(linkage.sizes.points.length, 1);
});

test("a point is added where it is clicked", () => {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, Math.PI / 2));
  linkage.addPoint(1, 0, 10); // the crank stands upright
  near(linkage.sizes.points[1]!.at, [10, 0]);
});

test("angles and values of a range", () => {
  near([principal(0.1 + 3 * TURN), principal(-3.2)], [0.1, TURN - 3.2]);
  const values = denseAtEnds(2, 4, 3); // sines of 15, 45 and 75 degrees, squared
  near(values, [2 + (2 - Math.sqrt(3)) / 2, 3, 2 + (2 + Math.sqrt(3)) / 2]);
  const { cycle } = new Linkage(fourBar(CRANK_ROCKER, 1));
  near([wrapped(cycle, 7), wrapped(cycle, -1), wrapped(cycle, TURN - 1e-9)], [7 - TURN, TURN - 1, 0]);
  assert.equal(wrapped({ ...cycle, full: false }, 7), 7);
});
