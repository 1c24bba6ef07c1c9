/** A design as its card shows it: the four-bar in its first position, with the curve of its point. */

import type { Cycle } from "../cycle";
import { place } from "../rows";
import type { Complex } from "./complex";

const WIDE = 300; // pixels
const [ROOM, PIN, TRIANGLE, TARGET] = [24, 5, 9, 8];

/** Places of joints and points in the first position, which of them each moving link has, and which stand still. */
export interface Drawn {
  places: readonly Complex[];
  members: readonly number[][];
  fixed: readonly number[];
  /** How far the bearings of these are turned, by joints. */
  bearings: readonly number[];
  cycle: Cycle;
  point: { link: number; at: [number, number] };
  targets: readonly Complex[];
}

export function pictureOf({ places, members, fixed, bearings, cycle, point, targets }: Drawn): string {
  const curve = Array.from(cycle.values, (_, row): Complex => place(cycle.rows, row, point.link, ...point.at));
  const xs = [...places, ...curve].map(([x]) => x);
  const ys = [...places, ...curve].map(([, y]) => y);
  const [left, top] = [Math.min(...xs), Math.max(...ys)];
  const [wide, high] = [Math.max(...xs) - left, top - Math.min(...ys)];
  const scale = (WIDE - 2 * ROOM) / Math.max(wide, high);
  const short = (value: number) => Number(value.toFixed(1));
  const spot = ([x, y]: Complex) => `${short(ROOM + scale * (x - left))} ${short(ROOM + scale * (top - y))}`;
  const path = (name: string, line: readonly Complex[], end = "") =>
    `<path class="gr-${name}" d="M${line.map(spot).join("L")}${end}"/>`;
  const size = [wide, high].map((value) => short(2 * ROOM + scale * value));
  const stand = fixed.map((k) => {
    const [x, y] = spot(places[k]!).split(" ").map(Number) as [number, number];
    const d = `M${x} ${y}l${TRIANGLE} ${2 * TRIANGLE - 4}h${-2 * TRIANGLE}Z`;
    return `<path class="gr-block-frame" d="${d}" transform="rotate(${bearings[k]} ${x} ${y})"/>`;
  });
  const largestFirst = [...members].sort((one, other) => other.length - one.length);
  const bodies = largestFirst.map((own) => {
    const line = own.map((k) => places[k]!);
    const kind = line.length > 2 ? "" : "-bar";
    const end = line.length > 2 ? "Z" : "";
    return path(`outline${kind}`, line, end) + path(`body${kind}`, line, end);
  });
  const disc = (name: string, at: Complex, radius: number) => {
    const [x, y] = spot(at).split(" ");
    return `<circle class="gr-${name}" cx="${x}" cy="${y}" r="${radius}"/>`;
  };
  const marks = targets.map((at) => disc("head", at, TARGET));
  const pins = places.map((at) => disc("joint", at, PIN));
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" class="gr" width="${size[0]}" height="${size[1]}" ` +
    `viewBox="0 0 ${size.join(" ")}">${stand.join("")}${bodies.join("")}${marks.join("")}` +
    `${path("curve", curve, cycle.full ? "Z" : "")}${pins.join("")}</svg>`
  );
}
