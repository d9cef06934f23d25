// The inputs of one number and its range, or of a choice, whose words are all tried.

import { numberCell } from "../form/number-cell.js";
import { shownUnit } from "../form/shown.js";
import { make } from "../page/dom.js";
import { LIMITED, rangeOf } from "./question.js";

/**
 * @import { Field } from "../../pkg/armill.js"
 * @import { Job } from "../job/job.js"
 * @import { Cell } from "../form/number-cell.js"
 */

/**
 * The numbers of a job that can be asked about: those that are usually limited first.
 * @param {Job} job
 * @param {Field[]} fields
 */
export function askable(job, fields) {
  const numbers = fields.filter(
    (field) =>
      (field.kind === "number" || field.kind === "integer") &&
      !field.path.startsWith("program.") &&
      (job.shows(field) || field.path === "cutting.feed_per_tooth_mm"),
  );
  /** @param {Field} field */
  const rank = ({ path }) => (LIMITED.includes(path) ? LIMITED.indexOf(path) : LIMITED.length);
  return [...numbers].sort((a, b) => rank(a) - rank(b));
}

/**
 * The choices of a job that can be asked about.
 * @param {Job} job
 * @param {Field[]} fields
 */
export const choosable = (job, fields) =>
  fields.filter(
    (field) =>
      field.kind === "choice" &&
      field.choices &&
      !FIXED.some((start) => field.path.startsWith(start)) &&
      (job.shows(field) || field.path === "shaper.kind"),
  );

const FIXED = ["program.", "path.", "stock.", "robot."]; // what says what the job is, not how it is done

/** @typedef {{ path: string, from: number, to: number } | { path: string, words: "all" }} Entered */

/**
 * One number or choice of the job, from and to; `changed()` is called after an edit. With `isOptional` there may be none.
 * @param {string} id
 * @param {string} label
 * @param {() => void} changed
 */
export function makeRangeFields(id, label, changed, isOptional = false) {
  /** @type {Field[]} */
  let offered = [];
  /** @type {Cell[]} */
  let cells = [];
  let isOfBoth = true; // whether choices are offered as well
  const select = make("select", { id: `${id}-number` });
  const places = ["from", "to"].map((end) => make("div", { className: "number", "data-end": end }));
  const node = make(
    "div",
    { className: "study-range" },
    make("div", {}, make("label", { for: select.id }, label), select),
    ...places,
  );
  select.addEventListener("change", () => {
    begin(select.value);
    changed();
  });

  /** @type {(path: string) => any} */
  let valueAt = () => undefined;

  const chosen = () => offered.find(({ path }) => path === select.value);

  /**
   * Shows a number with the range to begin with, or with `given`.
   * @param {string} path
   * @param {[number, number]} [given]
   */
  function begin(path, given) {
    select.value = path;
    const field = chosen();
    for (const place of places) place.hidden = !field || isChoice(field);
    if (!field || isChoice(field)) return;
    const now = valueAt(path);
    const ends = given ?? rangeOf(field, typeof now === "number" ? now : (field.usual?.[0] ?? 1));
    cells = places.map((place, k) => {
      const cell = numberCell(`${id}-${place.dataset.end}`, field.unit, field.kind === "integer");
      const unit = make("span", { className: "unit" }, ` ${shownUnit(field.unit)}`);
      place.replaceChildren(make("label", { for: cell.input.id }, k ? "To" : "From", unit), cell.input);
      cell.write(ends[k]);
      cell.input.addEventListener("input", changed);
      return cell;
    });
  }

  /** Lists what can be chosen; what is stays where it can. */
  function list() {
    const before = select.value;
    const listed = offered.filter((field) => isOfBoth || !isChoice(field));
    const options = listed.map((field) =>
      make("option", { value: field.path }, `${field.label} (${isChoice(field) ? "every choice" : field.group})`),
    );
    select.replaceChildren(...(isOptional ? [make("option", { value: "" }, "none")] : []), ...options);
    if (listed.some(({ path }) => path === before)) select.value = before;
    else begin(isOptional ? "" : (listed[0]?.path ?? ""));
  }

  return {
    node,
    chosen,
    begin,
    /**
     * Offers the numbers of a job; what is chosen stays where it can.
     * @param {Field[]} numbers
     * @param {(path: string) => any} of what a path is in the job
     */
    offer(numbers, of) {
      valueAt = of;
      const key = numbers.map(({ path }) => path).join();
      if (key === offered.map(({ path }) => path).join()) return;
      offered = numbers;
      list();
    },
    /**
     * Whether choices are offered beside numbers.
     * @param {boolean} both
     */
    withChoices(both) {
      if (both === isOfBoth) return;
      isOfBoth = both;
      list();
    },
    /**
     * The number and its range, or the choice; throws a Mistake.
     * @returns {Entered | undefined}
     */
    read() {
      const field = chosen();
      if (!field) return undefined;
      if (isChoice(field)) return { path: field.path, words: "all" };
      const [from, to] = cells.map((cell) => cell.read());
      return { path: field.path, from, to };
    },
    /** Writes the range in the units of the settings. */
    relabel() {
      const field = chosen();
      if (!field || isChoice(field)) return;
      const [from, to] = cells.map((cell) => cell.read());
      begin(field.path, [from, to]);
    },
  };
}

/** @param {Field} field */
const isChoice = ({ kind }) => kind === "choice";
