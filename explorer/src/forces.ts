/** The panel of forces: what the drive and the joints carry over a turn, and how the linkage falls; by the library. */

import { DEGREE, wrapped } from "./cycle";
import { documentOf } from "./document";
import { action, h, renew, svg, unbroken } from "./dom";
import { FactList } from "./factlist";
import type { Fact } from "./facts";
import type { Fall } from "./falling";
import { icon } from "./icons";
import { number, t } from "./language";
import type { Linkage } from "./linkage";
import { type Acting, type Change, LoadForm } from "./loads";
import type { End, Model, Spring } from "./model";
import type { PlaneTransport } from "./planetransport";
import { Plot } from "./plot";
import { Polar, type Vectors, vectorAt } from "./polar";
import { type Pair, place } from "./rows";
import type { Column } from "./table";
import type { Page } from "./view";
import { awaited, moment } from "./waiting";
import { lengthUnit } from "./wording";

const ASKED_AFTER = 350; // milliseconds
const REST = 1e-5; // of the largest speed of a free motion: what is slower stands still
const LASTS: Pair = [0.01, 20]; // seconds of a free motion

/** A unit in which amounts are shown, and how much it is in N, or in N·m. */
type Unit = [name: string, factor: number];

/** Numbers of JSON, null where one is not known. */
type Numbers = (number | null)[];

/** What the library says; without anything that acts only what may be changed. */
interface Answer extends Acting, Carried {
  /** What the document is to keep, if the reader changed something. */
  kept?: Kept;
  /** Where the masses come from, or how they would be assumed. */
  origin: string;
  drives?: number[];
  /** What the effort of the drive is called, and its unit. */
  title: string;
  unit: Unit;
  effort: Numbers;
  facts: Fact[];
  lines: string[];
}

/** What joints carry and loads do, over the range of the drive or the time of a free motion. */
interface Carried {
  /** Of joints: what they are called, how large they are at most, and where. */
  forces: { joint: number; parts: Numbers[]; most: number; unit: Unit; name: string; note: string }[];
  /** Where loads act, and both parts of a force, or the moment. */
  acting: { at: End; parts: Numbers[]; unit: Unit }[];
}

/** Loads as a document has them, and the links whose masses lie along their bars. */
export interface Kept {
  loads: unknown;
  bars: readonly number[] | "steel";
}

/** A force or a moment on the stage: its place, its direction, as long as the root of its part of the largest, how much
 * it is, its unit, and, of a joint, its sign and whether it is the chosen one. */
export type Arrow = [
  x: number,
  y: number,
  dx: number,
  dy: number,
  amount: number,
  unit: string,
  sign?: string | null,
  chosen?: boolean,
];

interface Force extends Vectors {
  at: () => Pair;
  unit: Unit;
}

/** The forces of joints, and loads. */
interface Shown {
  joints: (Force & { name: string; note: string; sign: string })[];
  loads: Force[];
}

const NOTHING: Shown = { joints: [], loads: [] };

/** What the panel asks of its view. */
export interface Loaded {
  readonly page: Page;
  readonly linkage: Linkage;
  readonly transport: PlaneTransport;
  redraw(): void;
  /** The document has other loads, which can be undone if the reader changed them. */
  keepLoads(kept: Kept, typed: boolean): void;
}

export class Forces {
  readonly element = h("div", { "data-part": "forces" });
  readonly #form = new LoadForm(() => this.changed());
  readonly #summary = h("summary", {});
  /** What acts, above its results. */
  readonly #acting = h("details.words", {}, this.#summary, this.#form.element);
  readonly #result = h("div", {});
  /** What holds while the drive turns; how it is let go, and what is known of the last free motion. */
  readonly #ofDrive = h("div", {});
  #free = h("div", {});
  #ofFall = h("div", {});
  readonly #facts = new FactList();
  /** The force of each joint where the drive is, and its largest. */
  readonly #joints = new FactList();
  readonly #polar = new Polar();
  readonly #joint = h("select", { "data-field": "force-joint", onchange: () => this.#chosen() });
  #plot: Plot | null = null;
  /** For a table. */
  columns: Column[] = [];
  #model: Model | null = null;
  /** That of several drives, which no document has. */
  #speed: number | null = null;
  /** Lets the drive go, or again. */
  #release!: HTMLElement;
  /** Over the range of the drive; of the last free motion over time; which of both is shown. */
  #driven = NOTHING;
  #fallen = NOTHING;
  #of = NOTHING;
  /** Of the last free motion, over time. */
  #plots: Plot[] = [];
  #timer = 0;
  /** How long it moves freely, in seconds. */
  #until = 2;
  /** Whether the next forces are brought to sight. */
  brings = false;
  readonly #view: Loaded;
  readonly #opened: () => boolean;

