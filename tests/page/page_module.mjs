// The built module of the page, which a test names, with the kernel that its pages carry.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

export async function pageModule(built) {
  const address = pathToFileURL(built);
  const module = await import(address.href);
  await module.loadKernel(readFileSync(new URL("../../core/page/motion.wasm.gz", import.meta.url)));
  return module;
}
