/** A linkage as `gruebler.files` reads and writes it. */

import { besideOf } from "./beside";
import type { Rows } from "./kernel";
import type { Linkage } from "./linkage";
import type { LinkageDocument } from "./model";
import { placeBlocks, readState } from "./reading";
import { Refused } from "./refused";
import { oneRow, place, putOrigin, putTurn, turn } from "./rows";
import { meshesOf, setPhases } from "./wheels";

/** The document of a linkage; its reference pose is the one that is shown, or a row of others. */
export function documentOf(linkage: Linkage, rows: Rows = linkage.pose, row = 0): LinkageDocument {
  const { model, sizes } = linkage;
  const out = structuredClone(model.document);
  const degrees = (angle: number) => (angle * 180) / Math.PI;
  model.elements.forEach((e, k) => {
    const held = out.elements![model.links[e.link]!]!;
    const joint = model.joints[e.joint]!.name;
    const at: number[] = sizes.xy(k);
    if (e.kind === "round") (held[joint] as { at: number[] }).at = at;
    else held[joint] = e.kind === "line" ? [...at, degrees(sizes.angles[k]!)] : at;
  });
  out.points = Object.fromEntries(sizes.points.map((p) => [p.name, { link: model.links[p.link]!, at: [...p.at] }]));
  delete out.home;
  delete out.page;
  out.loads = linkage.loads;
  out.reference_pose = Object.fromEntries(
    model.links.slice(0, model.own).map((name, link) => {
      const [c, s] = turn(rows, row, link);
      return [name, [...place(rows, row, link, 0, 0), degrees(Math.atan2(s, c))]];
    }),
  );
  return out;
}

/** The same with what the page keeps beside it, as it is saved. */
export function savedDocument(linkage: Linkage, pose = linkage.pose): LinkageDocument {
  const { beside } = linkage;
  return { ...documentOf(linkage, pose), ...(Object.keys(beside).length && { page: beside }) };
}

/** Take sizes and pose from the document of a linkage of the same structure. */
export function applyDocument(linkage: Linkage, document: LinkageDocument, drive?: number): void {
  const { model, sizes } = linkage;
  const degrees = Math.PI / 180;
  const pose = oneRow(linkage.pose, 0);
  const meshes = meshesOf(linkage);
  linkage.change(() => {
    linkage.beside = besideOf(document);
    linkage.loads = document.loads;
    if (drive !== undefined && Number.isFinite(drive)) linkage.drives[linkage.active] = drive;
    model.elements.forEach((e, k) => {
      const given = document.elements?.[model.links[e.link]!]?.[model.joints[e.joint]!.name];
      const raw =
        e.kind === "round"
          ? numbers((given as { at?: unknown } | undefined)?.at, 2)
          : numbers(given, e.kind === "line" ? 3 : 2);
      sizes.put(k, raw[0]!, raw[1]!);
      if (e.kind === "line") sizes.angles[k] = raw[2]! * degrees;
    });
    sizes.points = Object.entries(document.points ?? {}).map(([name, { link, at }]) => {
      const [x, y] = numbers(at, 2) as [number, number];
      const number = model.links.indexOf(link);
      if (number < 0 || number >= model.own) throw new Refused(null);
      return { name, link: number, at: [x, y] };
    });
    linkage.writeSizes();
    model.links.slice(0, model.own).forEach((name, link) => {
      const given = (document.reference_pose ?? document.home)?.[name];
      const [x, y, angle] = numbers(given, 3) as [number, number, number];
      putOrigin(pose, link, x, y);
      putTurn(pose, link, Math.cos(angle * degrees), Math.sin(angle * degrees));
    });
    placeBlocks(linkage, pose);
    readState(linkage, pose);
    setPhases(linkage, meshes, pose);
  });
}

/** So many finite numbers, or the document is refused. */
function numbers(raw: unknown, count: number): number[] {
  if (!Array.isArray(raw) || raw.length !== count) throw new Refused(null);
  // angles may have more digits than a number
  const found = raw.map((v) => (typeof v === "string" ? parseFloat(v) : v) as number);
  if (!found.every((v) => Number.isFinite(v))) throw new Refused(null);
  return found;
}
