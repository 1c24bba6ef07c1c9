// Builds the page into the folder given, else into the Python package: one ES module, no other files.

import { readFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build, transform } from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? path.join(here, "../src/gruebler/page/static");

/** Style sheets become texts of the module: minified first, which esbuild leaves out for texts. */
const styles = {
  name: "styles",
  setup: ({ onLoad }) =>
    onLoad({ filter: /\.css$/ }, async ({ path: file }) => {
      const { code } = await transform(await readFile(file, "utf8"), { loader: "css", charset: "utf8", minify: true });
      return { contents: code.trim(), loader: "text" };
    }),
};

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
  loader: { ".gz": "binary" },
  plugins: [styles],
});
