import type { App, View } from "./app";
import { h } from "./dom";

export class StructureView implements View {
  readonly element = h("div", { class: "view" });
  constructor(private readonly app: App) {}
  arrange(): void {
    void this.app;
  }
}
