// One editor per kind of field. An editor is { node, inputs, read(), write(value), at(rest),
// mark(line), show(line), step(count) } of which mark and show are for texts and step for numbers alone. read() gives the
// value or throws a Mistake; at(rest) gives the input that an error path such as "[1].a_mm" means.

import { make } from "../page/dom.js";
import { listing } from "./program-text.js";
import { parseNumber, plainNumber, stepped } from "../page/number.js";

/** What is wrong with what was typed, and in which input. */
export class Mistake extends Error {
  constructor(message, input) {
    super(message);
    this.input = input;
  }
}

/** The order in which tables of the field print a row. */
const DH_ORDER = ["alpha_deg", "a_mm", "d_mm", "theta_offset_deg", "joint_sign", "offset_deg"];

export const idOf = (path) => path.replaceAll(".", "-");

export function editorFor(field) {
  if (field.path === "stock.points_mm") return rows(field, ["x", "y"]);
  if (field.path.endsWith("points_mm") || field.path.endsWith("work_offsets_mm")) return rows(field, ["x", "y", "z"]);
  if (field.path.endsWith("length_offsets_mm")) return rows(field, ["H", "length"]);
  if (field.path.endsWith("springs_nm_arcmin")) return rows(field, ["joint", "torque", "turn"]);
  if (field.path.endsWith("loads_kg_mm")) return rows(field, ["link", "mass", "x", "y", "z"]);
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

function single(field, input, read, write) {
  return { node: input, inputs: [input], read, write, at: () => input };
}

function number(field) {
  const whole = field.kind === "integer";
  const input = numberInput(idOf(field.path), whole);
  const editor = single(
    field,
    input,
    () => typedNumber(input, whole),
    (value) => (input.value = plainNumber(value)),
  );
  return { ...editor, step: (count) => step(input, count, whole) };
}

function numberInput(id, whole = false) {
  const input = make("input", { id, type: "text", inputMode: whole ? "numeric" : "decimal", className: "value" });
  input.addEventListener("keydown", (event) => {
    const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!direction || event.altKey || event.ctrlKey || event.metaKey || Number.isNaN(parseNumber(input.value))) return;
    event.preventDefault();
    step(input, direction, whole);
  });
  return input;
}

/**
 * Changes a number by some steps at once: an "input" whose detail says that nothing is being typed.
 */
function step(input, count, whole) {
  let value = parseNumber(input.value);
  if (Number.isNaN(value)) return;
  for (let i = 0; i < Math.abs(count); i++) value = stepped(value, Math.sign(count), whole);
  input.value = plainNumber(value);
  input.dispatchEvent(new CustomEvent("input", { bubbles: true, detail: "stepped" }));
}

function typedNumber(input, whole = false) {
  const value = parseNumber(input.value);
  if (input.value.trim() === "") throw new Mistake("A number is needed here.", input);
  if (Number.isNaN(value)) throw new Mistake(`“${input.value.trim()}” is not a number.`, input);
  if (!Number.isFinite(value)) throw new Mistake(`“${input.value.trim()}” is too large.`, input);
  if (whole && !Number.isInteger(value)) throw new Mistake("A whole number is needed here.", input);
  return value;
}

/** A number, or a word that a checkbox stands for. */
function numberOrWord(field, { value: word, label }) {
  const input = numberInput(idOf(field.path));
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
      input.value = plainNumber(typeof field.default === "number" ? field.default : (field.min ?? 0));
  });
  return {
    node,
    inputs: [input, box],
    read: () => (box.checked ? word : typedNumber(input)),
    write(value) {
      box.checked = value === word;
      input.disabled = box.checked;
      if (!box.checked) input.value = plainNumber(value);
    },
    at: () => input,
  };
}

function choice(field) {
  const input = make("select", { id: idOf(field.path) });
  const groups = new Map();
  for (const { value, label, heading } of field.choices) {
    if (heading && !groups.has(heading)) {
      groups.set(heading, make("optgroup", { label: heading }));
      input.append(groups.get(heading));
    }
    (groups.get(heading) ?? input).append(make("option", { value }, label));
  }
  return single(
    field,
    input,
    () => input.value,
    (value) => (input.value = value),
  );
}

function checkboxes(field) {
  const inputs = field.choices.map(({ value }) =>
    make("input", { type: "checkbox", value, id: `${idOf(field.path)}-${value}` }),
  );
  const labels = field.choices.map(({ label }, i) =>
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

function vector(field) {
  const names = field.path.endsWith("range_deg")
    ? ["from", "to"]
    : field.path.endsWith("rpy_deg")
      ? ["roll", "pitch", "yaw"]
      : ["x", "y", "z"];
  const id = idOf(field.path);
  const inputs = names.map((name) => numberInput(`${id}-${name}`));
  const parts = names.map((name, i) =>
    make("label", { className: "part", for: inputs[i].id }, make("span", {}, name), inputs[i]),
  );
  return {
    node: make("div", { id, className: "vector", role: "group" }, ...parts),
    inputs,
    read: () => inputs.map((input) => typedNumber(input)),
    write: (values) => inputs.forEach((input, i) => (input.value = plainNumber(values[i]))),
    at: (rest) => inputs[indexIn(rest)] ?? inputs[0],
  };
}

/** One of a few words, or a vector of one's own. */
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
  };
}

