// One editor for each kind of field. Those that are more than an input have a file of their own.

import { indexIn } from "../job/field-path.js";
import { make } from "../page/dom.js";
import { allUnderstood, numberCell } from "./number-cell.js";
import { opwEditor } from "./opw-editor.js";
import { orientationEditor } from "./orientation-editor.js";
import { listing } from "./program-text.js";
import { rowsEditor } from "./rows.js";
import { searchList } from "./search-list.js";
import { makeSlider } from "./slider.js";
import { tableEditor } from "./table-editor.js";

/** @import { Field } from "../../pkg/armill.js" */

/**
 * `read` gives the value or throws a `Mistake`; `at(rest)` gives the input that an error path such as
 * "[1].a_mm" means. `mark` and `show` are for texts alone, `step` and `slider` for numbers. `understood` is what was
 * read of typed expressions; `relabel` writes the units of the settings.
 *
 * @typedef {{
 *   node: HTMLElement,
 *   inputs: any[],
 *   read(): any,
 *   write(value: any): void,
 *   at(rest: string): HTMLElement,
 *   mark?(line: number): void,
 *   show?(line: number): void,
 *   step?(count: number): void,
 *   understood?(): string,
 *   relabel?(): void,
 *   slider?: HTMLElement,
 *   unit?(): string,
 *   meaning?(): string,
 * }} Editor
 */

/** @typedef {Pick<Field, "path"> & Partial<Field> & { default?: any }} Edited what an editor needs to know of a field */

const XYZ = ["x", "y", "z"].map((name) => [name, "mm"]);

/**
 * Tables of any length: the end of their path, and name and unit of each column.
 * @type {Record<string, string[][]>}
 */
const ROWS = {
  "stock.points_mm": [
    ["x", "mm"],
    ["y", "mm"],
  ],
  points_mm: XYZ,
  work_offsets_mm: XYZ,
  length_offsets_mm: [
    ["H", ""],
    ["length", "mm"],
  ],
  springs_nm_arcmin: [
    ["joint", ""],
    ["torque", "N m"],
    ["turn", "arcmin"],
  ],
  loads_kg_mm: [["link", ""], ["mass", "kg"], ...XYZ],
};

/** @param {string} path */
export const idOf = (path) => path.replaceAll(".", "-");

/**
 * The editor of a field; `badges` are those of the libraries' entries, `brand()` says whose robot the job has.
 * @param {Field} field
 * @param {{ badges: Map<string, import("./badges.js").Badge[]>, brand: () => string }} given
 * @returns {Editor}
 */
export function editorFor(field, { badges, brand }) {
  if (field.path.endsWith(".preset")) return searchList(idOf(field.path), field.choices ?? [], badges);
  const columns = Object.keys(ROWS).find((ending) => field.path.endsWith(ending));
  if (columns)
    return rowsEditor(idOf(field.path), ROWS[columns], { lines: /** @type {any[]} */ (field.default).length ? 8 : 2 });
  if (field.path.endsWith("_frame.rpy_deg"))
    return orientationEditor(idOf(field.path), brand, { spindle: field.path === "tool_frame.rpy_deg" });
  if (field.kind === "number" && field.choices) return numberOrWord(field, field.choices[0]);
  if (field.kind === "choice") return choice(field);
  if (field.kind === "set") return checkboxes(field);
  if (field.kind === "vector" && field.choices) return wordOrVector(field);
  if (field.kind === "vector") return vector(field);
  if (field.path === "robot.opw") return opwEditor(idOf(field.path), /** @type {any} */ (field.default));
  if (field.kind === "table")
    return tableEditor(idOf(field.path), /** @type {any} */ (field.default), {
      unit: field.unit,
      joints: field.path.startsWith("robot."),
    });
  if (field.path === "path.text") return program();
  if (field.kind === "text") return text(field);
  return number(field);
}

/**
 * @param {HTMLElement} input
 * @param {() => any} read
 * @param {(value: any) => void} write
 * @returns {Editor}
 */
function single(input, read, write) {
  return { node: input, inputs: [input], read, write, at: () => input };
}

/**
 * @param {Edited} field
 * @returns {Editor}
 */
function number(field) {
  const cell = numberCell(idOf(field.path), field.unit, field.kind === "integer");
  const slider = field.usual && makeSlider(cell, field.unit ?? "", field.usual);
  return {
    ...cell,
    node: cell.input,
    slider: slider?.node,
    inputs: [cell.input],
    at: () => cell.input,
    write(value) {
      cell.write(value);
      slider?.follow();
    },
  };
}

/**
 * A number, or a word that a checkbox stands for.
 * @param {Field} field
 * @param {{ value: string, label: string }} word
 * @returns {Editor}
 */
