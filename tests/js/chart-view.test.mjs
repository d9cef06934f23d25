// The part of an axis that is shown.

import assert from "node:assert/strict";
import { test } from "node:test";
import { between, fractionOf, nearest, ranged, scaled, shifted, valueAt } from "../../web/js/chart/view.js";
import { random } from "./common.mjs";

const near = (a, b, size = 1) => assert.ok(Math.abs(a - b) <= 1e-9 * size, `${a} is not ${b}`);

/** Axes, some of them logarithmic, whole or zoomed. */
function* axes() {
  const next = random(3);
  for (let k = 0; k < 500; k++) {
    const log = k % 2 === 1;
    const low = log ? 10 ** (next() * 6 - 5) : next() * 100 - 50;
    const high = log ? low * 10 ** (0.5 + 3 * next()) : low + 1 + next() * 1000;
    const full = [low, high];
    const whole = { min: low, max: high, log, full };
    yield whole;
    const [a, b] = [next(), next()].sort((x, y) => x - y);
    if (b - a > 0.01) yield { ...whole, min: valueAt(whole, a), max: valueAt(whole, b) };
  }
}

test("value and fraction undo each other", () => {
  const next = random(1);
  for (const axis of axes()) {
    const fraction = next() * 3 - 1;
    near(fractionOf(axis, valueAt(axis, fraction)), fraction);
    near(valueAt(axis, 0), axis.min, Math.abs(axis.min));
    near(valueAt(axis, 1), axis.max, Math.abs(axis.max));
  }
});

test("any range stays inside the whole, in order, or is the whole", () => {
  const next = random(2);
  for (const axis of axes())
    for (let k = 0; k < 5; k++) {
      const range = between(axis, next() * 4 - 2, next() * 4 - 1);
      if (range === null) continue;
      const [low, high] = axis.full;
      const slack = 1e-9 * (Math.abs(low) + Math.abs(high));
      assert.ok(range[0] < range[1] && range[0] >= low - slack && range[1] <= high + slack, `${range} in ${axis.full}`);
    }
});

test("a zoom keeps the value under the pointer, as long as there is room", () => {
  for (const axis of axes()) {
    const range = scaled(axis, 0.5, 0.5);
    near(fractionOf(ranged(axis, range), valueAt(axis, 0.5)), 0.5);
  }
});

test("in and out again is the range before, and far out is the whole", () => {
  for (const axis of axes()) {
    const back = scaled(ranged(axis, scaled(axis, 0.3, 0.5)), 0.3, 2);
    const whole = axis.min === axis.full[0] && axis.max === axis.full[1];
    if (whole) assert.ok(back === null || Math.abs(fractionOf(axis, back[0])) < 1e-9);
    else near(fractionOf(axis, back[0]), 0);
    assert.equal(scaled(axis, 0.5, 1e6), null);
  }
});

test("a shift keeps the length, and stops at the ends", () => {
  const axis = { min: 2, max: 4, log: false, full: [0, 10] };
  for (const [by, range] of [
    [0.5, [3, 5]],
    [100, [8, 10]],
    [-100, [0, 2]],
  ])
    shifted(axis, by).forEach((end, i) => near(end, range[i]));
});

test("zooming in comes to an end", () => {
  let axis = { min: 0, max: 10, log: false, full: [0, 10] };
  for (let k = 0; k < 200; k++) axis = ranged(axis, scaled(axis, 0.5, 0.5));
  assert.ok(axis.max > axis.min);
  near((axis.max - axis.min) / 10, 1e-6, 1e-6);
});

test("the nearest sample is the one that a look at all of them finds", () => {
  const next = random(4);
  for (let k = 0; k < 200; k++) {
    const values = Array.from({ length: 1 + Math.floor(next() * 30) }, () => next() * 10).sort((a, b) => a - b);
    const value = next() * 12 - 1;
    const away = values.map((each) => Math.abs(each - value));
    assert.equal(away[nearest(values, value)], Math.min(...away));
  }
});
