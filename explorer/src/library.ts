/** In place of the view that asks the library at every step, where there is none: what it does, and how to get it. */

import { h, renew } from "./dom";
import { t } from "./language";
import type { View } from "./view";

export class LibraryView implements View {
  readonly element = h("div.view", { "data-page": "build" });

  arrange(): void {
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("h2", {}, t("Draw")),
        h("p", {}, t("Draw a mechanism: its mobility is told while you draw, then it moves.")),
        h(
          "p",
          {},
          t("This needs gruebler on your computer: pip install 'gruebler[web]', then: {command}", {
            command: "gruebler explore",
          }),
        ),
      ),
    );
  }
}
