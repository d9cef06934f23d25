// Places on a slider: logarithmic, and the inverse of its values.

import assert from "node:assert/strict";
import { test } from "node:test";
import { placeOf, valueAt } from "../../web/js/form/slider.js";

test("equal ways are equal ratios, and places lead back", () => {
  const span = [1, 1000];
  for (const [value, place] of [
    [1, 0],
    [10, 1 / 3],
    [100, 2 / 3],
    [1000, 1],
    [5000, 1],
    [0.1, 0],
    [0, 0],
    [-5, 0],
  ])
    assert.ok(Math.abs(placeOf(value, span) - place) < 1e-12, String(value));
  for (const place of [0, 0.1, 0.5, 0.99, 1])
    assert.ok(Math.abs(placeOf(valueAt(place, [0.005, 2]), [0.005, 2]) - place) < 1e-12, String(place));
});
