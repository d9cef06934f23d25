// The job as the page holds it, with the fields, presets and default job of the core. What it makes is shown to the core.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { merged, textOf } from "../../web/js/job/data.js";
import { FROM_STOCK, Job } from "../../web/js/job/job.js";
import { armill, hello, one, random } from "./common.mjs";

const core = hello();
const fresh = () => new Job(structuredClone(core.job), core);
const fieldOf = (path) => core.fields.find((field) => field.path === path);
const shownIn = (job) => core.fields.filter((field) => job.shows(field));
const choicesOf = (field) => (field.kind === "choice" ? field.choices.map(({ value }) => value) : []);

/** Choices that need more than themselves: a mesh, or a stock, which the default job does not have. */
const NEEDY = ["stock.kind=stl", "motion.feed_rule=constant-force", "cutting.engagement=from-stock"];
const isNeedy = (field, value) => NEEDY.includes(`${field.path}=${value}`);

/** A value of a field other than the one it has; undefined where that is not simple. */
function another(next, field, value) {
  if (field.kind === "choice") return one(next, choicesOf(field));
  if (field.kind === "number" && typeof value === "number") return value * (1 + next() / 100);
  if (field.kind === "integer") return value + 1;
  return undefined;
}

describe("the default job", () => {
  test("is the core's, and nothing in it is changed", () => {
    const job = fresh();
    assert.equal(job.text, textOf(core.job));
    assert.deepEqual(JSON.parse(job.text), job.data);
    assert.deepEqual(job.differences(core.job), []);
    for (const field of shownIn(job)) assert.equal(job.changed(field), false, field.path);
    armill.check(job.text);
  });

  test("shows a field for every part, and none twice", () => {
    const paths = shownIn(fresh()).map(({ path }) => path);
    assert.equal(new Set(paths).size, paths.length);
    for (const part of Object.keys(core.job).filter((key) => !["version", "model"].includes(key)))
      assert.ok(
        paths.some((path) => path.startsWith(part)),
        part,
      );
  });
});

describe("choices", () => {
  for (const field of core.fields.filter((each) => choicesOf(each).length && fresh().shows(each)))
    test(`${field.path}: each is a job that the core takes, and the way back is the job before`, () => {
      const isRobot = field.path === "robot.preset";
      for (const value of choicesOf(field).filter((each) => !isNeedy(field, each))) {
        const job = fresh();
        const before = job.get(field);
        job.set(field, value);
        assert.equal(job.get(field), value);
        armill.check(job.text);
        job.set(field, before);
        // The thesis's shaper is its own arm's: another robot leaves it behind.
        const left = job
          .differences(core.job)
          .filter(({ field: { path } }) => !(isRobot && path.startsWith("shaper.")));
        assert.deepEqual(left, [], `${value} and back`);
        armill.check(job.text);
      }
    });

  test("what is typed for one choice is still there on the way back to it", () => {
    const job = fresh();
    const [kind, radius] = ["path.kind", "path.radius_mm"].map(fieldOf);
    job.set(radius, 123.25);
    job.set(kind, "line");
    assert.equal(job.shows(radius), false);
    assert.equal(job.data.path.radius_mm, undefined, "a line has no radius");
    job.set(kind, "circle");
    assert.equal(job.get(radius), 123.25);
  });

  test("programs in two languages are kept apart", () => {
    const job = fresh();
    const [kind, text] = ["path.kind", "path.text"].map(fieldOf);
    job.set(kind, "gcode");
    job.set(text, "G1 X10 F100");
    job.set(kind, "csv");
    assert.notEqual(job.get(text), "G1 X10 F100");
    job.set(text, "0, 0, 0\n1, 0, 0");
    job.set(kind, "gcode");
    assert.equal(job.get(text), "G1 X10 F100");
  });

  test("a preset's numbers are where one's own start", () => {
    const job = fresh();
    const { id, joint_compliance_rad_per_nm: compliance } = core.presets.robots.at(-1);
    job.set(fieldOf("robot.preset"), id);
    assert.deepEqual(job.get(fieldOf("robot.joint_compliance_rad_per_nm")), compliance);
    job.set(fieldOf("robot.preset"), "table");
    assert.deepEqual(job.data.robot.joint_compliance_rad_per_nm, compliance);
    assert.equal(job.data.robot.preset, undefined);
    armill.check(job.text);
  });

  test("another robot does without the thesis's shaper, and keeps one's own", () => {
    const [robot, zeta] = ["robot.preset", "shaper.damping"].map(fieldOf);
    const other = core.presets.robots.find(({ id }) => id !== core.job.robot.preset).id;
    const job = fresh();
    job.set(robot, other);
    assert.equal(job.data.shaper, "none");
    const own = fresh();
    own.set(zeta, own.get(zeta) / 2);
    const { shaper } = own.data;
    own.set(robot, other);
    assert.deepEqual(own.data.shaper, shaper);
  });

  test("with the stock goes what follows from it", () => {
    const job = fresh();
    const [kind, engagement, rule] = ["stock.kind", "cutting.engagement", "motion.feed_rule"].map(fieldOf);
    job.set(kind, "box");
    job.set(engagement, FROM_STOCK);
    assert.equal(job.data.cutting.engagement, undefined, "left out, it follows from the stock");
    assert.equal(job.get(engagement), FROM_STOCK);
    job.set(rule, "constant-force");
    job.set(kind, "none");
    assert.equal(job.data.stock, undefined);
    assert.equal(job.get(rule), "programmed");
    assert.notEqual(job.get(engagement), FROM_STOCK);
    armill.check(job.text);
  });
});

