/** Slopes of rows, at ends of a range too, against derivatives by hand. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { slopes } from "../src/space/outputs";

const rows = (of: (x: number) => number) => Float64Array.from({ length: 73 }, (_, row) => of(row / 72));

test("at the ends of a range slopes come from the one side", () => {
  const found = slopes(
    rows((x) => Math.sin(x)),
    1 / 72,
    false,
  );
  for (const row of [0, 1, 36, 71, 72]) assert.ok(Math.abs(found[row]! - Math.cos(row / 72)) < 5e-5, `${row}`);
});

test("next to a limit, where a slope is without bound, it is unknown", () => {
  const found = slopes(
    rows((x) => Math.sqrt(x)),
    1 / 72,
    false,
  );
  assert.ok(Number.isNaN(found[0]!));
  assert.ok(Math.abs(found[72]! - 0.5) < 1e-4);
});
