// Prints what the page measures of models that Python wrote, one JSON document a line; see test_machine.py.
import { createReadStream } from "node:fs";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const { Machine } = await import(pathToFileURL(process.argv[2]).href);

for await (const line of createInterface({ input: createReadStream(process.argv[3]) })) {
  const machine = new Machine(JSON.parse(line));
  const { cycle } = machine;
  const least = machine.leastTransmission();
  const kept = machine.document();
  const out = {
    full: cycle.full, turns: cycle.turns, low: cycle.low, high: cycle.high, rows: cycle.values.length,
    stops: cycle.stops.map((stop) => stop && { value: stop.value, form: stop.form, links: stop.links }),
    deadCentres: machine.deadCentres(), least, document: kept, drags: [],
  };
  // every joint is dragged a little: all other joints must stay, the joint must be where it was put
  machine.model.joints.forEach((_, joint) => {
    if (!machine.draggable(joint)) return;
    const before = machine.model.joints.map((_, k) => machine.jointAt(k));
    const [x, y] = machine.permitted(joint, before[joint][0] + 0.011 * machine.size, before[joint][1] + 0.017 * machine.size);
    const old = machine.snapshot();
    const result = { joint, missed: NaN, moved: 0, length: 0, document: null };
    try {
      machine.dragJoint(joint, x, y);
      const [u, v] = machine.jointAt(joint);
      result.missed = Math.hypot(u - x, v - y) / machine.size;
      machine.model.joints.forEach((_, k) => {
        if (k === joint || machine.elementsOf(k).every((m) => machine.model.elements[m].kind !== "pin")) return;
        const [a, b] = machine.jointAt(k);
        result.moved = Math.max(result.moved, Math.hypot(a - before[k][0], b - before[k][1]) / machine.size);
      });
      result.document = machine.document();
      result.belts = machine.model.shapes.filter((shape) => shape.between).flatMap((shape) => machine.linesOf(shape));
      result.least = machine.leastTransmission();
      result.low = machine.cycle.low;
      result.high = machine.cycle.high;
      result.full = machine.cycle.full;
      if (machine.model.elements.some((e) => e.kind === "round") && machine.moveTo(machine.drives[machine.active] + 0.3)) {
        result.later = {
          drives: [...machine.drives],
          joints: machine.model.joints.map((_, k) => machine.jointAt(k)),
          turns: machine.model.links.slice(0, machine.model.own).map((_, link) => machine.turn(machine.pose, 0, link)),
        };
      }
    } catch (error) {
      result.refused = String(error.stack);
    }
    machine.restore(old);
    out.drags.push(result);
  });
  console.log(JSON.stringify(out));
}
