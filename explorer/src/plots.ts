/** The plots of a linkage over its drive. */

import { type Cycle, DEGREE, TURN, wrapped } from "./cycle";
import { h, renew } from "./dom";
import { type Icon, icon } from "./icons";
import type { Rows } from "./kernel";
import { currentLanguage, t } from "./language";
import type { Linkage } from "./linkage";
import { goesRound, isAngle, output, outputAlong, outputStandsStill, transmission } from "./measures";
import type { OutputRecord } from "./model";
import { Plot, type Series, valueAt } from "./plot";
import { place } from "./rows";
import { Span } from "./span";
import { whole } from "./waiting";
import { inBrackets, lengthUnit, rateUnit, transferName } from "./wording";

/** The rows of a cycle in the order in which they are plotted, with their drive values. */
export interface Lap {
  drives: Float64Array;
  rows: number[];
}

/** The lap of a cycle, and the output in its rows; what turns fully begins anew after 360°. */
interface Plotted extends Lap {
  cycle: Cycle;
  outputs: Float64Array;
  round: boolean;
}

type Making = (plotted: Plotted) => Series;

const OF_OUTPUT = 3; // plots: its angle or place, two derivatives
const SMALL = 40; // degrees: transmission angles below are shaded

export class Plots {
  readonly element = h("div", {});
  parts: { plot: Plot; make: Making }[] = [];
  /** In place of the plots of an output that does not turn or travel. */
  readonly #still = h("p.note", { "data-note": "still" });
  #last: Plotted | null = null;
  #turn = 0;
  readonly #span = new Span(() => {
    for (const { plot } of this.parts) plot.redraw();
  });

  constructor(private readonly pick: (drive: number) => void) {}

  /** Empty plots: of another linkage, with other points, in another language. */
  arrange(linkage: Linkage): void {
    const { drive, model, sizes } = linkage;
    this.#span.narrow();
    const record = model.outputs[0];
    const series = record ? outputSeries(linkage, record, (angle) => this.plottedAngle(linkage, angle)) : [];
    for (const { name, link, at } of sizes.points)
      series.push(({ rows }) => ({
        title:
          t("Speed of {name} per drive speed", { name: linkage.pointName(name) }) +
          inBrackets(rateUnit(linkage, 1, false)),
        colour: "--ink",
        ...over(linkage, rows, (all, row) => Math.hypot(...place(all, row, link, ...at, 1))),
      }));
    const unit = drive?.turning ? "°" : lengthUnit(model);
    this.parts = series.map((make) => ({ plot: new Plot(unit, this.pick, this.#span), make }));
    const note = record?.note[currentLanguage()];
    if (record) {
      const name = linkage.linkName(record.link);
      this.#still.textContent = isAngle(linkage)
        ? t("Output {name} does not turn.", { name })
        : t("Output {name} does not move.", { name });
    }
    const tool = (sign: Icon, text: string, factor: number) =>
      h(
        "button.quiet",
        {
          title: text,
          "data-plots": sign,
          onclick: () => this.#zoom(linkage, factor),
        },
        icon(sign),
      );
    const tools = h(
      "div.plot-tools",
      {},
      tool("more", t("Enlarge the plots where the drive is"), 2),
      tool("less", t("Less enlarged"), 0.5),
      tool("fit", t("The whole range"), 0),
    );
    renew(
      this.element,
      tools,
      this.#still,
      ...this.parts.map(({ plot }) => plot.element),
      !!note && h("p.note", {}, note),
    );
  }

  /** While sizes are dragged: one plot a frame by turns. */
  follow(linkage: Linkage): void {
    this.#turn = (this.#turn + 1) % (this.parts.length || 1);
    whole(this.drawing(linkage, this.parts.slice(this.#turn, this.#turn + 1)));
  }

  /** Draw them, one after the other. */
  *drawing(linkage: Linkage, parts = this.parts): Generator<void> {
    const { active, cycle, drives, model } = linkage;
    if (cycle.values.length < 2) return;
    const plotted = this.#plotted(linkage);
    const record = model.outputs[0];
    const still = record !== undefined && outputStandsStill(linkage, plotted.outputs);
    this.#still.hidden = !still;
    for (const { plot } of record ? this.parts.slice(0, OF_OUTPUT) : [])
      plot.element.style.display = still ? "none" : "";
    for (const { plot, make } of parts) {
      plot.show(plotted.drives, make(plotted), rangeOf(cycle), wrapped(cycle, drives[active]!));
      yield;
    }
  }

  #zoom({ active, cycle, drives }: Linkage, factor: number): void {
    const [first, last] = this.#span.of(rangeOf(cycle));
    this.#span.zoom(factor, (wrapped(cycle, drives[active] ?? 0) - first) / (last - first));
  }

  /** Put the cursor to a drive value. */
  at(drive: number): void {
    for (const { plot } of this.parts) plot.at(drive);
  }

  /** The angle of the output in the pose that is shown, in the lap in which it is plotted. */
  plottedAngle(linkage: Linkage, value: number): number {
    const { active, cycle } = linkage;
    const { drives, outputs, round } = this.#plotted(linkage);
    if (round) return inTurn(value);
    const near = valueAt(drives, outputs, wrapped(cycle, linkage.drives[active] ?? 0));
    return value + TURN * Math.round((near - value) / TURN);
  }

  #plotted(linkage: Linkage): Plotted {
    const { cycle } = linkage;
    const last = this.#last;
    if (last?.cycle === cycle) return last;
    const { drives, rows } = lapOf(cycle);
    const along = outputAlong(linkage, rows);
    const round = goesRound(linkage, along);
    this.#last = { drives, rows, cycle, outputs: round ? along.map(inTurn) : along, round };
    return this.#last;
  }
}

/** The rows of full turns from 0 on, the first of them once more at the end; of a range as they are. */
export function lapOf(cycle: Cycle): Lap {
  const { full, turns, values } = cycle;
  const count = values.length;
  if (!full) return { drives: values, rows: [...values.keys()] };
  const at = values.map((value) => wrapped(cycle, value));
  let first = 0;
  for (let row = 1; row < count - 1; row++) if (at[row]! < at[first]!) first = row;
  // values grow, so that those of one lap follow the least one, then those before it
  const rows = Array.from({ length: count }, (_, k) => (first + k) % (count - 1));
  const drives = Float64Array.from(rows, (row) => at[row]!);
  drives[count - 1]! += TURN * turns;
  return { drives, rows };
}

function rangeOf({ full, high, low, turns }: Cycle): [number, number] {
  return full ? [0, TURN * turns] : [low, high];
}

function inTurn(angle: number): number {
  return wrapped({ full: true, turns: 1 }, angle);
}

function degrees(angle: number): number {
  return angle / DEGREE;
}

/** A value over the cycle, and of the pose that is shown. */
function over(linkage: Linkage, rows: number[], f: (all: Rows, row: number) => number) {
  return { values: Float64Array.from(rows, (row) => f(linkage.cycle.rows, row)), now: () => f(linkage.pose, 0) };
}

function outputSeries(linkage: Linkage, record: OutputRecord, inLap: (angle: number) => number): Making[] {
  const turning = isAngle(linkage);
  const name = linkage.linkName(record.link);
  const same = 1e-9 * (turning ? 1 : linkage.size);
  const angle: Making = ({ outputs, round }) => ({
    title: t("Output {name}", { name }) + inBrackets(turning ? "°" : lengthUnit(linkage.model)),
    colour: "--motion",
    values: turning ? outputs.map(degrees) : outputs,
    now: () => {
      const value = output(linkage, linkage.pose, 0);
      return turning ? degrees(inLap(value)) : value;
    },
    marks: record.marks,
    same: turning ? degrees(same) : same,
    turn: round ? 360 : 0,
    degrees: turning,
  });
  const transfer =
    (order: 1 | 2, colour: string): Making =>
    ({ rows }) => ({
      title: transferName(linkage, order) + inBrackets(rateUnit(linkage, order)),
      colour,
      ...over(linkage, rows, (all, row) => output(linkage, all, row, order)),
      same,
    });
  const mu: Making = ({ rows }) => ({
    title: `${t("Transmission angle μ")} [°]`,
    colour: "--accent",
    floor: SMALL,
    degrees: true,
    ...over(linkage, rows, (all, row) => degrees(transmission(linkage, all, row))),
  });
  return [angle, transfer(1, "--green"), transfer(2, "--purple"), ...(record.legs.length ? [mu] : [])];
}
