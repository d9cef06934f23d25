// A question and a job become an answer: the runs are shared among Workers.

import { shareOut } from "../core/pool.js";
import { largestText, rangeText } from "./question.js";

/**
 * @import { ChoiceRow, LargestAnswer, LoopRow, RobotRow, StudyOutcome, Summary, SweepRow, Tornado } from "../../pkg/armill.js"
 * @import { Runs } from "../core/studies.js"
 * @import { Largest, Measure, Question } from "./question.js"
 */

const SEARCHED = 13; // runs that a search for the largest value usually takes

/** @typedef {Summary["how_sure"]["measures"]} Measurements */

/**
 * @typedef {{
 *   rows?: SweepRow[], largest?: LargestAnswer, robots?: RobotRow[], choices?: ChoiceRow[], tornado?: Tornado,
 *   loops?: LoopRow[], measures?: Measurements, now?: number,
 * }} Answer `now` is what 95 of 100 cases leave at most before anything is measured [mm]
 */

/**
 * The error of an outcome that a measure means [mm], NaN without one.
 * @param {Measure} measure
 * @param {StudyOutcome} outcome
 */
export const errorOf = (measure, { after_max_mm = NaN, p95_mm = NaN, before_max_mm = NaN }) =>
  measure === "nominal" ? after_max_mm : measure === "p95" ? p95_mm : before_max_mm;

/**
 * Answers `question` about the job `json`. `onprogress(fraction)` hears how far it is; rejects with
 * `{ code: "cancelled" }` when `signal` aborts, and with what is wrong with the question or the job.
 * @param {Question} question
 * @param {string} json
 * @param {(fraction: number) => void} onprogress
 * @param {AbortSignal} signal
 * @returns {Promise<Answer>}
 */
export async function answer(question, json, onprogress, signal) {
  if (question.kind === "sweep") return { rows: await runs("sweep", question.ranges.map(rangeText)) };
  if (question.kind === "robots") return { robots: await runs("robots", [question.place]) };
  if (question.kind === "choices") return { choices: await runs("choices", []) };
  if (question.kind === "loops") return { loops: await runs("loops", []) };
  if (question.kind === "tornado") return { tornado: await alone("tornado", json) };
  if (question.kind === "measures") {
    const { how_sure, expected_mm } = await alone("hold", "measures", json);
    return { measures: how_sure.measures, now: expected_mm.p95 };
  }
  return searched(question);

  /**
   * Rounds of runs until the largest value is known.
   * @param {Largest} asked
   * @returns {Promise<Answer>}
   */
  async function searched(asked) {
    const given = [json, largestText(asked), asked.measure];
    /** @type {SweepRow[]} */
    const rows = [];
    for (;;) {
      const errors = Float64Array.from(rows, (row) => errorOf(asked.measure, row));
      /** @type {LargestAnswer} */
      const largest = await alone("largest", ...given, errors);
      const { wanted = [] } = largest;
      if (!wanted.length) return { rows: rows.sort((a, b) => Number(a.value) - Number(b.value)), largest };
      rows.push(...(await runs("sweep", [`${asked.path}=${wanted.join(",")}`], rows.length, SEARCHED)));
    }
  }

  /**
   * @param {Runs["kind"]} kind
   * @param {string[]} texts
   * @param {number} before how many were made before
   * @param {number} [expected] how many there will probably be
   */
  async function runs(kind, texts, before = 0, expected = 0) {
    /** @type {Runs} */
    const asked = { kind, json, texts };
    const count = await alone("study_count", asked);
    /** @type {any[]} */
    const rows = Array.from({ length: count });
    const total = Math.max(expected, before + count);
    let done = before;
    const keep = (/** @type {unknown} */ row, /** @type {number} */ index) => {
      rows[index] = row;
      onprogress(++done / total);
    };
    await shareOut(count, (worker, index) => worker.ask("study_row", asked, index), keep, signal);
    return rows;
  }

  /**
   * @param {string} kind
   * @param {unknown[]} args
   */
  function alone(kind, ...args) {
    return fromOne(kind, args, signal);
  }
}

/**
 * What one of the Workers answers.
 * @param {string} kind
 * @param {unknown[]} args
 * @param {AbortSignal} signal
 */
async function fromOne(kind, args, signal) {
  /** @type {any} */
  let given;
  await shareOut(
    1,
    (worker) => worker.ask(kind, ...args),
    (part) => (given = part),
    signal,
  );
  return given;
}

/**
 * Asks a Worker for what is not shared: drawings of an answer.
 * @param {string} kind
 * @param {unknown[]} args
 */
export const askSingle = (kind, ...args) => fromOne(kind, args, new AbortController().signal);
