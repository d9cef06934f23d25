// Camera, arm and paths of the picture in space: geometry without a graphics card.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { armParts, framesOf, shadow } from "../../web/js/scene/arm.js";
import { Camera, VIEWS, cross, dot, length, minus, plus, project } from "../../web/js/scene/camera.js";
import { colour as diverging } from "../../web/js/scene/diverging.js";
import { Paths } from "../../web/js/scene/paths.js";
import { colour as ramp } from "../../web/js/scene/ramp.js";
import { armill, one, random } from "./common.mjs";

const near = (a, b, size = 1e-9) => assert.ok(Math.abs(a - b) <= size, `${a} is not ${b}`);
const run = armill.run(armill.default_job());

/** The corners of a box. */
const cornersOf = ([low, high]) => Array.from({ length: 8 }, (_, c) => low.map((v, i) => ((c >> i) & 1 ? high[i] : v)));

/** A camera somewhere, with a picture of some shape. */
function someCamera(next) {
  const camera = new Camera();
  Object.assign(camera, { width: 300 + 900 * next(), height: 200 + 600 * next(), distance: 100 + 5000 * next() });
  camera.target = [next() * 1000, next() * 1000 - 500, next() * 500];
  camera.orbit(next() * 7 - 3, next() * 3 - 1.5);
  return camera;
}

describe("the camera", () => {
  test("its axes are a right-handed frame of unit vectors", () => {
    const next = random(1);
    for (let k = 0; k < 200; k++) {
      const { right, up, out } = someCamera(next).axes();
      for (const axis of [right, up, out]) near(length(axis), 1);
      for (const [a, b] of [
        [right, up],
        [up, out],
        [out, right],
      ])
        near(dot(a, b), 0);
      cross(right, up).forEach((v, i) => near(v, out[i]));
    }
  });

  test("the target is in the middle, what is beside it a pixel's size away", () => {
    const next = random(2);
    for (let k = 0; k < 200; k++) {
      const camera = someCamera(next);
      const { right, up, out } = camera.axes();
      const at = (point) => project(camera.matrix(), point, camera.width, camera.height);
      const [x, y, depth] = at(camera.target);
      // The matrix has single precision.
      near(x, camera.width / 2, 0.1);
      near(y, camera.height / 2, 0.1);
      near(depth, camera.distance, 1e-3 * camera.distance);
      near(at(plus(camera.target, right, 10 * camera.pixel()))[0] - x, 10, 0.2);
      near(at(plus(camera.target, up, 10 * camera.pixel()))[1] - y, -10, 0.2);
      assert.ok(at(plus(camera.target, out, 2 * camera.distance))[2] < 0, "behind the eye");
    }
  });

  test("a fitted box is in the picture with every corner, and fills a good part of it", () => {
    const next = random(3);
    for (let k = 0; k < 300; k++) {
      const camera = someCamera(next);
      const low = [next() * 100, next() * 100, next() * 100];
      const high = low.map((v) => v + 1 + next() * 500);
      const corners = cornersOf([low, high]);
      camera.fit(corners);
      const seen = corners.map((corner) => project(camera.matrix(), corner, camera.width, camera.height));
      for (const [x, y, depth] of seen)
        assert.ok(x >= 0 && x <= camera.width && y >= 0 && y <= camera.height && depth > 0, `${x}, ${y}, ${depth}`);
      const [wide, tall] = [0, 1].map((i) => Math.max(...seen.map((p) => p[i])) - Math.min(...seen.map((p) => p[i])));
      assert.ok(Math.max(wide / camera.width, tall / camera.height) > 0.3, "not a speck");
    }
  });

  test("a drag and its way back are no move", () => {
    const next = random(4);
    for (let k = 0; k < 100; k++) {
      const camera = someCamera(next);
      const before = [...camera.target, camera.distance];
      camera.pan(30, -70);
      camera.pan(-30, 70);
      camera.zoom(1.7);
      camera.zoom(1 / 1.7);
      [...camera.target, camera.distance].forEach((v, i) => near(v, before[i], 1e-6));
    }
  });

  test("it never turns over, and comes neither through the target nor to the stars", () => {
    const camera = new Camera();
    for (let k = 0; k < 100; k++) camera.orbit(1, 0.5);
    near(camera.elevation, Math.PI / 2);
    for (let k = 0; k < 100; k++) camera.zoom(10);
    assert.ok(camera.distance >= 0.5);
    for (let k = 0; k < 100; k++) camera.zoom(0.1);
    assert.ok(camera.distance <= 1e6);
  });

  test("the views look from where they say", () => {
    for (const [name, direction] of [
      ["top", [0, 0, 1]],
      ["front", [0, -1, 0]],
      ["side", [1, 0, 0]],
    ]) {
      const camera = new Camera();
      camera.look(VIEWS[name]);
      camera.axes().out.forEach((v, i) => near(v, direction[i]));
    }
  });

  test("from a direction is that direction, straight down too", () => {
    const next = random(5);
    for (const direction of [
      [0, 0, 1],
      [0, 0, -1],
      ...Array.from({ length: 50 }, () => [0, 0, 0].map(() => next() - 0.5)),
    ]) {
      const camera = new Camera();
      camera.lookFrom(direction);
      camera.axes().out.forEach((v, i) => near(v, direction[i] / length(direction)));
    }
  });
});

