// The Worker's part in questions about a job: runs of a question one by one, and what a single Worker answers.

/** @import { ChartOptions, ChartUnits, Study, StudyCurves } from "../../pkg/armill.js" */

/**
 * A question of many runs: its texts are those of the script's command line.
 *
 * @typedef {{ kind: "sweep" | "scan" | "robots" | "choices", json: string, texts: string[] }} Runs
 */

/**
 * Curves to draw: `errors` has four numbers for each of `values`, see the core.
 *
 * @typedef {{
 *   label: string, unit: string, tolerance: number, now?: number, values: Float64Array, errors: Float64Array,
 * }} Curves
 */

/**
 * Answers about questions; `core()` is the core.
 * @param {any} core
 */
export function studies(core) {
  /** @type {{ key: string, study: Study } | undefined} */
  let held; // the question that was asked last

  /** @param {Runs} runs */
  function studyOf({ kind, json, texts }) {
    const key = JSON.stringify([kind, json, texts]);
    if (held?.key === key) return held.study;
    held?.study.free();
    held = undefined;
    const { Study } = core();
    const given = kind === "sweep" ? [texts] : texts;
    held = { key, study: Study[kind](json, ...given) };
    return held.study;
  }

  /**
   * What `use` makes of curves, which are let go of afterwards.
   * @template T
   * @param {Curves} curves
   * @param {(curves: StudyCurves) => T} use
   */
  function drawn({ label, unit, tolerance, now, values, errors }, use) {
    const { StudyCurves } = core();
    const made = new StudyCurves(label, unit, tolerance, now, values, errors);
    try {
      return use(made);
    } finally {
      made.free();
    }
  }

  return {
    study_count: (/** @type {Runs} */ runs) => studyOf(runs).count(),
    study_row: (/** @type {Runs} */ runs, /** @type {number} */ index) => studyOf(runs).row(index),
    largest: (
      /** @type {string} */ json,
      /** @type {string} */ text,
      /** @type {string} */ quantity,
      /** @type {Float64Array} */ scanned,
    ) => core().largest(json, text, quantity, scanned),
    tornado: (/** @type {string} */ json) => core().tornado(json),
    study_chart: (/** @type {Curves} */ curves, /** @type {ChartOptions} */ options) =>
      drawn(curves, (made) => made.chart(options)),
    study_data: (/** @type {Curves} */ curves, /** @type {ChartUnits} */ units) =>
      drawn(curves, (made) => made.chart_data(units)),
  };
}
