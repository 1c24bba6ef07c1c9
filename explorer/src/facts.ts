/** What is read off in the pose that is shown and over the cycle: names and values, good or bad. */

import { DEGREE, TURN, wrapped } from "./cycle";
import { angle, number, t } from "./language";
import type { Linkage } from "./linkage";
import { type DeadCentre, isAngle, type Least, output, stillRate, transmission } from "./measures";
import { readingsOf } from "./rulers";
import { driveText } from "./track";
import { placeOf, rateUnit, transferName } from "./wording";

/** From here on a transmission angle is good. */
export const GOOD = 40 * DEGREE;

export interface Fact {
  name: string;
  text: string;
  style?: "good" | "bad" | "wide";
  /** Where it is so. */
  note?: string | undefined;
  /** Of a way along a guide, which the picture draws: from where it is measured. */
  hint?: string | undefined;
}

/** What was found over the cycle: dead centres, how far the output goes, the smallest transmission angle. */
export interface Found {
  dead: DeadCentre[];
  travel: number | null;
  /** Of a link that does not turn: how far its points go. */
  shift?: number;
  least: Least | null;
}

export function factsOf(
  linkage: Linkage,
  { dead, least, shift, travel }: Found,
  inLap: (angle: number) => number,
): Fact[] {
  const { cycle, model, pose } = linkage;
  const facts: Fact[] = [];
  const record = model.outputs[0];
  const turning = isAngle(linkage);
  const by = (drive: number) => (model.drives[1] ? `: ${linkage.driveName(drive)}` : "");
  const of = by(linkage.active);
  const size = (value: number) => (turning ? angle(value) : `${number(linkage.sizes.clean(value))} ${model.unit}`);
  if (record) {
    const value = output(linkage, pose, 0);
    const text = size(turning ? inLap(value) : value);
    const hint = turning ? undefined : t("Measured along the guide, from the dot in the picture");
    facts.push({ name: t("Output {name}", { name: linkage.linkName(record.link) }), text, hint });
    const rate = output(linkage, pose, 0, 1);
    facts.push({
      name: transferName(linkage, 1) + of,
      text: number(travel === 0 || Math.abs(rate) < stillRate(linkage) ? 0 : rate),
      note: rateUnit(linkage, 1),
    });
    const [one, two] = dead;
    if (shift) facts.push({ name: t("Travel of its points"), text: `${number(shift)} ${model.unit}` });
    else if (travel !== null) facts.push({ name: (turning ? t("Swing") : t("Stroke")) + of, text: size(travel) });
    if (one && two && !dead[2] && cycle.full) {
      const part = Math.abs(wrapped(cycle, one.value) - wrapped(cycle, two.value));
      const rest = cycle.turns * TURN - part;
      facts.push({ name: t("Time ratio"), text: number(Math.max(part, rest) / Math.min(part, rest)) });
    }
  }
  const mu = transmission(linkage, pose, 0);
  if (Number.isFinite(mu)) {
    facts.push({ name: t("Transmission angle μ"), text: angle(mu), style: mu < GOOD ? "bad" : "good" });
    if (least) {
      const where = placeOf(linkage, least.value);
      const tenth = DEGREE / 10;
      const place = driveText(linkage, linkage.drive?.turning ? Math.round(where / tenth) * tenth : where);
      // of four links it is no question which one pushes
      const link = model.own > 4 && least.leg?.links.map((one) => linkage.linkName(one)).join(", ");
      let note = least.leg ? t("at {place}", { place }) : t("throughout");
      if (link) note = t("at {place}, link {link}", { place, link });
      facts.push({ name: t("Smallest μ"), text: angle(least.mu), note, style: least.mu < GOOD ? "bad" : "good" });
      if (least.leg?.cam) facts.push({ name: t("Pressure angle α"), text: `≤ ${angle(TURN / 4 - least.mu)}` });
    }
  }
  if (dead.length) {
    const places = dead.map(({ value }) => placeOf(linkage, value)).sort((a, b) => a - b);
    const name = record?.inLine ? t("Dead centres") : t("Turns back at");
    facts.push({ name, text: places.map((value) => driveText(linkage, value)).join(", ") });
  }
  for (const [k, drive] of model.drives.entries()) {
    const here = k === linkage.active;
    const [low, high] = (here ? [cycle.low, cycle.high] : model.span.stops?.[k]) ?? [];
    if (low === undefined) continue;
    const whole = here && cycle.full;
    const note = whole && cycle.turns > 1 ? t("repeats after {turns} turns", { turns: cycle.turns }) : undefined;
    // that of a slide is rounded, which may leave 4e-14
    const from = drive.turning ? angle(low) : number(linkage.sizes.clean(low));
    const part = `${from} … ${driveText({ drive, model }, high!).replace(" ", "\u00a0")}`;
    facts.push({ name: t("Range of the drive") + by(k), text: whole ? t("full turns") : part, note });
  }
  return [...facts, ...readingsOf(linkage)];
}
