/** Where the letters of joints and the names of links stand on the plane: clear of all that is drawn, else at the end
 * of a line; on a phone those that have no room are left out, but for what is chosen. */

import type { Dimension } from "./dimensions";
import { type Drawing, isPin, knotName, radiiOf } from "./drawing";
import { DRIVING, HATCH, PUSHING, placed, RAIL } from "./ground";
import { away, convexHull, middleOf, sidesOf, spotsAbout, toHull } from "./hull";
import { currentLanguage, number, spaced } from "./language";
import { boxed, leaderOf } from "./leaders";
import { halfOf, namePlace, nameSpots, rimSpots } from "./names";
import { bodiesOf, isCylinder, outlineOf, RING, rimsOf, ringOf, type Seen, wayOf } from "./outlines";
import type { Pair } from "./rows";

const HIGH = 6; // half the height of a text
const LETTER = 20; // pixels from a joint to its letter
const WELL = 4; // pixels of room with which a text stands well
const TOOLS = 172; // down to where the buttons over the plane end
const BESIDE = 56; // from its right edge to the left one of these
const RULE = 30; // from its left edge to where the numbers of the grid end
const FOOT = 24; // and from its lower one

export interface Written {
  /** The middle of its foot. */
  at: Pair;
  name: string;
  /** From its body to it, if it stands farther off. */
  line?: [Pair, Pair] | null;
}

/** Something drawn with the room that it takes, and the rectangle about it. */
type Ink = readonly [hull: readonly Pair[], room: number, left: number, right: number, top: number, bottom: number];

function inked(hull: readonly Pair[], room: number): Ink {
  const [, left, right, top, bottom] = boxed(hull);
  return [hull, room, left, right, top, bottom];
}

/** All that is drawn, but for texts. */
function inkOf({ drawing, viewport }: Seen, dimensions: readonly Dimension[]): Ink[] {
  const { drives, frame, knots } = drawing;
  const ink: Ink[] = [];
  const draw = (hull: readonly Pair[], room = 1) => ink.push(inked(hull, room));
  for (const link of bodiesOf({ drawing, viewport })) {
    const hull = outlineOf({ drawing, viewport }, link);
    for (const side of hull[2] ? sidesOf(hull) : [hull]) if (side[0]) draw(side, 6);
  }
  for (const [k, knot] of knots.entries()) {
    const at = viewport.screen(...knot.at);
    if (isPin(knot)) draw([at], 6);
    const shift = (sign: readonly Pair[], turn = 0) => draw(convexHull(placed(sign, at, turn)));
    const way = wayOf(knot);
    if (drives.includes(k)) shift(way === null ? DRIVING : PUSHING, -(way ?? 0));
    if (isCylinder(knot))
      draw(
        knot.between!.map((end) => viewport.screen(...end)),
        8,
      );
    for (const rim of rimsOf(knot, viewport)) draw(rim, 2);
    if (knot.slide !== undefined) {
      const box = (x: number, low: number, high: number): Pair[] => [
        [-x, low],
        [x, low],
        [x, high],
        [-x, high],
      ];
      shift(box(15, -9, 9), -knot.slide);
      if (knot.links.includes(frame!)) shift(box(46, RAIL - 1, RAIL + 2 * HATCH), -knot.slide);
    } else if (isPin(knot) && knot.links.includes(frame!))
      shift([
        [0, 0],
        [17, 23],
        [-17, 23],
      ]);
  }
  for (const {
    at: [x, y],
    line,
    text,
  } of dimensions) {
    draw(line, 2);
    draw(
      [
        [x - halfOf(text), y],
        [x + halfOf(text), y],
      ],
      HIGH,
    );
  }
  return ink;
}

class Sheet {
  readonly written: Written[] = [];
  readonly #ink: Ink[];

  constructor(
    private readonly seen: Seen,
    dimensions: readonly Dimension[],
  ) {
    this.#ink = inkOf(seen, dimensions);
  }

  /** How much room a text has there beyond what it needs; less than nothing where it lies upon something. */
  gap(half: number, [x, y]: Pair, most = WELL): number {
    const { height, width } = this.seen.viewport;
    const right = y < TOOLS ? width - BESIDE : width - 4;
    if (x - half < RULE || x + half > right || y < 14 || y > height - FOOT) return -99;
    const middle = y - 4;
    let least = most;
    const count = Math.ceil(half / 5);
    const inner = Math.max(0, half - HIGH); // its ends are as round as it is high
    for (const [hull, room, left, end, top, bottom] of this.#ink) {
      const reach = room + HIGH + least;
      if (x + half < left - reach || x - half > end + reach || middle < top - reach || middle > bottom + reach)
        continue;
      for (let k = 0; k <= count; k++)
        least = Math.min(least, toHull(hull, x - inner + (2 * inner * k) / count, middle) - room - HIGH);
    }
    return least;
  }

  write(name: string, at: Pair, line: [Pair, Pair] | null = null): void {
    this.written.push({ at, name, line });
    const [x, y] = at;
    const half = halfOf(name);
    this.#ink.push(
      inked(
        [
          [x - half, y - 4],
          [x + half, y - 4],
        ],
        HIGH,
      ),
    );
    if (line) this.#ink.push(inked(line, 1));
  }
}

