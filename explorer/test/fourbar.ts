/** A four-bar as Python describes it, and what is known of it without solving: triangles and the law of cosines. */

import packed from "../../core/page/motion.wasm.gz";
import { loadKernel } from "../src/kernel";
import type { Model } from "../src/model";

await loadKernel(packed);

export interface Lengths {
  crank: number;
  coupler: number;
  rocker: number;
  frame: number;
}

export const CRANK_ROCKER: Lengths = { crank: 25, coupler: 70, rocker: 40, frame: 70 };

export const CRANK = 1;
export const COUPLER = 2;
export const ROCKER = 3;

/** The joints: A and D at the frame, B and C at the coupler. */
export const A = 0;
export const B = 1;
export const C = 2;
export const D = 3;

const FIXED = { turning: false, sliding: false, contours: false };
const TURNING = { ...FIXED, turning: true, free: { turn: true, along: false, across: false } };
const SLIDING = { ...FIXED, sliding: true, free: { turn: false, along: true, across: false } };

/** The angle between two sides of a triangle of which all are known. */
export function angleBetween(one: number, other: number, opposite: number): number {
  return Math.acos((one * one + other * other - opposite * opposite) / (2 * one * other));
}

/** The angles of coupler and rocker at a crank angle, C on the left of BD as it is seen from B. */
export function angles({ crank, coupler, rocker, frame }: Lengths, theta: number): { phi: number; psi: number } {
  const [x, y] = [crank * Math.cos(theta), crank * Math.sin(theta)];
  const diagonal = Math.hypot(frame - x, -y);
  const phi = Math.atan2(-y, frame - x) + angleBetween(coupler, diagonal, rocker);
  const [cx, cy] = [x + coupler * Math.cos(phi), y + coupler * Math.sin(phi)];
  return { phi, psi: Math.atan2(cy, cx - frame) };
}

/** A model with the crank at an angle; the output is the rocker. The point K lies in the middle of the coupler. */
export function fourBar(lengths: Lengths, theta: number): Model {
  const { crank, coupler, rocker, frame } = lengths;
  const names = ["frame", "crank", "coupler", "rocker"];
  const joints = [
    { name: "R(frame-crank)", pair: TURNING, links: [0, CRANK] },
    { name: "R(crank-coupler)", pair: TURNING, links: [CRANK, COUPLER] },
    { name: "R(coupler-rocker)", pair: TURNING, links: [COUPLER, ROCKER] },
    { name: "R(frame-rocker)", pair: TURNING, links: [0, ROCKER] },
  ];
  const pins = [
    [A, 0, 0],
    [A, CRANK, 0],
    [B, CRANK, crank],
    [B, COUPLER, 0],
    [C, COUPLER, coupler],
    [C, ROCKER, rocker],
    [D, 0, frame],
    [D, ROCKER, 0],
  ] as const;
  const elements = pins.map(([joint, link, x]) => ({
    joint,
    link,
    kind: "pin" as const,
    at: [x, 0] as [number, number],
    angle: 0,
  }));
  const placed: Record<string, Record<string, unknown>> = { frame: {}, crank: {}, coupler: {}, rocker: {} };
  for (const { joint, link, at } of elements) placed[names[link]!]![joints[joint]!.name] = at;
  const { phi, psi } = angles(lengths, theta);
  const degrees = (angle: number) => (angle * 180) / Math.PI;
  return {
    version: 1,
    name: "four-bar",
    names: {},
    source: "",
    document: {
      joints: joints.map(({ name }) => name).join(" "),
      elements: placed,
      points: { K: { link: "coupler", at: [coupler / 2, 0] } },
      reference_pose: {
        frame: [0, 0, 0],
        crank: [0, 0, degrees(theta)],
        coupler: [crank * Math.cos(theta), crank * Math.sin(theta), degrees(phi)],
        rocker: [frame, 0, degrees(psi)],
      },
    },
    links: names,
    linkNames: { en: names, de: ["Gestell", "Kurbel", "Koppel", "Schwinge"] },
    own: 4,
    frame: 0,
    unit: "mm",
    joints,
    elements,
    points: [{ name: "K", link: COUPLER, at: [coupler / 2, 0] }],
    drives: [{ name: "R(frame-crank)", turning: true, joint: A }],
    program: {
      operations: [
        [0, 0, 0, 1, 1, -1, -1, -1, -1, -1], // turn the crank
        [2, 2, 3, 4, 5, 7, 6, COUPLER, ROCKER, 0], // the dyad of coupler and rocker
      ],
      links: pins.map(([, link]) => link),
      points: pins.flatMap(([, , x]) => [x, 0]),
      lines: pins.flatMap(() => [1, 0]),
      conditions: [0],
      kinds: [],
      sides: [],
      owners: [],
      bodies: [0],
      roots: [],
      most: [Math.PI / 36],
      size: Math.max(crank, coupler, rocker, frame),
      values: [],
      windings: [],
      pieces: [],
      linkCount: 4,
      drives: 1,
      dyads: 1,
    },
    sources: pins.map((_, k) => k),
    reference: { drives: [[0, CRANK, 0, 1]], bodies: [], windings: [] },
    groups: [{ dyad: true, number: 0, form: "RRR", links: ["coupler", "rocker"], modes: true }],
    shortest: [],
    released: [],
    start: { drives: [theta], signs: [1], unknowns: [] },
    span: { turns: 0, between: null },
    outputs: [
      {
        link: ROCKER,
        joint: null,
        inLine: true,
        legs: [
          {
            links: [COUPLER],
            from: [COUPLER, 0, 0, 1, 0, 3],
            across: false,
            cam: false,
            pin: [COUPLER, coupler, 0, 1, 0, 4],
            pushed: ROCKER,
            guide: { slides: false, at: [0, frame, 0, 1, 0, 6] },
          },
        ],
        note: {},
      },
    ],
    shapes: [],
    bearings: [0, 0, 0, 0],
  };
}

/** A slider-crank: the slider, in place of the rocker, moves along a line through A at an angle. */
export function sliderCrank(crank: number, rod: number, line: number, theta: number): Model {
  const model = fourBar({ crank, coupler: rod, rocker: 0, frame: 0 }, theta);
  const name = "P(frame-slider)";
  const renamed = (text: string) => text.replace("rocker", "slider");
  model.links = model.links.map(renamed);
  model.joints = model.joints.map((joint) => ({ ...joint, name: renamed(joint.name) }));
  model.joints[D] = { name, pair: SLIDING, links: [0, ROCKER] };
  for (const k of [6, 7]) model.elements[k]!.kind = "line";
  model.elements[6]!.angle = line;
  model.program.lines.splice(12, 2, Math.cos(line), Math.sin(line));
  model.program.operations[1] = [3, 2, 3, 4, 5, 7, 6, COUPLER, ROCKER, 0];
  model.program.size = rod;
  model.groups[0]!.form = "RRP";
  const output = model.outputs[0]!;
  output.joint = D;
  output.legs[0]!.guide = { slides: true, at: [0, 0, 0, 1, 0, 6] };
  return model;
}
