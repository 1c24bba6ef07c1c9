/** The texts of the page in the reader's language; in the sources the English ones stand for them. */

import { textOf } from "./packed";

export type Language = "en" | "de";

/** All English texts, then the German ones in the same order. */
let texts: string[] = [];

let language: Language = "en";

/** Take the texts, once, before anything is said: they stand packed beside the script, and build.mjs numbers them. */
export async function loadTexts(packed: string): Promise<void> {
  texts = (await textOf(packed)).split("\n");
}

export function setLanguage(chosen: Language): void {
  language = chosen;
}

/** The language asked for, else that of the browser, as far as there is one. */
export function firstLanguage(wanted: string): Language {
  return (wanted || navigator.language).startsWith("de") ? "de" : "en";
}

export function currentLanguage(): Language {
  return language;
}

/** A text in the reader's language; gaps are written {name}. In the built page its number stands for it (build.mjs). */
export function t(text: string | number, values: Record<string, string | number> = {}): string {
  const at = typeof text === "number" ? text : texts.indexOf(text);
  const said = texts[language === "de" && at >= 0 ? at + texts.length / 2 : at] ?? String(text);
  return said.replace(/\{(\w+)\}/g, (gap, name: string) => (name in values ? String(values[name]) : gap));
}

/** An angle in degrees; what is below a millionth of a degree is rounding. */
export function angle(radians: number, digits = 4): string {
  return `${number(Math.round((radians * 180e6) / Math.PI) / 1e6, digits)}°`;
}

/** A number with so many significant digits, a minus sign as long as the plus, and the decimal sign of the language. */
export function number(value: number, digits = 4): string {
  return Number.isFinite(value) ? written(String(Number(value.toPrecision(digits)) + 0)) : "–";
}

/** A number with so many places after the decimal sign. */
export function fixed(value: number, places: number): string {
  return written((Number(value.toFixed(places)) + 0).toFixed(places));
}

function written(digits: string): string {
  const text = digits.replaceAll("-", "−");
  return language === "de" ? text.replace(".", ",") : text;
}

/** A name as it is read: in documents it has no spaces. */
export function spaced(name: string): string {
  return name.replaceAll("_", " ").replace(/(\p{L}{3})(\d+)\b/gu, "$1 $2");
}

/** The letters of joints, as of the group 3-RR, as the reader writes them: in German D turns and S slides. */
export function inLetters(letters: string): string {
  const known = language === "de" && /^[\d-]*[RPG]+$/.test(letters);
  return known ? letters.replaceAll("R", "D").replaceAll("P", "S") : letters;
}

/** A number that a reader typed, with a comma or a point; NaN if it is none. */
export function parsed(typed: string): number {
  const text = typed.replaceAll("−", "-");
  return /^\s*-?[\d.,]+(e-?\d+)?\s*$/i.test(text) ? Number(text.replace(",", ".")) : NaN;
}
