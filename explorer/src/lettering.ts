/** Where the letters of joints and the names of links stand on the plane: clear of all that is drawn, else at the end
 * of a line; on a phone those that have no room are left out, but for what is chosen. */

import type { Dimension } from "./dimensions";
import { type Drawing, isPin, knotName, radiiOf } from "./drawing";
import { DRIVING, GUIDE, HATCH, lying, PUSHING, placed, RAIL, STANDING } from "./ground";
import { away, convexHull, middleOf, sidesOf, spotsAbout, toHull } from "./hull";
import { currentLanguage, number, spaced } from "./language";
import { type Boxed, boxed, endAt, leaderOf } from "./leaders";
import { between, halfOf, namePlace, nameSpots, nearerBy, rimSpots } from "./names";
import { BARREL, bodiesOf, isCylinder, outlineOf, RING, rimsOf, ringOf, type Seen, wayOf } from "./outlines";
import type { Pair } from "./rows";

const HIGH = 6; // half the height of a text
const LETTER = 20; // pixels from a joint to its letter
const WELL = 4; // pixels of room with which a text stands well
const RULE = 40; // from the left edge of the plane to where the numbers of the grid end
const FOOT = 24; // and from its lower one
const GROUND: Pair[] = [[0, 0], ...STANDING.slice(1)];

export interface Written {
  /** The middle of its foot. */
  x: number;
  y: number;
  half: number;
  name: string;
  /** From its body to it, if it stands farther off. */
  line?: [Pair, Pair] | null;
}

/** Something drawn with the room that it takes. */
type Ink = readonly [room: number, ...Boxed];

/** All that is drawn, but for texts. */
function inkOf({ drawing, viewport }: Seen, dimensions: readonly Dimension[]): Ink[] {
  const { drives, frame, knots } = drawing;
  const ink: Ink[] = [];
  const draw = (hull: readonly Pair[], room = 1) => ink.push([room, ...boxed(hull)]);
  for (const link of bodiesOf({ drawing, viewport })) {
    const hull = outlineOf({ drawing, viewport }, link);
    for (const side of hull[2] ? sidesOf(hull) : [hull]) if (side[0]) draw(side, 6);
  }
  for (const [k, knot] of knots.entries()) {
    const at = viewport.screen(...knot.at);
    if (isPin(knot)) draw([at], 6);
    const shift = (sign: readonly Pair[], turn = 0, room = 1) => draw(convexHull(placed(sign, at, turn)), room);
    const along = (half: number, low: number, room: number) => {
      const ends: Pair[] = [
        [-half, low],
        [half, low],
      ];
      shift(ends, -lying(knot.slide!), room);
    };
    const way = wayOf(knot);
    if (drives.includes(k) && !isCylinder(knot))
      shift(way === null ? [...DRIVING, [-13, -5]] : PUSHING, -lying(way ?? 0));
    if (isCylinder(knot))
      draw(
        knot.between!.map((end) => viewport.screen(...end)),
        12,
      );
    for (const rim of rimsOf(knot, viewport)) draw(rim, 2);
    const grounded = knot.links.includes(frame!);
    if (knot.slide !== undefined) {
      along(6, 0, 9);
      if (grounded) along(GUIDE, RAIL + HATCH, HATCH);
    } else if (grounded && isPin(knot)) shift(GROUND);
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
      HIGH + 6, // two numbers are not read as one
    );
  }
  return ink;
}

type Sheet = ReturnType<typeof sheetOf>;

function sheetOf(seen: Seen, dimensions: readonly Dimension[]) {
  const written: Written[] = [];
  const ink = inkOf(seen, dimensions);
  const { viewport } = seen;

  /** How much room a text has there beyond what it needs; less than nothing where it lies upon something. */
  const gap = (half: number, [x, y]: Pair): number => {
    if (x - half < RULE || x + half + 4 > viewport.right(y - 14) || y < 14 || y > viewport.height - FOOT) return -99;
    const middle = y - 4;
    let least = WELL;
    const count = Math.ceil(half / 5);
    const inner = Math.max(0, half - HIGH); // its ends are as round as it is high
    for (const [room, hull, left, end, top, bottom] of ink) {
      const reach = room + HIGH + least;
      if (x + half < left - reach || x - half > end + reach || middle < top - reach || middle > bottom + reach)
        continue;
      for (let k = 0; k <= count; k++)
        least = Math.min(least, toHull(hull, x - inner + (2 * inner * k) / count, middle) - room - HIGH);
    }
    return least;
  };

  const write = (name: string, [x, y]: Pair, line: [Pair, Pair] | null = null) => {
    const half = halfOf(name);
    written.push({ x, y, half, name, line });
    const text: Pair[] = [
      [x - half, y - 4],
      [x + half, y - 4],
    ];
    ink.push([HIGH + 4, ...boxed(text)]);
    if (line) ink.push([1, ...boxed(line)]);
  };

  return { gap, write, written };
}