describe("edits", () => {
  test("at random, keep their laws", () => {
    for (let seed = 0; seed < 100; seed++) {
      const next = random(seed);
      const job = fresh();
      for (let k = 0; k < 15; k++) {
        const field = one(next, shownIn(job));
        const value = another(next, field, job.get(field));
        if (value === undefined || isNeedy(field, value)) continue;
        const story = `seed ${seed}: ${field.path} = ${value}`;
        const [before, text] = [job.data, job.text];
        const copy = JSON.stringify(before);
        job.set(field, value);
        assert.deepEqual(job.get(field), value, story);
        assert.equal(JSON.stringify(before), copy, `${story}: what was handed out stays as it was`);
        assert.deepEqual(JSON.parse(job.text), job.data, story);
        // Another job from the same data is the same job.
        assert.equal(job.of(job.data).text, job.text, story);
        // State and back.
        const again = fresh();
        const { job: data, drafts } = job.state;
        again.load(data, drafts);
        assert.equal(again.text, job.text, story);
        // Differences are seen from both sides.
        const differs = job.differences(JSON.parse(text));
        const back = job.of(JSON.parse(text)).differences(job.data);
        assert.deepEqual(
          differs.map(({ field: { path }, own, other }) => [path, own, other]),
          back.map(({ field: { path }, own, other }) => [path, other, own]),
          story,
        );
      }
    }
  });

  test("reset is the default, for every field", () => {
    for (const field of shownIn(fresh())) {
      const job = fresh();
      const value = another(random(1), field, job.get(field));
      if (value === undefined) continue;
      job.set(field, value);
      job.reset(field);
      assert.equal(job.changed(field), false, field.path);
    }
  });

  test("nothing that is handed out can be changed", () => {
    const { data } = fresh();
    assert.throws(() => (data.motion.feed_mm_s = 1), TypeError);
    assert.throws(() => data.path.center_mm.push(0), TypeError);
  });

  test("a state can be changed without changing the job", () => {
    const job = fresh();
    const before = job.text;
    job.state.job.motion.feed_mm_s = 1;
    assert.equal(job.text, before);
  });

  test("a frequency in hertz is the one in radians per second, by its definition", () => {
    const job = fresh();
    const rad = fieldOf("shaper.frequency_rad_s");
    const omega = job.get(rad);
    const hz = job.swapUnit(rad);
    assert.equal(hz.path, "shaper.frequency_hz");
    // Twelve digits are kept.
    assert.ok(Math.abs(job.get(hz) * 2 * Math.PI - omega) <= 1e-11 * omega);
    assert.equal(job.shows(rad), false);
    armill.check(job.text);
    assert.equal(job.swapUnit(hz).path, rad.path);
    assert.ok(Math.abs(job.get(rad) - omega) <= 1e-11 * omega);
  });

  test("a preview has fewer samples and no loop, all else stays", () => {
    const job = fresh();
    job.load({ ...core.job, online: { measures: "position" } });
    assert.equal("online" in JSON.parse(job.sampledEvery(0.004)), false);
    job.load(core.job);
    const preview = JSON.parse(job.sampledEvery(0.004));
    assert.equal(preview.motion.sample_time_s, 0.004);
    preview.motion.sample_time_s = job.sampleTime;
    assert.deepEqual(preview, job.data);
  });

  test("compliances of one's own do not keep another's covariance", () => {
    const job = fresh();
    job.load({ ...core.job, uncertainty: { compliance_covariance: [[1]] } });
    job.set(fieldOf("robot.preset"), core.presets.robots.at(-1).id);
    assert.equal(job.data.uncertainty.compliance_covariance, undefined);
  });
});

