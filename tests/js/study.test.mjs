// Questions as texts, and answers as tables.

import assert from "node:assert/strict";
import { test } from "node:test";
import { askedIn, rangeOf, read, written } from "../../web/js/study/question.js";
import { tableCsv, tableMarkdown } from "../../web/js/study/columns.js";
import { isAlike, ranked } from "../../web/js/study/words.js";

const path = "cutting.axial_depth_mm";

test("every question comes back from its text", () => {
  const range = { path, from: 0.5, to: 5, count: 20, log: true };
  for (const question of [
    { kind: "largest", path, from: 0.1, to: 10, measure: "p95" },
    { kind: "sweep", ranges: [range] },
    { kind: "sweep", ranges: [range, { path: "workpiece_frame.xyz_mm.0", from: -5, to: 5e-7, count: 3, log: false }] },
    { kind: "robots", place: "front" },
    { kind: "choices" },
    { kind: "tornado" },
    { kind: "measures" },
  ]) {
    assert.deepEqual(read(written(question)), question);
    assert.deepEqual(askedIn(`#job=2.abc&view=compare&ask=${encodeURIComponent(written(question))}`), question);
    assert.deepEqual(askedIn(`#ask=${written(question)}`), question);
  }
  assert.equal(written({ kind: "sweep", ranges: [range] }), "sweep~cutting.axial_depth_mm=0.5:5:20:log");
});

test("what is no question is none", () => {
  for (const text of [
    "",
    "largest",
    `largest~${path}=1:2~best`,
    `largest~${path}=a:2~p95`,
    `sweep~${path}=1:2`,
    "robots~there",
    "tornado~x",
    `sweep~${path}=1:2:3~${path}=1:2:3~${path}=1:2:3`,
  ])
    assert.equal(read(text), undefined, text);
  assert.equal(askedIn("#job=2.abc&view=compare"), undefined);
});

test("a range has the present value inside and stays within the limits", () => {
  assert.deepEqual(rangeOf({ min: 0, max: 50, usual: [1, 20] }, 2), [1, 20]);
  assert.deepEqual(rangeOf({ min: 0, max: 50, usual: [1, 20] }, 30), [1, 30]);
  assert.deepEqual(rangeOf({ min: 0.5, max: 6 }, 2), [0.5, 6]);
  assert.deepEqual(rangeOf({}, 0), [-1, 1]);
});

test("tables keep what they hold, in Markdown and in CSV", () => {
  const columns = [
    { key: "name", label: "Name", of: ({ name }) => name },
    {
      key: "size",
      label: "Size",
      unit: "mm",
      of: ({ size }) => size,
      text: ({ size }) => size.toFixed(1),
      digits: true,
    },
  ];
  const listed = { rows: [{ name: 'a "b", c|d', size: 1.25 }], columns };
  assert.equal(tableCsv(listed), 'Name,"Size, mm"\n"a ""b"", c|d",1.25\n');
  assert.equal(tableMarkdown(listed), '| Name | Size, mm |\n| --- | ---: |\n| a "b", c\\|d | 1.3 |');
});

test("what cannot be run is not ranked, and overlapping bands are alike", () => {
  const [a, b] = [
    { p50_mm: 0.1, p95_mm: 0.2 },
    { p50_mm: 0.15, p95_mm: 0.3 },
  ];
  assert.deepEqual(ranked([b, { p95_mm: 0.01, cannot_run: "no" }, { error: "no" }, a]), [a, b]);
  assert.ok(isAlike(a, b) && isAlike(b, a));
  assert.ok(!isAlike(a, { p50_mm: 0.21, p95_mm: 0.5 }));
});
