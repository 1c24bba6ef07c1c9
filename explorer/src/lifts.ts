/** The law of a cam's lift as fields: how far it lifts, and over which angles. */

import { t } from "./language";

/** A size of a cam or roller: its name, its value, and what the library is to be told of another one. */
export interface RoundSize {
  what: string;
  value: number;
  unit: string;
  /** Not of a size that follows from the others. */
  set?: (size: number) => Record<string, number | string>;
}

type LawField = Omit<RoundSize, "unit"> & { angle?: boolean };

/** Of "rise 20 90; dwell 60; fall 20 120; dwell" the lift and the angles; null of a law with several lifts. */
export function lawFields(law: string): LawField[] | null {
  const parts = law.split(/[;\n]/).map((part) => part.trim().split(/\s+/));
  const moves = parts.filter(([kind]) => kind === "rise" || kind === "fall");
  const rests = parts.filter(([kind]) => kind === "dwell");
  const lift = Number(moves[0]?.[1]);
  const plain = moves.length + rests.length === parts.length && moves.every((one) => Number(one[1]) === lift);
  if (!plain || !(lift > 0)) return null;
  const where = (part: string[]) => (part[0] === "dwell" ? 1 : 2);
  const written = (change: (part: string[], at: number) => string[]) => ({
    lift: parts.map((part, n) => change(part, n).join(" ")).join("; "),
  });
  const put = (part: string[], at: number, size: number) => part.map((word, n) => (n === at ? String(size) : word));
  const angles = parts.map((part) => Number(part[where(part)] ?? Number.NaN));
  const rest = 360 - angles.reduce((sum, one) => sum + (one || 0), 0);
  const names: Record<string, string> = { rise: t("rise"), fall: t("fall"), dwell: t("dwell") };
  return [
    {
      what: t("lift"),
      value: lift,
      set: (size) => written((part) => (part[0] === "dwell" ? part : put(part, 1, size))),
    },
    ...parts.map((part, n): LawField => {
      const open = Number.isNaN(angles[n]);
      const set = (size: number) => written((one, m) => (m === n ? put(one, where(one), size) : one));
      return { what: names[part[0]!]!, value: open ? rest : angles[n]!, angle: true, ...(!open && { set }) };
    }),
  ];
}
