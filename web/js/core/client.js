// The page's side of the WebAssembly core.
//
// Two Workers take turns: one holds the result that the page shows and draws its charts, the other
// computes the next one. A run that is invalid, cancelled or trapped therefore never takes the
// shown result away.

import { startAsked } from "./asked.js";

const SUPERSEDE_MS = [400, 1500]; // a run older than this is cut off when a newer job arrives; a younger one may finish
const LARGE = 100_000; // samples: a Worker that has held more is not used again, for its memory never shrinks
const CANCELLED = { code: "cancelled", message: "Cancelled." };

/**
 * @import { ChartEntry, ChartOptions, ChartValues, Controller, Field, Format, Presets, Summary } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Asked } from "./asked.js"
 */

/**
 * What a form is built from.
 *
 * @typedef {{ version: string, model: number, job: JobData, opening: JobData, fields: Field[], presets: Presets, formats: Format[] }} Hello
 */

/**
 * An error as data: the core's, or `fatal` where its Worker cannot be used any more.
 *
 * @typedef {{
 *   code: string, message: string, field?: string, line?: number, column?: number, fatal?: boolean,
 *   value?: number, min?: number, max?: number, unit?: string,
 * }} Failure
 */

/** @typedef {{ fraction: number, stage: string }} Progress of a run; the fraction is 0 to 1 */

/** @typedef {{ text: string, summary: Summary, charts: ChartEntry[] }} Result of the job `text` */

/**
 * @typedef {{
 *   onstart(): void,
 *   onprogress(progress: Progress): void,
 *   onresult(result: Result, took: number): void,
 *   onerror(error: Failure): void,
 *   oncancel(error: Failure): void,
 *   ontrap(error: Failure): void,
 * }} Events what is heard of runs; `took` is in milliseconds
 */

/** @type {Events} */
let events; // given to start()
/** @type {Asked | null} */
let shown = null; // Worker with the shown result
/** @type {Asked | null} */
let spare = null; // Worker to compute in
/** @type {number | null} */
let since = null; // when the run in progress began
/** @type {Promise<Hello> | undefined} */
let hello; // promise of what a form is built from
/** @type {{ json?: string, result: Promise<Result>, since?: number } | undefined} */
let foreseen; // { json, result, since } of a speculative run
let lasted = 0; // how long the shown result took [ms]
/** @type {string | null} */
let next = null; // the job to compute next: only the latest counts
/** @type {string | null} */
let good = null; // the job of the shown result
let lost = false; // the shown result was lost to a trap and is being computed again

/**
 * Begins to load the core, and resolves with what a form is built from: version, model, default
 * job, fields, presets, formats.
 * @returns {Promise<Hello>}
 */
export function load() {
  hello ??= (spare ??= spawn()).ask("hello").catch((error) => {
    hello = undefined; // it may be asked for again
    throw error;
  });
  return hello;
}

/**
 * The same for the page, which hears what happens from now on.
 * @param {Events} handlers
 */
export function start(handlers) {
  events = handlers;
  return load();
}

/**
 * Begins to compute a job before the page is ready to ask for it.
 * @param {string} [json]
 */
export function foresee(json) {
  const early = { json, result: (spare ??= spawn()).ask("run", json), since: performance.now() };
  early.result.catch(() => {
    if (foreseen === early) foreseen = undefined; // asked for, it runs again and says why it fails
  });
  foreseen = early;
}

/**
 * Computes `json`; what is being computed or waits is superseded. Events tell the rest.
 * @param {string} json
 */
export function run(json) {
  lost = false;
  next = json;
  if (since === null) compute();
  else if (performance.now() - since > patience()) cutOff(CANCELLED);
}

/**
 * Twice as long as the last run took, within bounds, so that dragging a number still shows results.
 */
const patience = () => Math.min(SUPERSEDE_MS[1], Math.max(SUPERSEDE_MS[0], 2 * lasted));

