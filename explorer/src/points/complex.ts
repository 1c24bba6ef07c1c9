/** Complex numbers, as far as the synthesis on the page needs them. */

export type Complex = readonly [number, number];

export const add = ([a, b]: Complex, [c, d]: Complex): Complex => [a + c, b + d];
export const sub = ([a, b]: Complex, [c, d]: Complex): Complex => [a - c, b - d];
export const mul = ([a, b]: Complex, [c, d]: Complex): Complex => [a * c - b * d, a * d + b * c];
export const scaled = (k: number, [a, b]: Complex): Complex => [k * a, k * b];
export const conj = ([a, b]: Complex): Complex => [a, -b];
export const abs = ([a, b]: Complex): number => Math.hypot(a, b);
export const angle = ([a, b]: Complex): number => Math.atan2(b, a);
export const turned = (by: number): Complex => [Math.cos(by), Math.sin(by)];

export function div(u: Complex, [c, d]: Complex): Complex {
  const square = c * c + d * d;
  return scaled(1 / square, mul(u, [c, -d]));
}
