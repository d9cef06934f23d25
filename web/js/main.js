// Wires the page: the form edits the job, the core computes it, results and charts show it.

import * as core from "./core.js";
import { setCharts, showPanel } from "./charts.js";
import { setCursor } from "./cursor.js";
import { pin, pinnedResult, restorePin, showCompared, unpin } from "./compare.js";
import { makeArmView } from "./arm-view.js";
import { byId, debounced, make, sentence } from "./dom.js";
import { download } from "./download.js";
import { Form } from "./form.js";
import { Job, merged } from "./job.js";
import { makeIdentify } from "./identify/panel.js";
import { makePlacement } from "./placement/panel.js";
import { formatNumber } from "./number.js";
import { openPanels, rememberPanels, restoreGroups } from "./panels.js";
import {
  followCaret,
  followPaste,
  isOfExample,
  openProgram,
  programTools,
  setLines,
  showProgram,
  textIn,
} from "./program.js";
import { showSummary, showThesis, showUnits } from "./results.js";
import { Session } from "./session.js";
import { makeScene } from "./scene/view.js";
import { onSetting } from "./settings.js";
import { settingsPanel } from "./settings-panel.js";
import { shareDialog } from "./share.js";
import { begun } from "./start.js";
import { makeTabs } from "./tabs.js";
import { judgeTakeAway, makeTakeAway } from "./take-away.js";
import { followTheme } from "./theme.js";

const TYPING_MS = 150; // results follow this long after the last key
const PUSHED = 4000; // samples of a run that follows a number while it is pushed
const COARSE_S = 0.005; // but no further apart than this
const PATIENCE_MS = 150; // a run that takes longer shows its progress
// Warn after this long without progress; browsers do not report a killed Worker.
const SILENCE_MS = 30_000;

await begun;

const results = byId("results");
const scene = makeScene(byId("scene"));
const placement = makePlacement(byId("placement"), {
  job: () => job && JSON.parse(job.json),
  use: (moved) => session.load(moved),
});
const identify = makeIdentify(byId("identify"), {
  job: () => JSON.parse(job.json),
  use: (changed) => session.load(changed),
});
let job;
let form;
let session;
let standard; // the default job
let shown = null; // the shown result: { json, summary, preview } and its job
let opened = 0; // programs, to tell the latest
let slow; // timer that shows the progress
let silent; // timer that says that there is none
const previews = new Set(); // JSON texts of jobs with fewer samples that were asked for since the last full result
const FILES = ["download-compensated", "download-columns", "download-program", "export-format"];
const TAKEN_AWAY = [...FILES, "share", "pin"];

const state = (name) => (results.dataset.state = name);
const say = (text) => (byId("status").textContent = text);
const armView = makeArmView((json) => core.armAtZero(json));
const computing = () => (shown?.preview ? "A preview; computing" : "Computing");
const lastValid = () =>
  shown?.preview ? " Showing a preview with fewer samples." : shown ? " Showing the last valid result." : "";

const computeNow = () => {
  if (form.flawed) return;
  alertOff();
  form.clearErrors();
  core.run(job.json);
};
const compute = debounced(computeNow, TYPING_MS);

/**
 * Has a long run follow a number that is pushed with fewer samples; all of them come when it rests.
 */
function computeSoon() {
  const time = job.sampleTime;
  const every = Math.floor(Math.min(shown.summary.duration_s / PUSHED, COARSE_S) / time);
  if (every < 2) return computeNow();
  const preview = job.sampledEvery(every * time);
  previews.add(preview);
  core.run(preview);
  compute();
}

/**
 * After every edit: compute, or say what is wrong and keep the last result. A number that is pushed
 * is complete at every step.
 */
function edited(stepped = false) {
  alertOff();
  if (form.flawed) {
    if (shown) core.cancel();
    else core.run(job.json); // the last valid value of what is wrong
    return stale();
  }
  form.clearErrors();
  armView.show(job);
  state("computing");
  if (!shown) computeNow();
  else if (stepped) computeSoon();
  else compute();
}

/** A result of other inputs than those on the page is shared with its own, but not milled. */
const withholdFiles = () => FILES.forEach((id) => (byId(id).disabled = true));

function stale() {
  state("stale");
  withholdFiles();
  const problem = form.problem;
  if (problem) alertOn(problem.message, "Show the field", () => (foldInputs(false), problem.go()));
  say(lastValid().trim() || "No result yet.");
}

function alertOn(message, action, go) {
  const box = byId("alert");
  box.replaceChildren(make("p", {}, sentence(message)));
  if (action) {
    const button = make("button", { type: "button" }, action);
    button.addEventListener("click", go);
    box.append(button);
  }
}

const alertOff = () => byId("alert").replaceChildren();

