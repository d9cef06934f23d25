// Undo and redo, held to a list and an index that nobody could get wrong.

import assert from "node:assert/strict";
import { test } from "node:test";
import { History } from "../../web/js/job/undo.js";
import { one, random } from "./common.mjs";

const state = (value) => ({ job: { motion: { feed_mm_s: value }, path: [1, 2, value] } });

test("undo is the way back, redo the way there again", () => {
  const history = new History();
  for (const value of [1, 2, 3]) history.record(state(value));
  assert.deepEqual([history.canUndo, history.canRedo], [true, false]);
  assert.deepEqual(history.move(-1), state(2));
  assert.deepEqual(history.move(-1), state(1));
  assert.equal(history.canUndo, false);
  assert.equal(history.move(-1), undefined);
  assert.deepEqual(history.move(1), state(2));
  assert.deepEqual(history.move(1), state(3));
  assert.equal(history.move(1), undefined);
});

test("an edit after an undo takes the undone states' place", () => {
  const history = new History();
  for (const value of [1, 2, 3]) history.record(state(value));
  history.move(-1);
  history.move(-1);
  history.record(state(4));
  assert.equal(history.canRedo, false);
  assert.deepEqual(history.move(-1), state(1));
});

test("typing in one field is one step, until it rests", () => {
  const history = new History();
  history.record(state(0));
  for (const value of [1, 12, 123]) history.record(state(value), "motion.feed_mm_s");
  history.rest();
  history.record(state(1234), "motion.feed_mm_s");
  assert.deepEqual(history.move(-1), state(123));
  assert.deepEqual(history.move(-1), state(0));
});

test("what is typed and taken back leaves no step", () => {
  const history = new History();
  history.record(state(0));
  history.record(state(1), "feed");
  history.record(state(0), "feed");
  assert.equal(history.canUndo, false);
});

test("the same state again is no step, however its keys are ordered", () => {
  const history = new History();
  history.record({ a: 1, b: [1, { c: 2 }] });
  history.record({ b: [1, { c: 2 }], a: 1 });
  assert.equal(history.canUndo, false);
  history.record({ b: [1, { c: 3 }], a: 1 });
  assert.equal(history.canUndo, true);
});

test("two hundred steps are kept, the latest", () => {
  const history = new History();
  for (let value = 0; value < 500; value++) history.record(state(value));
  let steps = 0;
  let last;
  for (let back = history.move(-1); back; back = history.move(-1)) [steps, last] = [steps + 1, back];
  assert.equal(steps, 199);
  assert.deepEqual(last, state(300));
});

test("any order of steps is that of a plain list", () => {
  for (let seed = 0; seed < 200; seed++) {
    const next = random(seed);
    const history = new History();
    let [list, at] = [[], -1];
    for (let k = 0; k < 60; k++) {
      const act = one(next, ["record", "record", "undo", "redo"]);
      if (act === "record") {
        const value = Math.floor(next() * 5);
        history.record(state(value));
        if (list[at] !== value) [list, at] = [[...list.slice(0, at + 1), value], at + 1];
      } else {
        const to = at + (act === "undo" ? -1 : 1);
        const moved = history.move(act === "undo" ? -1 : 1);
        assert.deepEqual(moved, list[to] === undefined ? undefined : state(list[to]), `seed ${seed}`);
        if (moved) at = to;
      }
      assert.equal(history.canUndo, at > 0);
      assert.equal(history.canRedo, at < list.length - 1);
    }
  }
});
