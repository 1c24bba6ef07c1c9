/** What a linkage is to meet: marks in the plane, and a table in which they are typed. */

import { type Area, groundMark } from "./area";
import { DEGREE } from "./cycle";
import type { Design } from "./designs";
import { digits } from "./digits";
import { h, svg } from "./dom";
import { bodiesOf, pathOf, putBodies } from "./ghost";
import { away, clearAbout, convexHull } from "./hull";
import { angle, number, parsed, t } from "./language";
import { valueAt } from "./plot";
import type { Pair } from "./rows";
import { cross } from "./shell";

export const ARM = 14; // of the arrow that shows the angle of a position
const LONG = 100; // millimetres of a rocker of which only the swing is known
const AWAY = 6; // from a point to the middle of its number
export const HEAD = "M-1.8 -1.8L2.4 0L-1.8 1.8Z"; // of an arrow
const MOST = 1e6; // of what is typed: marks of others would fall into one
export const CROWD = 9; // targets, of more only some have their numbers

/** A table whose cells change the rows; each row may be removed. */
export function rowsTable(
  rows: number[][],
  title: string,
  head: string[],
  /** What stands at the end of a row; true is what removes it. */
  last: boolean | ((k: number) => HTMLElement),
  changed: () => void,
  say: (text: string) => void,
  numbered = (k: number) => String(k + 1),
): HTMLElement {
  const called = (k: number) => t("{title} {number}", { title, number: numbered(k) }).trim();
  const cell = (row: number[], k: number, axis: number) => {
    const input = h("input", {
      ...digits(row[axis]!, rows.flat()),
      inputmode: "decimal",
      "aria-label": `${called(k)} ${head[axis]}`,
      onchange: () => {
        const value = parsed(input.value);
        const right = Math.abs(value) <= MOST;
        input.setAttribute("aria-invalid", String(!right));
        const why = Number.isFinite(value)
          ? t("Expected a number from {least} to {most}.", { least: number(-MOST), most: number(MOST) })
          : t("Expected a number, such as {value}.", { value: number(row[axis]!) });
        say(right ? "" : why);
        if (!right) return;
        row[axis] = value;
        changed();
      },
    });
    return h("td", {}, input);
  };
  const remove = (k: number) => () => {
    rows.splice(k, 1);
    changed();
  };
  const end = (k: number) => {
    if (typeof last === "function") return last(k);
    return last ? cross(called(k), remove(k)) : null;
  };
  const first = (tag: "td" | "th", text: string) => (numbered(0) ? [h(tag, {}, text)] : []);
  return h(
    "table",
    {},
    h("tr", {}, ...first("th", title), ...head.map((name) => h("th", {}, name)), h("th", {}, "")),
    ...rows.map((row, k) =>
      h("tr", {}, ...first("td", numbered(k)), ...head.map((_, axis) => cell(row, k, axis)), h("td", {}, end(k))),
    ),
  );
}

/** So many places evenly along a line that was drawn; of one that comes back to its start without the last. */
export function evenly(line: number[][], count: number): { places: number[][]; closed: boolean } {
  const lengths = [0];
  for (let k = 1; k < line.length; k++) {
    const [[x, y], [u, v]] = [line[k - 1]!, line[k]!] as [Pair, Pair];
    lengths.push(lengths[k - 1]! + Math.hypot(u - x, v - y));
  }
  const long = lengths.at(-1)!;
  const [[x, y], [u, v]] = [line[0]!, line.at(-1)!] as [Pair, Pair];
  const closed = line.length > 2 && Math.hypot(u - x, v - y) < 0.1 * long;
  const all = Float64Array.from(lengths);
  const places = Array.from({ length: count }, (_, k) => {
    const at = (long * k) / (closed ? count : count - 1);
    return [0, 1].map((axis) => {
      const value = valueAt(
        all,
        Float64Array.from(line, (place) => place[axis]!),
        at,
      );
      return Math.round(10 * value) / 10;
    });
  });
  return { places, closed };
}