/** What the knots are called, beside them; of those at one place, such as a block and its slide, all of them. */
function writeLetters({ gap, write }: Sheet, { chosen, drawing, viewport }: Shown, hulls: readonly Pair[][]): void {
  const { knots } = drawing;
  const spots = knots.map(({ at }) => viewport.screen(...at));
  for (const [k, knot] of knots.entries()) {
    const here = [...knots.keys()].filter((one) => away(spots[one]!, ...spots[k]!) < 1);
    const wanted = here.includes(chosen?.knot ?? -1);
    // of a cylinder that is driven the arrow tells
    if (here[0]! < k || (!wanted && isCylinder(knot) && drawing.drives.includes(k))) continue;
    const letters = here.map((one) => knotName(drawing, one)).join(", ");
    const radii = radiiOf(knot);
    const told = `${letters} ${radii.map((radius) => number(radius, 3)).join(" : ")}`;
    // in the larger wheel, if it has room
    const name = Math.max(0, ...radii) * viewport.scale > 2 * halfOf(told) + 40 ? told : letters;
    const half = halfOf(name);
    const own = spots[k]!;
    const places = spotsAbout(own, -LETTER, half - 2);
    const off = (one: Pair, at: Pair) => away(one, ...endAt(one, at, half));
    const others = spots.filter((_, other) => !here.includes(other));
    const strays = places.map((at) => others.some((one) => off(one, at) < off(own, at) + WELL));
    const worth = places.map(([u, v], far) => {
      const upon = hulls.some((hull) => hull[2] && !toHull(hull, u, v)) ? 3 : 0;
      return gap(half, [u, v + 4]) - upon - (far < 16 ? 0 : WELL) - (strays[far] ? 2 * WELL : 0);
    });
    const best = Math.max(...worth);
    if (best <= -WELL && viewport.narrow && !wanted) continue; // it is told once it is chosen
    const place = worth.indexOf(best);
    const [x, y] = places[place]!;
    const to = endAt(own, [x, y], half);
    const line: [Pair, Pair] = [between(own, to, 6 / away(to, ...own)), to];
    write(name, [x, y + 4], place > 15 || strays[place] ? line : null);
  }
}

/** Where the name of a link may stand in its body or beside it. */
function placesOf({ drawing, viewport }: Seen, link: string, name: string): Pair[] {
  const mine = drawing.knots.filter((knot) => knot.links.includes(link));
  const ring = mine.some((knot) => knot.links[ringOf(knot)] === link);
  // of a wheel whose inside has no room, too
  const rims = mine.flatMap((knot) => {
    const which = knot.links.indexOf(link);
    const radius = (radiiOf(knot)[which] ?? 0) * viewport.scale;
    return radius ? rimSpots(viewport.screen(...knot.between![which]!), radius + (ring ? RING : 0), name) : [];
  });
  if (ring) return rims;
  const joints = mine.map(({ at }) => at);
  return [...nameSpots(viewport, namePlace(joints, [], name, viewport.scale), name), ...rims];
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
  const seen = [...viewport.screen(0, 0), scale, width, height, currentLanguage(), chosen?.knot, chosen?.link];
  const key = seen.join();
  if (last?.drawing === drawing && last.key === key) return last.written;
  const sheet = sheetOf(plane, dimensions);
  const { gap, write, written } = sheet;
  const bodies = bodiesOf(plane);
  const hulls = bodies.map((link) => {
    const held = drawing.knots.filter((knot) => isCylinder(knot) && knot.links.includes(link)); // a part of it
    const mouths = held.map((knot) => viewport.screen(...between(...knot.between!, BARREL)));
    return convexHull([...outlineOf(plane, link), ...mouths]);
  });
  writeLetters(sheet, plane, hulls);
  const bearings = drawing.knots.filter((knot) => isPin(knot) && knot.links.includes(drawing.frame!));
  const grounds = bearings.map(({ at }) => placed(GROUND, viewport.screen(...at)));
  const far: (() => void)[] = [];
  const letters = written.length;
  for (const [k, link] of bodies.entries()) {
    const name = spaced(link);
    const half = halfOf(name);
    const own = hulls[k]!;
    // of a plate upon which it lies only the edges are others
    const middle = own[0] ? middleOf(own) : null;
    const rest = hulls.filter((one) => one !== own && one[0]);
    const others = rest.flatMap((one) => (middle && one[2] && !toHull(one, ...middle) ? sidesOf(one) : [one]));
    const free = (at: Pair) => gap(half, at) > 0.5;
    const spot = placesOf(plane, link, name).find((at) => free(at) && nearerBy(at, half, own, others) >= 0);
    if (spot) write(name, spot);
    // on a phone it is told once it is chosen
    else if (own[0] && (!viewport.narrow || chosen?.link === link))
      far.push(() => {
        const home = own[2] ? own : [];
        const crossed = [...others, ...grounds].map(boxed);
        const found = leaderOf(boxed(own), home, crossed, half, free, linesOf(written), written)();
        if (found) write(name, found.at, found.line);
      });
  }
  for (const find of far) find();
  last = { drawing, key, written: [...written.slice(letters), ...written.slice(0, letters)] };
  return last.written;
}

/** From bodies and joints to what is written. */
export function linesOf(all: readonly Written[]): [Pair, Pair][] {
  return all.flatMap(({ line }) => (line ? [line] : []));
}
