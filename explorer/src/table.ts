/** The motion as a table in CSV, under the headers of `gruebler analyse`: the drive, the output and the points, with
 * their derivatives by the drive.
 *
 * Spreadsheets in German want semicolons, decimal commas and a byte order mark. */

import { DEGREE, TURN, wrapped } from "./cycle";
import type { Rows } from "./kernel";
import { currentLanguage, t } from "./language";
import type { Linkage } from "./linkage";
import { isAngle, output, transmission, unwrapped } from "./measures";
import { valueAt } from "./plot";
import { type Pair, place } from "./rows";
import { inBrackets, lengthUnit, rateUnit } from "./wording";

const STEPS = 360; // of a turn or of a range
const DIGITS = 6;
const NOISE = 9; // places behind the point: what is left there is rounding

/** A further one: its name, its unit, and its values at places of the drive. */
export type Column = [name: string, unit: string, drives: Float64Array, values: Float64Array];

export function tableOf(linkage: Linkage, more: readonly Column[] = []): string {
  const { drive, model, sizes } = linkage;
  const comma = currentLanguage() === "de";
  const columns: [name: string, unit: string, values: ArrayLike<number>][] = [];
  const { home, values } = evenSteps(linkage);
  const all = Array.from(values, (value) => linkage.at(value));
  const read = (of: (rows: Rows) => number) => Float64Array.from(all, (rows) => (rows ? of(rows) : NaN));
  const length = lengthUnit(model);
  /** An angle or a length. */
  const add = (name: string, own: Float64Array, turning: boolean) =>
    columns.push([name, turning ? "°" : length, turning ? own.map((angle) => angle / DEGREE) : own]);
  if (drive) add(linkage.jointSymbol(drive.name), values, drive.turning);
  const record = model.outputs[0];
  if (record) {
    const turning = isAngle(linkage);
    const name = linkage.linkName(record.link);
    const own = read((rows) => output(linkage, rows, 1));
    add(name, turning ? unwrapped(own, home) : own, turning);
    for (const order of [1, 2] as const)
      columns.push([
        name + "′".repeat(order),
        rateUnit(linkage, order),
        read((rows) => output(linkage, rows, 1, order)),
      ]);
    if (record.legs.length)
      add(
        t("Transmission angle μ"),
        read((rows) => transmission(linkage, rows, 1)),
        true,
      );
  }
  for (const { link, at, name } of sizes.points)
    for (const order of [0, 1, 2] as const)
      for (const axis of [0, 1] as const)
        columns.push([
          `${linkage.pointName(name)} ${["", "v", "a"][order]}${"xy"[axis]}`,
          order ? rateUnit(linkage, order, false) : length,
          read((rows) => place(rows, 1, link, ...at, order)[axis]),
        ]);
  for (const [name, unit, ...own] of more) columns.push([name, unit, values.map((value) => valueAt(...own, value))]);
  const cell = (x: number) => {
    const text = Number.isFinite(x) ? String(Number(Number(x.toFixed(NOISE)).toPrecision(DIGITS)) + 0) : "";
    return comma ? text.replace(".", ",") : text;
  };
  const head = columns.map(([name, unit]) => quoted(name + inBrackets(unit)));
  const lines = all.map((_, row) => columns.map((column) => cell(column[2][row]!)));
  return `${comma ? "\ufeff" : ""}${[head, ...lines].map((one) => one.join(comma ? ";" : ",")).join("\n")}\n`;
}

/** Values of the drive from where its range begins, a whole turn from 0 on; and which is next to the pose from which
 * the cycle was found. */
function evenSteps({ cycle }: Linkage): { values: Float64Array; home: number } {
  const { full, turns } = cycle;
  const [low, high]: Pair = full ? [0, turns * TURN] : [cycle.values[0]!, cycle.values.at(-1)!];
  const steps = full ? turns * STEPS : STEPS;
  const at = (k: number) => low + ((high - low) * k) / steps;
  const values = Float64Array.from({ length: full ? steps : steps + 1 }, (_, k) => at(k));
  const here = wrapped(cycle, cycle.values[cycle.home]!);
  return { values, home: values.findIndex((value) => value >= here) };
}

/** A text as a cell: in quotation marks if it needs them. */
export function quoted(text: string): string {
  return /[",;]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}
