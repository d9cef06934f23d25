// The rows of an answer as columns: what stands in a table, in Markdown and in CSV.

import { shownUnit, shownValue } from "../form/shown.js";
import { formatNumber } from "../page/number.js";
import { forceText, forceUnit, inLength, lengthText, lengthUnit } from "../page/units.js";
import { taken } from "./pictures.js";
import { INPUTS, SENSORS, shareText } from "./words.js";

/**
 * @import { Field, LoopRow, StudyOutcome } from "../../pkg/armill.js"
 * @import { Answer } from "./ask.js"
 * @import { Place, Question } from "./question.js"
 */

/**
 * A column: `of(row)` is what it is sorted by and saved as, `text(row)` how it reads.
 *
 * @typedef {{
 *   key: string, label: string, unit?: string, of(row: any): number | string | undefined, text?(row: any): string,
 *   digits?: boolean,
 * }} Column
 */

/** @typedef {{ rows: any[], columns: Column[] }} Listed */

/** @type {Record<string, string>} */
const STATES = { met: "within the tolerance", "met-if-nominal": "within it if every number is exact" };

/** @param {StudyOutcome} row */
const state = ({ error, cannot_run, verdict_state }) =>
  error ?? cannot_run ?? STATES[verdict_state ?? ""] ?? "out of tolerance";

/**
 * @param {string} key
 * @param {string} label
 * @param {(row: any) => number | undefined} of [mm]
 * @returns {Column}
 */
const lengthColumn = (key, label, of) => ({
  key,
  label,
  unit: lengthUnit(),
  of: (row) => known(of(row), inLength),
  text: (row) => textOf(of(row), lengthText),
  digits: true,
});

/**
 * @param {number | undefined} value
 * @param {(value: number) => number} convert
 */
const known = (value, convert) => (value === undefined ? undefined : convert(value));

/**
 * @param {number | undefined} value
 * @param {(value: number) => string} write
 */
const textOf = (value, write) => (value === undefined ? "–" : write(value));

const errors = () => [
  lengthColumn("before", "Before, largest", (row) => row.before_max_mm),
  lengthColumn("p50", "Expected", (row) => row.p50_mm),
  lengthColumn("p95", "Expected, 95 of 100", (row) => row.p95_mm),
];
/** @returns {Column} */
const verdict = () => ({ key: "state", label: "Verdict", of: state });

/**
 * A number or choice of the job.
 * @param {Field} field
 * @param {string} key
 * @param {"value" | "second"} part
 * @returns {Column}
 */
const numberColumn = (field, key, part) => ({
  key,
  label: field.label,
  unit: shownUnit(field.unit),
  of: (row) => (typeof row[part] === "number" ? shownValue(row[part], field.unit) : taken(field, row[part])),
  text: (row) => taken(field, row[part]),
  digits: field.kind !== "choice",
});

/**
 * @param {Place} place
 * @returns {Column[]}
 */
const armColumns = (place) => [
  { key: "robot", label: "Robot", of: ({ name }) => name },
  { key: "stiffness", label: "Stiffness", of: ({ stiffness }) => stiffness },
  ...errors(),
  {
    key: "force",
    label: "Force, of the payload",
    unit: "%",
    of: ({ force_n, payload_kg }) => known(force_n, (force) => (100 * force) / (9.80665 * payload_kg)),
    text: ({ force_n, payload_kg }) =>
      textOf(
        force_n,
        (force) => `${formatNumber((100 * force) / (9.80665 * payload_kg), 2)} (${forceText(force)} ${forceUnit()})`,
      ),
    digits: true,
  },
  ...(place === "sought" ? [angleColumn("turn", "Turn of the tool", (row) => row.spin_deg)] : []),
  angleColumn("limits", "Room to joint limits", (row) => row.limit_room_deg),
  angleColumn("singularity", "From a singularity", (row) => row.singularity_deg),
  {
    key: "reach",
    label: "Reach",
    unit: "mm",
    of: ({ reach_mm }) => reach_mm,
    text: ({ reach_mm }) => formatNumber(reach_mm),
    digits: true,
  },
  { key: "payload", label: "Payload", unit: "kg", of: ({ payload_kg }) => payload_kg, digits: true },
  {
    key: "time",
    label: "Time",
    unit: "s",
    of: ({ duration_s }) => duration_s,
    text: ({ duration_s }) => textOf(duration_s, formatNumber),
    digits: true,
  },
  verdict(),
];

/**
 * @param {string} key
 * @param {string} label
 * @param {(row: any) => number | undefined} of
 * @returns {Column}
 */
