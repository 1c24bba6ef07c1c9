/** The arrow of a slide that is driven: in the barrel of its cylinder, else along it beside what slides. */

import { cylinderOf, mouthOf } from "./bodies";
import { DEGREE } from "./cycle";
import { PUSHED, PUSHING } from "./ground";
import { away, middleOf } from "./hull";
import type { Linkage } from "./linkage";
import { slideOf } from "./measures";
import { direction, type Pair } from "./rows";
import type { Viewport } from "./viewport";

export const BESIDE = 15; // pixels from the line of a slide to the arrow
export const ARROW = 46; // of a barrel in which it has room

/** What it is in the pose that is shown: how it lies, and what it covers beside bodies. */
export interface Push {
  transform: string;
  covers: Pair[];
}

/** The path of the arrow of a joint, and where it is in each pose. */
export function pushOf(linkage: Linkage, joint: number): [path: string, at: (viewport: Viewport) => Push] {
  const { beside, model, sizes } = linkage;
  const way = beside.backward ? -1 : 1;
  const cylinder = cylinderOf(linkage, joint);
  const [line, other] = slideOf(model, sizes, joint);
  return [
    PUSHED,
    (viewport) => {
      const pixels = (at: Pair) => viewport.screen(...at);
      if (cylinder) {
        const from = pixels(linkage.elementAt(cylinder.ends[0]!));
        const to = pixels(mouthOf(linkage, cylinder, false));
        const [x, y] = middleOf([from, to]);
        const part = Math.min(1, away(from, ...to) / ARROW);
        const turn = Math.atan2(to[1] - from[1], to[0] - from[0]) / DEGREE;
        const within = `scale(${part * way} ${part}) translate(0 ${BESIDE})`;
        return { transform: `translate(${x} ${y}) rotate(${turn}) ${within}`, covers: [] };
      }
      const [x, y] = pixels(linkage.elementAt(other));
      const [c, s] = direction(linkage.pose, 0, sizes.element(line).link, sizes.line(line));
      // above, where a block stands on its rail, or at the left if it is upright
      const side = (Math.abs(c) > 1e-9 * Math.abs(s) ? c : s) > 0 ? 1 : -1;
      const transform = `translate(${x} ${y}) rotate(${-Math.atan2(s, c) / DEGREE}) scale(${way} ${side})`;
      const covers = PUSHING.map(([u, v]): Pair => [x + c * u + s * side * v, y - s * u + c * side * v]);
      return { transform, covers };
    },
  ];
}
