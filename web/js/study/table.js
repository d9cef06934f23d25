// The table of an answer: sorted by any column, and if it is long, filtered by words.

import { make } from "../page/dom.js";
import { cellText } from "./columns.js";

/** @import { Column, Listed } from "./columns.js" */

/**
 * @typedef {{
 *   sort?: { key: string, falling: boolean }, marks?(row: any): string, act?(row: any): HTMLElement | undefined,
 * }} TableOptions `marks(row)` is a class of the row, `act(row)` a button at its end
 */

const LONG = 12; // rows from which on there is a filter

/**
 * A table that sorts itself when the head of a column is pressed.
 * @param {string} caption
 * @param {Listed} listed
 * @param {TableOptions} [options]
 */
export function answerTable(caption, { rows, columns }, { sort, marks = () => "", act } = {}) {
  let sorted = sort;
  let words = "";
  let isAbleOnly = false;
  const body = make("tbody");
  const count = make("output", { className: "note" });
  const heads = columns.map((column) => {
    const button = make(
      "button",
      { type: "button", className: "quiet", "data-key": column.key },
      column.label,
      column.unit ? make("span", { className: "unit" }, ` ${column.unit}`) : "",
    );
    button.addEventListener("click", () => {
      sorted = { key: column.key, falling: sorted?.key === column.key && !sorted.falling };
      fill();
    });
    return make("th", { scope: "col", className: column.digits ? "digits" : "" }, button);
  });

  function fill() {
    const by = columns.find(({ key }) => key === sorted?.key);
    const order = by ? [...rows].sort((a, b) => compared(by, a, b, Boolean(sorted?.falling))) : rows;
    heads.forEach((head, k) => {
      if (columns[k] === by) head.setAttribute("aria-sort", sorted?.falling ? "descending" : "ascending");
      else head.removeAttribute("aria-sort");
    });
    const shown = order.filter((row) => !(isAbleOnly && cannot(row)) && holds(row));
    body.replaceChildren(...shown.map(rowOf));
    count.textContent = shown.length < rows.length ? `${shown.length} of ${rows.length}` : "";
  }

  /**
   * Whether the row has all words of the filter.
   * @param {any} row
   */
  function holds(row) {
    const text = columns
      .map((column) => cellText(column, row))
      .join(" ")
      .toLowerCase();
    return words
      .toLowerCase()
      .split(/\s+/)
      .every((word) => text.includes(word));
  }

  function filter() {
    const input = make("input", { type: "search", id: "study-filter" });
    const able = make("input", { type: "checkbox", id: "study-able" });
    input.addEventListener("input", () => ((words = input.value), fill()));
    able.addEventListener("change", () => ((isAbleOnly = able.checked), fill()));
    return make(
      "div",
      { className: "answer-filter" },
      make("label", { for: input.id }, "Only rows with"),
      input,
      ...(rows.some(cannot) ? [able, make("label", { for: able.id }, "that can be run")] : []),
      count,
    );
  }

  /** @param {any} row */
  function rowOf(row) {
    const [first, ...rest] = columns;
    const button = act?.(row);
    return make(
      "tr",
      { className: marks(row) },
      make("th", { scope: "row", className: first.digits ? "digits" : "" }, cellText(first, row)),
      ...(act ? [make("td", {}, button ?? "")] : []),
      ...rest.map((column) => cellOf(column, row)),
    );
  }

  fill();
  const table = make(
    "div",
    { className: "answer-table", role: "region", "aria-label": caption, tabIndex: 0 },
    make(
      "table",
      {},
      make("caption", {}, caption),
      make("thead", {}, make("tr", {}, heads[0], ...(act ? [make("td")] : []), ...heads.slice(1))),
      body,
    ),
  );
  return make("div", {}, ...(rows.length > LONG ? [filter()] : []), table);
}

/**
 * @param {Column} column
 * @param {any} row
 */
function cellOf(column, row) {
  const cell = make("td", { className: column.digits ? "digits" : column.key }, cellText(column, row));
  const value = column.of(row);
  if (typeof value === "number") cell.dataset.value = String(value);
  return cell;
}

/**
 * What cannot be run and what has no value come last, whichever way it is sorted.
 * @param {Column} column
 * @param {any} a
 * @param {any} b
 * @param {boolean} falling
 */
function compared({ of }, a, b, falling) {
  const unable = Number(cannot(a)) - Number(cannot(b));
  if (unable) return unable;
  const [x, y] = [of(a), of(b)];
  if (x === undefined || y === undefined) return Number(x === undefined) - Number(y === undefined);
  const order = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y));
  return falling ? -order : order;
}

/** @param {import("../../pkg/armill.js").StudyOutcome} row */
export const cannot = ({ error, cannot_run }) => Boolean(error ?? cannot_run);
