/** A design that plays over its targets: bars of its links, and the curves of its points. */

import { put, renew, svg, wantsStill } from "./dom";

const PACE = 48; // frames of a motion in a second

export interface Moving {
  /** Places of the joints, then of the points, evenly in time. */
  frames: [number, number][][];
  /** Which of them each moving link has. */
  members: number[][];
  joints: number;
  /** The joint that is driven. */
  drive?: number;
}

const spot = ([x, y]: [number, number]) => `${x},${-y}`;

export class Ghost {
  readonly element = svg("g.ghost", { "data-ghost": "" });
  #frame = 0;

  /** It stands still while it is not seen. */
  constructor(private readonly seen: () => boolean) {}

  /** Pivots are drawn in units of the plane, which are so long. */
  play(moving: Moving | null, unit = 1): void {
    cancelAnimationFrame(this.#frame);
    if (!moving) return renew(this.element);
    const { frames, members, joints } = moving;
    const curves = frames[0]!.slice(joints).map((_, k) => {
      const points = [...frames, frames[0]!].map((frame) => spot(frame[joints + k]!)).join(" ");
      return svg("polyline.curve", { points });
    });
    // an edge under each link, and pins over all of them, as of machines that are open
    const [edges, bars] = ["path.edge", "polygon"].map((tag) => members.map(() => svg(tag as "path")));
    const pins = frames[0]!.slice(0, joints).map(() => svg("circle.pin", { r: 1.2 * unit }));
    const pivots = frames[0]!.slice(0, joints).flatMap(([x, y], k) => {
      const moves = frames.some((frame) => Math.hypot(frame[k]![0] - x, frame[k]![1] - y) > 1e-3 * unit);
      const place = { transform: `translate(${x} ${-y}) scale(${unit})` };
      const ring = k === moving.drive ? [svg("circle.ring", { r: 4.5, ...place })] : [];
      return moves ? [] : [svg("path.pivot", { d: "M0 0l3 5h-6zM-5 5h10", ...place }), ...ring];
    });
    renew(this.element, ...curves, ...pivots, ...edges!, ...bars!, ...pins);
    const still = wantsStill();
    const tick = (now: number) => {
      const places = frames[Math.floor((now / 1000) * PACE) % frames.length]!;
      for (const [k, bar] of bars!.entries()) {
        const points = members[k]!.map((one) => spot(places[one]!)).join(" ");
        bar.setAttribute("points", points);
        edges![k]!.setAttribute("d", `M${points}Z`);
      }
      for (const [k, pin] of pins.entries()) put(pin, { cx: places[k]![0], cy: -places[k]![1] });
      if (!still && this.seen()) this.#frame = requestAnimationFrame(tick);
    };
    tick(performance.now());
  }
}
