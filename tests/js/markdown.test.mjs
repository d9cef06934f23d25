// A result as Markdown, of a job that the core has computed.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Job } from "../../web/js/job/job.js";
import { markdown } from "../../web/js/result/markdown.js";
import { armill, hello } from "./common.mjs";

const core = hello();
const resultOf = (data) => ({
  summary: armill.run(JSON.stringify(data)).summary(),
  job: new Job(data, core),
  standard: core.job,
  link: "https://host.test/#job=2.x",
});

test("the default job says what it is, and that nothing differs", () => {
  const shared = resultOf(structuredClone(core.job));
  const { summary } = shared;
  const text = markdown(shared);
  assert.match(text, /Inputs: the default job\./);
  assert.ok(text.includes(summary.fingerprint));
  assert.ok(text.includes("[Open in Armill](https://host.test/#job=2.x)"));
  const rows = text.split("\n").filter((line) => line.startsWith("| "));
  for (const row of rows) assert.equal(row.match(/(?<!\\)\|/g).length, 4, `three cells: ${row}`);
  // The figures are the summary's, to the tenth of a micrometre.
  const after = rows.find((row) => row.includes("after compensation"));
  const [mean, max] = after.split("|").slice(2, 4).map(Number);
  assert.ok(Math.abs(mean - summary.after_mm.mean) <= 0.00005001 && Math.abs(max - summary.after_mm.max) <= 0.00005001);
});

test("inputs that differ are named with their value and the default; without a link none is shown", () => {
  const data = structuredClone(core.job);
  data.motion.feed_mm_s = 80.5;
  const text = markdown({ ...resultOf(data), link: null });
  assert.match(text, /- Feed[^:]*: 80\.5 mm\/s \(default 100 mm\/s\)/);
  assert.doesNotMatch(text, /Open in Armill/);
});

test("a name cannot become markup", () => {
  const data = structuredClone(core.job);
  data.program = { ...data.program, name: "a|b" };
  const shared = resultOf(structuredClone(core.job));
  const job = new Job({ ...data, program: { ...data.program, spindle_on: "<b>[x](y)|`*_" } }, core);
  const text = markdown({ ...shared, job });
  assert.ok(text.includes("\\<b\\>\\[x\\](y)\\|\\`\\*\\_"), text);
});
