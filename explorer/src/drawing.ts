/** A mechanism that is being drawn: places where links meet. Every change makes another drawing; nothing here knows the
 * browser. The library makes a linkage of its document. */

import type { Backdrop } from "./backdrop";
import type { Beside, Lock } from "./beside";
import { DEGREE } from "./cycle";
import { away, middleOf, onLine } from "./hull";
import { t } from "./language";
import type { LinkageDocument } from "./model";
import type { Pair } from "./rows";

/** A place of one or more links: a joint of two or more, an open end of one. */
export interface Knot {
  readonly at: Pair;
  readonly links: readonly string[];
  /** Of a slide its direction, in degrees; joints that turn have none. */
  readonly slide?: number;
  /** Of a cylinder the ends of its two links, of gears their centres. */
  readonly between?: readonly [Pair, Pair];
  /** Of gears: where on the line of centres they touch, as a part of the distance; beyond a centre the teeth of the
   * other wheel are internal. */
  readonly part?: number;
  /** What it was called in the linkage that was taken over; an open end as the point of its link. */
  readonly name?: string;
  /** What it is called without a name since another one was removed. */
  readonly letter?: string;
}

/** A length or a direction from knot to knot, or the place of one, that stays; knots by their names in order. */
export type Keep = readonly ["length" | "direction" | "joint", ...string[]];

export interface Drawing {
  readonly knots: readonly Knot[];
  readonly frame: string | null;
  /** Knots that are driven. */
  readonly drives: readonly number[];
  readonly locks?: readonly Keep[];
  /** The picture behind it, and whether the document of the linkage keeps it. */
  readonly picture?: Backdrop | undefined;
  readonly keeps?: boolean;
  /** Of a linkage that was taken over: its unit of length, its name, what its document keeps for the page. */
  readonly unit?: string;
  readonly title?: string;
  readonly beside?: Beside;
}

/** Where something is put: at a knot, on a link, or beside all of them. */
export interface Spot {
  readonly at: Pair;
  readonly knot: number | null;
  readonly link: string | null;
}

export const EMPTY: Drawing = { knots: [], frame: null, drives: [] };

export function unitOf({ unit }: Drawing): string {
  return unit ?? "mm";
}

/** The links, those that are called by numbers in their order. */
export function linksOf(drawing: Drawing): string[] {
  const all = drawing.frame === null ? [] : [drawing.frame];
  const links = [...new Set([...all, ...drawing.knots.flatMap((knot) => knot.links)])];
  const numbers = links.map(Number).filter((one) => one > 0);
  numbers.sort((one, other) => one - other);
  return links.map((link) => (Number(link) > 0 ? String(numbers.shift()) : link));
}

/** The joints: knots of at least two links. */
export function jointsOf({ knots }: Drawing): number[] {
  return [...knots.keys()].filter((k) => knots[k]!.links.length > 1);
}

/** What a knot is called, so that its name is not taken for that of a link: A to Z, then A1; not as another one. */
export function knotName({ knots }: Drawing, number: number): string {
  const names = knots.map(({ letter, name }) => name ?? letter);
  const taken = new Set(names);
  let before = names.slice(0, number).filter((one) => !one).length;
  const own = names[number];
  for (let k = 0; !own; k++) {
    const letter = String.fromCharCode(65 + (k % 26)) + (Math.floor(k / 26) || "");
    if (!taken.has(letter) && !before--) return letter;
  }
  return own;
}

/** Of two wheels that meet in a knot. */
export function radiiOf({ at, between, part }: Knot): number[] {
  return part === undefined ? [] : between!.map((centre) => away(at, ...centre));
}

/** Whether two spots or knots are at the same place. */
export function same(one: Pick<Spot, "at">, two: Pick<Spot, "at">): boolean {
  return one.at[0] === two.at[0] && one.at[1] === two.at[1];
}

/** The link that joins two spots, if one does. */
export function joining({ knots }: Drawing, one: Spot, two: Spot): string | undefined {
  const linksAt = ({ knot, link }: Spot) => (knot === null ? [link] : knots[knot]!.links);
  return linksAt(one).find((link): link is string => link !== null && linksAt(two).includes(link));
}

