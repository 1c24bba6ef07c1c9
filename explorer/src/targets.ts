/** What a linkage is to meet: marks in the plane, and a table in which they are typed. */

import { digits } from "./digits";
import { h, svg } from "./dom";
import { clearAbout } from "./hull";
import { angle, parsed, t } from "./language";
import { valueAt } from "./plot";
import type { Pair } from "./rows";

const ARM = 14; // of the arrow that shows the angle of a position
const AWAY = 6; // from a point to the middle of its number

/** A table whose cells change the rows; each row may be removed. */
export function rowsTable(
  rows: number[][],
  title: string,
  head: string[],
  removable: boolean,
  changed: () => void,
  numbered = (k: number) => String(k + 1),
): HTMLElement {
  const called = (k: number) => t("{title} {number}", { title, number: numbered(k) });
  const cell = (row: number[], k: number, axis: number) => {
    const input = h("input", {
      ...digits(row[axis]!),
      inputmode: "decimal",
      "aria-label": `${called(k)} ${head[axis]}`,
      onchange: () => {
        const value = parsed(input.value);
        input.setAttribute("aria-invalid", String(!Number.isFinite(value)));
        if (!Number.isFinite(value)) return;
        row[axis] = value;
        changed();
      },
    });
    return h("td", {}, input);
  };
  const cross = (k: number) => {
    const remove = () => {
      rows.splice(k, 1);
      changed();
    };
    return h("button.quiet", { "aria-label": t("Remove {name}", { name: called(k) }), onclick: remove }, "×");
  };
  return h(
    "table",
    {},
    h("tr", {}, h("th", {}, title), ...head.map((name) => h("th", {}, name)), h("th", {}, "")),
    ...rows.map((row, k) =>
      h(
        "tr",
        {},
        h("td", {}, numbered(k)),
        ...head.map((_, axis) => cell(row, k, axis)),
        h("td", {}, removable ? cross(k) : null),
      ),
    ),
  );
}

/** So many places evenly along a line that was drawn; of one that comes back to its start without the last. */
export function evenly(line: number[][], count: number): { places: number[][]; closed: boolean } {
  const lengths = [0];
  for (let k = 1; k < line.length; k++) {
    const [[x, y], [u, v]] = [line[k - 1]!, line[k]!] as [Pair, Pair];
    lengths.push(lengths[k - 1]! + Math.hypot(u - x, v - y));
  }
  const long = lengths.at(-1)!;
  const [[x, y], [u, v]] = [line[0]!, line.at(-1)!] as [Pair, Pair];
  const closed = line.length > 2 && Math.hypot(u - x, v - y) < 0.1 * long;
  const all = Float64Array.from(lengths);
  const places = Array.from({ length: count }, (_, k) => {
    const at = (long * k) / (closed ? count : count - 1);
    return [0, 1].map((axis) => {
      const value = valueAt(
        all,
        Float64Array.from(line, (place) => place[axis]!),
        at,
      );
      return Math.round(10 * value) / 10;
    });
  });
  return { places, closed };
}

/** The end of the arrow of a position. */
export function tip([x, y, turn]: number[], unit: number): number[] {
  const phi = ((turn ?? 0) * Math.PI) / 180;
  return [x! + ARM * unit * Math.cos(phi), y! + ARM * unit * Math.sin(phi)];
}

const ROCKER = 100;

/** A rocker at both ends of its swing, in degrees, and where it stands between them; the first place is its pivot. */
export function swingOf(swing: number): Pair[] {
  const at = (part: number): Pair => {
    const phi = (part * swing * Math.PI) / 180;
    return [ROCKER * Math.sin(phi), ROCKER * Math.cos(phi)];
  };
  return [[0, 0], at(-0.5), at(0.5), [0, 1.05 * ROCKER]];
}

/** The same as a picture with its angle, in units that are so long; nothing of no places. */
export function swingMark([, one, two, top]: readonly Pair[], swing: number, unit: number): SVGElement[] {
  if (!one || !two) return [];
  const [from, to] = [one, two].map(([x, y]) => `${x} ${-y}`);
  const text = { "text-anchor": "middle", transform: `translate(0 ${-top![1]}) scale(${unit})` };
  return [
    svg("path.polygon", { d: `M${from}A${ROCKER} ${ROCKER} 0 ${+(swing > 180)} 1 ${to}` }),
    svg("path.arm", { d: `M${from}L0 0L${to}` }),
    svg("path.pivot", { d: "M0 0l4 6h-8z", transform: `scale(${unit})` }),
    svg("text", text, angle((swing * Math.PI) / 180, 4)),
  ];
}

/** Where the number of each target has its middle: near its point, as clear as possible of all arrows, else of the way
 * from point to point. */
export function numberPlaces(rows: readonly number[][], closed: boolean, unit: number): Pair[] {
  const lines = rows.map((row, k) => {
    const next = rows[k + 1] ?? (closed ? rows[0]! : row);
    return [row, row.length > 2 ? tip(row, unit) : next].map(([x, y]): Pair => [x!, y!]);
  });
  return rows.map(([x, y]) => clearAbout([x!, y!], AWAY * unit, lines));
}

/** A point with its number, and the arrow of a position; all of it in units that are so long. */
export function targetMark([x, y, turn]: number[], k: number, [at, up]: Pair, unit: number): SVGElement {
  const [u, v] = tip([0, 0, turn ?? 0], 1);
  return svg(
    "g",
    { "data-point": String(k), transform: `translate(${x} ${-y!}) scale(${unit})` },
    ...(turn === undefined
      ? []
      : [svg("path.arm", { d: `M0 0L${u} ${-v!}` }), svg("circle.tip", { r: 1.8, cx: u!, cy: -v! })]),
    svg("circle", { r: 2.6 }),
    svg("text", { x: (at - x!) / unit, y: (y! - up) / unit + 2, "text-anchor": "middle" }, String(k + 1)),
  );
}