describe("jobs of others", () => {
  test("an earlier model is noticed, and is of this model once it is loaded", () => {
    const job = fresh();
    const { model: _, ...unnamed } = core.job;
    assert.equal(job.isAfter({ ...core.job, model: core.model - 1 }), true);
    assert.equal(job.isAfter(core.job), false);
    assert.equal(job.isAfter(unnamed), core.model > 1, "before model 2 it was not named");
    job.load({ ...core.job, model: core.model - 1 });
    assert.equal(job.data.model, core.model);
  });

  test("too many points for a field become rows, with the same numbers", () => {
    const points = Array.from({ length: 5001 }, (_, i) => [i / 7, 1 - i, 0.1 * i]);
    const job = fresh().of({ ...core.job, path: { kind: "polyline", points_mm: points } });
    assert.equal(job.data.path.kind, "csv");
    const rows = job.data.path.text.split("\n").map((row) => row.split(",").map(Number));
    assert.deepEqual(rows, points);
    const few = { kind: "polyline", points_mm: points.slice(1) };
    assert.deepEqual(fresh().of({ ...core.job, path: few }).data.path, few);
  });
});

// RFC 7386, appendix A: original, patch, result.
const MERGES = [
  [{ a: "b" }, { a: "c" }, { a: "c" }],
  [{ a: "b" }, { b: "c" }, { a: "b", b: "c" }],
  [{ a: "b" }, { a: null }, {}],
  [{ a: "b", b: "c" }, { a: null }, { b: "c" }],
  [{ a: ["b"] }, { a: "c" }, { a: "c" }],
  [{ a: "c" }, { a: ["b"] }, { a: ["b"] }],
  [{ a: { b: "c" } }, { a: { b: "d", c: null } }, { a: { b: "d" } }],
  [{ a: [{ b: "c" }] }, { a: [1] }, { a: [1] }],
  [
    ["a", "b"],
    ["c", "d"],
    ["c", "d"],
  ],
  [{ a: "b" }, ["c"], ["c"]],
  [{ a: "foo" }, null, null],
  [{ a: "foo" }, "bar", "bar"],
  [{ e: null }, { a: 1 }, { e: null, a: 1 }],
  [[1, 2], { a: "b", c: null }, { a: "b" }],
  [{}, { a: { bb: { ccc: null } } }, { a: { bb: {} } }],
];

test("merge patches as the standard's examples have them", () => {
  for (const [original, patch, result] of MERGES) {
    const before = structuredClone(original);
    assert.deepEqual(merged(original, patch), result, JSON.stringify(patch));
    assert.deepEqual(original, before, "the original stays");
  }
});
