// What a host page may ask the embedded calculator for.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { mock, test } from "node:test";
import { chartsIn, fieldsIn, isLinked, jobOf, optionsIn } from "../../web/js/embed-options.js";
import { fragmentOf } from "../../web/js/job/link.js";
import { armill, hello } from "./common.mjs";

const core = hello();

test("nothing asked for is the whole form, one chart, the system's theme", () => {
  assert.deepEqual(optionsIn(""), {
    theme: "auto",
    show: ["none"],
    units: { length: "mm", force: "N", feed: "second" },
    job: null,
    preset: [],
    inputs: ["all"],
    charts: ["before-after"],
  });
});

test("what is asked for is read, in any order and with commas or spaces", () => {
  const { show, units, inputs, theme } = optionsIn(
    "#show=budget,scene&units=inch,per-minute&inputs=motion%20path.radius_mm&theme=dark",
  );
  assert.deepEqual(show, ["budget", "scene"]);
  assert.deepEqual(units, { length: "inch", force: "N", feed: "minute" });
  assert.deepEqual(inputs, ["motion", "path.radius_mm"]);
  assert.equal(theme, "dark");
});

test("what there is none of is refused, with its name and what there is", () => {
  for (const [fragment, name] of [
    ["#theme=blue", "theme"],
    ["#show=everything", "show"],
    ["#units=furlong", "units"],
  ])
    assert.throws(
      () => optionsIn(fragment),
      (error) => error.message.includes(name) && /not one of \w+/.test(error.message),
    );
  assert.throws(() => fieldsIn(core.fields, ["motoin"]), /inputs "motoin", which is not one of none, .*motion/);
  assert.throws(() => chartsIn([{ name: "a", view: "v" }], ["b"]), /charts "b", which is not one of none, v, a, why/);
});

test("inputs are picked by group, by part and by field, each once", () => {
  assert.deepEqual(fieldsIn(core.fields, ["all"]), core.fields);
  assert.deepEqual(fieldsIn(core.fields, ["none"]), []);
  const motion = fieldsIn(core.fields, ["motion"]);
  assert.deepEqual(
    motion,
    core.fields.filter(({ group }) => group === "motion"),
  );
  const frame = fieldsIn(core.fields, ["tool_frame"]).map(({ path }) => path);
  assert.deepEqual(frame, ["tool_frame.xyz_mm", "tool_frame.rpy_deg"]);
  const twice = fieldsIn(core.fields, ["motion.feed_mm_s", "motion"]);
  assert.equal(twice[0].path, "motion.feed_mm_s", "in the order of the words");
  assert.equal(twice.length, motion.length);
});

test("charts are picked by name and by view", () => {
  const charts = armill.run(armill.default_job()).charts();
  const { name, view } = charts.at(-1);
  assert.deepEqual(chartsIn(charts, [name]), [charts.at(-1)]);
  assert.deepEqual(
    chartsIn(charts, [view]),
    charts.filter((chart) => chart.view === view),
  );
});

test("the view Why is the charts of all its pages, as on the page", async () => {
  const html = await readFile(new URL("../../web/index.html", import.meta.url), "utf8");
  const [, tabs] = html.split('aria-label="Pages of Why"');
  const pages = [...tabs.split("</div>")[0].matchAll(/aria-controls="panel-(\w+)"/g)].map(([, page]) => page);
  assert.ok(pages.length >= 6);
  const charts = armill.run(armill.default_job()).charts();
  const expected = charts.filter(({ view }) => pages.includes(view));
  assert.ok(expected.length > 10);
  assert.deepEqual(chartsIn(charts, ["why"]), expected);
});

test("a job comes as text or from a link", async () => {
  const text = JSON.stringify({ motion: { feed_mm_s: 42 } });
  const linked = (await fragmentOf(text)).slice("job=".length);
  for (const job of [text, linked]) {
    const options = optionsIn(`#${new URLSearchParams({ job })}`);
    assert.equal(isLinked(options), job === linked);
    assert.deepEqual(await jobOf(options, core), JSON.parse(text));
  }
  assert.deepEqual(await jobOf(optionsIn(""), core), core.job);
});

test("presets are put in by name: a robot, a material, an example with its stock and tool", async (t) => {
  globalThis.document = { baseURI: "https://host.test/" };
  t.after(() => delete globalThis.document);
  mock.method(globalThis, "fetch", async (url) => {
    const text = await readFile(new URL(`../../web${url.pathname}`, import.meta.url), "utf8");
    return { ok: true, text: async () => text };
  });
  const robot = core.presets.robots.at(-1).id;
  const job = await jobOf(optionsIn(`#preset=${robot} al-7075-t6 pocket`), core);
  assert.deepEqual(job.robot, { preset: robot });
  assert.deepEqual(job.material, { preset: "al-7075-t6" });
  assert.equal(job.path.kind, "gcode");
  assert.equal(job.stock.kind, "box");
  assert.equal(job.tool.diameter_mm, 10);
  armill.check(JSON.stringify(job));
  assert.equal(core.job.path.kind, "circle", "the default job stays");
  await assert.rejects(jobOf(optionsIn("#preset=unobtainium"), core), /preset "unobtainium".*al-7075-t6/);
});
