/** Drive values and ends of a motion in words. */

import { type Stop, wrapped } from "./cycle";
import { t } from "./language";
import type { Linkage } from "./linkage";
import { isAngle } from "./measures";
import type { Model } from "./model";
import type { Refused } from "./refused";
import { Status } from "./status";
import { driveText } from "./track";

/** The unit of lengths as a part of others, where none is given in words. */
export function lengthUnit({ unit }: Pick<Model, "unit">): string {
  return unit || t("length");
}

/** Where in the period an extreme lies; it is known to about a millionth of a radian. */
export function placeOf({ cycle, drive }: Linkage, value: number): number {
  const place = wrapped(cycle, value);
  return drive?.turning ? Math.round(place * 1e6) / 1e6 : place;
}

/** Why the motion ends, or why the linkage cannot be assembled. */
export function stopText(linkage: Linkage, stop: Stop): string {
  const drives = driveText(linkage, stop.value);
  const values = { drives, form: linkage.jointName(stop.form), links: linkage.linkList(stop.links) };
  if (stop.status === "open") return t("The motion ends at {drives}: there {form} is open.", values);
  if (stop.status === Status.START)
    return t("With these sizes the joints of {links} do not meet at {drives}; nothing was changed.", values);
  if (stop.status === Status.SINGULAR)
    return t("The motion ends at {drives}: there two assembly modes of {links} meet.", values);
  if (stop.status === Status.GIVEN_UP) return t("The motion was given up at {drives}.", values);
  return t("The motion ends at {drives}: there the joints of {links} no longer meet.", values);
}

/** Why sizes were refused at a drive value. */
export function refusedText(linkage: Linkage, { reason, stop }: Refused, value: number): string {
  if (stop) return stopText(linkage, { ...stop, status: Status.START, value });
  if (reason === "near") return t("Two joints of a link cannot lie in one place.");
  return reason ? t("What is kept does not allow it.") : t("This size is not possible.");
}

/** The unit of the first or second derivative of the output by the drive; nothing if there is none. */
export function rateUnit(linkage: Linkage, order: 1 | 2, turning = isAngle(linkage)): string {
  const { drive, model } = linkage;
  const unit = lengthUnit(model);
  const above = turning ? "rad" : unit;
  const below = drive?.turning ? "rad" : unit;
  if (above === below) return order === 1 ? "" : `1/${below}`;
  return `${above}/${below}${order === 1 ? "" : "²"}`;
}

/** A unit behind a title; nothing if there is none. */
export function inBrackets(unit: string): string {
  return unit && ` [${unit}]`;
}

/** The first or second derivative of the output by the drive. */
export function transferName(linkage: Linkage, order: 1 | 2): string {
  return t("Transfer function {sign}", { sign: (isAngle(linkage) ? "ψ" : "s") + "′″"[order - 1] });
}
