// Wires the page: the form edits the job, the calculator has the core compute it, the views show it.

import { Calculator } from "./calculator.js";
import { chartTexts, fixChart, setCharts, showPanel } from "./chart/panel.js";
import * as core from "./core/client.js";
import { Form } from "./form/form.js";
import { followCaret, followPaste, programTools } from "./form/program-tools.js";
import { ask, offerPlace, showAsked } from "./form/still-asked.js";
import { makeEvidence } from "./identify/evidence.js";
import { makeIdentify } from "./identify/panel.js";
import { merged } from "./job/data.js";
import { Job } from "./job/job.js";
import { makeOpening } from "./job/opening.js";
import { Session } from "./job/session.js";
import { makeTitle } from "./job/title.js";
import { announce } from "./page/announce.js";
import { setCursor } from "./page/cursor.js";
import { byId } from "./page/dom.js";
import { download } from "./page/download.js";
import { keepOffline } from "./page/offline.js";
import { openPanels, rememberPanels, restoreGroups } from "./page/open-panels.js";
import { setLines } from "./page/program-lines.js";
import { onSetting } from "./page/settings.js";
import { settingsPanel } from "./page/settings-panel.js";
import * as status from "./page/status.js";
import { makeTabs, viewIn } from "./page/tabs.js";
import { followTheme } from "./page/theme.js";
import { makePlacement } from "./placement/panel.js";
import { makeCompare } from "./result/compare.js";
import { judgeTakeAway, makeTakeAway } from "./result/export.js";
import { makePaper, preparePaper } from "./result/paper.js";
import { showProgram } from "./result/program.js";
import { shareDialog } from "./result/share.js";
import { showSummary, showUnits } from "./result/summary.js";
import { figuresIn, showFigureIndex, showThesis } from "./result/thesis.js";
import { makeArmView } from "./scene/sketch.js";
import { makeScene } from "./scene/view.js";
import { begun } from "./start.js";
import { makeStudy } from "./study/panel.js";

/**
 * @import { ChartEntry, Field, Summary } from "../pkg/armill.js"
 * @import { Shown, State } from "./calculator.js"
 * @import { Failure } from "./core/client.js"
 * @import { JobData } from "./job/data.js"
 */

const FILES = ["download-compensated", "download-columns", "download-program", "export-format", "all-figures"];
const OF_RESULT = [...FILES, "share", "pin"];

await begun;

/** @type {Job} */
let job;
/** @type {Session} */
let session;
/** @type {ReturnType<typeof makeTabs>} */
let tabs;
/** @type {Form | undefined} */
let form;
/** @type {string} */
let arm; // the robot of the inputs, by its key
/** @type {Field[]} */
let fields = [];
/** @type {{ job: JobData, opening: JobData }} */
let examples; // the core's own jobs: `opening`, and `job`, the thesis's

const present = { job: () => job?.data, use: (/** @type {JobData} */ changed) => session.load(changed) };
const scene = makeScene(byId("scene"));
const placement = makePlacement(byId("placement"), present);
const identify = makeIdentify(byId("identify"), present);
const evidence = makeEvidence(byId("evidence"));
const armView = makeArmView((text) => core.armAtZero(text));
const calculator = new Calculator(core, { ...status, become, show, progress, remedyFor });
const study = makeStudy(byId("study"), {
  job: () => job,
  use: (changed) => session.load(changed),
  fields: () => fields,
});
const compare = makeCompare({
  shown: () => calculator.shown,
  load: (changed) => session.load(changed),
});
const showTitle = makeTitle(
  () => job,
  () => session,
);
const opening = makeOpening({
  core,
  job: () => job,
  session: () => session,
  examples: () => examples,
  warn: status.warn,
});

/**
 * @param {string} id of a button or a choice
 * @param {boolean} disabled
 */
function disable(id, disabled) {
  const control = /** @type {HTMLButtonElement} */ (byId(id));
  control.disabled = disabled;
}

/**
 * A result of other inputs than those on the page is shared with its own, but not milled.
 * @param {State} state
 */
function become(state) {
  status.become(state);
  if (state === "stale") for (const id of FILES) disable(id, true);
}

/** @param {number} fraction */
function progress(fraction) {
  byId("progress").value = fraction;
}

