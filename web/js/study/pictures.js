// What an answer by cases looks like: a range for each case, or a grid over two things that vary.

import { choiceLabel } from "../form/field-text.js";
import { shownUnit, shownValue } from "../form/shown.js";
import { formatNumber } from "../page/number.js";
import { INPUTS, ranked, titleOf } from "./words.js";

/**
 * @import { Field, StudyOutcome, SweepRow } from "../../pkg/armill.js"
 * @import { Grid, Intervals } from "../core/studies.js"
 * @import { Answer } from "./ask.js"
 * @import { Question } from "./question.js"
 */

/** @typedef {{ kind: "study_intervals", data: Intervals, rows: number } | { kind: "study_grid", data: Grid, rows: number }} Picture */
/** @typedef {{ tolerance: number, valueAt(field: Field): unknown }} Asked what of the job that was asked about is drawn */

const WIDE = 12; // values that have room side by side
const MOST = 40; // cases of a picture; a table has them all
const EXPECTED = "Error, 50 to 95 of 100 cases";

/** @type {Record<string, string>} what is measured */
const MEASURED = {
  stiffness: "Joint stiffness",
  cutting: "Cutting forces",
  frequency: "Frequency of the filter",
  pass: "A milled pass",
};

/** @type {Record<string, string>} what a loop measures, where there is little room */
const SEEN = { position: "Tool", "load-side-angle": "Joints", force: "Force" };

/**
 * @param {number} from
 * @param {number} to
 * @returns {[number, number]}
 */
const ends = (from, to) => [from, to];

/**
 * The picture of an answer; undefined if a curve or a table says it better.
 * @param {Question} question
 * @param {Answer} answer
 * @param {Field[]} fields
 * @param {Asked} job
 * @returns {Picture | undefined}
 */
export function pictureOf(question, answer, fields, { tolerance, valueAt }) {
  const title = titleOf(question, fields);
  if (question.kind === "robots") {
    const cases = first(answer.robots ?? []).map((row) => ({
      ...bandOf(row, row.name),
      guess: row.stiffness === "guessed",
    }));
    return intervals(`${title}: hollow where the stiffness is a guess`, EXPECTED, tolerance, cases);
  }
  if (question.kind === "choices") {
    const cases = first(answer.choices ?? []).map((row) => bandOf(row, row.label));
    return intervals(title, EXPECTED, tolerance, cases);
  }
  if (question.kind === "loops") {
    const cases = (answer.loops ?? []).map(({ measures, name, both }) => ({
      name: `${SEEN[measures]}, ${name}`,
      range: ends(both?.p50 ?? NaN, both?.p95 ?? NaN),
    }));
    return intervals(`${title}, with corrected commands`, EXPECTED, tolerance, cases, answer.loops?.[0]?.offline.p95);
  }
  if (question.kind === "tornado") {
    const { bars = [], after_mm = NaN } = answer.tornado ?? {};
    const cases = bars.map(({ input, after_mm: range }) => ({ name: INPUTS[input] ?? input, range }));
    return intervals(title, "Largest error after compensation", tolerance, cases, after_mm);
  }
  if (question.kind === "measures") {
    const { measures = [], now = NaN } = answer;
    const cases = measures.map(({ input, p95_mm }) => ({ name: MEASURED[input], range: ends(p95_mm, now) }));
    return intervals(title, "95 of 100 cases, then and now", tolerance, cases);
  }
  const all = answer.rows ?? [];
  if (question.kind !== "sweep" || !all.length) return undefined;
  // What cannot be run promises nothing; if nothing can, the title says it.
  const isAble = all.some(({ cannot_run, p95_mm }) => !cannot_run && p95_mm !== undefined);
  const rows = isAble ? all.map(promised) : all;
  const heading = isAble ? title : `${title}, if the arm could run it`;
  if (fields.length > 1) return grid(heading, rows, fields, tolerance, valueAt);
  if (typeof rows[0].value === "number") return undefined;
  const [field] = fields;
  return intervals(
    heading,
    EXPECTED,
    tolerance,
    rows.map((row) => bandOf(row, taken(field, row.value))).slice(0, MOST),
  );
}

