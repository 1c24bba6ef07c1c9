/** Bytes that stand as text in the page. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { bytesOf } from "../src/packed";

test("97 bytes stand in 112 signs, fewer in fifteen more than they are", () => {
  // 122 signs: U+0001 is 0, tab 8, then U+000B 9, ... "!" 30, "#" 31, ... U+007F 121
  assert.deepEqual([...bytesOf("")], []);
  const zeros = "\u0001".repeat(15);
  assert.deepEqual([...bytesOf(`${zeros}\u0001`)], [0]);
  assert.deepEqual([...bytesOf(`${zeros}\t`)], [8]);
  assert.deepEqual([...bytesOf(`${zeros}!`)], [30]);
  assert.deepEqual([...bytesOf(`${zeros}#`)], [31]);
  // 255 = 2 * 122 + 11, that is U+000E
  assert.deepEqual([...bytesOf(`${zeros.slice(1)}\u0003\u000e`)], [255]);
  const digits = [];
  for (let value = 2n ** 775n; digits.length < 112; value /= 122n) digits.unshift(Number(value % 122n));
  const signs = Array.from({ length: 127 }, (_, k) => String.fromCharCode(k + 1)).filter(
    (one) => !'"<\\\n\r'.includes(one),
  );
  const whole = digits.map((digit) => signs[digit]).join("");
  assert.deepEqual([...bytesOf(`${whole}${zeros}!`)], [128, ...Array(96).fill(0), 30]);
});
