// Lengths and forces in the chosen units.

import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { choose, choices, lend, onSetting, setting } from "../../web/js/page/settings.js";
import {
  errorText,
  forceText,
  forceUnit,
  inLength,
  largeText,
  lengthText,
  lengthUnit,
} from "../../web/js/page/units.js";

afterEach(() => lend({ length: "mm", force: "N", theme: "auto" }));

test("an inch is 25.4 mm, a pound-force 4.448 N", () => {
  assert.deepEqual([lengthUnit(), forceUnit()], ["mm", "N"]);
  assert.equal(lengthText(25.4), "25.4");
  choose("length", "inch");
  choose("force", "lbf");
  assert.deepEqual([lengthUnit(), forceUnit()], ["in", "lbf"]);
  assert.equal(inLength(25.4), 1);
  assert.equal(lengthText(25.4), "1");
  // 9.80665 m/s2 times 0.45359237 kg.
  assert.equal(forceText(9.80665 * 0.45359237), "1");
});

test("a hundredth of a millimetre is the least that is set large", () => {
  assert.equal(largeText(0.004), "<0.01");
  assert.equal(Number(largeText(0.02)), 0.02);
  assert.equal(largeText(0), "0");
});

test("an inch has two places more than a millimetre, about as fine", () => {
  assert.equal(errorText(0.1), "0.1000");
  choose("length", "inch");
  assert.equal(errorText(0.1), "0.003937");
});

test("a setting takes only what it can be, and tells of a change once", () => {
  const heard = [];
  const end = onSetting((key, value) => heard.push([key, value]));
  choose("length", "furlong");
  choose("length", "inch");
  choose("length", "inch");
  assert.equal(setting("length"), "inch");
  assert.deepEqual(heard, [["length", "inch"]]);
  end();
  choose("length", "mm");
  assert.equal(heard.length, 1);
  for (const key of ["length", "force", "theme"]) assert.ok(choices(key).includes(setting(key)));
});
