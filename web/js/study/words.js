// Answers in words.

import { choiceLabel, quantity } from "../form/field-text.js";
import { formatNumber } from "../page/number.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { MEASURES } from "./question.js";

/**
 * @import { ChoiceRow, Field, LargestAnswer, LoopRow, RobotRow, StudyOutcome, SweepRow, Tornado } from "../../pkg/armill.js"
 * @import { Answer, Measurements } from "./ask.js"
 * @import { Measure, Question } from "./question.js"
 */

/** @type {Record<string, string>} */
export const INPUTS = {
  "joint-1": "Compliance of joint 1",
  "joint-2": "Compliance of joint 2",
  "joint-3": "Compliance of joint 3",
  "joint-4": "Compliance of joint 4",
  "joint-5": "Compliance of joint 5",
  "joint-6": "Compliance of joint 6",
  cutting: "Cutting coefficients",
  "radial-ratio": "Radial part of the force",
  "axial-ratio": "Axial part of the force",
  frequency: "Frequency of the filter",
};

/** @type {Record<LoopRow["measures"], string>} what a loop measures */
export const SENSORS = { position: "Position of the tool", "load-side-angle": "Angles of the joints", force: "Force" };

/** @type {Record<Measure, string>} */
const MEANT = {
  p95: "the error after compensation, in 95 of 100 cases,",
  nominal: "the error after compensation, if every number is exact,",
  uncompensated: "the error without compensation",
};

/** @param {number} mm */
const length = (mm) => `${lengthText(mm)} ${lengthUnit()}`;

/**
 * What an answer says, in a sentence or two; `fields` are those that the question is about.
 * @param {Question} question
 * @param {Answer} answer
 * @param {Field[]} fields
 */
export function sentenceOf(question, answer, fields) {
  const { loops = [] } = answer;
  const { rows = loops } = /** @type {{ rows?: { cannot_run?: string }[] }} */ (answer);
  const why = rows.length > 0 && rows.every(({ cannot_run }) => cannot_run) ? rows[0].cannot_run : undefined;
  const where = question.kind === "loops" ? "this" : "this at any of these values";
  const first = why ? `The arm cannot run ${where}: ${why}. If it could: ` : "";
  return first + ofNumbers(question, answer, fields, answer.rows ?? []);
}

/**
 * The same of what has figures, whether or not the arm can run it.
 * @param {Question} question
 * @param {Answer} answer
 * @param {Field[]} fields
 * @param {SweepRow[]} rows
 */
function ofNumbers(question, answer, fields, rows) {
  if (isFlat(rows))
    return `The error does not depend on the ${fields.map(({ label }) => label.toLowerCase()).join(" and ")} here: ${known(rows[0])}.`;
  if (answer.largest) return ofLargest(answer.largest, fields[0], question);
  if (answer.robots) return ofRobots(answer.robots);
  if (answer.choices) return ofChoices(answer.choices);
  if (answer.loops) return ofLoops(answer.loops);
  if (answer.tornado) return ofTornado(answer.tornado);
  if (answer.measures) return ofMeasures(answer.measures);
  return ofSweep(rows, fields);
}

/**
 * Whether all values come to the same: of a program's own feed, say, nothing else is used.
 * @param {SweepRow[]} rows
 */
const isFlat = (rows) =>
  rows.length > 1 &&
  rows.every(
    ({ p95_mm, before_max_mm }) =>
      before_max_mm !== undefined && p95_mm === rows[0].p95_mm && before_max_mm === rows[0].before_max_mm,
  );

/** @param {SweepRow} row */
const known = ({ p95_mm = NaN, before_max_mm = NaN }) =>
  `${length(before_max_mm)} before compensation, at most ${length(p95_mm)} after it in 95 of 100 cases`;

/**
 * @param {LargestAnswer} answer
 * @param {Field} field
 * @param {Question} question
 */
function ofLargest({ largest, holds, crossings, quantity: measure, tolerance_mm }, { label, unit }, question) {
  if (question.kind !== "largest") return "";
  const [from, to] = [question.from, question.to].map((value) => quantity(rounded(value), unit));
  const name = label.toLowerCase();
  const tolerance = `the tolerance of ${length(tolerance_mm)}`;
  if (holds === "nowhere" || largest === null)
    return `No ${name} from ${from} to ${to} is small enough: ${MEANT[measure]} is beyond ${tolerance}.`;
  if (holds === "everywhere")
    return `Every ${name} from ${from} to ${to} will do: ${MEANT[measure]} stays within ${tolerance}. The limit is beyond this range.`;
  const most = `Largest ${name}: ${quantity(rounded(largest), unit)}. There ${MEANT[measure]} just meets ${tolerance}.`;
  if (crossings.length < 2) return most;
  const all = crossings.map((value) => quantity(rounded(value), unit)).join(", ");
  return `${most} It does not simply rise: it crosses the tolerance at ${all}.`;
}

/**
 * Four digits: what a search can tell.
 * @param {number} value
 */
export const rounded = (value) => Number(value.toPrecision(4));