/** What the knots are called, beside them; of those at one place, such as a block and its slide, all of them. */
function writeLetters(sheet: Sheet, { chosen, drawing, viewport }: Shown, plates: readonly Pair[][]): void {
  const { knots } = drawing;
  const spots = knots.map(({ at }) => viewport.screen(...at));
  for (const [k, knot] of knots.entries()) {
    const here = [...knots.keys()].filter((one) => away(spots[one]!, ...spots[k]!) < 1);
    if (here[0]! < k) continue;
    const letters = here.map((one) => knotName(drawing, one)).join(", ");
    const radii = radiiOf(knot);
    const told = `${letters} ${radii.map((radius) => number(radius, 3)).join(" : ")}`;
    // in the larger wheel, if it has room
    const name = Math.max(0, ...radii) * viewport.scale > 2 * halfOf(told) + 40 ? told : letters;
    const half = halfOf(name);
    const places = spotsAbout(spots[k]!, -LETTER, half - 2).map(([x, y]): Pair => [x, y + 4]);
    const worth = places.map((at, place) => {
      const upon = plates.some((plate) => !toHull(plate, at[0], at[1] - 4)) ? 3 : 0;
      return sheet.gap(half, at) - upon - (place < 16 ? 0 : WELL);
    });
    const best = Math.max(...worth);
    const seen = best > -WELL || !viewport.narrow || here.includes(chosen?.knot ?? -1);
    if (seen) sheet.write(name, places[worth.indexOf(best)]!);
  }
}

/** Where the name of a link may stand in its body or beside it. */
function placesOf({ drawing, viewport }: Seen, link: string, name: string): Pair[] {
  const mine = drawing.knots.filter((knot) => knot.links.includes(link));
  const ring = mine.find((knot) => knot.links[ringOf(knot)] === link);
  if (ring) {
    const centre = viewport.screen(...ring.between![ringOf(ring)]!);
    return rimSpots(centre, Math.max(...radiiOf(ring)) * viewport.scale + RING, name);
  }
  const joints = mine.map(({ at }) => at);
  const beside = nameSpots(viewport, namePlace(joints, [], name, viewport.scale), name);
  // beside the rim of a wheel whose inside has no room
  const rims = mine.flatMap((knot) => {
    const which = knot.links.indexOf(link);
    const centre = knot.part === undefined ? undefined : knot.between?.[which];
    return centre ? rimSpots(viewport.screen(...centre), radiiOf(knot)[which]! * viewport.scale, name) : [];
  });
  return [...beside, ...rims];
}

interface Shown extends Seen {
  readonly chosen: { readonly knot: number | null; readonly link: string | null } | null;
}

/** What was found last, while only the pointer moves. */
let last: { drawing: Drawing; key: string; written: Written[] } | null = null;

/** Letters and names, each at its place. */
export function lettering(plane: Shown, dimensions: readonly Dimension[]): Written[] {
  const { chosen, drawing, viewport } = plane;
  const { height, scale, width } = viewport;
  const shown = [...viewport.screen(0, 0), scale, width, height, currentLanguage()];
  const key = `${shown} ${chosen?.knot} ${chosen?.link}`;
  if (last?.drawing === drawing && last.key === key) return last.written;
  last = { drawing, key, written: writtenOn(plane, dimensions) };
  return last.written;
}

function writtenOn(plane: Shown, dimensions: readonly Dimension[]): Written[] {
  const { chosen, drawing, viewport } = plane;
  const sheet = new Sheet(plane, dimensions);
  const bodies = bodiesOf(plane);
  const hulls = bodies.map((link) => {
    const held = drawing.knots.filter((knot) => isCylinder(knot) && knot.links.includes(link)); // a half of it
    return convexHull([...outlineOf(plane, link), ...held.map(({ at }) => viewport.screen(...at))]);
  });
  writeLetters(
    sheet,
    plane,
    hulls.filter((hull) => hull[2]),
  );
  const letters = sheet.written.length;
  const lines: [Pair, Pair][] = [];
  const order = [...bodies.keys()].sort(
    (one, other) => +(bodies[other] === chosen?.link) - +(bodies[one] === chosen?.link),
  );
  const far: number[] = [];
  for (const k of order) {
    const name = spaced(bodies[k]!);
    const half = halfOf(name);
    const own = hulls[k]!;
    // of a plate upon which it lies only the edges are others
    const middle = own[0] ? middleOf(own) : null;
    const others = hulls.flatMap((one) => {
      if (one === own || !one[0]) return [];
      return middle && one[2] && !toHull(one, ...middle) ? sidesOf(one) : [one];
    });
    const near = ([x, y]: Pair) =>
      [-half, 0, half].every((d) => others.every((one) => toHull(one, x + d, y - 4) >= toHull(own, x + d, y - 4)));
    const at = placesOf(plane, bodies[k]!, name).find((one) => sheet.gap(half, one) > 0.5 && near(one));
    if (at) sheet.write(name, at);
    else far.push(k);
  }
  for (const k of far) {
    const name = spaced(bodies[k]!);
    const half = halfOf(name);
    const own = hulls[k]!;
    const others = hulls.filter((one) => one !== own && one[0]).map(boxed);
    const names = sheet.written.map(({ at: [x, y], name: other }) => ({ x, y, half: halfOf(other) }));
    const free = (at: Pair) => sheet.gap(half, at) > 0.5;
    const meant = !viewport.narrow || chosen?.link === bodies[k];
    if (!meant) continue; // it is told once it is chosen
    const found = own[0] ? leaderOf(boxed(own), own[2] ? own : [], others, half, free, lines, names)() : null;
    if (found) {
      sheet.write(name, found.at, found.line);
      if (found.line) lines.push(found.line);
      continue;
    }
    const places = placesOf(plane, bodies[k]!, name);
    const worth = places.map((at) => sheet.gap(half, at));
    sheet.write(name, places[worth.indexOf(Math.max(...worth))]!);
  }
  return [...sheet.written.slice(letters), ...sheet.written.slice(0, letters)];
}
