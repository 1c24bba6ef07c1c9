/** Fields of laws of lift: their values, and the text with another one. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { lawFields } from "../src/lifts";

test("a law has its lift and its angles as fields, the last dwell what is left", () => {
  const fields = lawFields("rise 20 90 cycloidal; dwell 60; fall 20 120\ndwell")!;
  assert.deepEqual(
    fields.map(({ value }) => value),
    [20, 90, 60, 120, 90],
  );
  const [lift, rise, dwell, , rest] = fields;
  assert.deepEqual(lift!.set!(30), { lift: "rise 30 90 cycloidal; dwell 60; fall 30 120; dwell" });
  assert.deepEqual(rise!.set!(80), { lift: "rise 20 80 cycloidal; dwell 60; fall 20 120; dwell" });
  assert.deepEqual(dwell!.set!(50), { lift: "rise 20 90 cycloidal; dwell 50; fall 20 120; dwell" });
  assert.equal(rest!.set, undefined);
});

test("a law of several lifts or of other parts has none", () => {
  for (const law of ["rise 10 90; rise 10 90; fall 20 90; dwell", "poly 1 2 3", "dwell"])
    assert.equal(lawFields(law), null);
});
