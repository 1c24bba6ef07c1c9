/** The row under the picture: the drive of the linkage, which is set, pulled and played; how it falls by its weight. */

import { TURN, wrapped } from "./cycle";
import { h, renew } from "./dom";
import { driveValue, type Found } from "./facts";
import { type Fall, Falling } from "./falling";
import { parsed, t } from "./language";
import type { Linkage } from "./linkage";
import { later, Player } from "./player";
import { place } from "./rows";
import { Track } from "./track";
import { FRAMES } from "./video";
import type { Page } from "./view";
import { stopText } from "./wording";

/** The view whose linkage is driven. */
export interface Driven {
  readonly page: Page;
  readonly linkage: Linkage;
  /** The pose is another one. */
  posed(): void;
  /** Another drive turns, the others are held. */
  chosen(): void;
  /** A frame that began at this time, in milliseconds, is drawn. */
  timed(start: number): void;
}

export class Transport {
  readonly element = h("div.transport", {});
  readonly player = new Player(
    (seconds) => this.#advance(seconds),
    () => {
      this.#land();
      this.view.page.changed();
    },
  );
  /** Where poses of a free motion are played, not those of the drive. */
  falling: Falling | null = null;
  private speed = 12; // turns a minute; of a slide, strokes
  #way = 1;
  readonly #track = new Track((value, beyond) => this.pick(value, beyond));
  readonly #value = h("input.value", { size: 8, onchange: () => this.#typed() });

  constructor(private readonly view: Driven) {}

  /** Lay the row out anew: play, the drive, its slider and value, the speed. */
  arrange(): void {
    this.player.arrange();
    const { active, model } = this.view.linkage;
    const speed = h("input", {
      type: "range",
      min: 1,
      max: 60,
      value: this.speed,
      "aria-label": t("Speed"),
      oninput: () => {
        this.speed = Number(speed.value);
        rate.textContent = `${this.speed}/min`;
      },
    });
    const rate = h("span", {}, `${this.speed}/min`);
    const onchange = (event: Event) => {
      this.view.linkage.choose(Number((event.target as HTMLSelectElement).value));
      this.view.chosen();
    };
    const choices = model.drives.map((drive, k) =>
      h("option", { value: k, selected: k === active }, this.view.linkage.jointName(drive.name)),
    );
    const drives = choices.length > 1 ? [h("select", { "aria-label": t("Drive"), onchange }, ...choices)] : [];
    const speedLabel = h("label.speed", {}, t("Speed"), speed, rate);
    this.#value.setAttribute("aria-label", t("Drive"));
    renew(this.element, this.player.button, ...drives, this.#track.element, this.#value, speedLabel);
  }

  /** The value of the drive as it is plotted. */
  get drive(): number {
    const { active, cycle, drives } = this.view.linkage;
    return wrapped(cycle, drives[active] ?? 0);
  }

  get range(): [number, number] {
    return this.#track.range;
  }

  /** The range is another one, or what was found in it. */
  showRange({ dead, least }: Found): void {
    const { cycle, drive, model } = this.view.linkage;
    const places = dead.map(({ value }) => value);
    this.#track.show(cycle, drive?.turning ?? true, model.span.between, places, least?.value ?? null, model.unit);
  }

  showValue(): void {
    const { linkage } = this.view;
    this.#value.value = this.falling?.text ?? driveValue(linkage);
    const drive = linkage.drives[linkage.active];
    if (drive !== undefined) this.#track.set(drive);
  }

  // --- the drive is set ----------------------------------------------------------------------------------------------

  pick(value: number, beyond = false): void {
    this.pause();
    this.#go(value);
    const { page, linkage } = this.view;
    const { stops, low, high } = linkage.cycle;
    const stop = Math.abs(value - low) < Math.abs(value - high) ? stops[0] : stops[1];
    page.say(beyond && stop ? stopText(linkage, stop) : "");
  }

  /** A drive value that is typed, in degrees or in the unit of length. */
  #typed(): void {
    const { cycle, drive } = this.view.linkage;
    const value = parsed(this.#value.value.replace(/[^\d.,e−-]*$/, "")) * (drive?.turning ? TURN / 360 : 1);
    const [low, high] = this.range;
    if (!Number.isFinite(value)) return this.showValue();
    if (cycle.full) this.pick(value);
    else this.pick(Math.max(low, Math.min(high, value)), value < low || value > high);
    this.showValue();
  }

  /** Move the drive by so many degrees, or hundredths of the size. */
  nudge(steps: number): void {
    const { cycle, drive, size } = this.view.linkage;
    if (!drive) return;
    const value = this.drive + steps * (drive.turning ? TURN / 360 : size / 200);
    const [low, high] = this.range;
    if (cycle.full) this.pick(value);
    else this.pick(Math.max(low, Math.min(high, value)), value < low || value > high);
  }

  /** Let the drive follow a place of a link that is pulled, in a few steps along its velocity. */
  pull(link: number, u: number, v: number, x: number, y: number): void {
    this.pause();
    const { linkage } = this.view;
    const [low, high] = this.range;
    const limit = linkage.drive?.turning ? 0.35 : 0.1 * linkage.size;
    for (let k = 0; k < 4; k++) {
      const [px, py] = place(linkage.pose, 0, link, u, v);
      const [vx, vy] = place(linkage.pose, 0, link, u, v, 1);
      const square = vx * vx + vy * vy;
      if (!(square > 1e-18) || !Number.isFinite(square)) break;
      const step = Math.max(-limit, Math.min(limit, ((x - px) * vx + (y - py) * vy) / square));
      let value = linkage.drives[linkage.active]! + step;
      if (!linkage.cycle.full) value = Math.max(low, Math.min(high, value));
      if (!linkage.moveTo(value) || Math.abs(step) < 1e-4 * limit) break;
    }
    this.view.posed();
  }

  #go(value: number): void {
    if (this.view.linkage.moveTo(value)) this.view.posed();
  }

  // --- it goes on by itself ------------------------------------------------------------------------------------------

  toggle(): void {
    this.player.toggle();
  }

  pause(): void {
    this.player.pause();
  }

  /** Play poses of a free motion once, in real time. */
  play(fall: Fall): void {
    this.pause();
    this.falling = new Falling(fall, this.view.linkage);
    this.toggle();
  }

  /** A free motion is over: the linkage is as it was. */
  #land(): void {
    if (!this.falling) return;
    this.view.linkage.pose = this.falling.start;
    this.falling = null;
    this.view.posed();
  }

  #advance(seconds: number): void {
    if (this.falling) {
      const pose = this.falling.later(seconds);
      if (!pose) return this.pause();
      this.view.linkage.pose = pose;
      return this.view.posed();
    }
    const start = performance.now();
    const { range } = this;
    const next = later(this.drive, this.#way, seconds, this.speed, this.view.linkage.cycle, range);
    this.#way = next.way;
    if (range[1] > range[0]) this.#go(next.value);
    this.view.timed(start);
  }

  /** What is shown in each frame of a film, once through the motion from where the drive is. */
  *film<Shown>(shown: () => Shown): Generator<Shown> {
    this.pause();
    const { active, cycle, drives } = this.view.linkage;
    const start = drives[active] ?? 0;
    const turns = cycle.full ? cycle.turns : 1;
    let [value, way] = [wrapped(cycle, start), 1];
    for (let left = Math.round((turns * 60 * FRAMES) / this.speed); left > 0; left--) {
      yield shown();
      ({ value, way } = later(value, way, 1 / FRAMES, this.speed, cycle, this.range));
      this.#go(value);
    }
    this.#go(start);
  }
}
