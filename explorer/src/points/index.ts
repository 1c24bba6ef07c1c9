/** Four-bars through nine points, found without Python: the script of a worker that a static site starts when they are
 * asked for. It answers one question, and tells how far it is. */

import packed from "../../../core/page/motion.wasm.gz";
import type { Found } from "../designs";
import { loadKernel } from "../kernel";
import type { Model } from "../model";
import { place } from "../rows";
import { bearingTurn } from "./bearings";
import { abs, type Complex, scaled, sub } from "./complex";
import { cognatesOf, driven, moved, type Template } from "./fourbars";
import { CLASSES, type Complete, Homotopy, realRows, taskOf } from "./homotopy";
import { type Judged, judged } from "./judging";
import { pictureOf } from "./picture";
import { type Fault, faultOf } from "./soundness";

const MOST_DESIGNS = 24;
const FRAMES = 144; // of a motion, there and back if the drive does not turn fully

/** What it is asked. */
export interface Question {
  rows: [number, number][];
  crank: boolean;
  transmission: number;
  template: Template;
  /** The stored generic task and its solutions, as numbers. */
  task: number[];
  solutions: ArrayBuffer;
}

/** What it says: that it is there; how many paths of how many it has followed; what is wrong with the points; what it
 * found, how many solutions are real and how many missing. */
export type Said =
  | { ready: true }
  | { done: number; total: number }
  | { fault: Fault }
  | { found: Found; real: number; missing: number }
  | { error: string };

export async function answered(question: Question, progress: (done: number, total: number) => void) {
  const targets: Complex[] = question.rows;
  const fault = faultOf(targets);
  if (fault) return { fault };
  const homotopy = await Homotopy.from({
    task: Float64Array.from(question.task),
    solutions: Float64Array.from(new Float32Array(question.solutions)),
  });
  // the most central point as origin, where the equations cancel least; else the next
  const away = targets.map((from) => targets.reduce((sum, one) => sum + abs(sub(one, from)), 0) / targets.length);
  const central = targets.map((_, k) => k).sort((one, other) => away[one]! - away[other]!);
  let [best, first]: [Complete, number] = [{ solutions: new Float64Array(0), missing: CLASSES + 1 }, 0];
  for (const origin of central.slice(0, 2)) {
    const displaced = targets.filter((_, k) => k !== origin).map((one) => sub(one, targets[origin]!));
    const complete = homotopy.solve(taskOf(displaced.map((t) => scaled(1 / away[origin]!, t))), progress);
    if (complete.missing < best.missing) [best, first] = [complete, origin];
    if (best.missing === 0) break;
  }
  const size = Math.max(...targets.map((one) => abs(sub(one, targets[0]!)))) || 1;
  const real = realRows(best.solutions);
  const accepted = real
    .flatMap((row) => cognatesOf(best.solutions, row))
    .flatMap((bar) => {
      for (const one of driven(moved(bar, away[first]!, targets[first]!))) {
        const found = judged(question.template, one, targets, first, size, question);
        if (found) return [found];
      }
      return [];
    })
    .sort(
      (one, other) =>
        Number(other.full) - Number(one.full) || other.transmission - one.transmission || one.ratio - other.ratio,
    );
  const items = accepted.slice(0, MOST_DESIGNS).map((one) => designOf(one, targets));
  return { found: { total: accepted.length, items, words: "", note: "" }, real: real.length, missing: best.missing };
}

function designOf({ model, cycle, full, transmission }: Judged, targets: readonly Complex[]) {
  const { rows, values, home } = cycle;
  const [{ link, at }] = model.points as [Model["points"][number]];
  const pins = model.joints.map((_, joint) => model.elements.find((e) => e.joint === joint)!);
  const placesAt = (row: number): [number, number][] => [
    ...pins.map((e) => place(rows, row, e.link, ...e.at)),
    place(rows, row, link, ...at),
  ];
  const count = values.length - Number(full); // the last row of a full turn is the first
  const shown = Array.from({ length: FRAMES }, (_, k) => placesAt(Math.floor((k * count) / FRAMES)));
  const members = model.links.flatMap((_, own) => {
    if (own === model.frame) return [];
    const joints = model.joints.flatMap(({ links }, joint) => (links.includes(own) ? [joint] : []));
    return [own === link ? [...joints, pins.length] : joints];
  });
  const fixed = model.joints.flatMap(({ links }, joint) => (links.includes(model.frame) ? [joint] : []));
  const lengths = [fixed, ...members.map((own) => own.slice(0, 2))].map((ends) => {
    const [one, other] = ends.map((joint) => shown[0]![joint]!);
    return abs(sub(one!, other!));
  });
  const bearings = pins.map((_, joint) => {
    const beside = members.filter((own) => own.includes(joint)).flat();
    const arms = beside.flatMap((k) => (k === joint ? [] : shown.map((seen) => sub(seen[k]!, seen[joint]!))));
    return fixed.includes(joint) ? bearingTurn(arms) : 0;
  });
  return {
    model: { ...model, bearings },
    document: model.document,
    lengths,
    names: model.linkNames,
    picture: pictureOf({ places: placesAt(home), members, fixed, bearings, cycle, point: { link, at }, targets }),
    form: "RR-RR",
    transmission,
    error: 0, // but for rounding
    size: model.program.size,
    frames: full ? shown : [...shown, ...shown.slice(1, -1).reverse()],
    members,
    joints: pins.length,
    bearings,
  };
}

await loadKernel(packed);

const scope = globalThis as unknown as {
  WorkerGlobalScope?: unknown;
  postMessage(said: Said): void;
  onmessage: (event: MessageEvent<Question>) => void;
};
if (scope.WorkerGlobalScope) {
  scope.onmessage = ({ data }) => {
    answered(data, (done, total) => scope.postMessage({ done, total })).then(
      (found) => scope.postMessage(found),
      (error: Error) => scope.postMessage({ error: error.message }),
    );
  };
  scope.postMessage({ ready: true });
}