/** @param {Shown} shown */
function show(shown) {
  const first = !byId("fingerprint").dataset.seen;
  showFigures();
  takeLines(shown.summary);
  setCharts(shown.charts);
  if (!byId("panel-thesis").hidden) listFigures();
  if (first) {
    performance.mark("first result"); // read by benches
    byId("fingerprint").dataset.seen = "yes";
    compare.restore();
    keepOffline();
  }
  scene.show(shown.summary);
  judgeTakeAway(shown);
  preparePaper(shown);
  if (!shown.preview) announce("verdict", shown.summary.verdict);
  identify.look();
  placement.look();
  study.look();
  for (const id of OF_RESULT) disable(id, shown.preview);
}

/** Figures and tables of the shown result, in the units of the settings. */
function showFigures() {
  const { shown } = calculator;
  if (!shown) return;
  showSummary(shown.summary, (patch) => session.load(merged(job.data, patch)));
  showProgram(shown.summary.program, shown.summary.duration_s);
  form?.takeProgram(shown.summary.program);
  compare.show();
}

/**
 * Charts name the line of the program that runs at a time.
 * @param {Summary} summary
 */
async function takeLines({ program, duration_s, samples }) {
  setLines(null, 1);
  if (!program) return;
  try {
    setLines(await core.column("program_line"), duration_s / (samples - 1));
  } catch {
    // A newer result takes its own.
  }
}

/** The index of the thesis's figures, while it is looked at: dragging a number shows 20 results a second. */
const listFigures = () => showFigureIndex(calculator.shown?.charts ?? [], showChart);

/**
 * Opens the view of a chart and brings it into sight.
 * @param {string} view
 * @param {string} name
 */
function showChart(view, name) {
  tabs.choose(view);
  requestAnimationFrame(() => byId(`chart-${name}`)?.scrollIntoView({ block: "nearest" }));
}

/** @param {Failure} error */
function remedyFor({ code, field }) {
  if (!["unreachable", "branch-ends"].includes(code) && field !== "path") return undefined;
  return { label: "Place the path in front of this robot", go: placeInFront };
}

/** Moves the workpiece to where the robot reaches the whole path; false if there is no such place. */
async function placeInFront() {
  try {
    session.load(merged(job.data, { workpiece_frame: { xyz_mm: [...(await core.placeInFront(job.text))] } }));
    byId("group-frames").open = true;
    return true;
  } catch (error) {
    if (!error.fatal) status.warn(error.message);
    return false;
  }
}

/**
 * After every edit of the form, and after every job that was opened.
 * @param {boolean} [stepped]
 */
function edited(stepped) {
  arm = job.data.robot?.preset;
  showAsked(job.data);
  showTitle();
  calculator.edited(stepped);
  if (!calculator.form.flawed) armView.show(job);
}

/**
 * After an edit in the form: another robot has neither the tool's frame nor the part's place of the last.
 * @param {string} [typing]
 * @param {boolean} [stepped]
 */
function typed(typing, stepped) {
  const preset = job.data.robot?.preset;
  if (preset && preset !== arm) ask(job.data, "robot", "stock");
  session.edited(typing, stepped);
}

/**
 * On a phone the inputs fold away; elsewhere they always show.
 * @param {boolean} away
 */
function foldInputs(away) {
  byId("inputs").classList.toggle("open", !away);
  byId("inputs-toggle").setAttribute("aria-expanded", String(!away));
  byId("inputs-toggle").textContent = away ? "Show" : "Hide";
}

/**
 * @param {string} format
 * @param {string} name
 */
async function save(format, name) {
  try {
    download(name, "text/csv", await core.exported(format));
  } catch (error) {
    if (!error.fatal) status.warn(`The file could not be made: ${error.message}`);
  }
}

/** All figures of the thesis, as they are for the shown result: drawings and values in one archive. */
async function saveFigures() {
  try {
    const figures = figuresIn(calculator.shown?.charts ?? []);
    const texts = await chartTexts(figures.map(({ name }) => name));
    const files = figures.flatMap(({ number, name }) =>
      ["svg", "csv"].map((format) => [`fig-${number}-${name}.${format}`, texts.get(name)[format]]),
    );
    download("armill-figures.zip", "application/zip", await core.zip("armill-figures", files));
  } catch (error) {
    if (!error.fatal) status.warn(`The figures could not be saved: ${error.message}`);
  }
}

