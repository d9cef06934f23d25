// Numbers as people type and read them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { NotAQuantity, convert, isPlain, readQuantity } from "../../web/js/form/quantity.js";
import { formatError, formatLength, formatNumber, plainNumber, stepped } from "../../web/js/page/number.js";
import { one, random } from "./common.mjs";

/** What a person would type for a text that is read: plain minus, no gaps, powers as e. */
const typed = (text) =>
  text
    .replace(/\u2212/g, "-")
    .replace(/\u202f/g, "")
    .replace(
      /·10(.+)$/,
      (_, power) => `e${[...power].map((c) => (c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c))).join("")}`,
    );

/** Numbers of any size that a field may hold. */
function* numbers() {
  const next = random(7);
  for (let k = 0; k < 2000; k++) yield one(next, [-1, 1]) * next() * 10 ** Math.floor(next() * 24 - 12);
  yield* [0, 1, -1, 0.1, 1e-4, 9999, 10000, 99999.5, 1e9, 123456789, 0.30000000000000004];
}

test("a field's text is the number again, to the last bit", () => {
  for (const value of numbers()) {
    assert.equal(readQuantity(plainNumber(value)), value);
    assert.ok(isPlain(plainNumber(value)));
  }
});

test("a figure is as near as its digits say", () => {
  for (const value of numbers())
    for (const digits of [2, 3, 4]) {
      const read = Number(typed(formatNumber(value, digits)));
      // Half a unit of the last digit, of a number that starts with 1.
      assert.ok(Math.abs(read - value) <= 0.5 * 10 ** (1 - digits) * Math.abs(value) + 1e-300, `${value}: ${read}`);
    }
});

test("a fixed place is as near as the place says, and small is not nothing", () => {
  for (const value of numbers()) {
    const length = Math.abs(value);
    if (length >= 1000) continue;
    const text = formatError(length);
    if (text.startsWith("<")) assert.ok(length > 0 && length < 0.00005);
    else assert.ok(Math.abs(Number(text) - length) <= 0.00005 * (1 + 1e-9), `${length}: ${text}`);
  }
  assert.equal(formatError(0), "0.0000");
  assert.equal(formatLength(0), "0");
  assert.equal(formatLength(0.00001), "<0.0001");
});

test("lengths and figures grow with their value", () => {
  const sorted = [...numbers()]
    .map(Math.abs)
    .filter((v) => v >= 0.0001 && v < 1e9)
    .sort((a, b) => a - b);
  for (const format of [formatNumber, formatLength]) {
    const read = sorted.map((value) => Number(typed(format(value))));
    for (let k = 1; k < read.length; k++) assert.ok(read[k] >= read[k - 1], `${sorted[k - 1]}, ${sorted[k]}`);
  }
});

test("what is read as a number, and what is not", () => {
  for (const [text, value] of [
    ["1.5", 1.5],
    ["1,5", 1.5],
    [" 12 000 ", 12000],
    ["\u22123", -3],
    ["1.5e3", 1500],
    ["+.5", 0.5],
    ["7.", 7],
  ])
    assert.equal(readQuantity(text), value, text);
  for (const text of ["", "-", ".", "1,000", "1.2.3", "1e", "0x10", "Infinity", "NaN", "1 mm", "1/0", "1 2", "(1", "١"])
    assert.throws(() => readQuantity(text), NotAQuantity, text);
});

test("units are converted by their definitions", () => {
  for (const [text, unit, value] of [
    ["1/2 in", "mm", 12.7], // an inch is 25.4 mm
    ["1 1/2 in", "mm", 38.1],
    ["6000 mm/min", "mm/s", 100],
    ["60 rpm", "Hz", 1],
    ["1 m/s²", "mm/s²", 1000],
    ["1 Nm", "N mm", 1000],
    ["1 GPa", "MPa", 1000],
    ["2*(10+5)", "mm", 30],
    ["1 in + 0.6 mm", "mm", 26],
    ["12.5 %", "%", 12.5],
  ])
    assert.equal(readQuantity(text, unit), value, text);
  assert.equal(readQuantity("2", "mm", "in"), 50.8, "a bare number is in the unit that is shown");
  for (const unit of ["s", "deg", "N", "%", ""]) assert.throws(() => readQuantity("1 mm", unit), NotAQuantity, unit);
  const next = random(8);
  for (const [a, b] of [
    ["mm", "in"],
    ["mm/s", "in/min"],
    ["N", "lbf"],
    ["deg", "rad"],
  ])
    for (let k = 0; k < 100; k++) {
      const value = next() * 1000;
      // Each way is rounded to 15 digits.
      assert.ok(Math.abs(convert(convert(value, a, b), b, a) - value) <= 2e-14 * value, `${value} ${a}`);
    }
});

test("a comma that may separate decimals or thousands is asked about, with both readings", () => {
  assert.throws(
    () => readQuantity("1,000 mm", "mm"),
    (error) =>
      error instanceof NotAQuantity && error.readings.map((each) => readQuantity(each, "mm")).join() === "1000,1",
  );
  assert.equal(readQuantity("1,000.5"), 1000.5);
});

test("a step is in the second digit, and the way back is the way", () => {
  for (const value of numbers()) {
    if (value === 0) continue;
    const up = stepped(value, 1);
    assert.ok(up > value, `${value}`);
    // Across a power of ten, and where twelve digits round, steps have another size.
    const share = (up - value) / Math.abs(value);
    assert.ok(share >= 0.01 - 1e-9 && share <= 0.1 + 1e-9, `${value}: ${share}`);
  }
  assert.equal(stepped(stepped(250, 1), -1), 250);
  assert.equal(stepped(3, 1, true), 4);
  assert.equal(stepped(0, -1), -1);
  assert.equal(stepped(0.3, 1), 0.31, "without the last bits of a sum");
});

test("what is no number is a dash", () => {
  for (const value of [NaN, Infinity, -Infinity]) assert.equal(formatNumber(value), "–");
  assert.equal(plainNumber(undefined), "");
});
