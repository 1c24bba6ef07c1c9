/** The panel of forces: what the drive and the joints carry over a turn, and how the linkage falls; by the library. */

import { documentOf } from "./document";
import { action, h, renew } from "./dom";
import { FactList } from "./factlist";
import type { Fall } from "./falling";
import { number, t } from "./language";
import type { Linkage } from "./linkage";
import { LoadForm } from "./loads";
import type { Model } from "./model";
import type { PlaneTransport } from "./planetransport";
import { Plot } from "./plot";
import { Polar, type Vectors, vectorAt } from "./polar";
import type { Pair } from "./rows";
import type { Spring } from "./springs";
import { driveText } from "./track";
import type { Page } from "./view";
import { awaited, moment } from "./waiting";
import { lengthUnit, momentUnit } from "./wording";

const ASKED_AFTER = 350; // milliseconds

/** Numbers of JSON, null where one is not known. */
type Numbers = (number | null)[];

/** What the library says; without anything that acts only masses and speed. */
interface Answer {
  masses: number[];
  speed: number | null;
  springs: Spring[];
  /** Where the masses come from, or how they would be assumed. */
  origin: string;
  /** On what loads act that are not in the form. */
  besides: string;
  drives?: number[];
  effort: Numbers;
  effective: number;
  /** In watts: the largest, and the mean. */
  power: Pair;
  /** By joint, with the link on which it acts. */
  forces: { joint: number; link: number; force: [Numbers, Numbers] }[];
  lines: string[];
}

/** A force on the stage: its joint, its direction, as long as the root of its part of the largest, and how much. */
export type Arrow = [joint: number, x: number, y: number, force: number];

/** What the panel asks of its view. */
export interface Loaded {
  readonly page: Page;
  readonly linkage: Linkage;
  readonly transport: PlaneTransport;
  redraw(): void;
}

export class Forces {
  readonly element = h("div", { "data-part": "forces" });
  readonly #form = new LoadForm(() => this.changed());
  readonly #summary = h("summary", {});
  /** What acts, above its results. */
  readonly #acting = h("details.words", {}, this.#summary, this.#form.element);
  readonly #result = h("div", {});
  readonly #facts = new FactList();
  /** The force of each joint where the drive is, and its largest. */
  readonly #joints = new FactList();
  readonly #polar = new Polar();
  readonly #joint = h("select", { "data-field": "force-joint", onchange: () => this.#showJoint() });
  #plot: Plot | null = null;
  #model: Model | null = null;
  #forces: (Vectors & { joint: number; name: string; note: string })[] = [];
  #timer = 0;
  /** Whether the next forces are brought to sight. */
  #brings = false;
  readonly #view: Loaded;
  readonly #opened: () => boolean;

  constructor(view: Loaded, opened: () => boolean) {
    this.#view = view;
    this.#opened = opened;
  }

