// Prints what the page measures of models that Python wrote, one JSON document a line; see test_linkage.py.
import { createReadStream } from "node:fs";
import { createInterface } from "node:readline";
import { pageModule } from "./page_module.mjs";

const { Dragging, documentOf, Linkage, linesOf, measures, turn } = await pageModule(process.argv[2]);

for await (const line of createInterface({ input: createReadStream(process.argv[3]) })) {
  const linkage = new Linkage(JSON.parse(line));
  const dragging = new Dragging(linkage);
  const { cycle, model, sizes } = linkage;
  const least = measures.leastTransmission(linkage);
  const kept = documentOf(linkage);
  const dead = measures.deadCentres(linkage);
  const out = {
    full: cycle.full, turns: cycle.turns, low: cycle.low, high: cycle.high, rows: cycle.values.length,
    stops: cycle.stops.map((stop) => stop && { value: stop.value, form: stop.form, links: stop.links }),
    deadCentres: dead, travel: measures.travelOf(linkage, dead), least, document: kept, drags: [],
  };
  // every joint is dragged a little: all other joints must stay, the joint must be where it was put
  model.joints.forEach((_, joint) => {
    if (!dragging.draggable(joint)) return;
    const before = model.joints.map((_, k) => linkage.jointAt(k));
    const [x, y] = dragging.permitted(joint, before[joint][0] + 0.011 * linkage.size, before[joint][1] + 0.017 * linkage.size);
    const old = linkage.snapshot();
    const result = { joint, missed: NaN, moved: 0, length: 0, document: null };
    try {
      dragging.dragJoint(joint, x, y);
      const [u, v] = linkage.jointAt(joint);
      result.missed = Math.hypot(u - x, v - y) / linkage.size;
      model.joints.forEach((_, k) => {
        if (k === joint || model.elements.every((e) => e.joint !== k || e.kind !== "pin")) return;
        const [a, b] = linkage.jointAt(k);
        result.moved = Math.max(result.moved, Math.hypot(a - before[k][0], b - before[k][1]) / linkage.size);
      });
      result.document = documentOf(linkage);
      result.belts = model.shapes.filter((shape) => shape.between).flatMap((shape) => linesOf(sizes, shape));
      result.least = measures.leastTransmission(linkage);
      result.low = linkage.cycle.low;
      result.high = linkage.cycle.high;
      result.full = linkage.cycle.full;
      if (model.elements.some((e) => e.kind === "round") && linkage.moveTo(linkage.drives[linkage.active] + 0.3)) {
        result.later = {
          drives: [...linkage.drives],
          joints: model.joints.map((_, k) => linkage.jointAt(k)),
          turns: model.links.slice(0, model.own).map((_, link) => turn(linkage.pose, 0, link)),
        };
      }
    } catch (error) {
      result.refused = String(error.stack);
    }
    linkage.restore(old);
    out.drags.push(result);
  });
  console.log(JSON.stringify(out));
}