/** Whether links turn about a knot. */
export function isPin({ between, slide }: Knot): boolean {
  return slide === undefined && !between;
}

/** The formula of Grübler: each joint of k links takes 2(k - 1) freedoms, teeth that mesh one. */
export function counted(drawing: Drawing): number {
  const takes = ({ links, part }: Knot) => (part === undefined ? 2 * (links.length - 1) : 1);
  const taken = jointsOf(drawing).reduce((sum, k) => sum + takes(drawing.knots[k]!), 0);
  return 3 * (linksOf(drawing).length - 1) - taken;
}

function nextName(drawing: Drawing): string {
  const taken = new Set(linksOf(drawing));
  let number = 1;
  while (taken.has(String(number))) number++;
  return String(number);
}

function replaced(knots: readonly Knot[], number: number, knot: Knot): Knot[] {
  return knots.map((one, k) => (k === number ? knot : one));
}

/** Let a link reach a spot. */
function reaching({ knots, ...rest }: Drawing, spot: Spot, link: string): Drawing {
  if (spot.knot !== null) {
    const knot = knots[spot.knot]!;
    if (knot.links.includes(link)) return { knots, ...rest };
    return {
      ...rest,
      knots: replaced(knots, spot.knot, {
        ...knot,
        links: link === rest.frame ? [link, ...knot.links] : [...knot.links, link],
      }),
    };
  }
  const links = spot.link === null || spot.link === link ? [link] : [spot.link, link];
  return { ...rest, knots: [...knots, { at: spot.at, links }] };
}

/** A link from one spot to another. */
export function withLink(drawing: Drawing, from: Spot, to: Spot): Drawing {
  const name = nextName(drawing);
  return reaching(reaching(drawing, from, name), to, name);
}

/** Two links with a joint between them, which also takes in what it is put on. */
export function withDyad(drawing: Drawing, from: Spot, middle: Spot, to: Spot): Drawing {
  const one = withLink(drawing, from, middle);
  return withLink(one, { ...middle, knot: middle.knot ?? one.knots.length - 1, link: null }, to);
}

/** The ground at a spot: what is there is joined to the frame. */
export function withGround(drawing: Drawing, spot: Spot): Drawing {
  const frame = drawing.frame ?? t("frame");
  return reaching({ ...drawing, frame }, spot, frame);
}

/** A block at a spot that slides on the frame in a direction, in degrees. */
export function withSlider(drawing: Drawing, spot: Spot, slide = 0): Drawing {
  const frame = drawing.frame ?? t("frame");
  const block = nextName(drawing);
  const made = reaching({ ...drawing, frame }, spot, block);
  const { at } = spot.knot === null ? spot : made.knots[spot.knot]!;
  return { ...made, knots: [...made.knots, { at, links: [frame, block], slide }] };
}

/** With another direction of a slide, in degrees from -180 to 180. */
export function turned({ knots, ...rest }: Drawing, number: number, slide: number): Drawing {
  const around = slide - 360 * Math.round(slide / 360);
  return { ...rest, knots: replaced(knots, number, { ...knots[number]!, slide: around }) };
}

/** A point of a link that is not on the frame. */
export function withPoint(drawing: Drawing, link: string, at: Pair): Drawing {
  return { ...drawing, knots: [...drawing.knots, { at, links: [link] }] };
}

/** Two links of which one slides along the other, from one spot to another. */
export function withCylinder(drawing: Drawing, from: Spot, to: Spot): Drawing {
  const one = nextName(drawing);
  const half = reaching(drawing, from, one);
  const two = nextName(half);
  const made = reaching(half, to, two);
  return { ...made, knots: [...made.knots, placed({ at: to.at, links: [one, two], between: [from.at, to.at] })] };
}

/** Two gears about two spots that touch beside a place; null where both are the same link. */
export function withGears(drawing: Drawing, one: Spot, two: Spot, touch: Pair): Drawing | null {
  const [first, a] = withWheel(drawing, one);
  const [made, b] = withWheel(first, two);
  const between: [Pair, Pair] = [one.at, two.at];
  const gears = placed({ at: touch, links: [a, b], between, part: partOf(between, touch) });
  return a === b ? null : { ...made, knots: [...made.knots, gears] };
}

