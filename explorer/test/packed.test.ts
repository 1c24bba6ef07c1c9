/** Bytes that stand as text in the page. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { bytesOf } from "../src/packed";

test("six bytes stand in seven signs, fewer in one more than they are", () => {
  // 122 signs: U+0001 is 0, tab 8, then U+000B 9, ... "!" 30, "#" 31, ... U+007F 121
  assert.deepEqual([...bytesOf("")], []);
  assert.deepEqual([...bytesOf("\u0001\u0001")], [0]);
  assert.deepEqual([...bytesOf("\u0001\t")], [8]);
  assert.deepEqual([...bytesOf("\u0001!")], [30]);
  assert.deepEqual([...bytesOf("\u0001#")], [31]);
  // 255 = 2 * 122 + 11, that is U+000E
  assert.deepEqual([...bytesOf("\u0003\u000e")], [255]);
  const digits = [];
  for (let value = 2n ** 47n; digits.length < 7; value /= 122n) digits.unshift(Number(value % 122n));
  const signs = Array.from({ length: 127 }, (_, k) => String.fromCharCode(k + 1)).filter(
    (one) => !'"<\\\n\r'.includes(one),
  );
  assert.deepEqual([...bytesOf(`${digits.map((digit) => signs[digit]).join("")}\u0001!`)], [128, 0, 0, 0, 0, 0, 30]);
});
