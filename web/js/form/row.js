// A field on the page: its editor with label and unit, help, note, error, and the way back to the default.

import { make } from "../page/dom.js";
import { LIMITED } from "../study/question.js";
import { scrub } from "./drag-number.js";
import { idOf } from "./editors.js";
import { asText, helpText } from "./field-text.js";
import { shownUnits } from "./shown.js";

/**
 * @import { Field } from "../../pkg/armill.js"
 * @import { Editor } from "./editors.js"
 */

/** @typedef {{ label: string, go(): void }} Limit the nearest number that is allowed */

/**
 * `message` is the error beside the field; `mistake` says that what is typed is no value, `line` which line of a text
 * is wrong. Only `setError` changes them.
 *
 * @typedef {{
 *   field: Field,
 *   editor: Editor,
 *   node: HTMLElement,
 *   reset: HTMLElement,
 *   error: HTMLElement,
 *   note: HTMLElement,
 *   unit: HTMLElement,
 *   help: HTMLElement,
 *   understood: HTMLElement,
 *   mistake: boolean,
 *   message: string,
 *   limit?: Limit,
 *   line?: number,
 * }} Row
 */

/**
 * What is called when a row is used: `typing` while a text is being typed, `stepped` if it is a number that is dragged
 * or stepped; `frame` is the path of the frame that a pasted text may be.
 *
 * @typedef {{
 *   edited(row: Row, typing: boolean, stepped: boolean): void,
 *   reset(row: Row): void,
 *   swapUnit(row: Row, other: Field): void,
 *   paste(frame: string, event: ClipboardEvent): void,
 * }} Acts
 */

/**
 * The row of a field; `other` is the one that holds the same quantity in another unit.
 * @param {Field} field
 * @param {Editor} editor
 * @param {Field | undefined} other
 * @param {Acts} acts
 * @returns {Row}
 */
export function makeRow(field, editor, other, acts) {
  const id = idOf(field.path);
  const grouped = editor.node.getAttribute("role") === "group" || editor.node.tagName === "TABLE";
  const title = make(grouped ? "span" : "label", { className: "label", id: `${id}-label` }, field.label);
  if (grouped) editor.node.setAttribute("aria-labelledby", title.id);
  else title.setAttribute("for", editor.inputs[0].id);
  const unit = other ? unitButton(field, other, () => acts.swapUnit(row, other)) : make("span", { className: "unit" });
  if (field.unit) title.append(" ", unit);
  const reset = make("button", { type: "button", className: "reset" }, "↺");
  const help = make("p", { className: "help", id: `${id}-help`, hidden: true });
  const understood = make("output", { className: "understood", htmlFor: id });
  const note = make("p", { className: "note", id: `${id}-note` });
  const error = make("p", { className: "error", id: `${id}-error` });
  for (const input of editor.inputs) input.setAttribute("aria-describedby", `${id}-error ${id}-help`);
  const wide = grouped || editor.inputs[0].tagName === "TEXTAREA" || field.kind === "text" || editor.inputs.length > 1;
  const node = make(
    "div",
    { className: wide ? "field wide" : "field" },
    make(
      "div",
      { className: "head" },
      title,
      ...(LIMITED.includes(field.path) ? [limitButton(field)] : []),
      helpButton(field, help),
      reset,
    ),
    editor.node,
    editor.slider ?? "",
    understood,
    error,
    help,
    note,
  );
  /** @type {Row} */
  const row = { field, editor, node, reset, unit, help, understood, error, note, mistake: false, message: "" };
  label(row);
  // Some assistive tools and drivers choose an option with "change" alone.
  const kind = editor.inputs.some(({ tagName }) => tagName === "SELECT") ? "change" : "input";
  node.addEventListener(kind, (event) => {
    const { target, detail } = /** @type {CustomEvent} */ (event);
    const box = isBox(/** @type {HTMLInputElement} */ (target));
    acts.edited(row, kind === "input" && !box, detail === "stepped");
  });
  const frame = /^(.*_frame)\./.exec(field.path)?.[1];
  if (frame) node.addEventListener("paste", (event) => acts.paste(frame, event));
  if (editor.step) scrub(title, (count) => editor.step?.(count));
  reset.addEventListener("click", () => acts.reset(row));
  return row;
}

