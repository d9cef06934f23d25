// The Worker's side of core.js: owns one Run of the WebAssembly core and answers questions about
// it.

import { heldRuns } from "./held-runs.js";
import { studies } from "./studies.js";

/**
 * @import * as Armill from "../../pkg/armill.js"
 * @import { ChartOptions, ChartUnits, Controller, Package } from "../../pkg/armill.js"
 * @import { Failure } from "./client.js"
 */

/** @typedef {typeof Armill} Core the module that wasm-bindgen made */

/** @typedef {Omit<Package, "files"> & { files: string[] }} Outline a package with the names of its files */

/**
 * @typedef {{
 *   file: { name: string, type: string, content: string | Uint8Array<ArrayBuffer> },
 *   outline: Outline,
 * }} PackageFile what to save of a package, and how it runs
 */

const PROGRESS_MS = 40;
const ROWS = 20_000; // of a file written at a time

/** @type {Core} */
let armill; // the core
/** @type {any} */
let run = null;
/** @type {Record<string, any>} */
const identified = {}; // what was identified last, by its kind: see `identify`
/** @type {{ json: string, survey: Armill.Survey } | undefined} */
let surveyed; // of the map of places

/** @type {Record<string, (...args: any[]) => unknown>} */
const answers = {
  /** What a form is built from. Jobs are as the page saves them: with the number of the model. */
  hello: () => ({
    version: armill.version(),
    model: armill.model(),
    job: { ...JSON.parse(armill.default_job()), model: armill.model() },
    opening: { ...JSON.parse(armill.opening_job()), model: armill.model() },
    fields: armill.fields(),
    presets: armill.presets(),
    formats: armill.formats(),
  }),
  check: (json) => void armill.check(json),
  arm: (json) => armill.arm(json),
  place: (json) => armill.place_in_front(json),
  stock: (json) => armill.proposed_stock(json),
  cutting: (json) => armill.proposed_cutting(json),
  run(json) {
    let last = 0;
    const fresh = armill.run(json, (fraction, stage) => {
      const now = performance.now();
      if (now - last < PROGRESS_MS) return;
      last = now;
      postMessage({ progress: { fraction, stage } });
    });
    release();
    run = fresh;
    return { summary: run.summary(), charts: run.charts() };
  },
  column: (key) => run.column(key),
  pose: (sample) => ({ frames: run.frames(sample), excess: run.joint_excess(sample) }),
  stock_solid: () => run.stock_solid(),
  track: (most) => run.track(most),
  chart: (name, options) => run.chart(name, options),
  data: (name, units) => run.chart_data(name, units),
  part_mesh: () => run.part_mesh(),
  part_section: (sample) => run.part_section(sample),
  simulated_part: (kind) => run.simulated_part(kind),
  export: (format) => (format === "columns-csv" ? columnsFile() : run.export(format)),
  interface_zip: (id) => run.interface_zip(id),
  replay: (format) => run.replay(format),
  packaged: (controller) => outlineOf(run.package(controller)),
  package: packageFile,
  zip: (folder, paths, texts) => armill.zip(folder, paths, texts),
  release,
  thesis: () => armill.thesis_recomputed(),
  identify(kind, ...args) {
    /** @type {Record<string, Function>} */
    const by = {
      stiffness: armill.identify_stiffness,
      response: armill.identify_response,
      gear: armill.identify_gear,
      pass: armill.learn_pass,
      loads: armill.evidence_loads,
      encoders: armill.evidence_encoders,
      slots: armill.evidence_slots,
    };
    const fresh = Reflect.apply(by[kind], armill, args);
    identified[kind]?.free();
    identified[kind] = fresh;
    return fresh.summary();
  },
  identified_chart: (kind, options) => identified[kind].chart(options),
  identified_data: (kind, units) => identified[kind].chart_data(units),
  learned_file: (kind, ...args) => identified.pass[kind](...args),
  fit_cuts: (job, cuts) => armill.fit_cuts(job, cuts),
  extent: (json) => surveyOf(json).extent(),
  around: (json) => ({ part: surveyOf(json).part(), base: surveyOf(json).base() }),
  turns: (json, place, spins) => surveyOf(json).turns(place, spins),
  survey: (json, places) => surveyOf(json).places(places),
  trap: () => armill.trap(),
  ...heldRuns(() => armill),
  ...studies(() => armill),
};

/**
 * All columns as a file. A long run is a gigabyte of text, more than a string holds: the browser
 * keeps the parts on its disk.
 */
function columnsFile() {
  const samples = run.column("time_s").length;
  const parts = [];
  for (let from = 0; from < samples; from += ROWS) parts.push(new Blob([run.columns_csv(from, from + ROWS)]));
  return new Blob(parts);
}

/**
 * A package with the names of its files instead of their texts.
 * @param {Package} made
 * @returns {Outline}
 */
const outlineOf = ({ files, ...rest }) => ({ ...rest, files: files.map(({ path }) => path) });

/**
 * What to save of a package: its only file, or all of them as a zip archive; and how it runs.
 * @param {Controller} [controller]
 */
function packageFile(controller) {
  const made = run.package(controller);
  const { name, files } = made;
  const [{ path, text }] = files;
  const file =
    files.length > 1
      ? { name: `${name}.zip`, type: "application/zip", content: run.package_zip(controller) }
      : { name: path, type: "text/plain", content: text };
  return { file, outline: outlineOf(made) };
}

/** Frees the memory of the run. */
function release() {
  run?.free();
  run = null;
}

/**
 * The job of a map, read once for all its bands.
 * @param {string} json
 */
function surveyOf(json) {
  if (surveyed?.json !== json) {
    surveyed?.survey.free();
    surveyed = undefined;
    surveyed = { json, survey: new armill.Survey(json) };
  }
  return surveyed.survey;
}

/**
 * What is handed over instead of copied: an array of numbers, or those of a chart, a mesh or a section.
 * @param {unknown} value
 */
const buffers = (value) =>
  [value]
    .flat()
    .flatMap(arraysIn)
    .map(({ buffer }) => buffer);

/** @param {unknown} value */
function arraysIn(value) {
  if (ArrayBuffer.isView(value)) return [value];
  return value && typeof value === "object" ? Object.values(value).filter(ArrayBuffer.isView) : [];
}

/**
 * An error as data: Errors lose their extra properties on the way through postMessage.
 * @param {any} error
 * @returns {Failure}
 */
function plain(error) {
  const { code, message, field, line, column, value, min, max, unit } = error;
  return {
    code,
    message: message ?? String(error),
    field,
    line,
    column,
    ...(value !== undefined && { value, min, max, unit }),
    fatal: error instanceof WebAssembly.RuntimeError,
  };
}

/**
 * Answers the page's questions with a core, the module that wasm-bindgen made; the page sends the
 * compiled WebAssembly first.
 * @param {Core} core
 */
export function serve(core) {
  armill = core;
  /** @type {(module: WebAssembly.Module) => void} */
  let start;
  const started = new Promise((resolve) => (start = resolve)).then((module) =>
    armill.default({ module_or_path: module }),
  );
  started.catch(() => {}); // every question reports it
  addEventListener("message", async ({ data: { module, id, kind, args } }) => {
    if (module) return start(module);
    try {
      await started;
    } catch (error) {
      return postMessage({ id, error: { ...plain(error), code: "load", fatal: true } });
    }
    try {
      const value = answers[kind](...args);
      postMessage({ id, value }, { transfer: buffers(value) });
    } catch (error) {
      postMessage({ id, error: plain(error) });
    }
  });
}
