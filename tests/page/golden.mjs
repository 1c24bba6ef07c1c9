// Runs the page's kernel on records that Python wrote (one JSON document a line) and prints, for each, how far apart
// they are: `explorer.js` as first argument, the records as second.
import { createReadStream } from "node:fs";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const { Kernel, programOf } = await import(pathToFileURL(process.argv[2]).href);

/** The largest difference, each row against its own largest value where it is more than `unit`. */
function apart(mine, theirs, width, unit, trusted) {
  let most = 0;
  for (let row = 0; row * width < theirs.length; row++) {
    if (!trusted(row)) continue;
    let scale = unit;
    for (let k = row * width; k < (row + 1) * width; k++) scale = Math.max(scale, Math.abs(theirs[k] ?? 0));
    for (let k = row * width; k < (row + 1) * width; k++) {
      const gap = Math.abs(mine[k] - theirs[k]) / scale;
      if (!(gap <= most)) most = Number.isNaN(theirs[k]) || theirs[k] === null ? most : gap;
    }
  }
  return most;
}

for await (const line of createInterface({ input: createReadStream(process.argv[3]) })) {
  const record = JSON.parse(line);
  const kernel = new Kernel(programOf(record.program));
  const rows = kernel.run(
    Float64Array.from(record.path),
    { signs: Float64Array.from(record.signs), unknowns: Float64Array.from(record.unknowns) },
    2,
    record.speeds.map((s) => Float64Array.from(s)),
  );
  const { linkCount: links, dyads, size } = record.program;
  // Python: places (order, row, link), rates (order, row, link); here: row first
  const count = record.reached;
  const places = new Float64Array(count * 6 * links), rates = new Float64Array(count * 2 * links);
  for (let k = 0; k < 3; k++)
    for (let row = 0; row < count; row++)
      for (let m = 0; m < 2 * links; m++)
        places[(row * 3 + k) * 2 * links + m] = record.places[(k * count + row) * 2 * links + m] ?? NaN;
  for (let k = 0; k < 2; k++)
    for (let row = 0; row < count; row++)
      for (let m = 0; m < links; m++) rates[(row * 2 + k) * links + m] = record.rates[(k * count + row) * links + m] ?? NaN;
  const least = (row) => {
    let out = 1;
    for (let m = 0; m < dyads; m++) out = Math.min(out, Math.abs(record.roots[row * dyads + m]));
    return out;
  };
  const pick = (all, k) => Float64Array.from({ length: count * 2 * links }, (_, i) =>
    all[(Math.floor(i / (2 * links)) * 3 + k) * 2 * links + (i % (2 * links))]);
  const turn = (k, all) => Float64Array.from({ length: count * links }, (_, i) =>
    all[(Math.floor(i / links) * 2 + k) * links + (i % links)]);
  // what is lost beside a root r: a position is known to 1e-16 / r, a velocity to 1e-16 / r^2, an acceleration to / r^4
  const near = (r) => (row) => least(row) > r;
  console.log(JSON.stringify({
    status: rows.status, reached: rows.reached, at: rows.at, fault: rows.fault,
    turns: apart(rows.turns, record.turns, 2 * links, 1, near(1e-6)),
    places: apart(pick(rows.places, 0), pick(places, 0), 2 * links, size, near(1e-6)),
    velocities: Math.max(
      apart(pick(rows.places, 1), pick(places, 1), 2 * links, size, near(1e-3)),
      apart(turn(0, rows.rates), turn(0, rates), links, 1, near(1e-3))),
    accelerations: Math.max(
      apart(pick(rows.places, 2), pick(places, 2), 2 * links, size, near(1e-2)),
      apart(turn(1, rows.rates), turn(1, rates), links, 1, near(1e-2))),
    rows: count,
    trusted: Array.from({ length: count }, (_, row) => least(row)).filter((r) => r > 1e-3).length,
  }));
}
