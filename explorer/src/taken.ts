/** A linkage as a drawing: its joints where they are now, its links, drives and points; and a drawing as a linkage. */

import type { Beside } from "./beside";
import { DEGREE } from "./cycle";
import { savedDocument } from "./document";
import {
  type Drawing,
  documentOfDrawing,
  EMPTY,
  isName,
  jointsOf,
  type Keep,
  type Knot,
  knotName,
  linksOf,
  placed,
  traced,
} from "./drawing";
import { t } from "./language";
import type { Linkage } from "./linkage";
import type { Model } from "./model";
import { direction, type Pair, place } from "./rows";
import type { Page } from "./view";

/** The drawing of a linkage in the pose that is shown; without one the joints that cannot be drawn. */
export function drawingOf(linkage: Linkage): { drawing?: Drawing; other: string[] } {
  const { beside, model, pose, sizes } = linkage;
  const names = linkNames(linkage);
  const joints = model.joints.map((_, joint) => {
    const [knot, name] = [knotOf(linkage, joint, names), linkage.letterOf(joint)];
    return knot && name ? { ...knot, name } : knot;
  });
  const lacking = model.joints.flatMap(({ name }, joint) => (joints[joint] ? [] : [linkage.jointName(name)]));
  if (lacking.length) return { other: lacking };
  // names as the drawing has them
  const called = new Map<string, string>(
    model.joints.map(({ name, links }) => [name, name.replace(/\(.*\)/, `(${links.map((k) => names[k]).join("-")})`)]),
  );
  model.links.forEach((name, link) => {
    called.set(name, names[link]!);
  });
  const points = sizes.points.map(({ name: own, link, at }): Knot => {
    const name = linkage.pointName(own);
    called.set(own, name);
    return { at: place(pose, 0, link, ...at), links: [names[link]!], name };
  });
  const { bars, locks = [], picture, rulers, ...other } = beside; // numbers of links, which drawings may have otherwise
  const knots = [...(joints as Knot[]), ...points].map((knot) => ({
    ...knot,
    at: knot.at.map((value) => sizes.clean(value)) as Pair,
  }));
  const keeps = locks.map(([kind, ...held]): Keep => {
    const numbers = held.map((one) => model.joints.findIndex(({ name }) => name === one));
    const found = numbers.filter((k) => k >= 0).map((k) => knotName({ ...EMPTY, knots }, k));
    return [kind, ...found.sort()];
  });
  return {
    drawing: {
      knots,
      frame: names[model.frame]!,
      drives: model.drives.map(({ joint }) => joint),
      unit: model.unit,
      title: linkage.title,
      ...(keeps[0] && { locks: keeps }),
      beside: {
        ...other,
        ...(rulers && { rulers: rulers.map((both) => both.map((one) => called.get(one) ?? one) as [string, string]) }),
      } as Beside,
      ...(picture && { picture, keeps: true }),
    },
    other: [],
  };
}

/** The links by the names that their drawing has. */
function linkNames(linkage: Linkage): readonly string[] {
  const { links } = linkage.model;
  const shown = links.map((_, link) => linkage.linkName(link).replaceAll(" ", "_"));
  return new Set(shown).size === shown.length && shown.every(isName) ? shown : links;
}

/** A joint as the drawing has it: a pin, a slide or a cylinder, two gears; null if it is another one. */
function knotOf(linkage: Linkage, joint: number, names: readonly string[]): Knot | null {
  const { model, pose, sizes } = linkage;
  const { name, pair } = model.joints[joint]!;
  const mine = sizes.elementsOf(joint);
  const all = (kind: "pin" | "line" | "round") => mine.length > 1 && mine.every((k) => sizes.is(k, kind));
  const links = mine.map((k) => names[sizes.element(k).link]!);
  const at = linkage.jointAt(joint);
  if (mine.some((k) => sizes.element(k).link >= model.own)) return null;
  if (pair.turning && all("pin")) return { at, links };
  if (pair.sliding && all("line")) {
    const cylinder = sizes.cylinder(joint);
    if (cylinder) return placed({ at, links, between: ends(linkage, cylinder[2], cylinder[3]) });
    const [line] = mine as [number];
    const [c, s] = direction(pose, 0, sizes.element(line).link, sizes.line(line));
    return { at, links, slide: Math.atan2(s, c) / DEGREE };
  }
  if (!name.startsWith("G(") || !all("round")) return null;
  const [one, two] = mine as [number, number];
  const radius = (k: number) => {
    const held = model.document.elements?.[model.links[sizes.element(k).link]!]?.[name];
    return Number((held as { radius?: unknown } | undefined)?.radius);
  };
  const between = ends(linkage, one, two);
  const [[x, y], [u, v]] = between;
  const sum = radius(one) + radius(two);
  // a belt goes round wheels that do not touch, an elliptic wheel has no radius
  const touching = Math.abs(Math.abs(sum) - Math.hypot(u - x, v - y)) < 1e-9 * linkage.size;
  return touching ? placed({ at, links, between, part: radius(one) / sum }) : null;
}

function ends(linkage: Linkage, one: number, two: number): [Pair, Pair] {
  return [linkage.elementAt(one), linkage.elementAt(two)];
}

/** Links and joints of a linkage as its drawing calls them, from which the library tells what its loads act on now. */
function loadedBefore(linkage: Linkage | null): object | undefined {
  const { drawing } = (linkage && drawingOf(linkage)) ?? {};
  if (!drawing) return;
  const { joints, own, source } = linkage!.model;
  const letters = joints.map((_, k) => knotName(drawing, k));
  return { document: savedDocument(linkage!), source, letters, links: linkNames(linkage!).slice(0, own) };
}

/** Whether a linkage is that of a drawing, but for its sizes. */
export function isOf({ beside, model }: Linkage, drawing: Drawing): boolean {
  const own = jointsOf(drawing).map((k) => knotName(drawing, k));
  return beside.letters === own.join(" ") && `${model.links}` === `${linksOf(drawing)}`;
}

/** Let Motion show the linkage of a drawing, with the loads of what it was before, and with the curve of a point if it
 * is a new one; whether it does. */
export function openDrawn(page: Page, drawing: Drawing, before: Linkage | null): Promise<boolean> {
  const { title } = drawing;
  const document = documentOfDrawing(title === undefined ? traced(drawing) : drawing);
  const name = title ?? t("New drawing");
  const asked = page.ask<Model>("open_document", { document, name, before: loadedBefore(before) });
  return page.choose(asked, (model) => page.open({ ...model, changed: title !== undefined }));
}
