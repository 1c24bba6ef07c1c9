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

/** Row by row, and what is no number as NaN; `at` says where the numbers of a link are. */
function ordered(array, orders, links, width, count, at) {
  const out = new Float64Array(count * orders * links * width);
  for (let row = 0; row < count; row++)
    for (let k = 0; k < orders; k++)
      for (let link = 0; link < links; link++)
        for (let part = 0; part < width; part++)
          out[((row * orders + k) * links + link) * width + part] = array[at(k, link, row) * width + part] ?? NaN;
  return out;
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
  // Python: places (order, row, link), rates (order, row, link); the page: a column for each number; here: row first
  const count = record.reached, all = rows.turns.length / (2 * links);
  const theirs = (array, orders, width) => ordered(array, orders, links, width, count, (k, link, row) => (k * count + row) * links + link);
  const mine = (array, orders, width) => ordered(array, orders, links, width, count, (k, link, row) => (k * links + link) * all + row);
  const places = theirs(record.places, 3, 2), rates = theirs(record.rates, 2, 1), turns = theirs(record.turns, 1, 2);
  const found = { places: mine(rows.places, 3, 2), rates: mine(rows.rates, 2, 1), turns: mine(rows.turns, 1, 2) };
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
    turns: apart(found.turns, turns, 2 * links, 1, near(1e-6)),
    places: apart(pick(found.places, 0), pick(places, 0), 2 * links, size, near(1e-6)),
    velocities: Math.max(
      apart(pick(found.places, 1), pick(places, 1), 2 * links, size, near(1e-3)),
      apart(turn(0, found.rates), turn(0, rates), links, 1, near(1e-3))),
    accelerations: Math.max(
      apart(pick(found.places, 2), pick(places, 2), 2 * links, size, near(1e-2)),
      apart(turn(1, found.rates), turn(1, rates), links, 1, near(1e-2))),
    rows: count,
    trusted: Array.from({ length: count }, (_, row) => least(row)).filter((r) => r > 1e-3).length,
  }));
}
