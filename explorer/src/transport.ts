/** The row under the picture: the drive of the linkage, which is set, pulled and played. */

import { type Beside, wayOf } from "./beside";
import { DEGREE, type Reach, type Stop, TURN, wrapped } from "./cycle";
import { h, renew } from "./dom";
import { number, parsed, t } from "./language";
import { later, Player } from "./player";
import { driveText, Track } from "./track";

/** A linkage as far as it is driven. */
export interface Drivable {
  /** The number of the drive that is moved, and what it is. */
  readonly active: number;
  readonly drive: { turning: boolean } | null;
  readonly cycle: Reach;
  readonly drives: ArrayLike<number>;
  readonly model: { drives: { name: string }[]; unit: string };
  readonly size: number;
  readonly beside?: Beside;
  driveName(number: number): string;
  choose(active: number): void;
  /** Whether it could. */
  moveTo(value: number): boolean;
}

/** The view whose linkage is driven. */
export interface Driven {
  readonly linkage: Drivable;
  /** The pose is another one. */
  posed(): void;
  /** Another drive turns, the others are held. */
  chosen(): void;
  /** It plays no more. */
  paused(): void;
  /** A value was asked for, beyond this stop unless there is none. */
  picked(stop: Stop | null): void;
  /** A frame that began at this time, in milliseconds, is drawn. */
  timed(start: number): void;
}

/** What is found over a cycle, to be marked. */
export interface Marked {
  dead: { value: number }[];
  least: { value: number; leg: unknown } | null;
}

/** At which a machine is played at first. */
export const SPEED = 12;

export class Transport<View extends Driven = Driven> {
  readonly element = h("div.transport", {});
  readonly player = new Player(
    (seconds) => this.advance(seconds),
    () => this.paused(),
  );
  speed = SPEED; // turns a minute; of a slide, strokes
  /** Of another motion than that of the drive: so many times as fast as it is. */
  protected pace = 1;
  #way = 1;
  protected readonly track = new Track((value, beyond) => this.slid(value, beyond));
  readonly #value = h("input.value", { size: 8, onchange: () => this.#typed() });

  constructor(protected readonly view: View) {}

  /** Lay the row out anew: play, the drive, its slider and value, the speed. */
  arrange(): void {
    this.player.arrange();
    const { active, model } = this.view.linkage;
    const { ending } = this;
    const told = () => (ending ? `×\u2009${number(this.pace)}` : `${number(this.speed, 3)}/min`);
    const [step, max, value] = ending ? [0.1, 1, this.pace] : [1, 60, this.speed];
    const oninput = () => {
      if (ending) this.pace = Number(speed.value);
      else this.speed = Number(speed.value);
      rate.textContent = told();
    };
    const speed = h("input", { type: "range", min: step, max, step, value, "aria-label": t("Speed"), oninput });
    const rate = h("span", {}, told());
    const onchange = (event: Event) => {
      this.view.linkage.choose(Number((event.target as HTMLSelectElement).value));
      this.view.chosen();
    };
    const choices = model.drives.map((_, k) =>
      h("option", { value: k, selected: k === active }, this.view.linkage.driveName(k)),
    );
    const called = t("Drive");
    const drives = choices.length > 1 && h("select", { "aria-label": called, title: called, onchange }, ...choices);
    const speedLabel = h("label.speed", {}, !ending && h("span", {}, t("Speed")), speed, rate);
    this.#value.setAttribute("aria-label", ending ? t("Time") : called);
    const { button } = this.player;
    const track = this.track.element;
    const row = ending
      ? [button, track, this.#value, speedLabel, ending]
      : [button, drives, track, this.#value, speedLabel];
    renew(this.element, ...(this.view.linkage.drive ? row : []));
  }

  /** Where the slider stands. */
  protected get place(): number | undefined {
    const { active, drives } = this.view.linkage;
    return drives[active];
  }

  /** Of what is typed. */
  protected get scale(): number {
    return this.view.linkage.drive?.turning ? DEGREE : 1;
  }

  /** What ends another motion than that of the drive. */
  protected get ending(): HTMLElement | null {
    return null;
  }

  /** The value of the drive as it is plotted. */
  get drive(): number {
    const { active, cycle, drives } = this.view.linkage;
    return wrapped(cycle, drives[active] ?? 0);
  }

  get range(): [number, number] {
    return this.track.range;
  }

  /** The range is another one, or what was found in it. */
  showRange({ dead, least }: Marked): void {
    const { cycle, drive, model } = this.view.linkage;
    const places = dead.map(({ value }) => value);
    this.track.show(cycle, drive?.turning ?? true, places, least?.leg ? least.value : null, model.unit);
  }

  /** The value of the drive as it is shown. */
  protected get text(): string {
    return this.view.linkage.drive ? driveText(this.view.linkage, this.drive) : "";
  }

  showValue(): void {
    this.#value.value = this.text;
    const { place } = this;
    if (place !== undefined) this.track.set(place);
  }

  // --- the drive is set ----------------------------------------------------------------------------------------------

  pick(value: number, beyond = false): void {
    this.pause();
    this.go(value);
    const { stops, low, high } = this.view.linkage.cycle;
    const stop = Math.abs(value - low) < Math.abs(value - high) ? stops[0] : stops[1];
    this.view.picked(beyond ? stop : null);
  }

  /** A drive value that is typed, in degrees or in the unit of length. */
  #typed(): void {
    const value = parsed(this.#value.value.replace(/[^\d.,e−-]*$/, "")) * this.scale;
    if (Number.isFinite(value)) this.turnTo(value);
    this.showValue();
  }

  /** Move the drive by so many degrees, or hundredths of the size. */
  nudge(steps: number): void {
    const { drive, size } = this.view.linkage;
    if (drive) this.turnTo(this.drive + steps * (drive.turning ? DEGREE : size / 200));
  }

  /** As far as it goes. */
  protected turnTo(value: number): void {
    if (this.view.linkage.cycle.full) this.pick(value);
    else this.track.pickWithin(value);
  }

  /** The slider was moved. */
  protected slid(value: number, beyond: boolean): void {
    this.pick(value, beyond);
  }

  protected go(value: number): void {
    if (this.view.linkage.moveTo(value)) this.view.posed();
  }

  // --- it goes on by itself ------------------------------------------------------------------------------------------

  toggle(): void {
    this.player.toggle();
  }

  /** Play at a speed of the drive, in rad/s or lengths a second. */
  playAt(speed: number): void {
    const [low, high] = this.range;
    this.speed = (60 * speed) / (this.view.linkage.cycle.full ? TURN : 2 * (high - low));
    this.arrange();
    if (!this.player.playing) this.toggle();
  }

  pause(): void {
    this.player.pause();
  }

  protected paused(): void {
    this.view.paused();
  }

  protected advance(seconds: number): void {
    const start = performance.now();
    const { range } = this;
    const { beside, cycle } = this.view.linkage;
    if (cycle.full) this.#way = wayOf(beside);
    const next = later(this.drive, this.#way, seconds, this.speed, cycle, range);
    this.#way = next.way;
    if (range[1] > range[0]) this.go(next.value);
    this.view.timed(start);
  }
}
