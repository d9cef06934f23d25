// Numbers with units and sums: against arithmetic done by hand, and by laws.

import assert from "node:assert/strict";
import { test } from "node:test";
import { NotAQuantity, convert, isPlain, readQuantity } from "../../web/js/form/quantity.js";

const refused = (text, unit, pattern) =>
  assert.throws(
    () => readQuantity(text, unit),
    (error) => error instanceof NotAQuantity && pattern.test(error.message),
    text,
  );

test("units and sums", () => {
  const cases = [
    // An inch is 25.4 mm, a minute 60 s, by definition.
    ["1/2 in", "mm", 12.7],
    ["0.5in", "mm", 12.7],
    ['1/2"', "mm", 12.7],
    ["1 1/2 in", "mm", 38.1],
    ["1.1 in", "mm", 27.94],
    ["2 cm + 3 mm", "mm", 23],
    ["1 ft", "mm", 304.8],
    ["12.7", "mm", 12.7],
    ["12.7 MM", "mm", 12.7],
    ["6000 mm/min", "mm/s", 100],
    ["6 m/min", "mm/s", 100],
    ["60 ipm", "mm/s", 25.4],
    ["100 mm/s", "mm/s", 100],
    ["1 m/s²", "mm/s²", 1000],
    ["1 m/s^2", "mm/s²", 1000],
    ["1 m/s2", "mm/s²", 1000],
    ["50*2", "mm", 100],
    ["2*(10+5)", "mm", 30],
    ["-(3-5) × 2", "mm", 4],
    ["0.1+0.2", "mm", 0.3],
    ["12.5 %", "%", 12.5],
    ["30 N", "N", 30],
    ["0.1 deg", "deg", 0.1],
    ["0.1°", "deg", 0.1],
    ["2 GPa", "N/mm²", 2000],
    ["3 Nm", "N m", 3],
    ["3 N m", "N m", 3],
    ["0.5 rad/(N m)", "rad/(N m)", 0.5],
    ["4 ms", "s", 0.004],
    ["4000", "1/min", 4000],
    ["4000 rpm", "1/min", 4000],
    ["4000 1/min", "1/min", 4000],
    ["4000/min", "1/min", 4000],
    ["60 rpm", "Hz", 1],
    ["18 rad/s", "rad/s", 18],
    ["2 lb", "kg", 0.90718474],
    ["4", "", 4],
  ];
  for (const [text, unit, value] of cases) assert.equal(readQuantity(text, unit), value, text);
  // 1 Hz is 2 pi rad/s; the last digits are rounded away.
  assert.ok(Math.abs(readQuantity("1 Hz", "rad/s") - 2 * Math.PI) < 1e-13);
});

test("commas and thousands", () => {
  const cases = [
    ["1,5", 1.5],
    ["0,125", 0.125],
    [",5", 0.5],
    ["1,2345", 1.2345],
    ["1 000", 1000],
    ["1\u202f000", 1000],
    ["1'000", 1000],
    ["1,000.5", 1000.5],
    ["1,000,000", 1e6],
    ["1.000,5", 1000.5],
    ["1 000,5", 1000.5],
    ["1e3", 1000],
    ["\u22125", -5],
  ];
  for (const [text, value] of cases) assert.equal(readQuantity(text, "mm"), value, text);
  for (const [text, readings] of [
    ["1,000", ["1000", "1.000"]],
    ["-12,345", ["-12345", "-12.345"]],
    ["2*1,000 mm", ["2*1000 mm", "2*1.000 mm"]],
  ]) {
    assert.throws(
      () => readQuantity(text, "mm"),
      (error) => {
        assert.deepEqual(error.readings, readings);
        assert.match(error.message, /Did you mean 1\d+ or 1\d*\.\d+\?/);
        return true;
      },
    );
  }
});

test("what is no quantity of the field is refused by name", () => {
  refused("", "mm", /^A number is needed here/);
  for (const text of [
    "fast",
    "NaN",
    "Infinity",
    "mm",
    "1 2",
    "1..2",
    "1,00,0.5",
    "2*",
    "(1",
    "1)",
    "<b>1</b>",
    "1.000.000",
  ])
    refused(text, "mm", /is not a number/);
  refused("constructor 1", "mm", /not a number|not a unit/);
  refused("5 parsec", "mm", /“parsec” is not a unit/);
  refused("30 N", "mm", /“30 N” is a force\. A length is needed here, in mm, cm, m, in or ft/);
  refused("5 mm", "mm/s", /is a length\. A speed is needed/);
  refused("5 mm", "", /without a unit/);
  refused("5 mm + 2", "mm", /same kind/);
  refused("1e999", "mm", /too large/);
  refused("1/0", "mm", /too large or divides by zero/);
});

test("a plain number is one of the unit on show, bit for bit where that is the field's own", () => {
  assert.equal(readQuantity("0.5", "mm", "in"), 12.7);
  assert.equal(readQuantity("6000", "mm/s", "mm/min"), 100);
  assert.equal(readQuantity("0.5 mm", "mm", "in"), 0.5);
  for (const value of [0.1, 1 / 3, 5e-324, Number.MAX_VALUE, 123456789.123456789])
    assert.equal(readQuantity(String(value), "mm"), value);
});

test("there and back is the same to 15 digits, and units agree with one another", () => {
  for (const [one, other] of [
    ["mm", "in"],
    ["mm/s", "in/min"],
    ["mm/s", "mm/min"],
    ["mm/s²", "in/s²"],
    ["N", "lbf"],
    ["rad/s", "Hz"],
  ]) {
    for (const value of [1e-6, 0.1, 3, 12.7, 98765.4321]) {
      const back = convert(convert(value, one, other, 17), other, one, 17);
      assert.ok(Math.abs(back - value) <= 4e-16 * value, `${value} ${one} by ${other}: ${back}`);
      // Typed with its unit it is what it converts to.
      assert.equal(readQuantity(`${value} ${one}`, other), convert(value, one, other));
    }
  }
  assert.ok(isPlain("12.5") && isPlain("-.5e-3") && !isPlain("1,5") && !isPlain("1 in") && !isPlain("1+1"));
});