/** @param {RobotRow[]} rows */
function ofRobots(rows) {
  const able = ranked(rows);
  if (!able.length) return `None of the ${rows.length} robots can run this job.`;
  const best = able[0];
  const alike = able.filter((row) => row !== best && isAlike(row, best)).length;
  return (
    `${able.length} of ${rows.length} robots can run this job. The least error to expect: ${best.name}, at most ` +
    `${length(best.p95_mm ?? NaN)} in 95 of 100 cases. ${others(alike)}`
  );
}

/** @param {number} count */
const others = (count) =>
  count
    ? `${count === 1 ? "One other is" : `${count} others are`} equal to it as far as is known: the bands overlap.`
    : "No other comes near: the bands do not overlap.";

/** @param {ChoiceRow[]} rows */
function ofChoices(rows) {
  const able = ranked(rows);
  if (!able.length) return "No choice makes this job one that the arm can run.";
  const [best, asIs] = [able[0], rows[0]];
  const now = asIs.p95_mm === undefined || asIs.cannot_run ? "cannot be run" : `at most ${length(asIs.p95_mm)}`;
  if (best === asIs) return `As it is, the job errs least: ${now} in 95 of 100 cases.`;
  const equal = !asIs.cannot_run && isAlike(best, asIs) ? " Both are equal as far as is known: the bands overlap." : "";
  return `${best.label}: at most ${length(best.p95_mm ?? NaN)} in 95 of 100 cases; as it is: ${now}.${equal}`;
}

/** @param {Tornado} given */
function ofTornado({ after_mm, bars }) {
  if (!bars.length) return "No input is said to vary: see “How sure” among the inputs.";
  const [{ input, after_mm: ends }] = bars;
  return (
    `${INPUTS[input]} moves the error most: over its own 95 % range it is ${length(Math.min(...ends))} to ` +
    `${length(Math.max(...ends))} after compensation, ${length(after_mm)} if every number is exact.`
  );
}

/** @param {LoopRow[]} loops */
function ofLoops(loops) {
  const [{ without, offline }] = loops;
  /** @param {LoopRow} row */
  const left = ({ both }) => both?.p95 ?? Infinity;
  const best = loops.reduce((least, row) => (left(row) < left(least) ? row : least));
  const now =
    `95 of 100 cases have at most ${length(without.p95)} if nothing corrects, ` +
    `${length(offline.p95)} with corrected commands.`;
  if (!(left(best) < offline.p95)) return `${now} No sensor would bring more.`;
  const least = `${length(Number(left(best).toPrecision(2)))}: ${SENSORS[best.measures].toLowerCase()}, ${best.name}`;
  return (
    `${now} With a sensor as well, at best about ${least}. ` +
    `It helps below ${formatNumber(best.helps_below_hz ?? NaN, 2)} Hz; ${shareText(best.slow_share)} % of this error lies there.`
  );
}

/**
 * A share in percent; nearly all is not all.
 * @param {number} share
 */
export const shareText = (share) => (share > 0.99 ? "more than 99" : formatNumber(100 * share, 2));

/** @param {Measurements} measures */
const ofMeasures = (measures) => measures[0]?.sentence ?? "Nothing that could be measured would narrow the band.";

/**
 * @param {SweepRow[]} rows
 * @param {Field[]} fields
 */
function ofSweep(rows, fields) {
  const [best] = [...ranked(rows), ...ranked(rows.map((row) => ({ ...row, cannot_run: undefined })))];
  if (!best) return `No value has a result: ${rows[0]?.error ?? "there are none"}.`;
  const at = [best.value, best.second]
    .slice(0, fields.length)
    .map((value, k) => `${fields[k].label.toLowerCase()} ${takenText(fields[k], value)}`)
    .join(" and ");
  return `The least error to expect is at ${at}: at most ${length(best.p95_mm ?? NaN)} in 95 of 100 cases.`;
}

/**
 * What something takes, within a sentence.
 * @param {Field} field
 * @param {number | string | undefined} value
 */
const takenText = (field, value) =>
  typeof value === "string" ? `“${choiceLabel(field, value)}”` : quantity(rounded(value ?? NaN), field.unit);

/**
 * The rows that can be run, the least error to expect first.
 * @template {StudyOutcome} R
 * @param {R[]} rows
 */
export const ranked = (rows) =>
  rows
    .filter(({ p95_mm, cannot_run }) => p95_mm !== undefined && !cannot_run)
    .sort((a, b) => (a.p95_mm ?? 0) - (b.p95_mm ?? 0));

/**
 * Whether the bands of two outcomes overlap: half of the cases and 95 of 100 lie below their ends.
 * @param {StudyOutcome} a
 * @param {StudyOutcome} b
 */
export const isAlike = (a, b) => (a.p50_mm ?? 0) <= (b.p95_mm ?? 0) && (b.p50_mm ?? 0) <= (a.p95_mm ?? 0);

/**
 * What a question asks, as a heading.
 * @param {Question} question
 * @param {Field[]} fields
 */
export function titleOf(question, fields) {
  const names = fields.map(({ label }) => label.toLowerCase()).join(" and ");
  if (question.kind === "largest") return `Largest ${names} for the tolerance, ${MEASURES[question.measure]}`;
  if (question.kind === "sweep") return `Error by ${names}`;
  return {
    robots: "This job on every robot of the library",
    choices: "Choices of the programmer",
    tornado: "What each uncertain input does",
    measures: "What to measure first",
    loops: "What a sensor would bring while the arm mills",
  }[question.kind];
}