/** Fills the panel "Thesis, recomputed" when it is first looked at: its rows stay the same. */
async function recomputeThesis() {
  if (byId("thesis").tBodies[0].rows.length) return;
  try {
    showThesis(await core.thesis());
  } catch {
    // The Worker was stopped for a newer run; the next look asks again.
  }
}

function wire() {
  showUnits(); // before anything is drawn, so that nothing moves later
  byId("cancel").addEventListener("click", () => core.cancel());
  byId("again").addEventListener("click", () => calculator.compute());
  byId("all-figures").addEventListener("click", saveFigures);
  byId("open-thesis").addEventListener("click", () => session.load(examples.job));
  byId("reset").addEventListener("click", () => session.load(examples.opening));
  byId("open-job").addEventListener("click", () => byId("job-file").click());
  byId("job-file").addEventListener("change", () => opening.openJob(byId("job-file").files?.[0]));
  byId("download-job").addEventListener("click", () =>
    download("armill-job.json", "application/json", `${job.text}\n`),
  );
  byId("download-columns").addEventListener("click", () => save("columns-csv", "armill-columns.csv"));
  byId("download-compensated").addEventListener("click", () => save("compensated-csv", "armill-compensated-path.csv"));
  byId("inputs-toggle").addEventListener("click", () => foldInputs(byId("inputs").classList.contains("open")));
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  byId("form").addEventListener("limit", (event) => {
    tabs.choose("compare");
    study.limit(/** @type {CustomEvent<string>} */ (event).detail);
  });
  wireResultTools();
  fixChart(/** @type {HTMLElement} */ (byId("curve").querySelector(".charts")), "before-after");
  tabs = makeTabs((panel) => {
    showPanel(panel);
    rememberPanels({ tab: panel.id.replace("panel-", "") });
    if (panel.id === "panel-thesis") {
      listFigures();
      recomputeThesis();
    }
    if (panel.id === "panel-identify") identify.look();
    if (panel.id === "panel-evidence") evidence.look();
    if (panel.id === "panel-placement") placement.look();
  });
  if (!tabs.show(viewIn(location.hash) ?? "") && !tabs.show(openPanels().tab ?? "")) showPanel(tabs.current());
}

/** What is done with the shown result as a whole: shared, pinned, read in other units. */
function wireResultTools() {
  /** @param {(shown: Shown) => void} act */
  const withShown = (act) => () => calculator.shown && act(calculator.shown);
  makePaper();
  const share = shareDialog();
  byId("share").addEventListener(
    "click",
    withShown((shown) => share({ ...shown, job: shown.job, standard: examples.job })),
  );
  settingsPanel(byId("settings"));
  followTheme();
  onSetting((key) => key !== "theme" && showFigures());
}

/** Builds the form and opens the job. */
async function open() {
  const hello = await core.start(calculator.events);
  examples = hello;
  fields = hello.fields;
  job = new Job(hello.opening, hello);
  calculator.open(job);
  byId("version").textContent = `v${hello.version}`;
  form = new Form(byId("form"), job, hello.fields, hello.presets, typed);
  calculator.form = form;
  byId("group-robot").querySelector("legend")?.after(armView.node);
  byId("group-path").querySelector("legend")?.after(programTools(opening.useProgram, status.warn));
  followPaste(opening.useProgram);
  followCaret((time) => setCursor(time, "program"));
  opening.wireDrop();
  offerPlace(placeInFront);
  makeTakeAway(hello.fields, status.say, status.warn);
  restoreGroups();
  session = new Session({ job, form, examples, core, changed: edited, warn: status.warn });
  await session.open();
  byId("download-job").disabled = false;
  study.open();
}

/**
 * The core could not be loaded: says so, and offers to try again.
 * @param {Partial<Failure>} error
 */
function cannotStart(error) {
  if (!calculator.shown) byId("verdict").textContent = "The calculator could not start.";
  calculator.cannotStart(error, () => {
    status.calm();
    status.become("empty");
    open().catch(cannotStart);
  });
}

try {
  wire();
  await open();
} catch (error) {
  cannotStart(error);
}
