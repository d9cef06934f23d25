// Export of the program: the controller, the program's accuracy, and its files.

import * as core from "../core/client.js";
import { announce } from "../page/announce.js";
import { byId, make } from "../page/dom.js";
import { download } from "../page/download.js";

/**
 * @import { Controller, Field } from "../../pkg/armill.js"
 * @import { Shown } from "../calculator.js"
 * @import { Outline } from "../core/server.js"
 */

/**
 * A download other than a program: a name for the menu and for the button, the file, and how it is made.
 *
 * @typedef {{
 *   option: string,
 *   button: string,
 *   name: string,
 *   type: string,
 *   made(): Promise<BlobPart>,
 *   stock?: boolean,
 * }} Other
 */

const QUIET_MS = 400; // inputs that are still changing are not judged
const LONG_MS = 3000; // longer runs are checked on export only, as a check costs several runs

/** @type {Other} */
const joints = {
  option: "joint commands as CSV",
  button: "Export joint commands",
  name: "armill-joints.csv",
  type: "text/csv",
  made: () => core.exported("joints-csv"),
};
/**
 * @param {string} kind
 * @param {string} option
 * @returns {Other}
 */
const part = (kind, option) => ({
  option,
  button: "Export part",
  name: `armill-part-${kind}.stl`,
  type: "model/stl",
  made: () => core.simulatedPart(kind),
  stock: true, // of jobs with a stock
});
/** @type {Other} */
const correction = {
  option: "correction at the cycle, as CSV",
  button: "Export correction",
  name: "armill-correction.csv",
  type: "text/csv",
  made: () => core.exported("correction-csv"),
};
/**
 * The correction for an interface that adds it to the running desired program.
 * @param {"kuka-rsi" | "abb-egm"} id
 * @param {string} name
 * @returns {Other}
 */
const added = (id, name) => ({
  option: `correction for ${name}, untested`,
  button: `Export for ${name}`,
  name: `armill-${id}.zip`,
  type: "application/zip",
  made: () => core.interfaceZip(id),
});
/** @type {Record<string, Other>} */
const OTHERS = {
  "joints-csv": joints,
  "correction-csv": correction,
  "kuka-rsi": added("kuka-rsi", "KUKA RSI"),
  "abb-egm": added("abb-egm", "ABB EGM"),
  "part-before": part("before", "part before, as STL"),
  "part-after": part("after", "part after compensation, as STL"),
  "part-nominal": part("nominal", "nominal part, as STL"),
};

/** @type {Record<string, string>} */
let names; // controller -> name
/** @type {string | undefined} */
let wanted; // the controller that was chosen here, if it is not the job's
/** @type {number | undefined} */
let waiting; // timer
/** @type {Shown | undefined} */
let shown; // the result to judge

/**
 * Fills the menu of controllers; `say` and `warn` show a text.
 * @param {Field[]} fields
 * @param {(text: string) => void} say
 * @param {(text: string) => void} warn
 */
export function makeTakeAway(fields, say, warn) {
  const { choices = [] } = fields.find(({ path }) => path === "program.controller") ?? {};
  names = Object.fromEntries(
    choices.filter(({ value }) => value !== "brand").map(({ value, label }) => [value, label]),
  );
  const menu = byId("export-format");
  menu.append(
    ...Object.entries(names).map(([value, name]) => make("option", { value }, name)),
    ...Object.entries(OTHERS).map(([value, { option, stock }]) =>
      make("option", { value, hidden: Boolean(stock), disabled: Boolean(stock) }, option),
    ),
  );
  menu.addEventListener("change", () => {
    wanted = menu.value === shown?.summary.controller ? undefined : menu.value;
    label();
    judgeSoon(0);
  });
  byId("download-program").addEventListener("click", () => save(say, warn));
}

/**
 * Judges a new result once it has stood for a while.
 * @param {Shown} result
 */
export function judgeTakeAway(result) {
  shown = result;
  const { summary } = result;
  const stock = Boolean(summary.surface);
  for (const option of byId("export-format").options)
    if (OTHERS[option.value]?.stock) option.hidden = option.disabled = !stock;
  if (wanted && OTHERS[wanted]?.stock && !stock) wanted = undefined;
  byId("export-format").value = wanted ?? summary.controller;
  label();
  judgeSoon(QUIET_MS);
}

const label = () => {
  const { value } = byId("export-format");
  byId("download-program").textContent = OTHERS[value]?.button ?? `Export ${names[value]}`;
};

/** @param {number} quiet [ms] */
function judgeSoon(quiet) {
  const line = byId("as-program");
  state(line, "");
  line.classList.remove("bad");
  showRemarks([]);
  clearTimeout(waiting);
  const { value } = byId("export-format");
  if (!shown || shown.preview || OTHERS[value]) return; // nothing is promised
  if (shown.took > LONG_MS)
    state(line, "A program has its own timing, so its accuracy may differ; it is simulated on export.");
  else waiting = setTimeout(judge, quiet, line, value, core.shownJob());
}

/**
 * @param {HTMLElement} line
 * @param {Controller} controller
 * @param {string | null} json
 */
async function judge(line, controller, json) {
  const current = () => core.shownJob() === json && byId("export-format").value === controller;
  try {
    const outline = await core.packaged(controller);
    if (current()) showOutline(line, outline);
  } catch (error) {
    if (!error.fatal && error.code !== "cancelled" && current())
      state(line, `Not as ${names[controller]}: ${error.message}`);
  }
}

/**
 * @param {HTMLElement} line
 * @param {string} text
 */
function state(line, text) {
  line.textContent = text;
  announce("program", text);
}

/**
 * What a program is worth, and what to look out for.
 * @param {HTMLElement} line
 * @param {Outline} outline
 */
function showOutline(line, { met, sentence, remarks }) {
  state(line, sentence);
  line.classList.toggle("bad", !met);
  showRemarks(remarks);
}

/**
 * In a list that an export opens: the text comes late, and until then nothing below may move.
 * @param {string[]} remarks
 */
function showRemarks(remarks) {
  const shaper = remarks.some((remark) => remark.includes("input shaper"));
  byId("download-program").title = shaper ? remarks[0] : "";
  byId("download-program").classList.toggle("needs-shaper", shaper);
  byId("remarks").hidden = true;
  byId("remarks-first").textContent = remarks.length ? `: ${remarks[0]}` : "";
  byId("remarks-list").replaceChildren(...remarks.map((remark) => make("li", {}, remark)));
}

/**
 * @param {(text: string) => void} say
 * @param {(text: string) => void} warn
 */
async function save(say, warn) {
  const { value } = byId("export-format");
  const json = core.shownJob();
  try {
    const other = OTHERS[value];
    if (other) return download(other.name, other.type, await other.made());
    const { file, outline } = await core.packageOf(/** @type {Controller} */ (value));
    download(file.name, file.type, file.content);
    if (core.shownJob() === json) showOutline(byId("as-program"), outline);
    byId("remarks").open = outline.remarks.length > 0;
    byId("remarks").hidden = outline.remarks.length === 0;
    say(`Saved ${file.name}${outline.files.length > 1 ? `: ${outline.files.join(", ")}` : ""}`);
  } catch (error) {
    if (!error.fatal && error.code !== "cancelled") warn(`The file could not be made: ${error.message}`);
  }
}
