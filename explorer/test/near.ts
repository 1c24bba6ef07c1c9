import assert from "node:assert/strict";

/** Numbers that agree, one by one. */
export function near(found: ArrayLike<number>, wanted: ArrayLike<number>, tolerance = 1e-9): void {
  assert.equal(found.length, wanted.length);
  for (const [k, value] of Array.from(wanted).entries())
    assert.ok(Math.abs(found[k]! - value) <= tolerance, `${found[k]} is not ${value} (number ${k})`);
}

/** A number that agrees. */
export function close(found: number, wanted: number, tolerance = 1e-9): void {
  near([found], [wanted], tolerance);
}
