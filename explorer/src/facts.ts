/** What is read off in the pose that is shown and over the cycle: names and values, good or bad. */

import { wrapped } from "./cycle";
import { angle, number, t } from "./language";
import type { Linkage } from "./linkage";
import { type Least, output, transmission } from "./measures";
import { driveText, placeOf } from "./wording";

/** From here on a transmission angle is good. */
const GOOD = (40 / 180) * Math.PI;

export interface Fact {
  name: string;
  text: string;
  style?: "good" | "bad";
}

/** What was found over the cycle: drive values of dead centres, the smallest transmission angle. */
export interface Found {
  dead: number[];
  least: Least | null;
}

export function factsOf(linkage: Linkage, { dead, least }: Found, inLap: (angle: number) => number): Fact[] {
  const { cycle, model, pose } = linkage;
  const facts: Fact[] = [];
  const record = model.outputs[0];
  if (record) {
    const [value, rate] = output(linkage, pose, 0);
    const text = record.joint === null ? angle(inLap(value), 5) : `${number(value, 5)} ${model.unit}`;
    facts.push({ name: t("Output {name}", { name: linkage.linkName(record.link) }), text });
    facts.push({ name: t("Velocity by the drive"), text: number(rate, 4) });
  }
  const mu = transmission(linkage, pose, 0);
  if (Number.isFinite(mu)) {
    facts.push({ name: t("Transmission angle"), text: angle(mu), style: mu < GOOD ? "bad" : "good" });
    if (least) {
      const text = `${angle(least.mu)} · ${driveText(linkage, placeOf(linkage, least.value), 4)}`;
      facts.push({ name: t("smallest"), text, style: least.mu < GOOD ? "bad" : "good" });
    }
  }
  if (linkage.drive) {
    const full = cycle.turns === 1 ? t("full turns") : t("full turns, repeats after {turns}", { turns: cycle.turns });
    const part = `${driveText(linkage, cycle.low, 5)} … ${driveText(linkage, cycle.high, 5)}`;
    facts.push({ name: t("Range of the drive"), text: cycle.full ? full : part });
  }
  if (dead.length) {
    const places = dead.map((value) => placeOf(linkage, value)).sort((a, b) => a - b);
    facts.push({ name: t("Dead centres"), text: places.map((value) => driveText(linkage, value, 5)).join(", ") });
  }
  return facts;
}

/** The value of the active drive as it is shown. */
export function driveValue(linkage: Linkage): string {
  const drive = linkage.drives[linkage.active];
  return drive === undefined ? "" : driveText(linkage, wrapped(linkage.cycle, drive), 4);
}
