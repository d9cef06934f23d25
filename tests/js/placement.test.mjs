// The map of places: its grid and the best of it, the part's outline, and the sides of the robot's base.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { aroundOf, hull, isInFloor, rangeOf, sideOf } from "../../web/js/placement/around.js";
import { gridOf, least, markFloor, placeAt, ranked } from "../../web/js/placement/grid.js";
import { armill, random } from "./common.mjs";

describe("the best of a map", () => {
  const { columns, rows, bands } = gridOf([0, 2, 1], [0, 20, 5, 15, 7], 3);
  const row = (...places) => Float64Array.from(places.flat());
  /** @type {{ fixed: number, found: (Float64Array | null)[] }[]} */
  const layers = [
    { fixed: 7, found: [row([5, 2, 0, 1], [1, 1, 4, 0.1], [NaN, NaN, 3, NaN]), null, null] },
    { fixed: 8, found: [null, row([4, 2, 0, 3], [2, 1, 1, 0.2], [6, 1, 0, 0.5]), null] },
  ];

  test("places are in the order in which the core gets them", () => {
    assert.deepEqual(
      [columns, rows],
      [
        [0, 10, 20],
        [5, 10, 15],
      ],
    );
    assert.deepEqual(Array.from(bands[1]), [0, 7, 10, 10, 7, 10, 20, 7, 10]);
    assert.deepEqual(placeAt(layers[1].found, 2, 1), { max: 6, mean: 1, mark: 0, p95: 0.5 });
    assert.equal(placeAt(layers[1].found, 2, 2), null);
  });

  test("it violates no limit, is not in the base, and depends on the error that counts", () => {
    const at = ({ i, k, layer }) => [i, k, layer];
    assert.deepEqual(at(ranked({ columns, rows, layers }, "max").best), [0, 1, 1]);
    assert.deepEqual(at(ranked({ columns, rows, layers }, "p95").best), [2, 1, 1]);
    assert.deepEqual(at(ranked({ columns, rows, layers }, "p95", ({ layer }) => layer === 0).best), [0, 0, 0]);
    assert.equal(ranked({ columns, rows, layers }, "p95", () => false).best, undefined);
    // What is out of reach or in the base is not on the scale.
    assert.equal(ranked({ columns, rows, layers: layers.slice(0, 1) }, "p95").limit, 1);
    const numbers = row([1, 1, 0, 1], [1, 1, 3, 1], [1, 1, 2, 1]);
    markFloor(numbers, (n) => n < 2);
    assert.deepEqual(
      [2, 6, 10].map((n) => numbers[n]),
      [4, 3, 2],
    );
    assert.equal(least([{ max: 1, mean: 1, mark: 2, p95: 1 }], "max"), undefined);
  });
});

test("an outline holds all its points and turns one way", () => {
  const next = random(3);
  for (let n = 0; n < 200; n++) {
    const points = Array.from({ length: 8 }, () => [Math.round(next() * 9), Math.round(next() * 9)]);
    const corners = hull(points);
    if (corners.length < 3) continue;
    corners.forEach((a, i) => {
      const b = corners[(i + 1) % corners.length];
      for (const p of points) assert.ok((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > -1e-9);
    });
  }
});

test("the core says where part and base are", () => {
  const job = JSON.parse(armill.opening_job());
  const survey = new armill.Survey(JSON.stringify(job));
  const around = aroundOf({ part: survey.part(), base: survey.base() });
  assert.equal(around.corners.length, 8);
  const [low, high] = rangeOf(around, 0, job.workpiece_frame.xyz_mm[0]);
  assert.ok(low < high && low > around.base.radius, `${low} to ${high}`);
  assert.equal(sideOf(around, job, job.workpiece_frame.xyz_mm), "front");
  assert.equal(sideOf(around, job, [-3000, 0, 0]), "behind");
  assert.equal(sideOf(around, job, [0, 3000, 0]), "left");
  assert.equal(sideOf(around, job, [0, -3000, 0]), "right");
  assert.deepEqual(
    [11, 12, 13].map((z) => isInFloor(around, z)),
    [true, false, false],
  );
  // A base that is turned has its front elsewhere.
  const turned = { ...job, base_frame: { xyz_mm: [0, 0, 0], rpy_deg: [0, 0, 90] } };
  assert.equal(sideOf(around, turned, [0, 3000, 0]), "front");
  survey.free();
});
