/** On which side of its joint a bearing stands, as `bearing_sides` of the library has it. */

const SELDOM = 0.05; // the part of a motion in which what lies over a bearing is no matter

/** How far a bearing is turned away from the links at its joint, in degrees: one side for the whole of a motion, in
 * which they reach to these places about it. */
export function bearingTurn(arms: readonly (readonly [number, number])[]): number {
  const over = [0, 0, 0, 0]; // below, at the right, above, at the left
  for (const [x, y] of arms) over[Math.round((2 * Math.atan2(x, -y)) / Math.PI + 1e-6) & 3]!++;
  const least = Math.min(...over);
  if (over[0]! <= Math.max(2 * least, SELDOM * arms.length)) return 0;
  return -90 * [2, 1, 3].find((way) => over[way] === least)!;
}