const events = {
  onstart() {
    state("computing");
    byId("progress").value = 0;
    clearTimeout(slow);
    slow = setTimeout(() => {
      say(`${computing()}…`);
      results.classList.add("slow");
    }, PATIENCE_MS);
  },
  onprogress({ fraction, stage }) {
    heard();
    byId("progress").value = fraction;
    if (results.classList.contains("slow")) say(`${computing()}: ${stage}`);
  },
  onresult({ summary, charts }, took) {
    idle();
    const first = !shown;
    const json = core.shownJob();
    const current = json === job.json;
    shown = {
      json,
      summary,
      preview: !current && previews.has(json),
      get job() {
        return job.of(JSON.parse(this.json));
      },
    };
    if (current) previews.clear();
    results.classList.toggle("preview", shown.preview);
    showFigures();
    takeLines(summary);
    setCharts(charts);
    if (first) performance.mark("first result"); // for whoever measures
    if (first) restorePin(() => shown);
    scene.show(summary);
    judgeTakeAway(shown, took);
    identify.look();
    placement.look();
    for (const id of TAKEN_AWAY) byId(id).disabled = shown.preview;
    if (form.flawed) return stale();
    if (shown.preview) say(`A preview of ${formatNumber(summary.samples, 1)} samples`);
    if (!current) return; // shown, but of an earlier edit
    state("current");
    say(`${formatNumber(summary.samples, 1)} samples in ${formatNumber(took / 1000, 2)} s`);
  },
  onerror(error) {
    idle();
    if (form.showError(error)) return stale();
    state("stale");
    withholdFiles();
    const where = error.line ? ` (line ${error.line}, column ${error.column})` : "";
    if (["unreachable", "branch-ends"].includes(error.code) || error.field === "path")
      alertOn(error.message, "Place the path in front of this robot", placeInFront);
    else alertOn(`${error.message}${where}`);
    say(lastValid().trim() || "No result yet.");
  },
  oncancel() {
    idle();
    if (form.flawed) return stale();
    state("stale");
    say(`Cancelled.${lastValid()}`);
  },
  ontrap(error) {
    idle();
    if (error.code === "load") return cannotStart(error);
    state("stale");
    alertOn(
      `The core stopped unexpectedly and was started again; your inputs are kept. (${error.message})`,
      "Compute again",
      () => {
        alertOff();
        core.run(job.json);
      },
    );
    say("The core was restarted.");
  },
};

/** Moves the workpiece to where the robot reaches the whole path. */
async function placeInFront() {
  try {
    const xyz_mm = [...(await core.placeInFront(job.json))];
    const data = JSON.parse(job.json);
    session.load({ ...data, workpiece_frame: { ...data.workpiece_frame, xyz_mm } });
    byId("group-frames").open = true;
  } catch (error) {
    if (!error.fatal) alertOn(error.message);
  }
}

/** Figures and tables of the shown result, in the units of the settings. */
function showFigures() {
  if (!shown) return;
  showSummary(shown.summary, (patch) => session.load(merged(JSON.parse(job.json), patch)));
  showProgram(shown.summary.program, shown.summary.duration_s);
  showCompared(shown);
}

/** Charts name the line of the program that runs at a time. */
async function takeLines({ program, duration_s, samples }) {
  setLines(null, 1);
  if (!program) return;
  try {
    setLines(await core.column("program_line"), duration_s / (samples - 1));
  } catch {
    // A newer result takes its own.
  }
}

/**
 * Makes a program the path of the job, whatever the job was before. The example's shaper goes: hardly
 * any controller has one, and commands for it are wrong without. An example brings its stock and its
 * tool; any other program gets a stock unless the job has one. False if another program came meanwhile.
 */
async function useProgram(kind, text, { stock, tool } = {}) {
  const mine = ++opened;
  core.cancel();
  const given = stock ?? (await stockFor(kind, text));
  if (mine !== opened) return false;
  const { shaper, ...rest } = JSON.parse(job.json);
  const own = JSON.stringify(shaper) !== JSON.stringify(standard.shaper);
  const next = { ...rest, path: { kind, text }, shaper: own ? shaper : "none" };
  delete next.stock;
  session.load(merged(next, { ...(given && { stock: given }), ...(tool && { tool }) }));
  byId("group-path").open = true;
  return true;
}

/** The stock for a program: the job's own, or its extents as the core proposes them. */
async function stockFor(kind, text) {
  const { stock, ...rest } = JSON.parse(job.json);
  const path = { kind, text };
  const kept = stock && stock.kind !== "extents" && !(await isOfExample(stock));
  if (kept) return stock;
  try {
    const proposed = await core.proposedStock(JSON.stringify({ ...rest, path }));
    return proposed && { ...proposed, ...(stock?.allowance_mm !== undefined && { allowance_mm: stock.allowance_mm }) };
  } catch {
    return undefined; // what is wrong with the program is said when it is computed
  }
}

/** Files dropped anywhere on the page. */
function wireDrop() {
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (!file) return;
    if (file.name.endsWith(".json")) openJob(file);
    else openProgram(file, useProgram, alertOn);
  });
}