/** How long the arrows of positions are: shorter where they are near each other, so that none ends upon another. */
export function armOf(rows: readonly (readonly (number | undefined)[])[], longest: number, unit: number): number {
  const gaps = rows.flatMap(([x, y], k) => rows.slice(k + 1).map(([u, v]) => Math.hypot(x! - u!, y! - v!)));
  return Math.max(0.4 * longest, Math.min(longest, (0.6 * Math.min(...gaps)) / unit));
}

/** The end of the arrow of a position, which is so long. */
export function tip([x, y, turn]: number[], arm: number): number[] {
  const phi = (turn ?? 0) * DEGREE;
  return [x! + arm * Math.cos(phi), y! + arm * Math.sin(phi)];
}

/** The pivot of a rocker, its end at both ends of its swing in degrees, and that between them: of a design, else of a
 * rocker as long as the longest link of designs, of which only the ratios of lengths count. */
export function swingOf(swing: number, design: Design | null): Pair[] {
  const [one, two] = design?.ends ?? [];
  const half = (swing * Math.PI) / 360;
  if (!one || !two)
    return [[0, 0], ...[-half, half, 0].map((phi): Pair => [LONG * Math.sin(phi), LONG * Math.cos(phi)])];
  const pivot = one.findIndex((at, k) => k !== design!.drive && `${at}` === `${two[k]}`);
  const end = design!.members.find((own) => own.includes(pivot))!.find((k) => k !== pivot)!;
  const [x, y] = one[pivot]!;
  const [[a, b], [c, d]] = [one[end]!, two[end]!];
  const part = Math.hypot(a - x, b - y) / Math.hypot(a + c - 2 * x, b + d - 2 * y);
  return [one[pivot]!, one[end]!, two[end]!, [x + part * (a + c - 2 * x), y + part * (b + d - 2 * y)]];
}

/** The same as a picture with its angle and its time ratio, and the names of the ends, which stand above what moves. */
export function swingMark(
  places: readonly Pair[],
  [swing, ratio]: readonly number[],
  area: Area,
  design: Design | null,
  corner: readonly Pair[],
): [picture: SVGElement[], names: SVGElement[]] {
  const { unit } = area;
  const [pivot, one, two, top] = places as [Pair, Pair, Pair, Pair];
  const [[x, y], [a, b], [c, d], [u, v]] = [pivot, one, two, top];
  const long = Math.hypot(a - x, b - y);
  const clockwise = (a - x) * (v - y) < (b - y) * (u - x);
  const texts = [`${t("Time ratio")} ${number(ratio!)}`, angle(swing! * DEGREE)];
  const left = u < x;
  const bodies = design?.ends?.flatMap((ends) => {
    const made = bodiesOf(design.members);
    putBodies(made, design.members, ends);
    return made.flat();
  });
  const picture = [
    ...(bodies ? [svg("g.faded", {}, ...bodies)] : [svg("path.arm", { d: pathOf([one, pivot, two]) })]),
    groundMark(pivot, unit),
    svg("path.polygon", { d: `M${a} ${-b}A${long} ${long} 0 ${+(swing! > 180)} ${+clockwise} ${c} ${-d}` }),
    ...texts.map((text, k) =>
      svg(
        k ? "text" : "text.tick",
        {
          "text-anchor": left ? "end" : "start", // beside the axis
          transform: `translate(${u} ${-v}) scale(${unit})`,
          x: left ? -2 : 2,
          y: -3 - 5 * k,
        },
        text,
      ),
    ),
  ];
  return [picture, design ? endNames(places, design, area, left, corner) : []];
}

/** What the dead centres of a design are called, beside the ends of its rocker, clear of all that links pass over, of
 * other words and of the edges of the picture. */