function numberOrWord(field, { value: word, label }) {
  const cell = numberCell(idOf(field.path), field.unit);
  const { input } = cell;
  const box = make("input", { type: "checkbox", id: `${idOf(field.path)}-${word}` });
  const node = make(
    "div",
    { className: "number-or-word" },
    input,
    make("label", { className: "check", for: box.id }, box, label),
  );
  box.addEventListener("input", () => {
    input.disabled = box.checked;
    if (!box.checked && input.value === "")
      cell.write(typeof field.default === "number" ? field.default : (field.min ?? 0));
  });
  return {
    node,
    inputs: [input, box],
    read: () => (box.checked ? word : cell.read()),
    write(value) {
      box.checked = value === word;
      input.disabled = box.checked;
      if (!box.checked) cell.write(value);
    },
    at: () => input,
    understood: cell.understood,
  };
}

/**
 * @param {Edited} field
 * @returns {Editor}
 */
function choice(field) {
  const options = (field.choices ?? []).map(({ value, label }) => make("option", { value }, label));
  const input = make("select", { id: idOf(field.path) }, ...options);
  return single(
    input,
    () => input.value,
    (value) => (input.value = value),
  );
}

/**
 * @param {Field} field
 * @returns {Editor}
 */
function checkboxes(field) {
  const { choices = [] } = field;
  const inputs = choices.map(({ value }) =>
    make("input", { type: "checkbox", value, id: `${idOf(field.path)}-${value}` }),
  );
  const labels = choices.map(({ label }, i) =>
    make("label", { className: "check", for: inputs[i].id }, inputs[i], label),
  );
  return {
    node: make("div", { id: idOf(field.path), className: "checks", role: "group" }, ...labels),
    inputs,
    read: () => inputs.filter((input) => input.checked).map((input) => input.value),
    write: (values) => inputs.forEach((input) => (input.checked = values.includes(input.value))),
    at: () => inputs[0],
  };
}

/**
 * @param {Edited} field
 * @returns {Editor}
 */
function vector(field) {
  const names = field.path.endsWith("range_deg") ? ["from", "to"] : ["x", "y", "z"];
  const id = idOf(field.path);
  const cells = names.map((name) => numberCell(`${id}-${name}`, field.unit));
  const inputs = cells.map(({ input }) => input);
  const parts = names.map((name, i) =>
    make("label", { className: "part", for: inputs[i].id }, make("span", {}, name), inputs[i]),
  );
  return {
    node: make("div", { id, className: "vector", role: "group" }, ...parts),
    inputs,
    read: () => cells.map((cell) => cell.read()),
    write: (values) => cells.forEach((cell, i) => cell.write(values[i])),
    at: (rest) => inputs[indexIn(rest)] ?? inputs[0],
    understood: () => allUnderstood(cells),
  };
}

/**
 * One of a few words, or a vector of one's own.
 * @param {Field} field
 * @returns {Editor}
 */
function wordOrVector(field) {
  const words = choice(field);
  const [select] = words.inputs;
  select.setAttribute("aria-labelledby", `${select.id}-label`);
  select.append(make("option", { value: "" }, "a direction"));
  const own = vector({ path: `${field.path}.direction` });
  own.node.setAttribute("aria-labelledby", `${select.id}-label`);
  // A direction starts as the first axis; afterwards as it was last. It hides behind a word.
  own.write([1, 0, 0]);
  const reveal = () => {
    own.node.hidden = select.value !== "";
  };
  select.addEventListener("input", reveal);
  reveal();
  return {
    node: make("div", { className: "word-or-vector" }, select, own.node),
    inputs: [select, ...own.inputs],
    read: () => select.value || own.read(),
    write(value) {
      const isWord = typeof value === "string";
      select.value = isWord ? value : "";
      if (!isWord) own.write(value);
      reveal();
    },
    at: (rest) => (rest ? own.at(rest) : select),
    understood: () => (select.value === "" ? (own.understood?.() ?? "") : ""),
  };
}

/**
 * @param {Field} field
 * @returns {Editor}
 */
function text(field) {
  const input = make("input", { id: idOf(field.path), spellcheck: false, type: "text" });
  return single(
    input,
    () => input.value,
    (value) => (input.value = value),
  );
}

/**
 * The text of a program, of which there is one.
 * @returns {Editor}
 */
function program() {
  return {
    node: listing.node,
    inputs: listing.inputs,
    read: () => listing.text,
    write: (text) => (listing.text = text),
    at: () => listing.input,
    mark: (line) => listing.mark(line),
    show: (line) => listing.show(line),
  };
}
