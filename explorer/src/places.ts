/** The panel in which the places of joints are typed, and that of a picture behind them. */

import { backdropOf } from "./backdrop";
import { action, h, option } from "./dom";
import { isPin, knotName, radiiOf, unitOf } from "./drawing";
import { number, t } from "./language";
import { keeper, lengthList } from "./lengthlist";
import { movedKept } from "./lengths";
import type { Drawn } from "./mobility";
import type { Pair } from "./rows";
import { rowsTable } from "./targets";
import type { Viewport } from "./viewport";

export function placesPanel(
  view: Drawn & { readonly viewport: Viewport; empty(): void; scale(): void },
): HTMLElement[] {
  const { drawing, viewport } = view;
  const { keeps, knots, picture } = drawing;
  const unit = unitOf(drawing);
  const numbers = [...knots.keys()].filter((k) => isPin(knots[k]!));
  const rows = numbers.map((k) => [...knots[k]!.at]);
  const say = (text: string) => view.page.say(text);
  const typed = () => {
    const k = rows.findIndex((row, m) => row.join() !== knots[numbers[m]!]!.at.join());
    view.change(
      movedKept(drawing, numbers[k]!, rows[k] as unknown as Pair, true),
      t("What is kept does not allow it."),
    );
  };
  const [middle, sizes] = picture ? [[picture.at.slice(0, 2)], [picture.at.slice(2)]] : [];
  const framed = () => {
    const at = middle![0] && [...middle![0], ...sizes![0]!];
    view.change({ ...drawing, picture: at && { ...picture!, at } });
  };
  const read = () => {
    const { height, scale, width } = viewport;
    const here = viewport.world(width / 2, height / 2);
    backdropOf(file.files![0]!, [(0.6 * width) / scale, (0.7 * height) / scale], here).then(
      (made) => view.change({ ...view.drawing, picture: made }),
      () => view.page.say(t("This file is no picture that the browser reads.")),
    );
  };
  const file = h("input", { type: "file", accept: "image/*", hidden: true, onchange: read });
  return [
    file,
    h(
      "div.form",
      {},
      action("picture", () => file.click(), picture ? t("Replace picture") : t("Background picture")),
      knots[0] ? action("empty", () => view.empty(), t("Clear drawing")) : "",
    ),
    ...(rows.length
      ? [
          rowsTable(
            rows,
            t("Point"),
            [`x [${unit}]`, `y [${unit}]`],
            (k) => keeper(view, "joint", [numbers[k]!], knotName(drawing, numbers[k]!)),
            typed,
            say,
            (k) => knotName(drawing, numbers[k]!),
          ),
        ]
      : []),
    ...lengthList(view),
    ...knots.flatMap((knot, k) => {
      const [one, two] = radiiOf(knot).map((radius) => number(radius));
      const radii = `${one}, ${two} ${unit}`;
      return one ? [h("p.note", {}, t("{joint}: radii {radii}", { joint: knotName(drawing, k), radii }))] : [];
    }),
    ...(picture
      ? [
          h("h2", {}, t("Background picture")),
          rowsTable(middle!, t("Picture"), ["x", "y"], true, framed, say, () => ""),
          rowsTable(sizes!, t("Picture"), [`${t("Width")} [${unit}]`, "φ [°]"], false, framed, say, () => ""),
          h(
            "div.form",
            {},
            action("scale", () => view.scale(), t("Scale by two points")),
          ),
          option(t("Keep it in the document"), !!keeps, (on) => view.change({ ...drawing, keeps: on }), "keeps"),
        ]
      : []),
  ];
}