/** The link of a wheel about a spot: one that turns there already, else another one, on the ground if on nothing. */
function withWheel(drawing: Drawing, spot: Spot): [Drawing, string] {
  const links = spot.knot === null ? [] : drawing.knots[spot.knot]!.links;
  const here = links.filter((link) => link !== drawing.frame).at(-1);
  if (here !== undefined) return [drawing, here];
  const name = nextName(drawing);
  if (spot.knot !== null || spot.link !== null) return [reaching(drawing, spot, name), name];
  const grounded = withGround(drawing, spot);
  return [reaching(grounded, { ...spot, knot: grounded.knots.length - 1 }, name), name];
}

/** A cylinder or gears where their ends or centres have them. */
export function placed(knot: Knot): Knot {
  const { between, part = 0.5 } = knot;
  if (!between) return knot;
  const [[x, y], [u, v]] = between;
  return { ...knot, at: [x + part * (u - x), y + part * (v - y)] };
}

function partOf([[x, y], [u, v]]: readonly [Pair, Pair], [px, py]: Pair): number {
  const part = ((px - x) * (u - x) + (py - y) * (v - y)) / ((u - x) ** 2 + (v - y) ** 2);
  if (part < 0) return Math.min(-0.05, part);
  return part > 1 ? Math.max(1.05, part) : Math.min(0.95, Math.max(0.05, part));
}

/** Move a knot, and nothing else. */
export function movedAlone(drawing: Drawing, number: number, at: Pair): Drawing {
  return { ...drawing, knots: replaced(drawing.knots, number, { ...drawing.knots[number]!, at }) };
}

/** Move a knot, and what lies at the same place, such as the slide of a block; gears get another ratio. */
export function moved(drawing: Drawing, number: number, at: Pair): Drawing {
  const [x, y] = drawing.knots[number]!.at;
  const here = (place: Pair) => place[0] === x && place[1] === y;
  const to = (place: Pair) => (here(place) ? at : place);
  const knots = drawing.knots.map((knot, k) => {
    const { between, part } = knot;
    if (!between) return { ...knot, at: to(knot.at) };
    if (k === number) return placed(part === undefined ? knot : { ...knot, part: partOf(between, at) });
    return placed({ ...knot, between: [to(between[0]), to(between[1])] });
  });
  return { ...drawing, knots };
}

/** One joint out of two knots; null where a link would meet itself. */
export function joined(before: Drawing, one: number, other: number): Drawing | null {
  const drawing = moved(before, one, before.knots[other]!.at);
  const [first, second] = [drawing.knots[one]!, drawing.knots[other]!];
  if (one === other || !isPin(first) || !isPin(second)) return null;
  if (first.links.some((link) => second.links.includes(link))) return null;
  const links = [...second.links, ...first.links];
  return without({ ...drawing, knots: replaced(drawing.knots, other, { ...second, links }) }, one);
}

/** Separate the links of a joint: each gets an end of its own, a step apart. */
export function split(drawing: Drawing, number: number, step: number): Drawing {
  const { at, links } = drawing.knots[number]!;
  const ends = links.map((link, k): Knot => ({ at: [at[0] + k * step, at[1]], links: [link] }));
  const rest = without(drawing, number);
  return { ...rest, knots: [...rest.knots, ...ends] };
}

/** Without a knot; links that have no other vanish, the other knots are called as before. */
export function without(drawing: Drawing, number: number): Drawing {
  const drives = drawing.drives.filter((k) => k !== number).map((k) => (k > number ? k - 1 : k));
  const knots = drawing.knots.map((knot, k) => ({ ...knot, letter: knotName(drawing, k) }));
  return { ...drawing, drives, knots: knots.filter((_, k) => k !== number) };
}

