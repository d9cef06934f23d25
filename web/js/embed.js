// The calculator as a guest of another page. What to compute and to show stands in the fragment, as
// armill-calculator.js writes it; nothing is stored, and no message is listened to.

import { Calculator } from "./calculator.js";
import { setCharts, showPanel } from "./chart/panel.js";
import * as core from "./core/client.js";
import { chartsIn, fieldsIn, isLinked, jobOf, optionsIn } from "./embed-options.js";
import { Form } from "./form/form.js";
import { merged } from "./job/data.js";
import { Job } from "./job/job.js";
import { fragmentOf } from "./job/link.js";
import { announce } from "./page/announce.js";
import { byId } from "./page/dom.js";
import { lend } from "./page/settings.js";
import * as status from "./page/status.js";
import { errorText, forceUnit, lengthUnit } from "./page/units.js";
import { showBudget } from "./result/budget.js";
import { showFeedRule } from "./result/feed-rule.js";
import { showSurface } from "./result/surface.js";
import { showWarnings } from "./result/warnings.js";
import { makeScene } from "./scene/view.js";

/**
 * @import { Remedy, Summary } from "../pkg/armill.js"
 * @import { Shown } from "./calculator.js"
 * @import { Failure } from "./core/client.js"
 * @import { Options } from "./embed-options.js"
 */

/** @type {Options} */
let options; // what the host page asks for
/** @type {ReturnType<typeof makeScene> | undefined} */
let scene; // if it is asked for
/** @type {Job} */
let job;
/** @type {Form | undefined} */
let form;
let origin = ""; // what there is to say about the job of a link, until it is changed
let missing = ""; // what the host page asks for and there is none of

const calculator = new Calculator(core, {
  ...status,
  become: (state) => status.become(missing ? "stale" : state),
  say: (text) => status.say(calculator.current ? origin + text : text),
  slow() {},
  progress() {},
  show,
});

/**
 * After every edit; the way to the whole page takes the inputs along.
 * @param {string} [_typing]
 * @param {boolean} [stepped]
 */
function edited(_typing, stepped) {
  origin = "";
  link();
  calculator.edited(stepped);
}

/**
 * Applies the remedy of a warning.
 * @param {Remedy["patch"]} patch
 */
function remedy(patch) {
  job.load(merged(job.data, patch));
  calculator.form.reload();
  edited();
}

/** @param {Partial<Failure>} error */
function cannotStart(error) {
  byId("verdict").textContent = "The calculator could not start.";
  status.become("stale");
  status.warn(error.message ?? String(error));
  status.say("No result yet.");
}

/** @param {Shown} shown */
function show({ summary, charts }) {
  showFigures(summary);
  announce("verdict", summary.verdict);
  form?.takeProgram(summary.program);
  scene?.show(summary);
  showSurface(summary);
  showFeedRule(summary.feed_rule);
  if (options.show.includes("budget")) showBudget(summary.budget);
  try {
    setCharts(chartsIn(charts, options.charts).map((chart) => ({ ...chart, view: "embed" })));
  } catch ({ message }) {
    missing = message;
    status.warn(message);
  }
}

/** @param {Summary} summary */
function showFigures({ verdict, verdict_state, how_sure, before_mm, after_mm, cut, warnings, fingerprint }) {
  byId("stock").hidden = !cut.stock;
  byId("stock").textContent = cut.stock ? `Engagement from the stock: ${cut.stock}.` : "";
  byId("verdict").textContent = verdict;
  byId("results").dataset.verdict = verdict_state;
  byId("expected").textContent = how_sure.sentence;
  showWarnings(warnings, remedy);
  for (const [row, { mean, max }] of /** @type {[string, Summary["after_mm"]][]} */ ([
    [".before", before_mm.both],
    [".after", after_mm],
  ])) {
    /** @type {NodeListOf<HTMLElement>} */
    const cells = byId("figures").querySelectorAll(`${row} td`);
    [mean, max].forEach((value, i) => {
      cells[i].textContent = errorText(value);
      cells[i].dataset.value = String(value);
    });
  }
  byId("fingerprint").textContent = fingerprint;
}

async function link() {
  const { text } = job;
  const fragment = await fragmentOf(text);
  if (text === job.text) byId("open").href = `index.html#${fragment}`;
}

/** Shows the parts asked for, in the units asked for. */
function furnish() {
  lend(options.units);
  for (const unit of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-unit]")))
    unit.textContent = unit.dataset.unit === "force" ? forceUnit() : lengthUnit();
  for (const part of ["scene", "budget"]) byId(part).hidden = !options.show.includes(part);
  if (options.show.includes("scene")) scene = makeScene(byId("scene"));
}

/** Tells the page around how high this one is. That is no secret, so it may be any page. */
function tellHeight() {
  const tell = () =>
    parent.postMessage({ type: "armill-height", height: document.body.getBoundingClientRect().height }, "*");
  new ResizeObserver(tell).observe(document.body);
}

try {
  if (parent !== window) tellHeight();
  addEventListener("hashchange", () => location.reload());
  options = optionsIn(location.hash);
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  if (options.theme !== "auto") document.documentElement.dataset.theme = options.theme;
  byId("results").dataset.views = [...options.charts, ...options.show].filter((name) => name !== "none").join(" ");
  byId("results").dataset.inputs = options.inputs.filter((name) => name !== "none").join(" ");
  furnish();
  const hello = await core.start(calculator.events);
  const fields = fieldsIn(hello.fields, options.inputs);
  const data = await jobOf(options, hello);
  job = new Job(data, hello);
  if (isLinked(options) && job.isAfter(data))
    origin = "The link’s job was computed with an earlier model; figures differ. ";
  calculator.open(job);
  calculator.compute(); // while the form is built
  calculator.form = form = new Form(byId("form"), job, fields, hello.presets, edited);
  form.takeProgram(calculator.shown?.summary.program);
  for (const group of /** @type {NodeListOf<HTMLDetailsElement>} */ (document.querySelectorAll(".group")))
    group.open = !options.inputs.includes("all");
  showPanel(byId("panel-embed"));
  link();
} catch (error) {
  cannotStart(error);
}
