/** The curves as a table in CSV: the drive, the output and the points, with their derivatives.
 *
 * Spreadsheets in German want semicolons, decimal commas and a byte order mark. */

import { currentLanguage } from "./language";
import type { Linkage } from "./linkage";
import { output, outputAlong, transmission } from "./measures";
import { place } from "./rows";
import { lengthUnit } from "./wording";

export function tableOf(linkage: Linkage): string {
  const { cycle, model } = linkage;
  const comma = currentLanguage() === "de";
  const cell = (x: number) => (Number.isFinite(x) ? String(x).replace(".", comma ? "," : ".") : "");
  const { points } = linkage.sizes;
  const turning = linkage.drive?.turning ?? true;
  const record = model.outputs[0];
  const head = [turning ? "drive_deg" : `drive_${lengthUnit(model)}`];
  if (record) head.push("output", "output_velocity", "output_acceleration", "transmission_angle_deg");
  for (const { name } of points) head.push(`${name}_x`, `${name}_y`, `${name}_vx`, `${name}_vy`);
  const outputs = outputAlong(linkage, [...cycle.values.keys()]);
  const lines = Array.from(cycle.values, (value, row) => {
    const line = [turning ? degrees(value) : value];
    if (record) {
      const psi = outputs[row]!;
      line.push(record.joint === null ? degrees(psi) : psi);
      line.push(...[1, 2].map((order) => output(linkage, cycle.rows, row, order)));
      line.push(degrees(transmission(linkage, cycle.rows, row)));
    }
    for (const { link, at } of points)
      line.push(...place(cycle.rows, row, link, ...at), ...place(cycle.rows, row, link, ...at, 1));
    return line.map(cell).join(comma ? ";" : ",");
  });
  return `${comma ? "\ufeff" : ""}${[head.map(quoted).join(comma ? ";" : ","), ...lines].join("\n")}\n`;
}

function degrees(angle: number): number {
  return (angle * 360) / (2 * Math.PI);
}

/** A text as a cell: in quotation marks if it needs them. */
export function quoted(text: string): string {
  return /[",;]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}
