// Builds the page into the folder given, else into the Python package: one ES module, and one more for static sites.

import { readFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build, transform } from "esbuild";
import { gzipSync, strToU8 } from "fflate";

const here = path.dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? path.join(here, "../src/gruebler/page/static");

/** Style sheets, minified, and tables of texts stand packed in the module; the packer does the same everywhere. */
const texts = {
  name: "texts",
  setup: ({ onLoad }) =>
    onLoad({ filter: /\.(css|json)$/ }, async ({ path: file }) => {
      const text = await readFile(file, "utf8");
      const table = file.endsWith(".json");
      const code = table
        ? JSON.stringify(JSON.parse(text))
        : (await transform(text, { loader: "css", charset: "utf8", minify: true })).code.trim();
      const data = Buffer.from(gzipSync(strToU8(code), { level: 9, mtime: 0 })).toString("base64");
      const unpacked = `await textOf(${JSON.stringify(data)})`;
      const value = table ? `JSON.parse(${unpacked})` : unpacked;
      const contents = `import { textOf } from "./packed";\nexport default ${value};`;
      return { contents, loader: "js", resolveDir: path.join(here, "src") };
    }),
};

await build({
  absWorkingDir: here,
  entryPoints: { explorer: "src/index.ts", site: "src/site/index.ts" },
  outdir: target,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  charset: "utf8",
  legalComments: "none",
  loader: { ".gz": "binary" },
  plugins: [texts],
});
