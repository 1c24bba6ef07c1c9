/** The structures of a static site: what is said of a chain, with the frame and the drive that are chosen. */

import type { Structure } from "../chain";
import type { Language } from "../language";
import type { Said } from "./marks";

interface Frame {
  text: string;
  frame: string;
  /** The frame of the list that is like it. */
  like: string;
  listed: boolean;
  /** The text of the drive of the list that is like the one it is given. */
  driver: string;
  family: Said;
  picture: string;
  numbered: Record<string, string>;
  /** The picture without names, where those are long. */
  card?: string;
  /** How far it lies from the picture. */
  shift?: [number, number];
  at: [number, number][];
  outlines: Record<string, [number, number][]>;
}

/** Text, number of the frame, arrow, names of the drives with family, what they fix and the names in numbers, the one
 * of the list like it. */
type Driven = [string, number, string, Record<Language, [string[], string, string, string[]]>, string];

export interface StructurePack {
  text: string;
  code: string;
  size: number;
  name: Said;
  kinds: Said;
  names: Record<Language, string[]>;
  counted: number;
  generic: number;
  verdict: string;
  lines: Record<Language, string[]>;
  overconstrained: string[];
  rigid: string[];
  frames: Frame[];
  driven: Driven[];
}

/** A kind of joint in the plane. */
export interface Pair {
  text: string;
  /** Whether it may join more than two links. */
  group: boolean;
  said: Record<Language, [string, string]>;
}

/** The chain of a text, and what it says of frame and drives. */
export function chainOf(text: string): string {
  return text.split(";")[0]!.trim();
}

/** What is said of a text of a pack; null if neither its chain nor its frame nor its drive is there. */
export function structureOf(pack: StructurePack, text: string, lang: Language, pairs: Pair[]): Structure | null {
  const chosen = pack.driven.find(([own]) => own === text);
  const frame =
    pack.frames[
      chosen?.[1] ??
        Math.max(
          0,
          pack.frames.findIndex((one) => one.text === text),
        )
    ]!;
  if (!chosen && text !== pack.text && text !== frame.text) return null;
  const given = pack.driven.find(([own, number]) => own === frame.driver && pack.frames[number] === frame);
  const over = (drawn: string, arrow: string) => drawn.replace("</svg>", `${arrow}</svg>`);
  const joints = pack.text.match(/\w+\([^)]*\)/g) ?? [];
  const types = (joint: number) => {
    const [, now, links] = /^(\w+)(.*)$/.exec(joints[joint]!)!;
    return pairs
      .filter((pair) => pair.text === now || pair.group || links!.split("-").length === 2)
      .map((pair) => ({
        symbol: pair.said[lang][0],
        name: pair.said[lang][1],
        text: joints.map((one, k) => (k === joint ? pair.text + links : one)).join(" "),
        chosen: pair.text === now,
      }));
  };
  const card = ({ card: small, picture, shift = [0, 0] }: Frame, arrow = "") =>
    over(small ?? picture, `<g transform="translate(${shift})">${arrow}</g>`);
  const marks = Object.entries(frame.outlines).map(([name, outline]) => ({
    name,
    outline,
    overconstrained: pack.overconstrained.includes(name),
    rigid: pack.rigid.includes(name),
  }));
  return {
    text,
    code: pack.code,
    size: pack.size,
    name: pack.name[lang],
    kinds: pack.kinds[lang]!,
    chosen: frame.like,
    driver: chosen?.[4] ?? frame.driver,
    picture: over(frame.picture, (chosen ?? given)?.[2] ?? ""),
    numbered: frame.numbered,
    joints: pack.names[lang].map((name, k) => ({ name, at: frame.at[k]!, types: types(k) })),
    links: marks,
    frame: frame.frame,
    counted: pack.counted,
    generic: pack.generic,
    verdict: pack.verdict,
    lines: pack.lines[lang],
    drives: (chosen ?? given)?.[3][lang][2] ?? "",
    inversions: pack.frames
      .filter(({ listed }) => listed)
      .map((one) => ({
        text: one.text,
        frame: one.frame,
        drives: [],
        brief: [],
        family: one.family[lang],
        picture: card(one),
      })),
    driven: pack.driven
      .filter((row) => row[4] === row[0] && pack.frames[row[1]]!.frame === frame.like)
      .map(([own, number, arrow, said]) => ({
        text: own,
        frame: pack.frames[number]!.frame,
        drives: said[lang][0],
        brief: said[lang][3],
        family: said[lang][1],
        picture: card(pack.frames[number]!, arrow),
      })),
  };
}
