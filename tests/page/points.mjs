// Runs the synthesis of the page on tasks that Python wrote: `points.js` as first argument, the question, with the rows of
// all tasks, as second. Prints for each task what was found.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const { answered } = await import(pathToFileURL(process.argv[2]).href);
const { tasks, solutions, ...question } = JSON.parse(readFileSync(process.argv[3], "utf8"));

for (const rows of tasks) {
  const told = [];
  const bytes = Uint8Array.from(Buffer.from(solutions, "base64")).buffer;
  const said = await answered({ ...question, rows, solutions: bytes }, (done, total) => told.push([done, total]));
  console.log(JSON.stringify({ ...said, told }));
}
