/** The catalog of a static site. */

import type { Language } from "../language";

export interface Machine {
  entries: Record<Language, { id: string; text: string }>;
  /** In English alone where languages do not differ. */
  pictures: Partial<Record<Language, string>> & { en: string };
  text: string;
  pairs: string[];
  features: Record<string, unknown> & {
    joints_by_pair: Record<string, number>;
    links_by_joints: Record<string, number>;
  };
}

export interface Catalog {
  machines: Machine[];
  /** What each kind of joint is called: those of the plane first. */
  symbols: Record<string, string[]>;
}

const ASKED_BY_NUMBER = [
  "links",
  "mobility",
  "drive_joints",
  "drive_joints_at_frame",
  "output_links",
  "output_links_at_frame",
  "multiple_joints",
];

/** A word as it is looked for (`gruebler.teaching.catalog.loader.plain_word`). */
function plainWord(word: string): string {
  return word
    .toLowerCase()
    .replaceAll("ß", "ss")
    .normalize("NFKD")
    .replace(/[-‐‑–'’\p{M}]/gu, "");
}

/** The machines that fit what is asked (`gruebler.page.params.ListCatalog`), first those that are called so. */
export function fitting({ machines, symbols }: Catalog, asked: Record<string, unknown>): Machine[] {
  const parts = (key: string, by: RegExp) =>
    String(asked[key] ?? "")
      .split(by)
      .filter(Boolean);
  const meanings = (symbol: string) => Object.keys(symbols).filter((name) => symbols[name]!.includes(symbol));
  const kinds: [string, number][] = [];
  for (const part of parts("joints", /,/)) {
    const [, symbol, number] = /^\s*(\S+?)\s*:\s*(\d+)\s*$/.exec(part) ?? [];
    const [name] = meanings(symbol ?? "");
    if (!name) throw new RangeError(part);
    kinds.push([name, Number(number)]);
  }
  const words = parts("words", /\s+/).map(plainWord);
  const wanted = parts("pairs", /\s+/).map(meanings);
  const same = (found: unknown, key: string) => asked[key] === undefined || asked[key] === (found ?? 0);
  const fit = machines.filter(
    ({ text, pairs, features }) =>
      words.every((word) => text.includes(word)) &&
      wanted.every((names) => names.some((name) => pairs.includes(name))) &&
      kinds.every(([name, number]) => (features.joints_by_pair[name] ?? 0) === number) &&
      ASKED_BY_NUMBER.every((key) => same(features[key], key)) &&
      same(features.links_by_joints[2], "binary") &&
      same(features.links_by_joints[3], "ternary"),
  );
  // by id and names (`gruebler.teaching.catalog.loader.search`)
  const isCalled = ({ text }: Machine) => {
    const called = text
      .split("\n")
      .slice(0, 3)
      .join("\n")
      .split(/[\s_]+/);
    return words.every((word) => called.some((one) => one.startsWith(word)));
  };
  return [...fit.filter(isCalled), ...fit.filter((one) => !isCalled(one))];
}
