/** The drive of a linkage in the plane: it also follows a link that is pulled, lets it fall, and makes films. */

import { wayOf } from "./beside";
import { wrapped } from "./cycle";
import { action } from "./dom";
import { Falling } from "./falling";
import type { Rows } from "./kernel";
import { t } from "./language";
import type { Linkage } from "./linkage";
import { later } from "./player";
import { place } from "./rows";
import { type Driven, type Marked, Transport } from "./transport";
import { FRAMES } from "./video";

/** The view of a linkage in the plane. */
interface DrivenInPlane extends Driven {
  readonly linkage: Linkage;
  readonly found: Marked;
  readonly stage: { refit(): void };
  readonly side: { back(): void };
}

export class PlaneTransport extends Transport<DrivenInPlane> {
  /** Where poses of a free motion are shown, not those of the drive. */
  falling: Falling | null = null;

  protected override get text(): string {
    return this.falling?.text ?? super.text;
  }

  protected override get place(): number | undefined {
    return this.falling?.seconds ?? super.place;
  }

  protected override get scale(): number {
    return this.falling ? 1 : super.scale;
  }

  protected override get ending(): HTMLElement | null {
    const end = () => {
      this.endFall();
      this.view.side.back();
    };
    return this.falling && action("end", end, t("End free motion"));
  }

  override showRange(found: Marked): void {
    if (!this.falling) return super.showRange(found);
    const { until } = this.falling;
    this.track.show({ full: false, turns: 0, low: 0, high: until, stops: [null, null] }, false, [], null, "s");
  }

  override pick(value: number, beyond = false): void {
    this.endFall();
    super.pick(value, beyond);
  }

  override nudge(steps: number): void {
    if (this.falling) this.seek(this.falling.seconds + steps / this.falling.fall.rate);
    else super.nudge(steps);
  }

  protected override turnTo(value: number): void {
    if (this.falling) this.seek(value);
    else super.turnTo(value);
  }

  protected override slid(value: number, beyond: boolean): void {
    if (this.falling) this.seek(value);
    else super.slid(value, beyond);
  }

  /** Let the drive follow a place of a link that is pulled, in a few steps along its velocity. */
  pull(link: number, u: number, v: number, x: number, y: number): void {
    this.endFall();
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

  /** Stand still so many seconds after the start of a free motion. */
  seek(seconds: number, fall = this.falling?.fall): void {
    this.pause();
    if (!fall) return;
    if (this.falling?.fall !== fall) {
      this.endFall();
      this.falling = new Falling(fall, this.view.linkage);
      this.turned();
    }
    this.view.linkage.pose = this.falling!.at(seconds);
    this.view.posed();
  }

  /** A free motion is over: the linkage is as it was. */
  endFall(): void {
    const { falling } = this;
    if (!falling) return;
    this.pause();
    this.falling = null;
    Object.assign(this.view.linkage, falling.before);
    this.turned();
    this.view.posed();
  }

  /** The pose at the drive, also while another one is shown. */
  get pose(): Rows {
    return (this.falling?.before ?? this.view.linkage).pose;
  }

  /** From the drive to time, or back. */
  private turned(): void {
    const { found, stage } = this.view;
    this.arrange();
    this.showRange(found);
    stage.refit();
  }

  protected override paused(): void {
    if (!this.falling) super.paused();
  }

  protected override advance(seconds: number): void {
    if (!this.falling) return super.advance(seconds);
    this.view.linkage.pose = this.falling.later(seconds * this.pace);
    this.view.posed();
  }

  /** What is shown in each frame of a film, once through the motion from where the drive is. */
  *film<Shown>(shown: () => Shown): Generator<Shown> {
    this.endFall();
    const { playing } = this.player;
    this.pause();
    const { active, beside, cycle, drives } = this.view.linkage;
    const start = drives[active] ?? 0;
    const turns = cycle.full ? cycle.turns : 1;
    let [value, way] = [wrapped(cycle, start), wayOf(beside)];
    for (let left = Math.round((turns * 60 * FRAMES) / this.speed); left > 0; left--) {
      yield shown();
      ({ value, way } = later(value, way, 1 / FRAMES, this.speed, cycle, this.range));
      this.go(value);
    }
    this.go(start);
    if (playing) this.toggle();
  }
}
