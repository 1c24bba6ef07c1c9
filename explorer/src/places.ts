/** The panel in which the places of joints are typed, and that of a picture behind them. */

import { backdropOf } from "./backdrop";
import { action, h, option } from "./dom";
import { isPin, knotName, moved, radiiOf, unitOf } from "./drawing";
import { number, t } from "./language";
import type { Drawn } from "./mobility";
import type { Pair } from "./rows";
import { rowsTable } from "./targets";
import type { Viewport } from "./viewport";

export function placesPanel(
  view: Drawn & { readonly viewport: Viewport; empty(): void; scale(): void },
): HTMLElement[] {
  const { drawing, viewport } = view;
  const { keeps, knots, picture } = drawing;
  const numbers = [...knots.keys()].filter((k) => isPin(knots[k]!));
  const rows = numbers.map((k) => [...knots[k]!.at]);
  const say = (text: string) => view.page.say(text);
  const typed = () => {
    const k = rows.findIndex((row, m) => row.join() !== knots[numbers[m]!]!.at.join());
    view.change(moved(drawing, numbers[k]!, rows[k] as unknown as Pair));
  };
  const [middle, sizes] = picture ? [[picture.at.slice(0, 2)], [picture.at.slice(2)]] : [];
  const framed = () => {
    const at = middle![0] && [...middle![0], ...sizes![0]!];
    view.change({ ...drawing, picture: at && { ...picture!, at } });
  };
  const read = () => {
    const here = viewport.world(viewport.width / 2, viewport.height / 2);
    backdropOf(file.files![0]!, (0.6 * viewport.width) / viewport.scale, here).then(
      (made) => view.change({ ...view.drawing, picture: made }),
      () => view.page.say(t("This file is no picture that the browser reads.")),
    );
  };
  const file = h("input", { type: "file", accept: "image/*", hidden: true, onchange: read });
  return [
    ...(rows.length
      ? [
          rowsTable(
            rows,
            numbers.every((k) => knots[k]!.links[1]) ? t("Joint") : t("Joint, point"),
            ["x", "y"],
            false,
            typed,
            say,
            (k) => knotName(drawing, numbers[k]!),
          ),
        ]
      : []),
    ...knots.flatMap((knot, k) => {
      const [one, two] = radiiOf(knot).map((radius) => number(radius));
      const radii = `${one}, ${two} ${unitOf(drawing)}`;
      return one ? [h("p.note", {}, t("{joint}: radii {radii}", { joint: knotName(drawing, k), radii }))] : [];
    }),
    ...(picture
      ? [
          h("h2", {}, t("Background picture")),
          rowsTable(middle!, t("Picture"), ["x", "y"], true, framed, say, () => ""),
          rowsTable(
            sizes!,
            t("Picture"),
            [`${t("Width")} [${unitOf(drawing)}]`, "φ [°]"],
            false,
            framed,
            say,
            () => "",
          ),
          h(
            "div.form",
            {},
            action("scale", () => view.scale(), t("Scale by two points")),
          ),
          option(t("Keep it in the document"), !!keeps, (on) => view.change({ ...drawing, keeps: on }), "keeps"),
        ]
      : []),
    file,
    action("picture", () => file.click(), picture ? t("Replace picture") : t("Background picture")),
    ...(knots.length
      ? [
          h(
            "div.form",
            {},
            action("empty", () => view.empty(), t("Clear drawing")),
          ),
        ]
      : []),
  ];
}
