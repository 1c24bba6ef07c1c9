/** The page of gruebler: an ES module with the interface of an anywidget front end, so that one source has three hosts.
 *
 * A notebook calls `render`; a server's page and a file of their own have an element with `data-gruebler`, at which the
 * page starts by itself. */

import { App } from "./app";
import { type HostModel, SocketModel, StillModel } from "./host";
import { loadTexts, t } from "./language";

export { documentOf } from "./document";
export { Dragging } from "./dragging";
export { Kernel, loadKernel } from "./kernel";
export { loadTexts } from "./language";
export { packed, unpacked } from "./link";
export { Linkage } from "./linkage";
export * as measures from "./measures";
export { programOf } from "./program";
export { turn } from "./rows";
export { linesOf } from "./shapes";

async function render({ model, el }: { model: HostModel; el: HTMLElement }): Promise<() => void> {
  await loadTexts(String(model.get("texts")));
  const app = new App(model, el);
  void app.start();
  return () => app.destroy();
}

export default { render };

async function begin(at: HTMLElement): Promise<void> {
  const given = (name: string) => document.getElementById(`gruebler-${name}`)!.textContent!;
  const values = { ...(JSON.parse(given("model")) as object), motion: given("motion") };
  await loadTexts(given("texts"));
  const host = at.dataset.gruebler ?? "file";
  const address = new URL("ws", location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.hash = "";
  const made = { ...values, host };
  const site = (window as { grueblerSite?: (values: object, texts: typeof t) => HostModel }).grueblerSite;
  const model = host === "server" ? new SocketModel(made, address.href) : (site?.(made, t) ?? new StillModel(made));
  const app = new App(model, at);
  await app.start();
  Object.assign(window, { gruebler: app });
}

const place = typeof document === "undefined" ? null : document.querySelector<HTMLElement>("[data-gruebler]");
if (place) void begin(place);