describe("the arm", () => {
  const frames = framesOf(run.frames(0));

  test("has nine frames of unit axes, joint after joint", () => {
    assert.equal(frames.joints.length, 6);
    for (const { x, y, z } of [frames.base, ...frames.joints, frames.tcp, frames.workpiece]) {
      for (const axis of [x, y, z]) near(length(axis), 1);
      cross(x, y).forEach((v, i) => near(v, z[i]));
    }
  });

  test("its links join the joints' places, and its tool ends at the tip", () => {
    const parts = armParts(frames);
    const ends = parts.map(({ model }) => ({ from: [...model.slice(12, 15)], way: [...model.slice(8, 11)] }));
    const links = ends.filter((_, i) => parts[i].tone === "link");
    const places = [frames.base, ...frames.joints].map(({ origin }) => origin);
    // Single precision, of lengths of about a metre [mm].
    const stands = (place) => places.some((each) => length(minus(each, place)) < 1e-3);
    for (const { from, way } of links.slice(0, 4)) assert.ok(stands(from) && stands(plus(from, way)));
    const tool = ends[parts.findIndex(({ tone }) => tone === "tool")];
    assert.ok(length(minus(tool.from, frames.tcp.origin)) < 1e-3);
    // Its axis is the tool's.
    assert.ok(length(cross(tool.way, frames.tcp.z)) < 1e-3 * length(tool.way));
  });

  test("a shadow is flat on the floor, below its part", () => {
    for (const part of armParts(frames)) {
      const { model } = shadow(part);
      for (const column of [0, 1, 2, 3]) {
        assert.equal(model[4 * column + 2], 0);
        assert.deepEqual(model.slice(4 * column, 4 * column + 2), part.model.slice(4 * column, 4 * column + 2));
      }
    }
  });
});

describe("the paths", () => {
  const paths = new Paths(run.track(500));

  test("their largest deviation is the report's, and lies in their box", () => {
    // The track has some of the samples only.
    const { max } = run.summary().before_mm.both;
    assert.ok(paths.largest <= max + 1e-9 && paths.largest > 0.9 * max);
    const [low, high] = paths.box;
    for (let row = 0; row < paths.count; row++)
      paths.desired(row).forEach((v, i) => assert.ok(v >= low[i] && v <= high[i]));
  });

  test("the row of a sample is the nearest one", () => {
    const next = random(6);
    const samples = Array.from({ length: paths.count }, (_, row) => paths.sample(row));
    for (let k = 0; k < 200; k++) {
      const sample = next() * samples.at(-1);
      const away = samples.map((each) => Math.abs(each - sample));
      assert.equal(away[paths.rowOf(sample)], Math.min(...away));
    }
  });

  test("the magnification is round, and shows the deviation as up to a tenth of the path", () => {
    const factor = paths.factor();
    assert.match(String(factor), /^[125]0*$/);
    const [low, high] = paths.box;
    const share = (factor * paths.largest) / Math.max(...high.map((v, i) => v - low[i]));
    assert.ok(share <= 0.1 + 1e-9 && share > 0.03, `${share}`);
  });

  test("a picked row is the one that is drawn nearest", () => {
    const next = random(7);
    for (let k = 0; k < 50; k++) {
      const camera = someCamera(next);
      const factor = one(next, [1, 10, 100]);
      camera.fit(cornersOf(paths.box));
      const { width, height } = camera;
      const m = camera.matrix();
      const place = [width * (0.3 + 0.4 * next()), height * (0.3 + 0.4 * next())];
      const shown = { desired: true, actual: next() < 0.5, compensated: false };
      const away = Array.from({ length: paths.count }, (_, row) => {
        const drawn = [paths.desired(row)];
        if (shown.actual) drawn.push(plus(paths.closest(row), paths.before(row), factor));
        const distance = (point) => {
          const [x, y] = project(m, point, width, height);
          return Math.hypot(x - place[0], y - place[1]);
        };
        return Math.min(...drawn.map(distance));
      });
      const least = Math.min(...away);
      const row = paths.pick(m, place, { width, height, factor, shown, reach: 40 });
      if (row < 0) assert.ok(least >= 40 - 1e-6);
      else near(away[row], least, 1e-6);
    }
  });
});

describe("the scales of colours", () => {
  const lightness = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

  test("a larger error is never darker in the ramp", () => {
    for (const dark of [false, true]) {
      const steps = Array.from({ length: 101 }, (_, i) => lightness(ramp(i / 100, dark)));
      // A channel is rounded to one of 256.
      steps.slice(1).forEach((value, i) => assert.ok(value >= steps[i] - 1));
      assert.deepEqual(ramp(-5, dark), ramp(0, dark));
      assert.deepEqual(ramp(7, dark), ramp(1, dark));
    }
  });

  test("too little is blue, too much is orange, and both leave the middle", () => {
    for (const dark of [false, true]) {
      const [r, , b] = diverging(-1, dark);
      assert.ok(b > r);
      const [r2, , b2] = diverging(1, dark);
      assert.ok(r2 > b2);
      const apart = (share) => Math.abs(lightness(diverging(share, dark)) - lightness(diverging(0, dark)));
      for (const side of [-1, 1]) assert.ok(apart(side) > apart(side / 3), "further off is easier to see");
    }
  });
});
