/** Marks of answers, as `gruebler.teaching.exercises.grade` gives them. */

import type { Language } from "../language";

export type Said = Record<Language, string>;

export interface Answer {
  mark: "right" | "near" | "wrong";
  hint: string;
}

/** A number that is asked for. */
export interface Asked {
  value: number;
  whole: boolean;
  unit: string;
  /** The units in which it may be given, in terms of its own. */
  units: Record<string, number>;
  /** Values of likely mistakes of this task, and of those possible with any measured number, with their hints. */
  mistakes: [number, Said][];
  common: [number, Said][];
  near: Said;
  /** What helps with any other wrong answer. */
  way: Said;
}

export interface Tolerances {
  fine: number;
  nearly: number;
}

interface Given {
  number: number;
  /** The value of one unit of the last written digit. */
  place: number;
}

/** The number of an answer such as 7,2 cm; null if it is none, or in a unit of another kind. */
function given(text: string, units: Record<string, number>): Given | null {
  const form = /^\s*([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d{1,2})?)\s*(.*?)\s*$/.exec(text);
  if (!form) return null;
  const written = form[1]!.replace(",", ".");
  const unit = form[2]!.replace(/ /g, "").replace(/\^?2$/, "²");
  const scale = unit ? (units[unit] ?? units[unit.toLowerCase()]) : 1;
  if (scale === undefined) return null;
  const [digits, exponent] = written.toLowerCase().split("e");
  const places = digits!.split(".")[1]?.length ?? 0;
  return { number: Number(written) * scale, place: 10 ** (Number(exponent ?? 0) - places) * scale };
}

export function marked(asked: Asked, answer: string, lang: Language, { fine, nearly }: Tolerances): Answer | null {
  const read = given(answer, asked.units);
  if (!read) return null;
  const { number, place } = read;
  const mark = (value: number): Answer["mark"] => {
    const [off, size] = [Math.abs(number - value), Math.abs(value)];
    if (asked.whole) return off === 0 ? "right" : "wrong";
    const rounded = off <= 0.5 * place * (1 + 1e-9) && off <= nearly * size;
    if (off <= fine * size || rounded || off < 1e-9) return "right";
    const whole = Math.abs(value - Math.round(value)) <= 1e-9 * size; // but for rounding
    return off <= nearly * size && !whole ? "near" : "wrong";
  };
  const exactly = ([value]: [number, Said]) =>
    Math.abs(number - value) <= 1e-5 * Math.abs(value) && Math.abs(number - asked.value) > fine * Math.abs(asked.value);
  const found = mark(asked.value);
  if (found === "right" && (asked.whole || !asked.mistakes.some(exactly))) return { mark: found, hint: "" };
  const mistake = [...asked.mistakes, ...asked.common].find(([value]) => mark(value) === "right");
  if (mistake) return { mark: "wrong", hint: mistake[1][lang] };
  return { mark: found, hint: found === "near" ? asked.near[lang] : asked.way[lang] };
}
