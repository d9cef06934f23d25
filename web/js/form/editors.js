// One editor per kind of field. An editor is { node, inputs, read(), write(value), at(rest),
// mark(line), show(line), step(count), understood(), relabel(), slider } of which mark and show are for texts and the last three
// for numbers alone. read() gives the value or throws a Mistake; at(rest) gives the input that an error path such as
// "[1].a_mm" means; understood() is what was read of typed expressions; relabel() writes the units of the settings.

import { make } from "../page/dom.js";
import { allUnderstood, numberCell } from "./number-cell.js";
import { orientationEditor } from "./orientation-editor.js";
import { listing } from "./program-text.js";
import { rowsEditor } from "./rows.js";
import { searchList } from "./search-list.js";
import { shownUnit } from "./shown.js";
import { makeSlider } from "./slider.js";

/** @import { Field } from "../../pkg/armill.js" */

/**
 * `read` gives the value or throws a `Mistake`; `at(rest)` gives the input that an error path such as
 * "[1].a_mm" means. `mark` and `show` are for texts alone, `step` for numbers.
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

/** The order in which tables of the field print a row. */
const DH_ORDER = ["alpha_deg", "a_mm", "d_mm", "theta_offset_deg", "joint_sign", "offset_deg"];

const RANGE = ["lowest", "highest"];
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
  if (field.path === "robot.opw") return lengths(field);
  if (field.kind === "table") return table(field);
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
 * A table with as many rows as its default: rows of named numbers, of numbers, or single numbers.
 * @param {Edited} field
 * @returns {Editor}
 */
function table(field) {
  const id = idOf(field.path);
  const sample = field.default[0];
  /** @type {(string | null)[]} */
  const columns =
    typeof sample !== "object" ? [null] : Object.keys(sample).sort((a, b) => DH_ORDER.indexOf(a) - DH_ORDER.indexOf(b));
  const named = columns[0] !== null && !Array.isArray(sample);
  /** @param {number} row */
  const rowName = (row) => (field.path.startsWith("robot.") ? `J${row + 1}` : `${row + 1}`);
  const cells = field.default.map((/** @type {any} */ _, /** @type {any} */ row) =>
    columns.map((key) =>
      numberCell(`${id}-${row}${key === null ? "" : `-${key}`}`, named ? unitIn(String(key)) : field.unit),
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
        const values = row.map((/** @type {import("./number-cell.js").Cell} */ cell) => cell.read());
        if (columns[0] === null) return values[0];
        return Array.isArray(sample) ? values : Object.fromEntries(columns.map((key, i) => [key, values[i]]));
      }),
    write: (rows) =>
      cells.forEach((/** @type {any} */ row, /** @type {number} */ i) =>
        row.forEach((/** @type {import("./number-cell.js").Cell} */ cell, /** @type {number} */ c) =>
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
 * Ortho-parallel parameters: seven lengths, then sign and zero offset of each joint.
 * @param {Edited} field
 * @returns {Editor}
 */
function lengths(field) {
  const id = idOf(field.path);
  const scalars = Object.keys(field.default).filter((key) => key.endsWith("_mm"));
  const cells = scalars.map((key) => numberCell(`${id}-${key}`, "mm"));
  const inputs = cells.map(({ input }) => input);
  const parts = scalars.map((key, i) =>
    make("label", { className: "part", for: inputs[i].id }, make("span", {}, key.replace("_mm", "")), inputs[i]),
  );
  const joints = table({
    path: field.path,
    default: field.default.joint_sign.map((/** @type {number} */ sign, /** @type {number} */ i) => ({
      joint_sign: sign,
      offset_deg: field.default.joint_offset_deg[i],
    })),
  });
  return {
    node: make(
      "div",
      { id: `${id}-lengths`, role: "group" },
      make("div", { className: "vector lengths" }, ...parts),
      joints.node,
    ),
    inputs: [...inputs, ...joints.inputs],
    read() {
      /** @type {{ joint_sign: number, offset_deg: number }[]} */
      const rows = joints.read();
      const values = scalars.map((key, i) => [key, cells[i].read()]);
      return {
        ...Object.fromEntries(values),
        joint_sign: rows.map((row) => row.joint_sign),
        joint_offset_deg: rows.map((row) => row.offset_deg),
      };
    },
    write(value) {
      scalars.forEach((key, i) => cells[i].write(value[key]));
      joints.write(
        value.joint_sign.map((/** @type {any} */ sign, /** @type {number} */ i) => ({
          joint_sign: sign,
          offset_deg: value.joint_offset_deg[i],
        })),
      );
    },
    at(rest) {
      const scalar = inputs[scalars.findIndex((key) => rest.startsWith(`.${key}`))];
      return (
        scalar ??
        joints.at(
          rest.replace(
            /^\.joint_(sign|offset_deg)(\[\d+\])$/,
            (_, key, row) => `${row}.${key === "sign" ? "joint_sign" : key}`,
          ),
        )
      );
    },
    understood: () => [allUnderstood(cells), joints.understood?.()].filter(Boolean).join(", "),
    relabel: joints.relabel,
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

/** @param {string} rest */
const indexIn = (rest) => Number(/^\[(\d+)\]/.exec(rest)?.[1] ?? 0);

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
