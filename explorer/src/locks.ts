/** What a reader wants to stay as it is while joints are dragged, in the numbers of the linkage. */

import type { Lock } from "./beside";
import type { Linkage } from "./linkage";
import type { Pair } from "./rows";

export type Kept = "length" | "direction";

export class Locks {
  #read: readonly Lock[] | undefined;
  #joints: ReadonlySet<number> = new Set();
  #between: Record<Kept, Pair[]> = { length: [], direction: [] };

  constructor(private readonly linkage: Linkage) {}

  /** Joints that stay where they are. */
  get held(): ReadonlySet<number> {
    this.#readAnew();
    return this.#joints;
  }

  /** The pairs of elements whose distance, or whose direction in the plane, stays. */
  pairs(kind: Kept): readonly Pair[] {
    this.#readAnew();
    return this.#between[kind];
  }

  keeps(kind: Kept, first: number, second: number): boolean {
    return this.pairs(kind).some(([one, other]) => one === first && other === second);
  }

  /** Let a joint stay, or not. */
  hold(joint: number): void {
    this.#toggle(["joint", this.linkage.model.joints[joint]!.name]);
  }

  /** Let the length or the direction between two pins of a link stay, or not. */
  keep(kind: Kept, first: number, second: number): void {
    const { model, sizes } = this.linkage;
    const name = (k: number) => model.joints[sizes.element(k).joint]!.name;
    this.#toggle([kind, model.links[sizes.element(first).link]!, name(first), name(second)]);
  }

  #toggle(lock: Lock): void {
    const { locks = [], ...rest } = this.linkage.beside;
    const others = locks.filter((one) => one.join() !== lock.join());
    if (others.length === locks.length) others.push(lock);
    this.linkage.beside = { ...rest, ...(others.length && { locks: others }) };
  }

  /** Names of what is not there, in a file that was written by hand, are passed over. */
  #readAnew(): void {
    const { beside, model, sizes } = this.linkage;
    if (beside.locks === this.#read) return;
    this.#read = beside.locks;
    const numberOf = (name: string) => model.joints.findIndex((joint) => joint.name === name);
    const joints = new Set<number>();
    this.#between = { length: [], direction: [] };
    for (const [kind, owner, ...ends] of beside.locks ?? []) {
      if (kind === "joint") joints.add(numberOf(owner));
      else {
        const on = (name: string) =>
          sizes
            .elementsOf(numberOf(name))
            .find((k) => model.links[sizes.element(k).link] === owner && sizes.is(k, "pin"));
        const [one, other] = ends.map(on);
        if (one !== undefined && other !== undefined) this.#between[kind].push([one, other]);
      }
    }
    this.#joints = joints;
  }
}
