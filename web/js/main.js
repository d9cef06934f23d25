// Wires the page: the form edits the job, the calculator has the core compute it, the views show it.

import { Calculator } from "./calculator.js";
import { setCharts, showPanel } from "./chart/panel.js";
import * as core from "./core/client.js";
import { Form } from "./form/form.js";
import { followCaret, followPaste, programTools } from "./form/program-tools.js";
import { makeIdentify } from "./identify/panel.js";
import { Job, merged } from "./job/job.js";
import { makeOpening } from "./job/opening.js";
import { Session } from "./job/session.js";
import { setCursor } from "./page/cursor.js";
import { byId } from "./page/dom.js";
import { download } from "./page/download.js";
import { openPanels, rememberPanels, restoreGroups } from "./page/open-panels.js";
import { setLines } from "./page/program-lines.js";
import { onSetting } from "./page/settings.js";
import { settingsPanel } from "./page/settings-panel.js";
import * as status from "./page/status.js";
import { makeTabs } from "./page/tabs.js";
import { followTheme } from "./page/theme.js";
import { makePlacement } from "./placement/panel.js";
import { pin, pinnedResult, restorePin, showCompared, unpin } from "./result/compare.js";
import { judgeTakeAway, makeTakeAway } from "./result/export.js";
import { showProgram } from "./result/program.js";
import { shareDialog } from "./result/share.js";
import { showSummary, showThesis, showUnits } from "./result/summary.js";
import { makeArmView } from "./scene/sketch.js";
import { makeScene } from "./scene/view.js";
import { begun } from "./start.js";

const FILES = ["download-compensated", "download-columns", "download-program", "export-format"];
const OF_RESULT = [...FILES, "share", "pin"];

await begun;

let job;
let session;
let standard; // the default job

const present = { job: () => job?.data, use: (changed) => session.load(changed) };
const scene = makeScene(byId("scene"));
const placement = makePlacement(byId("placement"), present);
const identify = makeIdentify(byId("identify"), present);
const armView = makeArmView((text) => core.armAtZero(text));
const calculator = new Calculator(core, { ...status, become, show, progress, remedyFor });
const opening = makeOpening({
  core,
  job: () => job,
  session: () => session,
  standard: () => standard,
  warn: status.warn,
});

/** A result of other inputs than those on the page is shared with its own, but not milled. */
function become(state) {
  status.become(state);
  if (state === "stale") for (const id of FILES) byId(id).disabled = true;
}

const progress = (fraction) => (byId("progress").value = fraction);

function show(shown) {
  const first = !byId("fingerprint").dataset.seen;
  showFigures();
  takeLines(shown.summary);
  setCharts(shown.charts);
  if (first) {
    performance.mark("first result"); // for whoever measures
    byId("fingerprint").dataset.seen = "yes";
    restorePin(() => calculator.shown);
  }
  scene.show(shown.summary);
  judgeTakeAway(shown);
  identify.look();
  placement.look();
  for (const id of OF_RESULT) byId(id).disabled = shown.preview;
}

/** Figures and tables of the shown result, in the units of the settings. */
function showFigures() {
  const { shown } = calculator;
  if (!shown) return;
  showSummary(shown.summary, (patch) => session.load(merged(job.data, patch)));
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

function remedyFor({ code, field }) {
  if (!["unreachable", "branch-ends"].includes(code) && field !== "path") return undefined;
  return { label: "Place the path in front of this robot", go: placeInFront };
}

/** Moves the workpiece to where the robot reaches the whole path. */
async function placeInFront() {
  try {
    session.load(merged(job.data, { workpiece_frame: { xyz_mm: [...(await core.placeInFront(job.text))] } }));
    byId("group-frames").open = true;
  } catch (error) {
    if (!error.fatal) status.warn(error.message);
  }
}

/** After every edit of the form, and after every job that was opened. */
function edited(stepped) {
  calculator.edited(stepped);
  if (!calculator.form.flawed) armView.show(job);
}

/** On a phone the inputs fold away; elsewhere they always show. */
function foldInputs(away) {
  byId("inputs").classList.toggle("open", !away);
  byId("inputs-toggle").setAttribute("aria-expanded", String(!away));
  byId("inputs-toggle").textContent = away ? "Show" : "Hide";
}

async function save(format, name) {
  try {
    download(name, "text/csv", await core.exported(format));
  } catch (error) {
    if (!error.fatal) status.warn(`The file could not be made: ${error.message}`);
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
  byId("reset").addEventListener("click", () => session.load(standard));
  byId("open-job").addEventListener("click", () => byId("job-file").click());
  byId("job-file").addEventListener("change", ({ target }) => opening.openJob(target.files[0]));
  byId("download-job").addEventListener("click", () =>
    download("armill-job.json", "application/json", `${job.text}\n`),
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
  byId("share").addEventListener("click", () => share({ ...calculator.shown, job: calculator.shown.job, standard }));
  byId("pin").addEventListener("click", () => pin(calculator.shown));
  byId("unpin").addEventListener("click", () => (unpin(calculator.shown), byId("pin").focus()));
  byId("back-to-a").addEventListener("click", () => session.load(JSON.parse(pinnedResult().text)));
  settingsPanel(byId("settings"));
  followTheme();
  onSetting((key) => key !== "theme" && showFigures());
}

/** Builds the form and opens the job. */
async function open() {
  const hello = await core.start(calculator.events);
  standard = hello.job;
  job = new Job(standard, hello);
  calculator.open(job);
  byId("version").textContent = `v${hello.version}`;
  const form = new Form(byId("form"), job, hello.fields, hello.presets, (typing, stepped) =>
    session.edited(typing, stepped),
  );
  calculator.form = form;
  byId("group-robot").querySelector("legend").after(armView.node);
  byId("group-path").querySelector("legend").after(programTools(opening.useProgram, status.warn));
  followPaste(opening.useProgram);
  followCaret((time) => setCursor(time, "program"));
  opening.wireDrop();
  makeTakeAway(hello.fields, status.say, status.warn);
  restoreGroups();
  session = new Session({ job, form, standard, core, changed: edited, warn: status.warn });
  await session.open();
  byId("download-job").disabled = false;
}

/** The core could not be loaded: says so, and offers to try again. */
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
