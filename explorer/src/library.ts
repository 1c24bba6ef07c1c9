/** In place of the view that asks the library at every step, where there is none: what it does, and how to get it. */

import { h, renew } from "./dom";
import { t } from "./language";
import type { View } from "./view";

export class LibraryView implements View {
  readonly element = h("div.view", { "data-page": "build" });

  arrange(): void {
    const steps = ["pip install 'gruebler[web]'", "gruebler explore"];
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("h2", {}, t("Draw")),
        h("p", {}, t("Draw a mechanism: its mobility is told while you draw, then it moves.")),
        h("p", {}, t("This part asks the library at every step. On your computer, with Python, two commands open it:")),
        h("pre", {}, steps.join("\n")),
      ),
    );
  }
}
