// A table of numbers that has a fixed number of rows: one of joints or links, or of as many as its default.

import { indexIn } from "../job/field-path.js";
import { make } from "../page/dom.js";
import { allUnderstood, numberCell } from "./number-cell.js";
import { shownUnit } from "./shown.js";

/**
 * @import { Editor } from "./editors.js"
 * @import { Cell } from "./number-cell.js"
 */

/** The order in which tables of the field print a row. */
const DH_ORDER = ["alpha_deg", "a_mm", "d_mm", "theta_offset_deg", "joint_sign", "offset_deg"];

const RANGE = ["lowest", "highest"];

/**
 * A table with as many rows as `standard`: rows of named numbers, of numbers, or single numbers. The rows are those of
 * `joints`, or counted.
 * @param {string} id
 * @param {any[]} standard
 * @param {{ unit?: string, joints?: boolean }} of
 * @returns {Editor}
 */
export function tableEditor(id, standard, { unit, joints = false }) {
  const sample = standard[0];
  /** @type {(string | null)[]} */
  const columns =
    typeof sample !== "object" ? [null] : Object.keys(sample).sort((a, b) => DH_ORDER.indexOf(a) - DH_ORDER.indexOf(b));
  const named = columns[0] !== null && !Array.isArray(sample);
  /** @param {number} row */
  const rowName = (row) => (joints ? `J${row + 1}` : `${row + 1}`);
  const cells = standard.map((_, row) =>
    columns.map((key) =>
      numberCell(`${id}-${row}${key === null ? "" : `-${key}`}`, named ? unitIn(String(key)) : unit),
    ),
  );
  const body = cells.map((/** @type {any} */ row, /** @type {number} */ i) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, rowName(i)),
      ...row.map((/** @type {{ input: HTMLInputElement }} */ { input }) => make("td", {}, input)),
    ),
  );
  const heads = columns.map(() => make("th", { scope: "col" }));
  const head = columns[0] === null ? "" : make("thead", {}, make("tr", {}, make("td"), ...heads));
  const relabel = () =>
    columns.forEach((key, column) => {
      const name = key === null ? "" : named ? heading(key) : sample.length === 2 ? RANGE[column] : rowName(column);
      heads[column].textContent = name;
      cells.forEach((/** @type {any} */ row, /** @type {number} */ i) =>
        row[column].input.setAttribute("aria-label", [rowName(i), name].filter(Boolean).join(", ")),
      );
    });
  relabel();
  return {
    node: make("table", { id, className: "cells" }, head, make("tbody", {}, ...body)),
    inputs: cells.flat().map((/** @type {{ input: HTMLInputElement }} */ { input }) => input),
    read: () =>
      cells.map((/** @type {any} */ row) => {
        const values = row.map((/** @type {Cell} */ cell) => cell.read());
        if (columns[0] === null) return values[0];
        return Array.isArray(sample) ? values : Object.fromEntries(columns.map((key, i) => [key, values[i]]));
      }),
    write: (rows) =>
      cells.forEach((/** @type {any} */ row, /** @type {number} */ i) =>
        row.forEach((/** @type {Cell} */ cell, /** @type {number} */ c) =>
          cell.write(columns[c] === null ? rows[i] : rows[i]?.[columns[c]]),
        ),
      ),
    at(rest) {
      const row = cells[indexIn(rest)] ?? cells[0];
      const column = columns.findIndex(
        (key) => key !== null && (rest.endsWith(`.${key}`) || rest.endsWith(`][${key}]`)),
      );
      return row[Math.max(0, column)].input;
    },
    understood: () => allUnderstood(cells.flat()),
    relabel,
  };
}

/**
 * The unit that a key such as "a_mm" ends in, if it has one.
 * @param {string} key
 */
const unitIn = (key) => /_(mm|deg)$/.exec(key)?.[1] ?? "";

/**
 * "theta_offset_deg" as a column heading: "theta offset, deg".
 * @param {string} key
 */
function heading(key) {
  if (key === "joint_sign") return "sign";
  const at = key.lastIndexOf("_");
  return `${key.slice(0, at).replaceAll("_", " ")}, ${shownUnit(key.slice(at + 1))}`;
}