/**
 * Asks for the largest value of a field: an event "limit" with its path.
 * @param {Field} field
 */
function limitButton({ path, label: name }) {
  const title = `Largest ${name.toLowerCase()} for the tolerance`;
  const button = make("button", { type: "button", className: "limit", title, "aria-label": `${title}: max?` }, "max?");
  button.addEventListener("click", () =>
    button.dispatchEvent(new CustomEvent("limit", { bubbles: true, detail: path })),
  );
  return button;
}

/**
 * Writes what a row says of itself, in the units of the settings.
 * @param {Row} row
 */
export function label({ field, editor, unit, reset, help }) {
  if (unit.tagName !== "BUTTON") unit.textContent = shownUnits(editor.unit?.() ?? field.unit);
  reset.title = `Back to ${asText(field)}`;
  reset.setAttribute("aria-label", `Reset ${field.label} to ${asText(field)}`);
  help.textContent = [helpText(field), editor.meaning?.()].filter(Boolean).join(" ");
}

/**
 * Shows an error, or none if `message` is empty. It is about `input`, or about the whole row without one.
 * @param {Row} row
 * @param {string} message
 * @param {{ input?: HTMLElement, mistake?: boolean, line?: number, limit?: Limit }} [more]
 */
export function setError(row, message, { input, mistake = false, line, limit } = {}) {
  Object.assign(row, { message, mistake, line, limit });
  row.error.textContent = message;
  for (const each of row.editor.inputs) {
    if (message && (each === input || !input)) each.setAttribute("aria-invalid", "true");
    else each.removeAttribute("aria-invalid");
  }
}

/**
 * What each input of a row holds.
 * @param {Row} row
 * @returns {any[]}
 */
export const typedIn = ({ editor }) => editor.inputs.map((input) => (isBox(input) ? input.checked : input.value));

/**
 * Puts that back.
 * @param {Row} row
 * @param {any[]} texts
 */
export function retype({ editor }, texts) {
  editor.inputs.forEach((input, i) => {
    input.disabled = false;
    if (isBox(input)) input.checked = texts[i];
    else input.value = texts[i] ?? "";
  });
}

/**
 * Opens the group that a row is in.
 * @param {Row} row
 */
export function unfold({ node }) {
  const group = node.closest("details");
  if (group) group.open = true;
}

/**
 * Leads to what is wrong in a row.
 * @param {Row} row
 */
export function goTo(row) {
  unfold(row);
  const input = row.editor.inputs.find((each) => each.getAttribute("aria-invalid")) ?? row.editor.inputs[0];
  input.focus();
  input.scrollIntoView({ block: "center" });
  if (row.line) row.editor.show?.(row.line);
}

/**
 * @param {Field} field
 * @param {Field} other
 * @param {() => void} swap
 */
function unitButton(field, other, swap) {
  const button = make("button", { type: "button", className: "unit", title: `Give it in ${other.unit}` }, field.unit);
  button.setAttribute("aria-label", `${field.unit}; give it in ${other.unit} instead`);
  button.addEventListener("click", swap);
  return button;
}

/**
 * Shows and hides a field's help. Screen readers have it with the field in either case.
 * @param {Field} field
 * @param {HTMLElement} help
 */
function helpButton(field, help) {
  const button = make(
    "button",
    { type: "button", className: "explain", "aria-expanded": "false", "aria-controls": help.id },
    "?",
  );
  button.setAttribute("aria-label", `Explain ${field.label}`);
  button.addEventListener("click", () => {
    help.hidden = !help.hidden;
    button.setAttribute("aria-expanded", String(!help.hidden));
  });
  return button;
}

/** @param {HTMLInputElement} input */
const isBox = (input) => input.type === "checkbox";
