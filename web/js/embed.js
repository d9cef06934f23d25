// The calculator as a guest of another page. What to compute and to show stands in the fragment, as
// armill-calculator.js writes it; nothing is stored, and no message is listened to.

import * as core from "./core.js";
import { showBudget } from "./budget.js";
import { setCharts, showPanel } from "./charts.js";
import { byId, debounced, make, sentence } from "./dom.js";
import { showFeedRule } from "./feed-rule.js";
import { Form } from "./form.js";
import { chartsIn, fieldsIn, isLinked, jobOf, optionsIn } from "./guest.js";
import { Job } from "./job.js";
import { fragmentOf } from "./link.js";
import { formatNumber } from "./number.js";
import { makeScene } from "./scene/view.js";
import { lend } from "./settings.js";
import { showSurface } from "./surface.js";
import { errorText, forceUnit, lengthUnit } from "./units.js";

const TYPING_MS = 150; // results follow this long after the last key

const results = byId("results");
let options; // what the host page asks for
let scene; // if it is asked for
let job;
let form;
let origin = ""; // what there is to say about the job of a link, until it is changed

const state = (name) => (results.dataset.state = name);
const say = (text) => (byId("status").textContent = text);
const alertOff = () => byId("alert").replaceChildren();

function alertOn(message) {
  byId("alert").replaceChildren(make("p", {}, sentence(message)));
  state("stale");
  say(byId("fingerprint").textContent ? "Showing the last valid result." : "No result yet.");
}

const compute = debounced(() => form.flawed || core.run(job.json), TYPING_MS);

/** After every edit: compute, or say what is wrong and keep the last result. */
function edited() {
  alertOff();
  origin = "";
  link();
  if (form.flawed) {
    core.cancel();
    return alertOn(form.problem.message);
  }
  form.clearErrors();
  state("computing");
  compute();
}

const events = {
  onstart: () => say("Computing…"),
  onprogress: ({ stage }) => say(`Computing: ${stage}`),
  onresult({ summary, charts }, took) {
    show(summary);
    scene?.show(summary);
    showSurface(summary);
    showFeedRule(summary.feed_rule);
    if (options.show.includes("budget")) showBudget(summary.budget);
    try {
      setCharts(chartsIn(charts, options.charts).map((chart) => ({ ...chart, view: "embed" })));
    } catch ({ message }) {
      return alertOn(message);
    }
    if (form.flawed) return;
    state("current");
    say(`${origin}${formatNumber(summary.samples, 1)} samples in ${formatNumber(took / 1000, 2)} s`);
  },
  onerror(error) {
    if (form.showError(error)) return alertOn(form.problem.message);
    alertOn(`${error.message}${error.line ? ` (line ${error.line}, column ${error.column})` : ""}`);
  },
  oncancel: () => {},
  ontrap: (error) =>
    error.code === "load"
      ? cannotStart(error)
      : alertOn(`The core stopped unexpectedly and was started again; your inputs are kept. (${error.message})`),
};

function cannotStart(error) {
  byId("verdict").textContent = "The calculator could not start.";
  alertOn(error.message ?? String(error));
}

function show({ verdict, before_mm, after_mm, cut, fingerprint }) {
  byId("stock").hidden = !cut.stock;
  byId("stock").textContent = cut.stock ? `Engagement from the stock: ${cut.stock}.` : "";
  byId("verdict").textContent = verdict;
  for (const [row, { mean, max }] of [
    [".before", before_mm.both],
    [".after", after_mm],
  ]) {
    const cells = byId("figures").querySelectorAll(`${row} td`);
    [mean, max].forEach((value, i) => {
      cells[i].textContent = errorText(value);
      cells[i].dataset.value = String(value);
    });
  }
  byId("fingerprint").textContent = fingerprint;
}

/** The way to the whole page takes the inputs along. */
async function link() {
  const { json } = job;
  const fragment = await fragmentOf(json);
  if (json === job.json) byId("open").href = `index.html#${fragment}`;
}

/** Shows the parts asked for, in the units asked for. */
function furnish() {
  lend(options.units);
  for (const unit of document.querySelectorAll("[data-unit]"))
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
  results.dataset.views = [...options.charts, ...options.show].filter((name) => name !== "none").join(" ");
  furnish();
  const hello = await core.start(events);
  const fields = fieldsIn(hello.fields, options.inputs);
  const data = await jobOf(options, hello);
  job = new Job(data, hello);
  if (isLinked(options) && job.isAfter(data))
    origin = "The link’s job was computed with an earlier model; figures differ. ";
  core.run(job.json); // while the form is built
  form = new Form(byId("form"), job, fields, hello.presets, edited);
  for (const group of document.querySelectorAll(".group")) group.open = !options.inputs.includes("all");
  showPanel(byId("panel-embed"));
  link();
} catch (error) {
  cannotStart(error);
}
