/** A mechanism that is being drawn: places where links meet. Every change makes another drawing; nothing here knows the
 * browser. The library makes a linkage of its document. */

import { t } from "./language";
import type { LinkageDocument } from "./model";
import type { Pair } from "./rows";

/** A place of one or more links: a joint of two or more, an open end of one. */
export interface Knot {
  readonly at: Pair;
  readonly links: readonly string[];
  /** Of a slide its direction, in degrees; joints that turn have none. */
  readonly slide?: number;
}

export interface Drawing {
  readonly knots: readonly Knot[];
  readonly frame: string | null;
  /** Knots that are driven. */
  readonly drives: readonly number[];
}

/** Where something is put: at a knot, on a link, or beside all of them. */
export interface Spot {
  readonly at: Pair;
  readonly knot: number | null;
  readonly link: string | null;
}

export const EMPTY: Drawing = { knots: [], frame: null, drives: [] };

/** The links in the order in which they were drawn. */
export function linksOf(drawing: Drawing): string[] {
  const all = drawing.frame === null ? [] : [drawing.frame];
  return [...new Set([...all, ...drawing.knots.flatMap((knot) => knot.links)])];
}

/** The joints: knots of at least two links. */
export function jointsOf({ knots }: Drawing): number[] {
  return [...knots.keys()].filter((k) => knots[k]!.links.length > 1);
}

/** The formula of Grübler: each joint of k links takes 2(k - 1) freedoms. */
export function counted(drawing: Drawing): number {
  const taken = jointsOf(drawing).reduce((sum, k) => sum + 2 * (drawing.knots[k]!.links.length - 1), 0);
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

/** Two links with a joint between them. */
export function withDyad(drawing: Drawing, from: Spot, middle: Spot, to: Spot): Drawing {
  const one = withLink(drawing, from, { ...middle, knot: null, link: null });
  return withLink(one, { ...middle, knot: one.knots.length - 1, link: null }, to);
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

/** Move a knot, and what lies at the same place, such as the slide of a block. */
export function moved(drawing: Drawing, number: number, at: Pair): Drawing {
  const [x, y] = drawing.knots[number]!.at;
  const same = (knot: Knot) => knot.at[0] === x && knot.at[1] === y;
  return { ...drawing, knots: drawing.knots.map((knot) => (same(knot) ? { ...knot, at } : knot)) };
}

/** One joint out of two knots; null where a link would meet itself. */
export function joined(drawing: Drawing, one: number, other: number): Drawing | null {
  const [first, second] = [drawing.knots[one]!, drawing.knots[other]!];
  if (one === other || first.slide !== undefined || second.slide !== undefined) return null;
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

/** Without a knot; links that have no other vanish. */
export function without(drawing: Drawing, number: number): Drawing {
  const drives = drawing.drives.filter((k) => k !== number).map((k) => (k > number ? k - 1 : k));
  return { ...drawing, drives, knots: drawing.knots.filter((_, k) => k !== number) };
}

/** Without a link: its joints keep their other links, its open ends vanish. */
export function withoutLink(drawing: Drawing, link: string): Drawing {
  let out: Drawing = { ...drawing, frame: drawing.frame === link ? null : drawing.frame };
  for (let k = drawing.knots.length - 1; k >= 0; k--) {
    const knot = drawing.knots[k]!;
    if (!knot.links.includes(link)) continue;
    const links = knot.links.filter((one) => one !== link);
    if (links.length === 0 || knot.slide !== undefined) out = without(out, k);
    else {
      const drives = links.length > 1 ? out.drives : out.drives.filter((one) => one !== k);
      out = { ...out, drives, knots: replaced(out.knots, k, { ...knot, links }) };
    }
  }
  return out;
}

/** With another name of a link; null if it is no name, or taken. */
export function renamed(drawing: Drawing, link: string, name: string): Drawing | null {
  if (!/^[\p{L}\d_]+$/u.test(name) || (name !== link && linksOf(drawing).includes(name))) return null;
  const change = (one: string) => (one === link ? name : one);
  return {
    ...drawing,
    frame: drawing.frame === null ? null : change(drawing.frame),
    knots: drawing.knots.map((knot) => ({ ...knot, links: knot.links.map(change) })),
  };
}

/** Let a joint be driven, or not. */
export function driven(drawing: Drawing, number: number): Drawing {
  const { drives } = drawing;
  return { ...drawing, drives: drives.includes(number) ? drives.filter((k) => k !== number) : [...drives, number] };
}

/** What a joint is called in the text of the chain. */
export function jointName({ knots }: Drawing, number: number): string {
  const { links, slide } = knots[number]!;
  return `${slide === undefined ? "R" : "P"}(${links.join("-")})`;
}

/** The document of the linkage, which the library reads; open ends are named points of their links. */
export function documentOfDrawing(drawing: Drawing, unit: string): LinkageDocument {
  const joints = jointsOf(drawing);
  const name = (k: number) => jointName(drawing, k);
  const ends = drawing.knots.filter(({ links }) => links.length === 1 && links[0] !== drawing.frame);
  return {
    unit,
    joints: joints.map(name).join(" "),
    links: linksOf(drawing),
    ...(drawing.frame === null ? {} : { frame: drawing.frame }),
    drives: drawing.drives.map(name),
    places: Object.fromEntries(
      joints.map((k) => {
        const { at, slide } = drawing.knots[k]!;
        return [name(k), slide === undefined ? [...at] : [...at, slide]];
      }),
    ),
    points: Object.fromEntries(ends.map(({ at, links }, k) => [`K${k + 1}`, { link: links[0]!, at: [...at] }])),
  };
}