/** Stops the run in progress, at once. */
export function cancel() {
  next = null;
  if (since !== null) cutOff(CANCELLED);
}

/**
 * Resolves if `json` is a valid job, else rejects with the error.
 * @type {(json: string) => Promise<void>}
 */
export const check = (json) => (spare ??= spawn()).ask("check", json);

/**
 * Frames of base, joints and TCP of the job's arm at zero joint values, as a Float64Array.
 * @type {(json: string) => Promise<Float64Array>}
 */
export const armAtZero = (json) => (spare ??= spawn()).ask("arm", json);

/**
 * Resolves with x, y, z [mm] of the workpiece frame that bring the path in front of the robot.
 * @type {(json: string) => Promise<Float64Array>}
 */
export const placeInFront = (json) => (spare ??= spawn()).ask("place", json);

/**
 * Resolves with the stock to give a job's program if it has none of its own, or undefined.
 * @type {(json: string) => Promise<import("../../pkg/armill.js").Stock | undefined>}
 */
export const proposedStock = (json) => (spare ??= spawn()).ask("stock", json);

/**
 * Resolves with what a job's program says of its cut, keys of `cutting`, or undefined.
 * @param {string} json
 */
export const proposedCutting = (json) => (spare ??= spawn()).ask("cutting", json);

/**
 * The thesis's printed figures beside ours; they are the default job's, whatever is shown.
 * @type {() => Promise<import("../../pkg/armill.js").ThesisRow[]>}
 */
export const thesis = () => (spare ??= spawn()).ask("thesis");

/**
 * A Worker of its own, `{ ask(kind, ...args) }`, for what has nothing to do with the shown result.
 */
export const helper = () => startAsked({ onprogress() {}, onfail() {} });

/**
 * One chart of the shown result, drawn at `options.width` pixels.
 * @type {(name: string, options: ChartOptions) => Promise<import("../../pkg/armill.js").Chart>}
 */
export const chart = (name, options) => askShown("chart", name, options);

/**
 * The values that a chart of the shown result is drawn from: its first axis, then each series,
 * every sample.
 * @type {(name: string, units: ChartValues) => Promise<import("../../pkg/armill.js").ChartColumn[]>}
 */
export const chartData = (name, units) => askShown("data", name, units);

/**
 * One column of the shown result, as a Float64Array.
 * @type {(key: string) => Promise<Float64Array>}
 */
export const column = (key) => askShown("column", key);

/**
 * The arm at a sample of the shown result: `frames` of base, joints, TCP and workpiece, and by how much each joint is
 * beyond its range, `excess` [deg], empty if no ranges are known.
 * @param {number} sample
 */
export const pose = (sample) => askShown("pose", sample);

/** The shown result's stock before the first cut, or undefined. */
export const stockSolid = () => askShown("stock_solid");

/**
 * The paths of the shown result in at most about `most` rows, as a Float64Array.
 * @type {(most: number) => Promise<Float64Array>}
 */
export const track = (most) => askShown("track", most);

/**
 * A mesh of the shown result's part, with its deviation to be magnified.
 * @type {() => Promise<import("../../pkg/armill.js").PartMesh>}
 */
export const partMesh = () => askShown("part_mesh");

/**
 * A section through that part across the feed at a sample.
 * @type {(sample: number) => Promise<import("../../pkg/armill.js").PartSection>}
 */
export const partSection = (sample) => askShown("part_section", sample);

/**
 * The part as a binary STL file: "before", "after" or "nominal".
 * @type {(kind: string) => Promise<Uint8Array<ArrayBuffer>>}
 */
export const simulatedPart = (kind) => askShown("simulated_part", kind);

/**
 * The shown result as text; "columns-csv" as a Blob of it.
 * @type {(format: string) => Promise<string | Blob>}
 */
export const exported = (format) => askShown("export", format);

/**
 * The correction for an interface of a controller, with its files, as a zip archive.
 * @type {(id: string) => Promise<Uint8Array<ArrayBuffer>>}
 */
