// Entries found by a few letters.

import assert from "node:assert/strict";
import { test } from "node:test";
import { found } from "../../web/js/form/search.js";

const ROBOTS = [
  "Stäubli RX-90 stiffness published 6 kg",
  "KUKA KR 210 R2700-2 stiffness published 210 kg",
  "KUKA KR 60-3 stiffness guessed 60 kg",
  "KUKA KR 600 R2830 stiffness guessed 600 kg",
  "ABB IRB 4600-60/2.05 stiffness guessed 60 kg",
  "KUKA KR 270 R2700 stiffness measured 270 kg reach 2.70 m",
];

test("by name, badge or number, whatever the case, the accents and the gaps", () => {
  const by = (query) => found(ROBOTS, query, (text) => text).map((text) => ROBOTS.indexOf(text));
  assert.deepEqual(by("kr 210"), [1]);
  assert.deepEqual(by("KR210"), [1]);
  assert.deepEqual(by("r2700-2"), [1]);
  assert.deepEqual(by("staubli"), [0]);
  assert.deepEqual(by("rx90"), [0]);
  assert.deepEqual(by("measured"), [5]);
  assert.deepEqual(by("60 kg"), [2, 4], "neither 600 kg nor 160 kg");
  assert.deepEqual(by("60kg"), [2, 4]);
  assert.deepEqual(by("kuka measured"), [5], "words that do not follow each other");
  assert.deepEqual(by("2.70 m"), [5]);
  assert.deepEqual(by(" "), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual(by("comau"), []);
});
