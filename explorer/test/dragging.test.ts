/** What happens to the sizes when joints are dragged and lengths are typed. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { applyDocument, documentOf, savedDocument } from "../src/document";
import { Dragging, type Length } from "../src/dragging";
import { type Distance, kept } from "../src/keeping";
import { Linkage } from "../src/linkage";
import { Refused } from "../src/refused";
import { onCircle } from "../src/wheels";
import { A, B, C, CRANK_ROCKER, D, fourBar, sliderCrank } from "./fourbar";
import { close, near } from "./near";

const JOINTS = [A, B, C, D];

function upright(): { linkage: Linkage; dragging: Dragging } {
  const linkage = new Linkage(fourBar(CRANK_ROCKER, Math.PI / 2));
  return { linkage, dragging: new Dragging(linkage) };
}

function lengthsOf(dragging: Dragging): number[] {
  return dragging.lengths().map(({ value }) => value);
}

test("the sizes of a four-bar are its four lengths", () => {
  const { dragging } = upright();
  near(lengthsOf(dragging), [70, 25, 70, 40]);
  assert.deepEqual(
    JOINTS.map((joint) => dragging.draggable(joint)),
    [true, true, true, true],
  );
  assert.deepEqual(dragging.permitted(B, 3, 4), [3, 4]);
});

test("a joint goes where it is dragged to, the others stay", () => {
  for (const [joint, x, y] of [
    [A, -5, 3],
    [B, 4, 28],
    [C, 60, 50],
    [D, 75, -6],
  ] as const) {
    const { linkage, dragging } = upright();
    const before = JOINTS.map((one) => linkage.jointAt(one));
    dragging.dragJoint(joint, x, y);
    for (const one of JOINTS) near(linkage.jointAt(one), one === joint ? [x, y] : before[one]!);
    const [a, b, c, d] = JOINTS.map((one) => linkage.jointAt(one)) as [number, number][];
    const gap = (p: readonly number[], q: readonly number[]) => Math.hypot(p[0]! - q[0]!, p[1]! - q[1]!);
    near(lengthsOf(dragging), [gap(a!, d!), gap(a!, b!), gap(b!, c!), gap(c!, d!)]);
  }
});

test("the drive is the angle of the crank that was dragged, links keep their axes", () => {
  const { linkage, dragging } = upright();
  dragging.dragJoint(B, 18, 24);
  close(linkage.drives[0]!, Math.atan2(24, 18));
  near(linkage.sizes.xy(1), [0, 0]);
  near(linkage.sizes.xy(2), [30, 0]); // 18, 24, 30
});

test("a length that is typed is that length, the others stay", () => {
  const { linkage, dragging } = upright();
  const crank = dragging.lengths()[1]!;
  dragging.setLength(crank.first, crank.second, 31);
  near(lengthsOf(dragging), [70, 31, 70, 40]);
  near(linkage.jointAt(B), [0, 31]);
});

test("lengths that cannot be assembled are refused, and nothing is changed", () => {
  const { linkage, dragging } = upright();
  const before = documentOf(linkage);
  const rocker = dragging.lengths()[3]!;
  for (const length of [1, 400]) {
    assert.throws(
      () => dragging.setLength(rocker.first, rocker.second, length),
      (error) => error instanceof Refused && error.stop?.form === "RRR",
    );
    assert.deepEqual(documentOf(linkage), before);
  }
  for (const length of [-1, NaN, 1e10, 0])
    assert.throws(
      () => dragging.setLength(rocker.first, rocker.second, length),
      (error) => error instanceof Refused && error.stop === null,
    );
});

test("a slide goes on through the pin that is dragged", () => {
  const linkage = new Linkage(sliderCrank(30, 100, 0.3, 1));
  const dragging = new Dragging(linkage);
  assert.deepEqual(
    JOINTS.map((joint) => dragging.draggable(joint)),
    [true, true, true, false],
  );
  near(lengthsOf(dragging), [30, 100, 0]); // the line goes through A
  const [x, y] = linkage.jointAt(B);
  dragging.dragJoint(C, 120, 20);
  near(linkage.jointAt(A), [0, 0]);
  near(linkage.jointAt(B), [x, y]);
  near(linkage.jointAt(C), [120, 20]);
  const off = Math.abs(20 * Math.cos(0.3) - 120 * Math.sin(0.3)); // of A from the line through (120, 20)
  near(lengthsOf(dragging), [30, Math.hypot(120 - x, 20 - y), off]);
  close(linkage.sizes.angles[6]!, 0.3);
});

test("a rail is set off", () => {
  const linkage = new Linkage(sliderCrank(30, 100, 0.3, 1));
  const dragging = new Dragging(linkage);
  const rail = dragging.lengths()[2]!;
  dragging.setLength(rail.first, rail.second, 10);
  near(lengthsOf(dragging), [30, 100, 10]);
  const [x, y] = linkage.jointAt(C);
  close(Math.abs(y * Math.cos(0.3) - x * Math.sin(0.3)), 10);
});

test("a centre goes around another one at its distance", () => {
  const { linkage } = upright();
  const pivot = { wheel: 1, about: 0 }; // B about A, at 25
  near(onCircle(linkage, pivot, B, 30, 40), [15, 20]);
  near(onCircle(linkage, pivot, B, 0, 0), [0, 25]); // no direction: it stays
});

test("a document is taken and given back", () => {
  const { linkage } = upright();
  const other = new Linkage(fourBar({ crank: 20, coupler: 60, rocker: 45, frame: 65 }, 0.7));
  applyDocument(linkage, documentOf(other));
  close(linkage.drives[0]!, 0.7);
  for (const joint of JOINTS) near(linkage.jointAt(joint), other.jointAt(joint));
  assert.deepEqual(linkage.sizes.snapshot(), other.sizes.snapshot());
});

test("a damaged document is refused, and nothing is changed", () => {
  const { linkage } = upright();
  const before = documentOf(linkage);
  const other = documentOf(new Linkage(fourBar({ crank: 20, coupler: 60, rocker: 45, frame: 65 }, 0.7)));
  const damaged = [
    { ...other, elements: { ...other.elements!, rocker: {} } },
    { ...other, points: { K: { link: "nobody", at: [1, 2] } } },
    { ...other, reference_pose: { ...other.reference_pose!, crank: [0, 0, Infinity] } },
  ];
  for (const document of damaged) {
    assert.throws(
      () => applyDocument(linkage, document, 2),
      (error) => error instanceof Refused,
    );
    assert.deepEqual(documentOf(linkage), before);
    close(linkage.drives[0]!, Math.PI / 2);
  }
});

/** A four-bar with its crank upright, of which lengths are kept: 0 frame, 1 crank, 2 coupler, 3 rocker. */
function keeping(...lengths: number[]): { linkage: Linkage; dragging: Dragging } {
  const { linkage, dragging } = upright();
  const all = dragging.lengths();
  for (const k of lengths) dragging.locks.keep("length", all[k]!.first, all[k]!.second);
  return { linkage, dragging };
}

