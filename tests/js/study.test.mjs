// Questions as texts, and answers as tables.

import assert from "node:assert/strict";
import { test } from "node:test";
import { askedIn, rangeOf, read, written } from "../../web/js/study/question.js";
import { tableCsv, tableMarkdown } from "../../web/js/study/columns.js";
import { pictureOf, placeAmong } from "../../web/js/study/pictures.js";
import { isAlike, ranked } from "../../web/js/study/words.js";

const path = "cutting.axial_depth_mm";

test("every question comes back from its text", () => {
  const range = { path, from: 0.5, to: 5, count: 20, log: true };
  for (const question of [
    { kind: "largest", path, from: 0.1, to: 10, measure: "p95" },
    { kind: "sweep", ranges: [range] },
    { kind: "sweep", ranges: [range, { path: "workpiece_frame.xyz_mm.0", from: -5, to: 5e-7, count: 3, log: false }] },
    { kind: "sweep", ranges: [{ path: "material.preset", words: "all" }, range] },
    { kind: "robots", place: "front" },
    { kind: "robots", place: "sought" },
    { kind: "choices" },
    { kind: "tornado" },
    { kind: "measures" },
    { kind: "loops" },
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
    "robots~toString",
    `largest~${path}=1:2~toString`,
    "largest~material.preset=all~p95",
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

test("a value has its place among others", () => {
  assert.equal(placeAmong([1, 2, 4], 2), 1);
  assert.equal(placeAmong([1, 2, 4], 3), 1.5);
  assert.equal(placeAmong([1, 2, 4], 0.5), undefined);
  assert.equal(placeAmong([1, 2, 4], 5), undefined);
  assert.equal(placeAmong(["zv", "ei"], "ei"), 1);
  assert.equal(placeAmong(["zv", "ei"], undefined), undefined);
});

test("a picture shows what can be run, the best first, and pairs as a grid", () => {
  const job = { tolerance: 0.1, valueAt: ({ path: at }) => (at === path ? 1.5 : "ei") };
  const robots = [
    { name: "soft", stiffness: "guessed", p50_mm: 0.3, p95_mm: 0.6 },
    { name: "short", error: "out of reach" },
    { name: "jammed", stiffness: "measured", p50_mm: 0.01, p95_mm: 0.02, cannot_run: "joint 1 leaves its range" },
    { name: "stiff", stiffness: "measured", p50_mm: 0.1, p95_mm: 0.2 },
  ];
  const { kind, data, rows } = pictureOf({ kind: "robots", place: "kept" }, { robots }, [], job);
  assert.deepEqual([kind, rows, data.names], ["study_intervals", 2, ["stiff", "soft"]]);
  assert.deepEqual([...data.ranges], [0.1, 0.2, 0.3, 0.6]);
  assert.deepEqual([...data.guesses], [0, 1]);

  const depth = { path, kind: "number", label: "Axial depth", unit: "mm" };
  const shaper = {
    path: "shaper.kind",
    kind: "choice",
    label: "Shaper",
    unit: "",
    choices: [{ value: "zv", label: "ZV" }],
  };
  const pairs = [1, 2].flatMap((value) => ["zv", "ei"].map((second) => ({ value, second, p95_mm: value / 10 })));
  const grid = pictureOf({ kind: "sweep", ranges: [{}, {}] }, { rows: pairs }, [depth, shaper], job);
  assert.deepEqual([grid.kind, grid.rows], ["study_grid", 2]);
  assert.deepEqual(
    [grid.data.values, grid.data.seconds],
    [
      ["1", "2"],
      ["ZV", "ei"],
    ],
  );
  assert.deepEqual([...grid.data.errors], [0.1, 0.1, 0.2, 0.2]);
  assert.deepEqual([...grid.data.now], [0.5, 1]);
  const jammed = pairs.map((row, k) => (k % 2 ? { ...row, cannot_run: "joint 1 leaves its range" } : row));
  const able = pictureOf({ kind: "sweep", ranges: [{}, {}] }, { rows: jammed }, [depth, shaper], job);
  assert.deepEqual([...able.data.errors], [0.1, NaN, 0.2, NaN]);
  const none = jammed.map((row) => ({ ...row, cannot_run: "joint 1 leaves its range" }));
  const could = pictureOf({ kind: "sweep", ranges: [{}, {}] }, { rows: none }, [depth, shaper], job);
  assert.ok(could.data.title.includes("if the arm could run it"));
  assert.deepEqual([...could.data.errors], [0.1, 0.1, 0.2, 0.2]);
  const long = Array.from({ length: 20 }, (_, k) =>
    ["zv", "ei"].map((second) => ({ value: k, second, p95_mm: k })),
  ).flat();
  const turned = pictureOf({ kind: "sweep", ranges: [{}, {}] }, { rows: long }, [depth, shaper], job);
  assert.deepEqual([turned.data.values, turned.data.seconds.length, turned.rows], [["ZV", "ei"], 20, 20]);
  assert.deepEqual([...turned.data.errors.slice(18, 22)], [18, 19, 0, 1]);
  assert.deepEqual([...turned.data.now], [1, 1.5]);
  const brought = pictureOf({ kind: "measures" }, { measures: [{ input: "pass", p95_mm: 0.01 }], now: 0.2 }, [], job);
  assert.deepEqual([brought.data.names, [...brought.data.ranges]], [["A milled pass"], [0.01, 0.2]]);
  assert.equal(
    pictureOf({ kind: "sweep", ranges: [{}] }, { rows: [{ value: 1 }, { value: 2 }] }, [depth], job),
    undefined,
  );
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