/**
 * A row without figures if the arm cannot run it.
 * @param {SweepRow} row
 * @returns {SweepRow}
 */
const promised = (row) => (row.cannot_run ? { ...row, p50_mm: undefined, p95_mm: undefined } : row);

/**
 * What something takes, as it reads.
 * @param {Field} field
 * @param {number | string | undefined} value
 */
export const taken = (field, value) =>
  typeof value === "number" ? formatNumber(shownValue(value, field.unit), 4) : choiceLabel(field, String(value));

/**
 * The rows that a picture has room for: those that can be run, the least error first; if none can, those with figures.
 * @template {StudyOutcome} R
 * @param {R[]} rows
 */
function first(rows) {
  const able = ranked(rows);
  return (able.length ? able : ranked(rows.map((row) => ({ ...row, cannot_run: undefined })))).slice(0, MOST);
}

/**
 * @param {StudyOutcome} row
 * @param {string} name
 */
const bandOf = ({ p50_mm = NaN, p95_mm = NaN }, name) => ({
  name,
  range: ends(p50_mm, p95_mm),
});

/**
 * @param {string} title
 * @param {string} quantity
 * @param {number} tolerance
 * @param {{ name: string, range: [number, number], guess?: boolean }[]} cases
 * @param {number} [now]
 * @returns {Picture | undefined}
 */
function intervals(title, quantity, tolerance, cases, now) {
  if (!cases.length) return undefined;
  const data = {
    title,
    quantity,
    tolerance,
    now,
    names: cases.map(({ name }) => name),
    ranges: Float64Array.from(cases.flatMap(({ range }) => range)),
    guesses: Uint8Array.from(cases.map(({ guess }) => Number(Boolean(guess)))),
  };
  return { kind: "study_intervals", data, rows: cases.length };
}

/**
 * @param {string} title
 * @param {SweepRow[]} rows
 * @param {Field[]} fields
 * @param {number} tolerance
 * @param {Asked["valueAt"]} valueAt
 * @returns {Picture}
 */
function grid(title, rows, fields, tolerance, valueAt) {
  const count = rows.findIndex(({ value }) => value !== rows[0].value);
  const inner = count < 0 ? rows.length : count;
  const values = [
    rows.filter((_, k) => k % inner === 0).map(({ value }) => value),
    rows.slice(0, inner).map(({ second }) => /** @type {number | string} */ (second)),
  ];
  // The first goes from left to right, unless it has more values than there is room for.
  const [across, up] = values[0].length > WIDE && values[0].length > values[1].length ? [1, 0] : [0, 1];
  const errorAt = (/** @type {number} */ x, /** @type {number} */ y) => rows[across ? y * inner + x : x * inner + y];
  const places = [across, up].map((k) => placeAmong(values[k], valueAt(fields[k])));
  const printed = (/** @type {number} */ k) => values[k].map((value) => taken(fields[k], value));
  const data = {
    title: `${title}, at most in 95 of 100 cases`,
    names: [across, up].map((k) => [fields[k].label, shownUnit(fields[k].unit)].filter(Boolean).join(", ")),
    values: printed(across),
    seconds: printed(up),
    now: Float64Array.from(places.flatMap((place) => place ?? [])),
    tolerance,
    errors: Float64Array.from(values[across].flatMap((_, x) => values[up].map((_, y) => errorAt(x, y).p95_mm ?? NaN))),
  };
  if (data.now.length < 2) data.now = new Float64Array();
  return { kind: "study_grid", data, rows: values[up].length };
}

/**
 * Where a value is among rising numbers, or words, counted from 0; undefined where it is not.
 * @param {(number | string)[]} values
 * @param {unknown} value
 */
export function placeAmong(values, value) {
  if (typeof value !== "number") {
    const at = values.indexOf(/** @type {string} */ (value));
    return at < 0 ? undefined : at;
  }
  const numbers = /** @type {number[]} */ (values);
  const above = numbers.findIndex((other) => other >= value);
  if (above < 0 || value < numbers[0]) return undefined;
  if (numbers[above] === value) return above;
  const [low, high] = [numbers[above - 1], numbers[above]];
  return above - 1 + (value - low) / (high - low);
}
