/** Bytes that stand as text in the page. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { bytesOf } from "../src/packed";

test("thirteen bits stand in two characters, the last six in one", () => {
  // 91 characters: " " is 0, "!" 1, "#" 2, ... "}" 90
  assert.deepEqual([...bytesOf("")], []);
  assert.deepEqual([...bytesOf("  ")], [0]);
  // 11111111 11111: 8191 = 90 * 91 + 1; then 111 in one, 111000 = 56, "Z"
  assert.deepEqual([...bytesOf("}!Z")], [255, 255]);
});