/** Without a link: its joints keep their other links, its open ends vanish. */
export function withoutLink(drawing: Drawing, link: string): Drawing {
  let out: Drawing = { ...drawing, frame: drawing.frame === link ? null : drawing.frame };
  for (let k = drawing.knots.length - 1; k >= 0; k--) {
    const knot = drawing.knots[k]!;
    if (!knot.links.includes(link)) continue;
    const links = knot.links.filter((one) => one !== link);
    if (links.length === 0 || !isPin(knot)) out = without(out, k);
    else {
      const drives = links.length > 1 ? out.drives : out.drives.filter((one) => one !== k);
      out = { ...out, drives, knots: replaced(out.knots, k, { ...knot, links }) };
    }
  }
  return out;
}

/** What is left of a drawing after a change, without links that lost all of their knots but one. */
export function withoutLoose(before: Drawing, after: Drawing): Drawing {
  const knotsOf = ({ knots }: Drawing, link: string) => knots.filter(({ links }) => links.includes(link)).length;
  const loose = linksOf(after).find(
    (link) => link !== after.frame && knotsOf(after, link) < 2 && knotsOf(before, link) > 1,
  );
  return loose === undefined ? after : withoutLoose(before, withoutLink(after, loose));
}

/** Whether links may be called so. */
export function isName(text: string): boolean {
  return /^[\p{L}\d_]+$/u.test(text);
}

/** With another name of a link; null if it is no name, or taken. */
export function renamed(drawing: Drawing, link: string, name: string): Drawing | null {
  if (!isName(name) || (name !== link && linksOf(drawing).includes(name))) return null;
  const change = (one: string) => (one === link ? name : one);
  return {
    ...drawing,
    frame: drawing.frame === null ? null : change(drawing.frame),
    knots: drawing.knots.map((knot) => ({ ...knot, links: knot.links.map(change) })),
  };
}

/** With another name of a knot; null if it is none, or that of a link or of another knot. */
export function called(drawing: Drawing, number: number, name: string): Drawing | null {
  const taken = [...linksOf(drawing), ...drawing.knots.map((_, k) => (k === number ? "" : knotName(drawing, k)))];
  if (!isName(name) || taken.includes(name)) return null;
  const old = knotName(drawing, number);
  const change = (one: string) => (one === old ? name : one);
  // the others keep the letters that they have
  const knots = drawing.knots.map((knot, k) =>
    k === number ? { ...knot, name } : { ...knot, letter: knotName(drawing, k) },
  );
  const locks = drawing.locks?.map(([kind, ...ends]): Keep => [kind, ...ends.map(change).sort()]);
  return { ...drawing, knots, ...(locks && { locks }) };
}

/** Let a joint be driven, or not. */
export function driven(drawing: Drawing, number: number): Drawing {
  const { drives } = drawing;
  return { ...drawing, drives: drives.includes(number) ? drives.filter((k) => k !== number) : [...drives, number] };
}

/** The distances of the joints of links that have two. */
export function lengthsOf(drawing: Drawing): number[] {
  return linksOf(drawing).flatMap((link) => {
    const [one, two, three] = drawing.knots.filter((knot) => knot.links.includes(link) && isPin(knot));
    return one && two && !three ? [away(one.at, ...two.at)] : [];
  });
}

/** With a point whose curve is shown, in the middle of a link that is not on the frame, or of two of its joints where a
 * joint is there: of one beside a drive, else of the first; as it is if there is a point. */
export function traced(drawing: Drawing): Drawing {
  const { drives, frame, knots } = drawing;
  if (knots.some(({ links }) => !links[1] && links[0] !== frame)) return drawing;
  const pinsOf = (one: string) => knots.filter((knot) => isPin(knot) && knot.links.includes(one));
  const meets = (one: string, others: readonly string[]) =>
    pinsOf(one).some(({ links }) => others.some((other) => links.includes(other)));
  const afloat = linksOf(drawing).filter((one) => pinsOf(one)[1] && !meets(one, [frame!]));
  const driving = drives.flatMap((k) => knots[k]!.links);
  const carrier = afloat.find((one) => meets(one, driving)) ?? afloat[0];
  if (!carrier) return drawing;
  const pins = pinsOf(carrier).map((knot) => knot.at);
  const spots = [middleOf(pins), ...pins.map((pin) => middleOf([pin, pins[0]!]))];
  const clear = (spot: Pair) => pins.every((pin) => away(pin, ...spot) > 0.1 * away(pins[0]!, ...pins[1]!));
  const at = spots.find(clear) ?? spots[0]!;
  return { ...drawing, knots: [...knots, { at, links: [carrier], name: "K1" }] };
}