/**
 * A table with as many rows as its default: rows of named numbers, of numbers, or single numbers.
 */
function table(field) {
  const id = idOf(field.path);
  const sample = field.default[0];
  const columns =
    typeof sample !== "object" ? [null] : Object.keys(sample).sort((a, b) => DH_ORDER.indexOf(a) - DH_ORDER.indexOf(b));
  const heads = columns[0] === null ? [""] : Array.isArray(sample) ? ["lowest", "highest"] : columns.map(heading);
  const rowName = (row) => (field.path.startsWith("robot.") ? `J${row + 1}` : `${row + 1}`);
  const cells = field.default.map((_, row) =>
    columns.map((key, column) => {
      const input = numberInput(`${id}-${row}${key === null ? "" : `-${key}`}`);
      input.setAttribute("aria-label", [rowName(row), heads[column]].filter(Boolean).join(", "));
      return input;
    }),
  );
  const body = cells.map((row, i) =>
    make("tr", {}, make("th", { scope: "row" }, rowName(i)), ...row.map((input) => make("td", {}, input))),
  );
  const head =
    columns[0] === null
      ? ""
      : make("thead", {}, make("tr", {}, make("td"), ...heads.map((name) => make("th", { scope: "col" }, name))));
  return {
    node: make("table", { id, className: "cells" }, head, make("tbody", {}, ...body)),
    inputs: cells.flat(),
    read: () =>
      cells.map((row) => {
        const values = row.map((input) => typedNumber(input));
        if (columns[0] === null) return values[0];
        return Array.isArray(sample) ? values : Object.fromEntries(columns.map((key, i) => [key, values[i]]));
      }),
    write: (rows) =>
      cells.forEach((row, i) =>
        row.forEach((input, c) => (input.value = plainNumber(columns[c] === null ? rows[i] : rows[i]?.[columns[c]]))),
      ),
    at(rest) {
      const row = cells[indexIn(rest)] ?? cells[0];
      const column = columns.findIndex(
        (key) => key !== null && (rest.endsWith(`.${key}`) || rest.endsWith(`][${key}]`)),
      );
      return row[Math.max(0, column)];
    },
  };
}

/** Ortho-parallel parameters: seven lengths, then sign and zero offset of each joint. */
function lengths(field) {
  const id = idOf(field.path);
  const scalars = Object.keys(field.default).filter((key) => key.endsWith("_mm"));
  const inputs = scalars.map((key) => numberInput(`${id}-${key}`));
  const parts = scalars.map((key, i) =>
    make("label", { className: "part", for: inputs[i].id }, make("span", {}, key.replace("_mm", "")), inputs[i]),
  );
  const joints = table({
    path: field.path,
    default: field.default.joint_sign.map((sign, i) => ({
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
      const rows = joints.read();
      const values = scalars.map((key, i) => [key, typedNumber(inputs[i])]);
      return {
        ...Object.fromEntries(values),
        joint_sign: rows.map((row) => row.joint_sign),
        joint_offset_deg: rows.map((row) => row.offset_deg),
      };
    },
    write(value) {
      scalars.forEach((key, i) => (inputs[i].value = plainNumber(value[key])));
      joints.write(value.joint_sign.map((sign, i) => ({ joint_sign: sign, offset_deg: value.joint_offset_deg[i] })));
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
  };
}

function text(field) {
  const input = make("input", { id: idOf(field.path), spellcheck: false, type: "text" });
  return single(
    field,
    input,
    () => input.value,
    (value) => (input.value = value),
  );
}

/** The text of a program, of which there is one. */
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

/** Rows of as many numbers as `names`, a line each. */
function rows(field, names) {
  const input = make("textarea", {
    id: idOf(field.path),
    rows: field.default.length ? 8 : 2,
    spellcheck: false,
    placeholder: names.join(", "),
  });
  const read = () => {
    const lines = input.value
      .split("\n")
      .map((line, i) => ({ line: line.trim(), number: i + 1 }))
      .filter(({ line }) => line);
    return lines.map(({ line, number }) => {
      const values = line.split(line.includes(";") ? ";" : /[,\s]+/).map((part) => parseNumber(part));
      if (values.length !== names.length || values.some(Number.isNaN)) {
        throw new Mistake(`Line ${number}: the numbers ${names.join(", ")} are needed.`, input);
      }
      return values;
    });
  };
  return single(field, input, read, (rows) => (input.value = rows.map((row) => row.join(", ")).join("\n")));
}

const indexIn = (rest) => Number(/^\[(\d+)\]/.exec(rest)?.[1] ?? 0);

/** "theta_offset_deg" as a column heading: "theta offset, deg". */
function heading(key) {
  if (key === "joint_sign") return "sign";
  const at = key.lastIndexOf("_");
  return `${key.slice(0, at).replaceAll("_", " ")}, ${key.slice(at + 1)}`;
}