export const interfaceZip = (id) => askShown("interface_zip", id);

/**
 * How the shown result's path runs as a package for a controller, by default the job's, with the names
 * of its files.
 * @type {(controller?: Controller) => Promise<import("./server.js").Outline>}
 */
export const packaged = (controller) => askShown("packaged", controller);

/**
 * The package to save, `{ file: { name, type, content }, outline }`.
 * @type {(controller?: Controller) => Promise<import("./server.js").PackageFile>}
 */
export const packageOf = (controller) => askShown("package", controller);

/**
 * Texts as one zip archive, `files` of [path, text].
 * @param {any} folder
 * @param {any} files
 */
export const zip = (folder, files) =>
  askShown(
    "zip",
    folder,
    files.map((/** @type {[string]} */ [path]) => path),
    files.map((/** @type {[any, string]} */ [, text]) => text),
  );

/**
 * Smallest and largest x, y, z [mm] of places for the part that are worth a look.
 * @type {(json: string) => Promise<Float64Array>}
 */
export const extent = (json) => (spare ??= spawn()).ask("extent", json);

/**
 * The part's box and the robot's base, see `Survey.part` and `Survey.base` of the core.
 * @type {(json: string) => Promise<{ part: Float64Array, base: Float64Array }>}
 */
export const around = (json) => (spare ??= spawn()).ask("around", json);

/** The job of the shown result, as JSON text. */
export const shownJob = () => good;

/** Makes the core trap on purpose, so that a test can see the page recover. */
export const trap = () => askShown("trap").catch(() => {});

async function compute() {
  while (next !== null) {
    const json = next;
    const early = foresaw(json);
    const worker = (spare ??= spawn());
    next = null;
    since = early?.since ?? performance.now();
    events.onstart();
    try {
      const result = await (early?.result ?? worker.ask("run", json));
      worker.large = result.summary.samples > LARGE;
      if (shown?.large) retire(shown);
      [shown, spare] = [worker, shown ?? spawn()];
      good = json;
      lasted = performance.now() - since;
      events.onresult({ text: json, ...result }, lasted);
      spare.ask("release").catch(() => {}); // it may be stopped before
    } catch (error) {
      if (error.fatal) retire(worker);
      if (error.fatal) events.ontrap(error);
      else if (next === null) (error === CANCELLED ? events.oncancel : events.onerror)(error);
    }
    since = null;
  }
}

/**
 * The run foreseen, if it is of this job; any other is given up.
 * @param {string} json
 */
function foresaw(json) {
  const early = foreseen;
  foreseen = undefined;
  if (!early || early.json === json) return early;
  cutOff(CANCELLED);
  return undefined;
}

/**
 * @param {string} kind
 * @param {unknown[]} args
 * @returns {Promise<any>}
 */
async function askShown(kind, ...args) {
  const worker = shown;
  if (!worker) throw { code: "empty", message: "There is no result yet." };
  try {
    return await worker.ask(kind, ...args);
  } catch (error) {
    if (error.fatal && worker === shown) recover(error);
    throw error;
  }
}

/**
 * The shown result died with its Worker: says so and computes it again, but only once for the same
 * job.
 * @param {Failure} error
 */
function recover(error) {
  if (shown) retire(shown);
  events.ontrap(error);
  if (lost) return;
  lost = true;
  next ??= good;
  if (since === null) compute();
}

/** @param {Failure} reason */
function cutOff(reason) {
  const worker = spare;
  spare = spawn();
  worker?.stop(reason);
}

/** @param {Asked} worker */
function retire(worker) {
  worker.stop(CANCELLED);
  if (worker === shown) shown = null;
  if (worker === spare) spare = spawn();
}

/** Another Worker for runs. If it fails to load, the next question starts another one. */
function spawn() {
  return startAsked({
    onprogress: (progress) => events?.onprogress(progress),
    onfail(worker) {
      if (worker === spare) spare = null;
    },
  });
}