  /** The linkage, its sizes, its loads or the language are others. */
  changed(): void {
    const { page, linkage } = this.#view;
    clearTimeout(this.#timer);
    if (!page.served || !linkage.drive) {
      const word = linkage.model.source || "LINK";
      renew(this.element, h("p.note", {}, t("Forces need the library: gruebler explore {word}", { word })));
      return;
    }
    if (this.#model !== linkage.model) {
      this.#model = linkage.model;
      this.#forces = [];
      this.#form.clear();
      this.#acting.open = false;
      renew(this.#result);
    }
    this.#summary.textContent = t("Masses, loads");
    if (!this.#acting.isConnected) renew(this.element, this.#acting, this.#result);
    this.#result.classList.add("waiting");
    if (!this.#opened()) return;
    if (!this.#result.firstChild) renew(this.#result, moment());
    this.#timer = setTimeout(() => void this.#ask(), ASKED_AFTER);
  }

  get #question(): Record<string, unknown> {
    const { linkage } = this.#view;
    const { drives, model } = linkage;
    const held = [...drives].slice(0, model.drives.length);
    return { document: documentOf(linkage), source: model.source, drives: held, ...this.#form.record };
  }

  async #ask(): Promise<void> {
    const { page, linkage } = this.#view;
    const { range } = this.#view.transport;
    const { active, cycle } = linkage;
    const running = { active, range, full: cycle.full, speed: this.#form.speed };
    try {
      const found = await page.ask<Answer>("forces", { ...this.#question, ...running });
      if (linkage === this.#view.linkage) this.#show(linkage, found);
    } catch (error) {
      renew(this.#result, h("p.note.error", {}, (error as Error).message));
    }
    this.#result.classList.remove("waiting");
  }

  #show(linkage: Linkage, answer: Answer): void {
    const { besides, drives, effective, effort, forces, lines, masses, origin, power, speed, springs } = answer;
    const { drive, model } = linkage;
    this.#form.show(linkage, masses, speed ?? 0, springs, besides);
    this.#plot = null;
    this.#forces = [];
    const assume = () => {
      this.#form.steel = true;
      this.#brings = true;
      this.changed();
    };
    const button = masses.some(Boolean) ? null : action("assume", assume, t("Assume masses"));
    const offer = h("div.form", {}, button, h("p.note", {}, origin));
    const notes = lines.map((line) => h("p.note", {}, line));
    if (!drives) {
      renew(this.#result, ...notes, offer);
    } else {
      this.#form.element.append(offer);
      const places = Float64Array.from(drives);
      const turning = drive!.turning;
      const unit = turning ? momentUnit(model) : "N";
      const title = `${turning ? t("Drive torque") : t("Drive force")} [${unit}]`;
      this.#plot = new Plot(turning ? "°" : lengthUnit(model), (value) => this.#view.transport.pick(value));
      this.#plot.show(places, { title, colour: "--motion", values: numbers(effort) }, this.#view.transport.range);
      const largestOf = (sizes: ArrayLike<number | null>) => {
        const all = Array.from(sizes, (one) => Math.abs(one ?? 0) || 0);
        return all.indexOf(Math.max(...all));
      };
      const drivenTo = (row: number) => driveText(linkage, drives.at(row)!, 4);
      const at = (place: string) => t("at {place}", { place });
      this.#forces = forces.map(({ joint, link, force }) => {
        const [x, y] = force.map(numbers) as [Float64Array, Float64Array];
        const sizes = x.map((one, k) => Math.hypot(one, y[k]!));
        const links = model.joints[joint]!.links.filter((other) => other !== link);
        const others = links.map((other) => linkage.linkName(other)).join(", ");
        const name = t("{others} on {link}", { others, link: linkage.linkName(link) });
        const row = largestOf(sizes);
        return { joint, drives: places, x, y, most: sizes[row]!, name, note: at(drivenTo(row)) };
      });
      const chosen = this.#joint.selectedIndex;
      renew(this.#joint, ...this.#forces.map(({ name }, value) => h("option", { value }, name)));
      const fallen = h("div.form", {});
      const onclick = () => void this.#fall(fallen);
      const play = () => this.#view.transport.playAt(speed!);
      const release = t("Release the drive: free motion");
      const most = largestOf(effort);
      // a drive that gives way to what pushes it
      const braking = (value: number) => (value < 0 ? t("braking") : "");
      const strong = largestOf(this.#forces.map((force) => force.most));
      const strongest = this.#forces[strong]!;
      this.#joint.selectedIndex = chosen < 0 ? strong : chosen;
      this.#facts.show([
        {
          name: turning ? t("Largest drive torque") : t("Largest drive force"),
          text: `${figure(Math.abs(effort[most]!))} ${unit}`,
          note: `${at(drivenTo(most))} ${braking(effort[most]! * speed!)}`,
        },
        { name: t("Effective (RMS)"), text: `${figure(effective)} ${unit}` },
        { name: t("Largest drive power"), text: `${figure(Math.abs(power[0]))} W`, note: braking(power[0]) },
        { name: t("Mean drive power"), text: `${figure(power[1])} W` },
        {
          name: t("Drive work"),
          text: `${figure((power[1] * (drives.at(-1)! - drives[0]!)) / speed!)} J`,
          note: `${drivenTo(0)} … ${drivenTo(-1)}`,
        },
        {
          name: t("Largest joint force"),
          text: `${figure(strongest.most)} N`,
          note: `${strongest.note}, ${strongest.name}`,
        },
      ]);
      renew(
        this.#result,
        this.#form.rate,
        this.#facts.element,
        this.#plot.element,
        h("div.form", {}, action("play", play, t("Play at this speed"))),
        h("p.note", {}, t("Joint forces in this pose. Arrow length: square root of the force")),
        this.#joints.element,
        h("div.form", {}, h("label", {}, t("Force vector"), this.#joint)),
        this.#polar.element,
        ...notes,
        h("div.form", {}, action("fall", onclick, release)),
        fallen,
      );
      this.#showJoint();
      if (this.#brings) this.element.parentElement!.parentElement!.scrollIntoView();
      this.#brings = false;
    }
    this.at(this.#view.transport.drive);
    this.#view.redraw();
  }

  #showJoint(): void {
    const force = this.#forces[this.#joint.selectedIndex];
    if (!force) return;
    this.#polar.show(force, "N");
    this.#polar.at(this.#view.transport.drive);
  }

  /** The drive is elsewhere. */
  at(drive: number): void {
    if (!this.#opened()) return;
    this.#plot?.at(drive);
    this.#joints.show(
      this.#forces.map((force) => ({
        name: force.name,
        text: `${figure(force.most * Math.hypot(...vectorAt(force, drive)))} N`,
        note: `max. ${figure(force.most)} N ${force.note}`,
      })),
    );
    this.#polar.at(drive);
  }

  get springs(): readonly Spring[] {
    return this.#opened() && this.#model === this.#view.linkage.model ? this.#form.shown : [];
  }

  /** The forces on the stage where the drive is, against the largest of the range. */
  arrows(): Arrow[] {
    if (!this.#opened() || this.#model !== this.#view.linkage.model) return [];
    const most = Math.max(...this.#forces.map((force) => force.most));
    return this.#forces.map((force) => {
      const [x, y] = vectorAt(force, this.#view.transport.drive);
      const here = Math.hypot(x, y) * force.most;
      const root = Math.sqrt(here * most) / force.most || 1; // small ones are seen, too
      return [force.joint, x / root, y / root, here];
    });
  }

  async #fall(place: HTMLElement): Promise<void> {
    const { linkage, page } = this.#view;
    const found = await awaited(place, () => page.ask<Fall>("fall", this.#question));
    if (!found || linkage !== this.#view.linkage) return;
    renew(place, h("p.note", {}, found.lines.join(" ")));
    this.#view.transport.play(found);
  }
}

function numbers(values: Numbers): Float64Array {
  return Float64Array.from(values, (value) => value ?? NaN);
}

function figure(value: number): string {
  return number(value, 3);
}
