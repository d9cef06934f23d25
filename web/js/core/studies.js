// The Worker's part in questions about a job: runs of a question one by one, and what a single Worker answers.

/** @import { ChartOptions, ChartUnits, Study, StudyCurves, StudyGrid, StudyIntervals } from "../../pkg/armill.js" */

/**
 * A question of many runs: its texts are those of the script's command line.
 *
 * @typedef {{ kind: "sweep" | "robots" | "choices" | "loops", json: string, texts: string[] }} Runs
 */

/**
 * Curves to draw: `errors` has four numbers for each of `values`, see the core.
 *
 * @typedef {{
 *   label: string, unit: string, tolerance: number, now?: number, values: Float64Array, errors: Float64Array,
 * }} Curves
 */

/**
 * Ranges of the error to draw: `ranges` has two numbers for each of `names`, `guesses` one.
 *
 * @typedef {{
 *   title: string, quantity: string, tolerance: number, now?: number, names: string[], ranges: Float64Array,
 *   guesses: Uint8Array,
 * }} Intervals
 */

/**
 * A grid to draw: `errors` has one for each of `values` and `seconds`, the second varying faster.
 *
 * @typedef {{
 *   title: string, names: string[], values: string[], seconds: string[], now: Float64Array, tolerance: number,
 *   errors: Float64Array,
 * }} Grid
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

  /** @param {Curves} curves */
  function curvesOf({ label, unit, tolerance, now, values, errors }) {
    const { StudyCurves } = core();
    return /** @type {StudyCurves} */ (new StudyCurves(label, unit, tolerance, now, values, errors));
  }

  /** @param {Intervals} intervals */
  function intervalsOf({ title, quantity, tolerance, now, names, ranges, guesses }) {
    const { StudyIntervals } = core();
    return /** @type {StudyIntervals} */ (new StudyIntervals(title, quantity, tolerance, now, names, ranges, guesses));
  }

  /** @param {Grid} grid */
  function gridOf({ title, names, values, seconds, now, tolerance, errors }) {
    const { StudyGrid } = core();
    return /** @type {StudyGrid} */ (new StudyGrid(title, names, values, seconds, now, tolerance, errors));
  }

  /**
   * What `use` makes of something of the core, which is let go of afterwards.
   * @template {{ free(): void }} M
   * @template T
   * @param {M} made
   * @param {(made: M) => T} use
   */
  function drawn(made, use) {
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
      /** @type {Float64Array} */ errors,
    ) => core().largest(json, text, quantity, errors, true),
    tornado: (/** @type {string} */ json) => core().tornado(json),
    study_chart: (/** @type {Curves} */ curves, /** @type {ChartOptions} */ options) =>
      drawn(curvesOf(curves), (made) => made.chart(options)),
    study_data: (/** @type {Curves} */ curves, /** @type {ChartUnits} */ units) =>
      drawn(curvesOf(curves), (made) => made.chart_data(units)),
    study_intervals: (/** @type {Intervals} */ intervals, /** @type {ChartOptions} */ options) =>
      drawn(intervalsOf(intervals), (made) => made.draw(options)),
    study_grid: (/** @type {Grid} */ grid, /** @type {ChartOptions} */ options) =>
      drawn(gridOf(grid), (made) => made.draw(options)),
  };
}
