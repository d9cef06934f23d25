// What a host page asks the embedded calculator for: read from the fragment, and refused where it
// makes no sense.

import { readText } from "./core/assets.js";
import { jobIn } from "./job/link.js";

/**
 * @import { ChartEntry, Field, Presets, RobotPreset, MaterialPreset } from "../pkg/armill.js"
 * @import { Hello } from "./core/client.js"
 * @import { JobData } from "./job/data.js"
 */

/**
 * @typedef {{
 *   theme: string,
 *   show: string[],
 *   units: Record<string, string>,
 *   job: string | null,
 *   preset: string[],
 *   inputs: string[],
 *   charts: string[],
 * }} Options
 */

const THEMES = ["auto", "light", "dark"];
const PARTS = ["none", "scene", "budget"];
/** @type {Record<string, Record<string, string>>} */
const UNITS = {
  mm: { length: "mm" },
  inch: { length: "inch" },
  N: { force: "N" },
  lbf: { force: "lbf" },
  "per-second": { feed: "second" },
  "per-minute": { feed: "minute" },
}; // the setting that each is
/** @type {Record<string, string[]>} */
const PAGES = { why: ["path", "forces", "deflection", "error", "joints", "shaper"] }; // of views that have some
/** @param {string} text */
const words = (text) => text.split(/[\s,]+/).filter(Boolean);

/**
 * The options in a fragment, with what holds for those that are not given.
 * @param {string} fragment
 * @returns {Options}
 */
export function optionsIn(fragment) {
  const given = new URLSearchParams(fragment.slice(1));
  const theme = given.get("theme") || "auto";
  if (!THEMES.includes(theme)) throw unknown("theme", theme, THEMES);
  const show = words(given.get("show") ?? "none");
  for (const part of show) if (!PARTS.includes(part)) throw unknown("show", part, PARTS);
  const units = words(given.get("units") ?? "");
  for (const unit of units) if (!UNITS[unit]) throw unknown("units", unit, Object.keys(UNITS));
  return {
    theme,
    show,
    units: Object.assign({}, ...["mm", "N", "per-second", ...units].map((unit) => UNITS[unit])),
    job: given.get("job"),
    preset: words(given.get("preset") ?? ""),
    inputs: words(given.get("inputs") ?? "all"),
    charts: words(given.get("charts") ?? "before-after"),
  };
}

/**
 * Whether the job comes from a link rather than as JSON text.
 * @param {Pick<Options, "job">} options
 */
export const isLinked = ({ job }) => Boolean(job) && !job?.startsWith("{");

/**
 * The job to start from: the one given, or the default job with presets put in.
 * @param {Options} options
 * @param {Pick<Hello, "job" | "presets">} core
 * @returns {Promise<JobData>}
 */
export async function jobOf(options, { job: standard, presets }) {
  const { job, preset } = options;
  const text = isLinked(options) ? await jobIn(`#job=${job}`) : job;
  const data = text ? JSON.parse(text) : structuredClone(standard);
  for (const name of preset) await put(name, data, presets);
  return data;
}

/**
 * Puts a robot, a material or an example program of this name into a job.
 * @param {string} name
 * @param {JobData} job
 * @param {Presets} presets
 */
async function put(name, job, { robots, materials }) {
  /** @param {(RobotPreset | MaterialPreset)[]} list */
  const has = (list) => list.some(({ id }) => id === name);
  if (has(robots)) job.robot = { preset: name };
  else if (has(materials)) job.material = { preset: name };
  else {
    /** @type {{ file: string, kind: string, stock?: object, tool?: object }[]} */
    const examples = JSON.parse(await readText("examples/index.json"));
    /** @param {{ file: string }} example */
    const nameOf = ({ file }) => file.replace(/\.\w+$/, "");
    const example = examples.find((each) => nameOf(each) === name);
    if (!example)
      throw unknown("preset", name, [...robots, ...materials].map(({ id }) => id).concat(examples.map(nameOf)));
    job.path = { kind: example.kind, text: await readText(`examples/${example.file}`) };
    if (example.stock) job.stock = example.stock;
    Object.assign((job.tool ??= {}), example.tool);
  }
}

/**
 * The fields to show: those named, and those of groups named.
 * @param {Field[]} fields
 * @param {string[]} inputs
 */
export function fieldsIn(fields, inputs) {
  const names = new Set(fields.flatMap(({ group, path }) => [group, path]));
  return chosen(
    "inputs",
    fields,
    inputs,
    [...names],
    ({ group, path }, name) => name === "all" || name === group || path === name || path.startsWith(`${name}.`),
  );
}

/**
 * The charts to show: those named, and those of views or their pages named.
 * @param {ChartEntry[]} charts
 * @param {string[]} wanted
 */
export function chartsIn(charts, wanted) {
  const names = new Set(charts.flatMap(({ name, view }) => [view, name]));
  const legal = [...names, ...Object.keys(PAGES)];
  return chosen(
    "charts",
    charts,
    wanted,
    legal,
    ({ name, view }, word) => word === name || word === view || Boolean(PAGES[word]?.includes(view)),
  );
}

/**
 * The items that any of the words picks, in the order of the words; "none" picks nothing.
 * @template T
 * @param {string} option
 * @param {T[]} items
 * @param {string[]} asked
 * @param {string[]} legal
 * @param {(item: T, word: string) => boolean} picks
 */
function chosen(option, items, asked, legal, picks) {
  const found = asked.flatMap((word) => {
    const picked = items.filter((item) => picks(item, word));
    if (!picked.length && word !== "none") throw unknown(option, word, ["none", ...legal]);
    return picked;
  });
  return [...new Set(found)];
}

/**
 * @param {string} option
 * @param {string} value
 * @param {string[]} legal
 */
const unknown = (option, value, legal) =>
  new Error(`This calculator is asked for ${option} "${value}", which is not one of ${legal.join(", ")}.`);
