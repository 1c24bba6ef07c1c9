// Runs the page's kernel on records that Python wrote (one JSON document a line) and prints, for each, how it ended and how
// many numbers differ in a bit: `explorer.js` as first argument, the records as second.
import { createReadStream } from "node:fs";
import { createInterface } from "node:readline";
import { pageModule } from "./page_module.mjs";

const { Kernel, programOf } = await pageModule(process.argv[2]);

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
  const links = record.program.linkCount;
  // Python: places (order, row, link), rates (order, row, link); the page: a column for each number; here: row first
  const count = record.reached, all = rows.turns.length / (2 * links);
  const theirs = (array, orders, width) => ordered(array, orders, links, width, count, (k, link, row) => (k * count + row) * links + link);
  const mine = (array, orders, width) => ordered(array, orders, links, width, count, (k, link, row) => (k * links + link) * all + row);
  const different = (what, orders, width) => {
    const here = mine(rows[what], orders, width);
    // what is not finite came as null
    const same = (value, k) => Object.is(here[k], value) || (Number.isNaN(value) && !Number.isFinite(here[k]));
    return theirs(record[what], orders, width).filter((value, k) => !same(value, k)).length;
  };
  const { status, reached, at, fault } = rows;
  const apart = { places: different("places", 3, 2), rates: different("rates", 2, 1), turns: different("turns", 1, 2) };
  console.log(JSON.stringify({ end: { status, reached, at, fault }, apart, numbers: count * links * 10 }));
}