/** The run in progress is alive. */
function heard() {
  clearTimeout(silent);
  silent = setTimeout(
    say,
    SILENCE_MS,
    `Nothing was heard of the run for ${SILENCE_MS / 1000} s: the browser may have ended it. Cancel, or wait.`,
  );
}

function idle() {
  clearTimeout(slow);
  clearTimeout(silent);
  results.classList.remove("slow");
}

/**
 * The core could not be loaded, at first or for another Worker: a network that comes back mends
 * that.
 */
function cannotStart(error) {
  state("stale");
  if (!shown) byId("verdict").textContent = "The calculator could not start.";
  const why = `The core could not be loaded: ${error.message ?? error}. Armill needs a browser with WebAssembly and module workers.`;
  if (error.code === "load") alertOn(why, "Try again", tryAgain);
  else alertOn(why);
  say(lastValid().trim());
}

function tryAgain() {
  if (form) return edited();
  alertOff();
  state("starting");
  open().catch(cannotStart);
}

/** On a phone the inputs fold away; elsewhere they always show. */
function foldInputs(away) {
  byId("inputs").classList.toggle("open", !away);
  byId("inputs-toggle").setAttribute("aria-expanded", String(!away));
  byId("inputs-toggle").textContent = away ? "Show" : "Hide";
}

async function openJob(file) {
  byId("job-file").value = "";
  if (!file) return;
  const text = await textIn(file, alertOn);
  if (text === undefined) return;
  core.cancel();
  try {
    await core.check(text);
    session.load(JSON.parse(text));
  } catch ({ message, line, column }) {
    alertOn(
      `“${file.name}” was not opened: ${message}${line && !/\bline\b/.test(message) ? ` (line ${line}, column ${column})` : ""}`,
    );
  }
}

async function save(format, name) {
  try {
    download(name, "text/csv", await core.exported(format));
  } catch (error) {
    if (!error.fatal) alertOn(`The file could not be made: ${error.message}`);
  }
}

/** Fills the panel "Thesis, recomputed" when it is first looked at: its rows stay the same. */
async function recomputeThesis() {
  if (byId("thesis").tBodies[0].rows.length) return;
  try {
    showThesis(await core.thesis());
  } catch {
    // The Worker was taken away for a newer run; the next look asks again.
  }
}

function wire() {
  showUnits(); // before anything is drawn, so that nothing moves later
  byId("cancel").addEventListener("click", () => core.cancel());
  byId("reset").addEventListener("click", () => session.load(standard));
  byId("open-job").addEventListener("click", () => byId("job-file").click());
  byId("job-file").addEventListener("change", ({ target }) => openJob(target.files[0]));
  byId("download-job").addEventListener("click", () =>
    download("armill-job.json", "application/json", `${job.json}\n`),
  );
  byId("download-columns").addEventListener("click", () => save("columns-csv", "armill-columns.csv"));
  byId("download-compensated").addEventListener("click", () => save("compensated-csv", "armill-compensated-path.csv"));
  byId("inputs-toggle").addEventListener("click", () => foldInputs(byId("inputs").classList.contains("open")));
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  wireResultTools();
  const tabs = makeTabs(document.querySelector("[role=tablist]"), (panel) => {
    showPanel(panel);
    rememberPanels({ tab: panel.getAttribute("aria-labelledby") });
    if (panel.id === "panel-thesis") recomputeThesis();
    if (panel.id === "panel-identify") identify.look();
    if (panel.id === "panel-placement") placement.look();
  });
  if (!tabs.show(openPanels().tab)) showPanel(tabs.current());
}

/** What is done with the shown result as a whole: shared, pinned, read in other units. */
function wireResultTools() {
  const share = shareDialog();
  byId("share").addEventListener("click", () => share({ ...shown, job: shown.job, standard }));
  byId("pin").addEventListener("click", () => pin(shown));
  byId("unpin").addEventListener("click", () => (unpin(shown), byId("pin").focus()));
  byId("back-to-a").addEventListener("click", () => session.load(JSON.parse(pinnedResult().json)));
  settingsPanel(byId("settings"));
  followTheme();
  onSetting((key) => key !== "theme" && showFigures());
}

/** Builds the form and opens the job. */
async function open() {
  const hello = await core.start(events);
  standard = hello.job;
  job = new Job(standard, hello);
  byId("version").textContent = `v${hello.version}`;
  form = new Form(byId("form"), job, hello.fields, hello.presets, (typing, stepped) => session.edited(typing, stepped));
  byId("group-robot").querySelector("legend").after(armView.node);
  byId("group-path").querySelector("legend").after(programTools(useProgram, alertOn));
  followPaste(useProgram);
  followCaret((time) => setCursor(time, "program"));
  wireDrop();
  makeTakeAway(hello.fields, say, alertOn);
  restoreGroups();
  session = new Session({ job, form, standard, core, changed: edited, warn: alertOn });
  await session.open();
  byId("download-job").disabled = false;
}

try {
  wire();
  await open();
} catch (error) {
  cannotStart(error);
}