function endNames(
  [, ...places]: readonly Pair[],
  design: Design,
  { bottom, left: west, right: east, top: north, unit }: Area,
  left: boolean,
  corner: readonly Pair[],
): SVGElement[] {
  const top = places[2]!;
  const ends = design.ends ?? [];
  const words = [0, 4, 8].map((up) =>
    [0, left ? -30 : 30].map((beside): Pair => [top[0] + beside * unit, top[1] + up * unit]),
  );
  const all = [...ends, ...design.frames.filter((_, k) => k % 3 === 0)];
  const links = all.flatMap((at) => design.members.map((own) => own.map((joint) => at[joint]!)));
  const beyond = [-1, 1].map((side): Pair[] => {
    const edge = side < 0 ? west : east;
    return convexHull(
      [edge, edge + side * (east - west)].flatMap((x): Pair[] => [
        [x, bottom],
        [x, north],
      ]),
    );
  });
  const drawn = [...words, ...links, ...beyond, corner];
  // crank and coupler in one line: beyond each other where the rocker is the farther from the crank
  const spans = ends.map((at, k) => away(at[design.drive!]!, ...places[k]!));
  return spans.map((span, k) => {
    const name = span > spans[1 - k]! ? t("extended") : t("folded");
    const room = name.length * unit;
    const [x, y] = clearAbout(places[k]!, 7 * unit, drawn, room);
    drawn.push([-room, room].map((d): Pair => [x + d, y]));
    const transform = `translate(${x} ${-y}) scale(${unit})`;
    return svg("text.tick", { "text-anchor": "middle", transform, y: 1.3 }, name);
  });
}

/** What a target is called beside it; of many every fifth. */
export function numberOf(k: number, count: number): string {
  return count > CROWD && k % 5 ? "" : String(k + 1);
}

/** How large the marks of targets are that may be so large: of many as small as the way to the next ones asks. */
export function markSize(rows: readonly (readonly (number | undefined)[])[], largest: number, unit: number): number {
  if (!rows[CROWD]) return largest;
  const ways = rows.slice(1).map(([x, y], k) => Math.hypot(x! - rows[k]![0]!, y! - rows[k]![1]!));
  const mean = ways.reduce((sum, way) => sum + way) / ways.length;
  return Math.max(0.4 * largest, Math.min(largest, (0.22 * mean) / unit));
}

/** Where the number of each target has its middle: near its point, as clear as possible of other points, of what is
 * drawn besides, and of all arrows, else of the way from point to point. */
export function numberPlaces(
  rows: readonly number[][],
  closed: boolean,
  unit: number,
  drawn: readonly Pair[][] = [],
): Pair[] {
  const arm = unit * armOf(rows, ARM, unit);
  const lines = rows.map((row, k) => {
    const next = rows[k + 1] ?? (closed ? rows[0]! : row);
    return [row, row.length > 2 ? tip(row, arm) : next].map(([x, y]): Pair => [x!, y!]);
  });
  const placed = [...lines, ...drawn];
  return rows.map(([x, y], k) => {
    const others = rows.filter((_, other) => other !== k).map(([u, v]): Pair[] => [[u!, v!]]);
    const at = clearAbout([x!, y!], AWAY * unit, [...placed, ...others]);
    placed.push([at]);
    return at;
  });
}

/** A point with its number, and the arrow of a position; all of it in units that are so long. */
export function targetMark(rows: readonly number[][], k: number, [at, up]: Pair, unit: number, r: number) {
  const [x, y, turn] = rows[k]!;
  const [u, v] = tip([0, 0, turn ?? 0], armOf(rows, ARM, unit));
  return svg(
    "g",
    { "data-point": String(k), transform: `translate(${x} ${-y!}) scale(${unit})` },
    ...(turn === undefined
      ? []
      : [
          svg("path.arm", { d: `M0 0L${u} ${-v!}` }),
          svg("path.tip", { d: HEAD, transform: `translate(${u} ${-v!}) rotate(${-turn})` }),
        ]),
    svg("circle", { r }),
    svg("text", { x: (at - x!) / unit, y: (y! - up) / unit + 2, "text-anchor": "middle" }, numberOf(k, rows.length)),
  );
}