  constructor(view: Loaded, opened: () => boolean) {
    this.#view = view;
    this.#opened = opened;
    this.#joints.element.classList.add("listed");
    this.#joints.element.style.cssText = "grid-template-columns: none; gap: 7px";
    this.#joints.element.onclick = ({ target }) => {
      const row = [...this.#joints.element.children].findIndex((one) => one.contains(target as Node));
      if (row >= 0) this.#joint.selectedIndex = row;
      this.#chosen();
    };
  }

  /** The linkage, its sizes, its loads or the language are others. */
  changed(): void {
    const { page, linkage } = this.#view;
    clearTimeout(this.#timer);
    this.#view.transport.endFall();
    this.columns = [];
    if (!page.served || !linkage.drive) {
      const word = linkage.model.source || "LINK";
      renew(this.element, noted(t("Forces need the library: gruebler explore {word}", { word })));
      return;
    }
    if (this.#model !== linkage.model) {
      this.#model = linkage.model;
      this.#driven = this.#fallen = NOTHING;
      this.#speed = null;
      this.#form.change = {};
      this.#acting.open = false;
      for (const part of [this.#form.element, this.#result, this.#joint]) renew(part);
    }
    this.#summary.textContent = t("Masses, loads");
    if (!this.#acting.isConnected) renew(this.element, this.#acting, this.#result);
    this.#result.classList.add("waiting");
    if (!this.#opened()) return;
    if (!this.#result.firstChild) renew(this.#result, moment());
    this.#timer = setTimeout(() => void this.#ask(), ASKED_AFTER);
  }

  get #question(): Record<string, unknown> {
    const { linkage, transport } = this.#view;
    const { active, cycle, drives, model } = linkage;
    const held = [...drives].slice(0, model.drives.length);
    held[active] = wrapped(cycle, held[active]!); // however often it has turned
    const { bars } = linkage.beside;
    return {
      document: documentOf(linkage, transport.pose),
      source: model.source,
      drives: held,
      bars,
      speed: this.#speed,
      called: this.#called,
      ...this.#form.change,
    };
  }

  /** What several drives are called. */
  get #called(): string[] {
    const { linkage } = this.#view;
    const { drives } = linkage.model;
    return drives[1] ? drives.map((_, k) => linkage.driveName(k)) : [];
  }

  get #letGo(): string {
    return this.#called[0] ? t("Release the drives") : t("Release the drive");
  }

  /** What was typed and is not in the document yet. */
  get typed(): Change {
    return this.#form.change;
  }

  /** What was typed just before the page was loaded again. */
  async typedBefore(change: Change): Promise<void> {
    this.changed();
    this.#form.change = change;
    await this.settled();
  }

  /** What was typed is in the document. */
  async settled(): Promise<void> {
    if (!Object.keys(this.#form.change)[0]) return;
    clearTimeout(this.#timer);
    await this.#ask();
  }

  async #ask(): Promise<void> {
    const { page, linkage } = this.#view;
    const { range } = this.#view.transport;
    const { active, cycle } = linkage;
    const { change } = this.#form;
    try {
      const found = await page.ask<Answer>("forces", { ...this.#question, active, range, full: cycle.full });
      if (linkage !== this.#view.linkage || change !== this.#form.change) return; // another is asked
      if (found.kept) this.#view.keepLoads(found.kept, !!Object.keys(change)[0]);
      this.#form.change = {};
      if (linkage.model.drives[1]) this.#speed = change.speed ?? this.#speed;
      this.#show(linkage, found);
    } catch (error) {
      renew(this.#result, h("p.note.error", {}, (error as Error).message));
    }
    this.#result.classList.remove("waiting");
  }

  #show(linkage: Linkage, answer: Answer): void {
    const { acting, drives, effort, facts, lines, masses, origin, speed, title, unit } = answer;
    const { drive, model } = linkage;
    const { transport } = this.#view;
    this.#form.show(linkage, answer);
    transport.endFall();
    this.#plot = null;
    this.#plots = [];
    this.#driven = this.#fallen = NOTHING;
    const assume = () => {
      this.brings = true;
      this.#acting.open = false;
      this.#form.put({ bars: "steel" });
    };
    const given = masses.some(Boolean);
    const offer = h(
      "div",
      {},
      noted(origin),
      !given && h("div.form", {}, action("assume", assume, t("Assume masses"))),
    );
    const notes = lines.map(noted);
    if (!drives) {
      renew(this.#result, ...notes, offer);
    } else {
      this.#form.element.append(offer);
      const places = Float64Array.from(drives);
      const exact = numbers(effort);
      const values = exact.map((value) => value / unit[1]);
      this.#plot = new Plot(drive!.turning ? "°" : lengthUnit(model), (value) => transport.pick(value));
      this.#plot.show(places, { title: `${title} [${unit[0]}]`, colour: "--motion", values }, transport.range);
      this.#driven = shownOf(linkage, answer, places);
      const { joints } = this.#driven;
      this.columns = [
        [title, drive!.turning ? "N·m" : "N", places, exact],
        ...joints.flatMap(({ name, x, y }): Column[] => [
          [`${name} Fx`, "N", places, x],
          [`${name} Fy`, "N", places, y],
        ]),
      ];
      const chosen = this.#joint.selectedIndex;
      renew(this.#joint, ...joints.map(({ name, sign }, value) => h("option", { value }, `${sign} ${name}`)));
      this.#ofFall = h("div", {});
      const onclick = () => void this.#fall();
      const last = (seconds: number) => {
        this.#until = seconds;
        if (this.#ofFall.firstChild) onclick(); // what was found is of the duration before
      };
      const until = this.#form.row("until", t("Duration"), "s", this.#until, last, LASTS);
      const play = () => transport.playAt(speed!);
      const beside = this.#form.rate.lastElementChild as HTMLElement;
      beside.style.cssText = "display: flex; align-items: center; white-space: nowrap";
      this.#form.rate.style.gridTemplateColumns = "minmax(0, 1fr) 60px auto";
      const told = { title: t("Play at this speed"), "data-icon": "play", onclick: play };
      const key = h("button.quiet", told, icon("play"), t("Run"));
      key.style.cssText = "display: flex; align-items: center; gap: 4px; padding: 5px";
      beside.append(key);
      this.#release = action("fall", onclick, this.#letGo);
      const sizes = joints.map(({ most }) => most);
      this.#joint.selectedIndex = chosen < 0 ? sizes.indexOf(Math.max(...sizes)) : chosen;
      const loads = acting[0] ? signed("force.load", t("Loads")) : "";
      this.#facts.show(facts);
      renew(this.#ofDrive, this.#form.rate, this.#facts.element, this.#plot.element);
      this.#free = h(
        "div",
        {},
        h("h3", {}, t("Free motion")),
        h("div.rows", {}, ...until),
        h("div.form", {}, this.#release),
        this.#ofFall,
      );
      renew(
        this.#result,
        this.#ofDrive,
        h("h3", {}, t("Joint forces in this pose")),
        h("p.note", {}, signed("force", t("Square-root scale: twice the length, four times the force")), " ", loads),
        this.#joints.element,
        h("label.options", {}, t("Force vector"), this.#joint),
        this.#polar.element,
        this.#free,
        ...notes,
      );
    }
    if (this.brings && this.#opened()) this.element.closest("details")!.scrollIntoView();
    this.brings = false;
    this.at(transport.drive);
    this.#view.redraw();
  }

  /** Another joint is chosen: its force is the thick one on the stage, its row is marked. */
  #chosen(): void {
    this.#showJoint();
    this.at(this.#view.transport.drive);
    this.#view.redraw();
  }

  #showJoint(): void {
    const force = this.#of.joints[this.#joint.selectedIndex];
    if (!force) return;
    this.#polar.show(force, force.unit);
    this.#polar.at(this.#place);
  }

  /** Where what is shown stands: the drive, or the seconds of a free motion. */
  get #place(): number {
    const { drive, falling } = this.#view.transport;
    return falling?.seconds ?? drive;
  }

  /** The drive is elsewhere, or in a free motion nowhere. */
  at(drive: number): void {
    if (!this.#opened()) return;
    const { falling } = this.#view.transport;
    const where = this.#place;
    this.#plot?.at(drive);
    for (const plot of this.#plots) plot.at(falling ? where : NaN);
    const of = falling ? this.#fallen : this.#driven;
    if (of !== this.#of) {
      this.#of = of;
      this.#showJoint();
      this.#ofDrive.hidden = !!falling;
      // a free motion is seen above what it does
      this.#free.firstElementChild?.toggleAttribute("hidden", !!falling);
      if (falling) this.#ofDrive.after(this.#free);
      else this.#polar.element.after(this.#free);
      for (const course of this.#ofFall.querySelectorAll("details")) course.open = !!falling;
      this.#release.textContent = falling ? t("Release again") : this.#letGo;
    }
    this.#joints.show(
      of.joints.map((force) => ({
        name: `${force.sign} ${force.name}`,
        text: amount(Math.hypot(...vectorAt(force, where)), force.unit),
        note: !force.most ? "" : `max. ${amount(force.most, force.unit)} ${force.note}`,
      })),
    );
    [...this.#joints.element.children].forEach((row, k) => {
      row.className = "card";
      const mark = k === this.#joint.selectedIndex ? "0 0 0 2px var(--purple)" : "";
      (row as HTMLElement).style.cssText = `gap: 0; padding: 4px 8px; box-shadow: ${mark}`;
    });
    this.#polar.at(where);
  }

  /** The springs of a linkage: as they were typed, else as it was opened. */
  springsOf(model: Model): readonly Spring[] {
    return (this.#model === model && this.#form.springs) || (model.springs ?? []);
  }

  /** The forces on the stage where the drive is, against the largest of the range; of a free motion likewise. */
  arrows(where = this.#place): Arrow[] {
    const { linkage, transport } = this.#view;
    const { joints, loads } = transport.falling ? this.#fallen : this.#driven;
    const all = this.#opened() && this.#model === linkage.model ? [...joints, ...loads] : [];
    return all.map((force, k) => {
      const { at, unit } = force;
      const turns = ({ unit: [its] }: Force) => its.includes("N·m");
      const most = Math.max(...all.map((other) => (turns(other) === turns(force) ? other.most : 0)));
      const [x, y] = vectorAt(force, where);
      const here = Math.hypot(x, y);
      const root = Math.sqrt(here * most) || 1; // small ones are seen, too
      return [
        ...at(),
        x / root,
        y / root,
        here / unit[1],
        unit[0],
        joints[k]?.sign ?? null,
        k === this.#joint.selectedIndex,
      ];
    });
  }

  async #fall(): Promise<void> {
    const { linkage, page } = this.#view;
    const told = this.#ofFall;
    this.#view.transport.pause();
    const found = await awaited(told, () =>
      page.ask<Fall & Carried>("fall", { ...this.#question, until: this.#until }),
    );
    if (!found || !told.isConnected || this.#view.linkage !== linkage) return;
    const { transport } = this.#view;
    const { model } = linkage;
    const times = Float64Array.from(found.drives, (_, row) => row / found.rate);
    this.#fallen = shownOf(linkage, found, times);
    this.#plots = model.drives.flatMap(({ turning }, k) => {
      const [unit, scale] = turning ? ["°", DEGREE] : [lengthUnit(model), 1];
      const its = this.#called.slice(k, k + 1);
      const plot = (called: string, rows: number[][], of: string, degrees = false) => {
        const made = new Plot("s", (seconds) => transport.seek(seconds, found));
        const values = Float64Array.from(rows, (row) => row[k]! / scale);
        const title = `${[called, ...its].join(", ")} [${of}]`;
        const same = REST * Math.max(...values.map(Math.abs));
        made.show(times, { title, colour: "--motion", values, degrees, same }, [0, times[times.length - 1]!]);
        return made;
      };
      return [
        plot(turning ? t("Drive angle") : t("Drive travel"), found.drives, unit, turning),
        plot(t("Drive speed"), found.speeds, `${unit}/s`),
      ];
    });
    const course = h("summary", {}, t("Time history"));
    const plots = this.#plots.map((plot) => plot.element);
    renew(told, h("details.words", { open: true }, course, ...found.lines.map(noted), h("p", {}), ...plots));
    transport.seek(0, found);
    transport.toggle();
    this.element.closest("details")!.scrollIntoView();
  }
}

function shownOf(linkage: Linkage, { acting, forces }: Carried, places: Float64Array): Shown {
  const vectors = (parts: Numbers[], unit: Unit, at: () => Pair): Force => {
    const [x, y = x.map(() => 0)] = parts.map(numbers) as [Float64Array, Float64Array?];
    const most = Math.max(...x.map((one, k) => Math.hypot(one, y[k]!) || 0));
    return { drives: places, x, y, most, unit, at };
  };
  return {
    joints: forces.map(({ joint, parts, unit, ...more }, k) => ({
      sign: `F${[...`${k + 1}`].map((digit) => String.fromCharCode(0x2080 + Number(digit))).join("")}`,
      ...vectors(parts, unit, () => linkage.jointAt(joint)),
      ...more,
    })),
    loads: acting.map(({ at: [link, ...own], parts, unit }) =>
      vectors(parts, unit, () => place(linkage.pose, 0, link, ...own)),
    ),
  };
}

function noted(line: string): HTMLElement {
  return h("p.note", {}, unbroken(line));
}

/** What arrows of a class look like, and what they are. */
function signed(name: "force" | "force.load", text: string): HTMLElement {
  const sign = svg(`path.${name}`, { d: "M1 5H23M16 1L23 5L16 9" });
  const arrow = svg("svg", { viewBox: "0 -1 28 12", width: 28, height: 12 }, sign);
  return h("nobr" as "b", {}, arrow, `\u00a0${text}\u2003`);
}

function numbers(values: Numbers): Float64Array {
  return Float64Array.from(values, (value) => value ?? NaN);
}

function amount(value: number, [unit, factor]: Unit): string {
  return `${number(value / factor, 3)} ${unit}`;
}