/** What a joint is called in the text of the chain. */
export function jointName({ knots }: Drawing, number: number): string {
  const knot = knots[number]!;
  const sign = knot.part === undefined ? "P" : "G";
  return `${isPin(knot) ? "R" : sign}(${knot.links.join("-")})`;
}

/** A driven joint in the text of the chain: of three links and more it moves the first one beside the frame. */
function driveName(drawing: Drawing, number: number): string {
  const { links } = drawing.knots[number]!;
  const own = links.find((link) => link === drawing.frame) ?? links[0];
  const way = links.length > 2 ? `:${own}-${links.find((link) => link !== own)}` : "";
  return jointName(drawing, number) + way;
}

/** The document of the linkage, which the library reads; open ends are named points of their links. */
export function documentOfDrawing(drawing: Drawing): LinkageDocument {
  const joints = jointsOf(drawing);
  const name = (k: number) => jointName(drawing, k);
  const ends = [...drawing.knots.entries()].filter(
    ([, { links, name: own }]) => !links[1] && (own || links[0] !== drawing.frame),
  );
  const beside = {
    ...drawing.beside,
    ...locksOf(drawing),
    ...(drawing.picture && drawing.keeps && { picture: drawing.picture }),
    letters: joints.map((k) => knotName(drawing, k)).join(" "),
  };
  return {
    unit: unitOf(drawing),
    joints: joints.map(name).join(" "),
    links: linksOf(drawing),
    ...(drawing.frame === null ? {} : { frame: drawing.frame }),
    drives: drawing.drives.map((k) => driveName(drawing, k)),
    page: beside,
    places: Object.fromEntries(
      joints.map((k) => {
        return [name(k), placeOf(drawing, drawing.knots[k]!)];
      }),
    ),
    points: Object.fromEntries(
      ends.map(([k, { at, links }]) => [knotName(drawing, k), { link: links[0]!, at: [...at] }]),
    ),
  };
}

/** What stays, by the names of links and joints; what is kept of open ends stays in the drawing only. */
function locksOf(drawing: Drawing): Beside {
  const { knots, locks = [] } = drawing;
  const numbers = new Map(jointsOf(drawing).map((k) => [knotName(drawing, k), k]));
  const made = locks.flatMap(([kind, ...ends]): Lock[] => {
    const [one, two] = ends.map((end) => numbers.get(end)) as [number?, number?];
    if (one === undefined) return [];
    if (kind === "joint") return [[kind, jointName(drawing, one)]];
    const link = two === undefined ? undefined : knots[one]!.links.find((own) => knots[two]!.links.includes(own));
    return link === undefined ? [] : [[kind, link, jointName(drawing, one), jointName(drawing, two!)]];
  });
  return made[0] ? { locks: made } : {};
}

/** Where a joint lies, as the document has it: a pin, a slide with its direction, two wheels with their radii. */
function placeOf({ drives, frame, knots }: Drawing, { at, between, links, part, slide }: Knot): unknown {
  if (slide !== undefined) {
    // on the ground its way is counted from beside the pivot of the drive
    const pivot = knots[drives[0]!];
    const along: Pair = [at[0] + Math.cos(slide * DEGREE), at[1] + Math.sin(slide * DEGREE)];
    const grounded = pivot && [pivot.links, links].every((one) => one.includes(frame!));
    return [...(grounded ? onLine(at, along, pivot.at) : at), slide];
  }
  if (!between) return [...at];
  const [from, to] = between;
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  if (part === undefined) return [...from, Math.atan2(dy, dx) / DEGREE];
  const far = Math.hypot(dx, dy);
  const side = part < 0 || part > 1 ? -far : far; // the larger of two on one side is internal: a negative radius
  const radii = [part * side, side - part * side];
  return Object.fromEntries(links.map((link, k) => [link, { at: [...between[k]!], radius: radii[k] }]));
}
