// What differs between the inputs of several jobs, in words.

import { inWords } from "../form/field-text.js";
import { plainNumber } from "../page/number.js";

const MOST = 8; // rows of one field that are listed

/**
 * The lines of a table of inputs that differ: [{ label, texts }], a text for each of the jobs.
 * @param {import("../job/job.js").Job[]} jobs
 */
export function differingInputs(jobs) {
  const fields = new Map();
  for (const job of jobs.slice(1)) for (const { field } of jobs[0].differences(job.data)) fields.set(field.path, field);
  /**
   * @param {import("../job/job.js").Job} job
   * @param {import("../../pkg/armill.js").Field} field
   */
  const valueIn = (job, field) => (job.shows(field) ? job.get(field) : undefined);
  return [...fields.values()].flatMap((field) =>
    differing(
      field,
      jobs.map((job) => valueIn(job, field)),
    ),
  );
}

/**
 * Those of one field.
 * @param {import("../../pkg/armill.js").Field} field
 * @param {any[]} values
 */
function differing(field, values) {
  const rows = values.map((value) => rowsOf(field, value));
  if (
    rows.some((one) => !one) ||
    (typeof values[0] === "string" && new Set(rows.map((/** @type {any} */ one) => one.length)).size > 1)
  )
    return [{ label: field.label, texts: values.map((value) => inWords(field, value)) }];
  const noun = typeof values[0] === "string" ? "line" : "row";
  const length = Math.max(...rows.map((/** @type {any} */ one) => one.length));
  const places = Array.from({ length }, (_, k) => k).filter(
    (k) => new Set(rows.map((/** @type {any} */ one) => text(one[k]))).size > 1,
  );
  const lines = places.slice(0, MOST).map((k) => ({
    label: `${field.label}, ${noun} ${k + 1}`,
    texts: rows.map((one) => rowInWords(one, k, rows)),
  }));
  const more = places.length - lines.length;
  if (more > 0) lines.push({ label: `${field.label}, ${more} more ${noun}s`, texts: values.map(() => "differ") });
  return lines;
}

/**
 * A table as its rows, a text of several lines as those; undefined for what is said in one go.
 * @param {import("../../pkg/armill.js").Field} field
 * @param {any} value
 */
function rowsOf(field, value) {
  if (field.kind === "table" && Array.isArray(value)) return value;
  return typeof value === "string" && value.includes("\n") ? value.trimEnd().split("\n") : undefined;
}

/** @param {any} row */
const text = (row) => JSON.stringify(row);

/**
 * A row: its numbers, or of one with names what differs from the other jobs' row.
 * @param {any} rows
 * @param {number} k
 * @param {any[]} all
 */
function rowInWords(rows, k, all) {
  const row = rows[k];
  if (row === undefined) return "none";
  if (typeof row === "number") return plainNumber(row);
  if (typeof row === "string") return row.trim() || "empty";
  if (Array.isArray(row))
    return row.map((value) => (typeof value === "number" ? plainNumber(value) : value)).join(", ");
  const keys = Object.keys(row).filter((key) => new Set(all.map((one) => text(one[k]?.[key]))).size > 1);
  return keys
    .map((key) => `${key} ${typeof row[key] === "number" ? plainNumber(row[key]) : text(row[key])}`)
    .join(", ");
}
