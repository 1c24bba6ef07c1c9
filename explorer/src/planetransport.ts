/** The drive of a linkage in the plane: it also follows a link that is pulled, lets it fall, and makes films. */

import { wayOf } from "./beside";
import { wrapped } from "./cycle";
import { type Fall, Falling } from "./falling";
import type { Linkage } from "./linkage";
import { later } from "./player";
import { place } from "./rows";
import { type Driven, Transport } from "./transport";
import { FRAMES } from "./video";

/** The view of a linkage in the plane. */
interface DrivenInPlane extends Driven {
  readonly linkage: Linkage;
}

export class PlaneTransport extends Transport<DrivenInPlane> {
  /** Where poses of a free motion are played, not those of the drive. */
  falling: Falling | null = null;

  protected override get text(): string {
    return this.falling?.text ?? super.text;
  }

  protected override get drives(): ArrayLike<number> {
    return this.falling?.drives ?? super.drives;
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

  /** Play poses of a free motion in real time, again and again until it is paused. */
  play(fall: Fall): void {
    this.pause();
    this.falling = new Falling(fall, this.view.linkage);
    this.toggle();
  }

  /** A free motion is over: the linkage is as it was. */
  protected override paused(): void {
    if (this.falling) {
      this.view.linkage.pose = this.falling.start;
      this.falling = null;
      this.view.posed();
    }
    super.paused();
  }

  protected override advance(seconds: number): void {
    if (!this.falling) return super.advance(seconds);
    this.view.linkage.pose = this.falling.later(seconds);
    this.view.posed();
  }

  /** What is shown in each frame of a film, once through the motion from where the drive is. */
  *film<Shown>(shown: () => Shown): Generator<Shown> {
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