const angleColumn = (key, label, of) => ({
  key,
  label,
  unit: "deg",
  of,
  text: (row) => textOf(of(row), (angle) => formatNumber(angle, 2)),
  digits: true,
});

/**
 * The rows of an answer and what stands in each; `fields` are those that the question is about.
 * @param {Question} question
 * @param {Answer} answer
 * @param {Field[]} fields
 * @returns {Listed}
 */
export function listed(question, answer, fields) {
  if (question.kind === "robots") return { rows: answer.robots ?? [], columns: armColumns(question.place) };
  if (question.kind === "choices")
    return {
      rows: answer.choices ?? [],
      columns: [{ key: "choice", label: "Choice", of: ({ label }) => label }, ...errors(), verdict()],
    };
  if (question.kind === "loops") return { rows: answer.loops ?? [], columns: loopColumns() };
  if (question.kind === "tornado") return { rows: answer.tornado?.bars ?? [], columns: tornadoColumns() };
  if (question.kind === "measures")
    return {
      rows: answer.measures ?? [],
      columns: [
        { key: "measure", label: "Measure", of: ({ sentence }) => sentence },
        lengthColumn("p95", "Then at most, 95 of 100", (row) => row.p95_mm),
      ],
    };
  const numbers = fields.map((field, k) => numberColumn(field, k ? "second" : "value", k ? "second" : "value"));
  return { rows: answer.rows ?? [], columns: [...numbers, ...errors(), verdict()] };
}

/** @returns {Column[]} */
const loopColumns = () => [
  { key: "sensor", label: "Measured", of: (/** @type {LoopRow} */ { measures }) => SENSORS[measures] },
  { key: "controller", label: "Controller", of: ({ name }) => name },
  lengthColumn("online", "Loop alone, 95 of 100", (row) => row.online?.p95),
  lengthColumn("p50", "Loop and corrected commands, 50 of 100", (row) => row.both?.p50),
  lengthColumn("p95", "95 of 100", (row) => row.both?.p95),
  {
    key: "helps",
    label: "Helps below",
    unit: "Hz",
    of: ({ helps_below_hz }) => helps_below_hz,
    text: ({ helps_below_hz }) => textOf(helps_below_hz, (hertz) => formatNumber(hertz, 2)),
    digits: true,
  },
  {
    key: "slow",
    label: "Error that lies there",
    unit: "%",
    of: ({ slow_share }) => 100 * slow_share,
    text: ({ slow_share }) => shareText(slow_share),
    digits: true,
  },
];

/** @returns {Column[]} */
const tornadoColumns = () => [
  { key: "input", label: "Input", of: ({ input }) => INPUTS[input] ?? input },
  {
    key: "range",
    label: "Its 95 % range",
    unit: "of what is assumed",
    of: ({ factors }) => factors.map((/** @type {number} */ factor) => formatNumber(factor)).join(" to "),
  },
  lengthColumn("after-low", "After compensation, at its lower end", (row) => row.after_mm[0]),
  lengthColumn("after-high", "at its upper end", (row) => row.after_mm[1]),
  lengthColumn("before-low", "Before compensation, at its lower end", (row) => row.before_mm[0]),
  lengthColumn("before-high", "at its upper end", (row) => row.before_mm[1]),
];

/** @param {Column} column */
const headOf = ({ label, unit }) => (unit ? `${label}, ${unit}` : label);

/**
 * What a cell reads.
 * @param {Column} column
 * @param {any} row
 */
export const cellText = ({ of, text }, row) => text?.(row) ?? String(of(row) ?? "–");

/**
 * A table in Markdown.
 * @param {Listed} listed
 */
export function tableMarkdown({ rows, columns }) {
  /** @param {string[]} cells */
  const line = (cells) => `| ${cells.map((cell) => cell.replaceAll("|", "\\|")).join(" | ")} |`;
  return [
    line(columns.map(headOf)),
    line(columns.map(({ digits }) => (digits ? "---:" : "---"))),
    ...rows.map((row) => line(columns.map((column) => cellText(column, row)))),
  ].join("\n");
}

/**
 * All digits, as CSV (RFC 4180).
 * @param {Listed} listed
 */
export function tableCsv({ rows, columns }) {
  /** @param {unknown} value */
  const cell = (value) => {
    const text = String(value ?? "");
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const lines = [columns.map(headOf), ...rows.map((row) => columns.map(({ of }) => of(row)))];
  return `${lines.map((line) => line.map(cell).join(",")).join("\n")}\n`;
}
