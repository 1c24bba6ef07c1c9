// Builds the page into the folder given, else into the Python package: one ES module, no other files.

import path from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? path.join(here, "../src/gruebler/page/static");

await build({
  absWorkingDir: here,
  entryPoints: { explorer: "src/index.ts" },
  outdir: target,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  charset: "utf8",
  legalComments: "none",
  loader: { ".css": "text", ".gz": "binary" },
});
