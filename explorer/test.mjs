// Bundles the tests of the page (test/*.test.ts) and runs them with node's own test runner.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const target = mkdtempSync(path.join(tmpdir(), "gruebler-page-"));
const names = readdirSync(path.join(here, "test")).filter((name) => name.endsWith(".test.ts"));

try {
  await build({
    absWorkingDir: here,
    entryPoints: names.map((name) => `test/${name}`),
    outdir: target,
    outExtension: { ".js": ".mjs" },
    bundle: true,
    platform: "node",
    format: "esm",
    target: "es2022",
    sourcemap: "inline",
    loader: { ".gz": "binary", ".txt": "text" },
  });
  const files = names.map((name) => path.join(target, name.replace(/\.ts$/, ".mjs")));
  const done = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit" });
  process.exitCode = done.status ?? 1;
} finally {
  rmSync(target, { recursive: true });
}
