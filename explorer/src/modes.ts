/** The motions of other assembly modes, which are shown while a joint is dragged. */

import type { Cycle } from "./cycle";
import type { Rows } from "./kernel";
import type { Linkage } from "./linkage";
import { stateAt } from "./rows";

const MOST = 2;

export class OtherModes {
  /** The cycle beside which they were asked for last. */
  #cycle: Cycle | null = null;
  #rows: Rows[] = [];
  #old = false;

  /** The motions over some drive values with one dyad assembled the other way, places alone; none if nothing is
   * dragged. While a drag moves they follow in every second cycle, else they are those of the cycle before. */
  beside(linkage: Linkage): Rows[] {
    const { cycle, dragged, model, program, quick } = linkage;
    if (!dragged || program.roots.length) {
      this.#cycle = null;
      this.#rows = [];
    } else if (cycle !== this.#cycle) {
      this.#cycle = cycle;
      this.#old = quick && !this.#old;
      if (this.#old) return this.#rows;
      const step = quick ? 2 : 3;
      const values = cycle.values.filter((_, row) => row % step === 0);
      const dyads = model.groups.filter((group) => group.modes).slice(0, MOST);
      this.#rows = dyads.map(({ number }) => {
        const state = stateAt(cycle.rows, 0);
        state.signs[number]! *= -1;
        return linkage.runAlong(values, state, 0, true);
      });
    }
    return this.#rows;
  }
}
