/** Dimension lines on the plane: the lengths of what is chosen, and those that are kept. */

import { svg } from "./dom";
import type { Drawing } from "./drawing";
import { away, middleOf, pathThrough } from "./hull";
import { number } from "./language";
import { isKept, lengthOf, type Span, spanName, spansOf } from "./lengths";
import { halfOf } from "./names";
import type { Pair } from "./rows";
import type { Viewport } from "./viewport";

const OFF = 30; // pixels from a bar to its line
const HEAD = 8; // the length of an arrow
const LEAST = 24; // pixels: what is shorter has no room for a line
const MOST = 6; // of what is chosen

/** A length with its line, in pixels. */
export interface Dimension {
  readonly name: string;
  readonly text: string;
  readonly kept: boolean;
  /** Its line, with its extension lines and arrows, and where its figure stands. */
  readonly path: string;
  readonly line: readonly [Pair, Pair];
  readonly at: Pair;
}

type Segment = [Pair, Pair];

interface Measured {
  readonly drawing: Drawing;
  readonly viewport: Viewport;
  readonly chosen: { readonly knot: number | null; readonly link: string | null } | null;
}

/** The lengths of what is chosen: of a link, or of a joint beside the frame. */
export function wantedOf({ chosen, drawing, viewport }: Measured): Span[] {
  const { frame, knots } = drawing;
  const all = spansOf(drawing);
  const { knot = null, link = null } = chosen ?? {};
  const alone = (span: Span) => all.every((one) => one === span || one.link !== span.link);
  const jointed = (span: Span) => alone(span) || span.ends.every((k) => knots[k]!.links[1]);
  const wanted = all.filter((span) => {
    if (link !== null) return span.link === link && (jointed(span) || !viewport.narrow);
    // those of points only with these
    return span.link !== frame && span.ends.includes(knot ?? -1) && (jointed(span) || !knots[knot!]!.links[1]);
  });
  return wanted.slice(0, MOST);
}

export function dimensionsOf(plane: Measured): Dimension[] {
  const { drawing, viewport } = plane;
  const { knots } = drawing;
  const held = ({ ends }: Span) => isKept(drawing, "length", ends);
  const shown = [...new Set([...wantedOf(plane), ...(viewport.narrow ? [] : spansOf(drawing).filter(held))])];
  const taken: Segment[] = [];
  return shown.flatMap((span) => {
    const [p, q] = span.ends.map((k) => viewport.screen(...knots[k]!.at)) as [Pair, Pair];
    const far = away(p, ...q);
    if (far < LEAST) return [];
    const [c, s] = [(q[0] - p[0]) / far, (q[1] - p[1]) / far];
    const [mx, my] = [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
    const text = number(lengthOf(drawing, span.ends));
    const half = halfOf(text) + 4;
    // the line is open where its figure stands in it
    const gap = Math.min(Math.abs(half / c), Math.abs(9 / s));
    const open = far > 2 * gap + 4 * HEAD;
    const head = ([x, y]: Pair, way: number): Pair[] => [
      [x + way * HEAD * c - 3 * s, y + way * HEAD * s + 3 * c],
      [x, y],
      [x + way * HEAD * c + 3 * s, y + way * HEAD * s - 3 * c],
    ];
    const beside = (hand: number) => {
      const off = (by: number): Pair => [-s * by * hand, c * by * hand];
      const [dx, dy] = off(OFF);
      const beyond = (part: number) => [p, q].map(([u, v]): Pair => [u + part * dx, v + part * dy]) as Segment;
      const [a, b] = beyond(1);
      const [from, to] = [beyond(1 / 3), beyond(1.2)];
      const [ax, ay] = open ? [0, 0] : off(9 + half * Math.abs(s));
      const [x, y] = [mx + dx + ax, my + dy + ay];
      const parts: Segment[] = open
        ? [
            [a, [mx + dx - gap * c, my + dy - gap * s]],
            [[mx + dx + gap * c, my + dy + gap * s], b],
          ]
        : [[a, b]];
      parts.push([from[0], to[0]], [from[1], to[1]]);
      const whole: Segment[] = [
        ...parts,
        ...[-8, 8].map(
          (high): Segment => [
            [x - half, y - high],
            [x + half, y + high],
          ],
        ), // across the figure
      ];
      const over = whole.filter((one) => taken.some((other) => cross(one, other))).length;
      const hidden = [a, b].some(([u, v]) => u > viewport.right(v)); // by the buttons
      const cut = hidden || x < half || x > viewport.right(y) - half ? 1 : 0;
      const path = [...parts, head(a, 1), head(b, -1)].map(pathThrough).join("");
      return { path, line: [a, b] as Segment, at: [x, y] as Pair, whole, bad: over + cut };
    };
    // away from the middle of its link, or of what is drawn, where it crosses nothing there
    const its = knots.filter(({ links }) => links.includes(span.link));
    const middle = middleOf((its[2] ? its : knots).map((one) => viewport.screen(...one.at)));
    const side = -s * (mx - middle[0]) + c * (my - middle[1]) < 0 ? -1 : 1;
    const [first, second] = [beside(side), beside(-side)];
    const { at, bad, line, path, whole } = second.bad < first.bad ? second : first;
    if (bad && viewport.narrow) return []; // it is in the table
    taken.push(...whole);
    return [{ name: spanName(drawing, span.ends), text, kept: held(span), path, line, at }];
  });
}

/** Whether two lines cross. */
function cross([a, b]: Segment, [c, d]: Segment): boolean {
  const turn = (p: Pair, q: Pair, r: Pair) => (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/** The lines with their figures, which are pressed to type them. */
export function dimensionElements(all: readonly Dimension[]): SVGElement[] {
  return all.flatMap(({ at: [x, y], kept, name, path, text }) => [
    svg("path.crosshair", { d: path }),
    svg(kept ? "text.mark" : "text", { x, y: y + 4, "text-anchor": "middle" }, text),
    svg("rect.halo", {
      x: x - halfOf(text) - 10,
      y: y - 16,
      width: 2 * halfOf(text) + 20,
      height: 32,
      "data-span": name,
      cursor: "text",
    }),
  ]);
}
