/** By what angle a link in space is turned, against its rotation matrix. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { FLAT, fitted, NATURAL, projection, seen, type Vector } from "../src/space/algebra";
import { Machine, turnOf } from "../src/space/machine";
import type { Model } from "../src/space/model";

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

test("what is fitted into a picture in space fills its free room, from edge to edge one way", () => {
  const broad: Vector[] = [
    [300, 0, 0],
    [-40, 10, 0],
    [0, 200, 30],
    [20, -20, 150],
  ];
  // along it the eye keeps away from what is nearest
  const slender: Vector[] = [
    [400, 30, 0],
    [400, -30, 20],
    [-400, 60, -20],
    [-400, -30, 0],
  ];
  const free = { left: 0.05, right: 0.2, top: 0.1, bottom: 0.15 }; // parts of the picture
  const room = [
    [-1 + 2 * free.left, 1 - 2 * free.right],
    [-1 + 2 * free.bottom, 1 - 2 * free.top],
  ];
  const looks = [
    [broad, 0.9, 0.5],
    [slender, 0.9, 0.5],
    [slender, 0, 0],
    [slender, Math.PI, 0],
    [slender, Math.PI / 2, 0],
  ] as const;
  const shapes = [0.8, 1.5].flatMap((wide) => [NATURAL, FLAT].map((opening) => [wide, opening] as const));
  for (const [wide, opening, [places, turn, lift]] of shapes.flatMap((one) =>
    looks.map((look) => [...one, look] as const),
  )) {
    const camera = { turn, lift, middle: [0, 0, 0] as Vector, distance: 1, opening };
    const view = projection(fitted(camera, wide, places, free), wide);
    const all = places.map((place) => seen(view, place));
    const ends = [0, 1].map((axis) => all.map((at) => at[axis]!)).map((at) => [Math.min(...at), Math.max(...at)]);
    const left = ends.map(([low, high], axis) => [low! - room[axis]![0]!, room[axis]![1]! - high!]);
    for (const [before, after] of left) {
      assert.ok(Math.abs(before! - after!) < 0.01, `in the middle: ${before} ${after}`);
      assert.ok(before! > -0.01);
    }
    if (places === broad) assert.ok(Math.min(...left.flat()) < 0.01, `it fills it: ${left}`);
  }
});

test("along an axis what is alike is seen alike, however far it is", () => {
  const camera = { turn: -Math.PI / 2, lift: 0, middle: [0, 0, 0] as Vector, distance: 1 };
  const places: Vector[] = [-100, 100].flatMap((y) => [-50, 50].map((x): Vector => [x, y, 0]));
  const free = { left: 0, right: 0, top: 0, bottom: 0 };
  const ratios = [FLAT, NATURAL].map((opening) => {
    const view = projection(fitted({ ...camera, opening }, 1, places, free), 1);
    const [a, b, c, d] = places.map((place) => seen(view, place)[0]) as [number, number, number, number];
    return (b - a) / (d - c);
  });
  assert.ok(ratios[0]! < 1.01 && ratios[1]! > 1.3, String(ratios));
});

test("poses between rows are those of the motion, at its ends, too", () => {
  const turned = (phi: number) => [
    Math.cos(phi),
    -Math.sin(phi),
    0,
    50 * phi,
    Math.sin(phi),
    Math.cos(phi),
    0,
    0,
    0,
    0,
    1,
    0,
  ];
  const rows = 72;
  const machine = (round: boolean, first: number, last: number) => {
    const values = Array.from({ length: rows + 1 }, (_, k) => first + (k * (last - first)) / rows);
    const poses = values.map((value) => [turned((value * Math.PI) / 180).map((v, k) => (round && k === 3 ? 0 : v))]);
    const motion = { drive: 0, round, unit: "°", values, poses, arrow: { link: 0, at: [0, 0, 0], along: [0, 0, 1] } };
    return new Machine({
      bodies: [{}],
      live: null,
      middle: [0, 0, 0],
      motions: [motion],
      points: [],
      size: 50,
      unit: "mm",
    } as unknown as Model);
  };
  for (const [round, first, last] of [
    [true, 0, 360],
    [false, -30, 40],
  ] as const) {
    const moved = machine(round, first, last);
    for (const part of [0.004, 0.36, 0.9987]) {
      const phi = ((first + part * (last - first)) * Math.PI) / 180;
      moved.moveTo(phi);
      const wanted = turned(phi).map((v, k) => (round && k === 3 ? 0 : v));
      const off = wanted.map((v, k) => Math.abs(moved.poses[0]![k]! - v));
      assert.ok(Math.max(...off) < 2e-5, `${round} ${part}`);
    }
  }
});