test("a length that is kept takes the neighbours of a dragged joint along", () => {
  const { linkage, dragging } = keeping(1, 2); // crank and coupler
  dragging.locks.hold(A);
  dragging.locks.hold(D);
  const [, , c] = JOINTS.map((joint) => linkage.jointAt(joint));
  dragging.dragJoint(C, c![0] + 3, c![1] - 2);
  const [a, b, now, d] = JOINTS.map((joint) => linkage.jointAt(joint)) as [number, number][];
  near([...a!, ...d!], [0, 0, 70, 0]);
  near(now!, [c![0] + 3, c![1] - 2]);
  close(Math.hypot(...b!), 25); // B: where the circles of 25 about A and 70 about C meet
  close(Math.hypot(now![0] - b![0], now![1] - b![1]), 70);
  const [frame, crank, coupler] = lengthsOf(dragging);
  assert.deepEqual([frame, crank, coupler], [70, 25, 70]); // to the bit: whole links are carried
});

test("all lengths kept, a joint pulled beyond its reach ends on its circle, and the linkage moves", () => {
  const { linkage, dragging } = keeping(0, 1, 2, 3);
  dragging.locks.hold(A);
  dragging.locks.hold(D);
  dragging.dragJoint(B, 40, 30);
  near(linkage.jointAt(B), [20, 15], 1e-5); // the nearest place on the circle of 25
  close(linkage.drives[0]!, Math.atan2(15, 20), 1e-6);
  assert.deepEqual(lengthsOf(dragging), [70, 25, 70, 40]);
  near(linkage.jointAt(D), [70, 0]);
  assert.ok(!dragging.draggable(A)); // it is held
  dragging.locks.hold(A);
  assert.ok(dragging.draggable(A));
});

