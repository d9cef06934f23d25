// A question and a job become an answer: the runs are shared among Workers.

import { shareOut } from "../core/pool.js";
import { largestText, rangeText } from "./question.js";

/**
 * @import { ChoiceRow, LargestAnswer, RobotRow, StudyOutcome, Summary, SweepRow, Tornado } from "../../pkg/armill.js"
 * @import { Runs } from "../core/studies.js"
 * @import { Measure, Question } from "./question.js"
 */

/** @typedef {Summary["how_sure"]["measures"]} Measurements */

/**
 * @typedef {{
 *   rows?: SweepRow[], largest?: LargestAnswer, robots?: RobotRow[], choices?: ChoiceRow[], tornado?: Tornado,
 *   measures?: Measurements, now?: number,
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
  if (question.kind === "tornado") return { tornado: await alone("tornado", json) };
  if (question.kind === "measures") {
    const { how_sure, expected_mm } = await alone("hold", "measures", json);
    return { measures: how_sure.measures, now: expected_mm.p95 };
  }
  const text = largestText(question);
  /** @type {SweepRow[]} */
  const rows = await runs("scan", [text]);
  const scanned = Float64Array.from(rows.map((row) => errorOf(question.measure, row)));
  return { rows, largest: await alone("largest", json, text, question.measure, scanned) };

  /**
   * @param {Runs["kind"]} kind
   * @param {string[]} texts
   */
  async function runs(kind, texts) {
    /** @type {Runs} */
    const asked = { kind, json, texts };
    const count = await alone("study_count", asked);
    /** @type {any[]} */
    const rows = Array.from({ length: count });
    let done = 0;
    const keep = (/** @type {unknown} */ row, /** @type {number} */ index) => {
      rows[index] = row;
      onprogress(++done / count);
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
