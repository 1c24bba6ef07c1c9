/** In place of a view that asks the library at every step, where there is none: what it does, and how to get it. */

import { h, renew } from "./dom";
import { t } from "./language";
import type { View } from "./view";

export class LibraryView implements View {
  readonly element: HTMLElement;

  constructor(private readonly name: "build" | "synthesis") {
    this.element = h("div.view", { "data-page": name });
  }

  arrange(): void {
    const build = this.name === "build";
    const steps = ["pip install 'gruebler[web]'", "gruebler explore"];
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("h2", {}, build ? t("Draw") : t("Synthesis")),
        h(
          "p",
          {},
          build
            ? t("Draw a mechanism of your own: its mobility is told while you draw, then it moves.")
            : t("Give points, positions, angles or dead centres: four-bars that do it are found and play over them."),
        ),
        h("p", {}, t("This part asks the library at every step. On your computer, with Python, two commands open it:")),
        h("pre", {}, steps.join("\n")),
      ),
    );
  }
}