test("a direction that is kept stays at any length; joints of files that are not there do no harm", () => {
  const { linkage, dragging } = upright();
  const [frame, , coupler] = dragging.lengths() as [Length, Length, Length];
  dragging.locks.keep("direction", coupler.first, coupler.second);
  for (const joint of [A, D]) dragging.locks.hold(joint);
  const before = JOINTS.map((joint) => linkage.jointAt(joint)) as [number, number][];
  dragging.dragJoint(C, before[2]![0] + 3, before[2]![1] - 2);
  const [a, b, c, d] = JOINTS.map((joint) => linkage.jointAt(joint)) as [number, number][];
  near([...a!, ...d!, ...c!], [0, 0, 70, 0, before[2]![0] + 3, before[2]![1] - 2]);
  // B goes by what of (3, -2) lies across the coupler, from (0, 25) to C
  const [u, v] = [before[2]![0] / 70, (before[2]![1] - 25) / 70];
  const across = -v * 3 - u * 2;
  near(b!, [-v * across, 25 + u * across]);
  const { locks } = savedDocument(linkage).page as { locks: string[][] };
  assert.deepEqual(locks[0], ["direction", "coupler", "R(crank-coupler)", "R(coupler-rocker)"]);
  assert.deepEqual(locks.slice(1), [
    ["joint", "R(frame-crank)"],
    ["joint", "R(frame-rocker)"],
  ]);
  const other = new Linkage(fourBar(CRANK_ROCKER, Math.PI / 2));
  applyDocument(other, {
    ...documentOf(other),
    page: { locks: [...locks, ["joint", "X"], ["length", "crank", "X", "Y"], ["joint"], [7]] },
  });
  assert.deepEqual(other.beside.locks?.length, 5);
  const { locks: read } = new Dragging(other);
  assert.ok(read.keeps("direction", coupler.first, coupler.second) && !read.keeps("length", frame.first, frame.second));
  assert.deepEqual(
    [...read.held].filter((joint) => joint >= 0),
    [A, D],
  );
  // turned round it would be another direction
  assert.equal(
    kept(
      [
        [0, 0],
        [-1, 0],
      ],
      [[0, 1, 1, [1, 0]]],
      [0, 0],
    ),
    null,
  );
});

test("distances are met with the least moves, also those that follow from others; what is impossible is not", () => {
  const square: [number, number][] = [
    [0, 0],
    [2, 0],
    [2, 2],
    [0, 2],
  ];
  // one of two free places a unit nearer: each moves half of it
  near(kept(square.slice(0, 2), [[0, 1, 1]], [1, 1])!.flat(), [0.5, 0, 1.5, 0]);
  const sides = [0, 1, 2, 3].map((k): Distance => [k, (k + 1) % 4, 2]);
  const diagonals: Distance[] = [
    [0, 2, Math.sqrt(8)],
    [1, 3, Math.sqrt(8)],
  ]; // six distances of four places: one too many
  const turned = kept(
    [
      [0, 0],
      [2.1, 0.3],
      [2, 2],
      [0, 2],
    ],
    [...sides, ...diagonals],
    [0, 1e-4, 1, 1],
  )!;
  for (const [one, two, length] of [...sides, ...diagonals])
    close(Math.hypot(turned[two]![0] - turned[one]![0], turned[two]![1] - turned[one]![1]), length);
  assert.equal(
    kept(
      square,
      [
        [0, 1, 1],
        [1, 2, 1],
        [0, 2, 5],
      ],
      [1, 1, 1, 1],
    ),
    null,
  ); // no triangle
});
