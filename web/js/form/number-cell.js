// A text input for one number. It remembers the value that it was given: what is only looked at, in
// whatever unit and however rounded, comes back bit for bit.

import { make } from "../page/dom.js";
import { plainNumber, stepped } from "../page/number.js";
import { NotAQuantity, isPlain } from "./quantity.js";
import { shownUnit, shownValue, typedAsShown, typedValue } from "./shown.js";

/** What is wrong with what was typed, in which input, and the texts that it may have meant. */
export class Mistake extends Error {
  /**
   * @param {string} message
   * @param {HTMLInputElement | HTMLTextAreaElement} [input]
   * @param {string[]} [readings]
   */
  constructor(message, input, readings = []) {
    super(message);
    this.input = input;
    this.readings = readings;
  }
}

/**
 * @typedef {{
 *   input: HTMLInputElement,
 *   read(): number,
 *   write(value: number | undefined): void,
 *   step(count: number): void,
 *   push(shown: number): void,
 *   understood(): string,
 *   relabel(): void,
 * }} Cell
 */

/**
 * What `read` returns; what is no quantity becomes a Mistake of `input`.
 * @template T
 * @param {HTMLInputElement | HTMLTextAreaElement} input
 * @param {() => T} read
 */
export function mistaken(input, read) {
  try {
    return read();
  } catch (error) {
    if (error instanceof NotAQuantity) throw new Mistake(error.message, input, error.readings);
    throw error;
  }
}

/**
 * An input for a number of the job in `unit`: `{ input, read(), write(value), step(count), push(shown), understood(), relabel() }`. read()
 * throws a Mistake; understood() is what was read of an expression, "" of a plain number.
 * @param {string} id
 * @returns {Cell}
 */
export function numberCell(id, unit = "", whole = false) {
  const input = make("input", { id, type: "text", inputMode: whole ? "numeric" : "decimal", className: "value" });
  /** @type {{ text: string, value?: number }} */
  let written = { text: "" };

  function read() {
    if (written.value !== undefined && input.value === written.text) return written.value;
    const value = mistaken(input, () => typedValue(input.value, unit));
    if (whole && !Number.isInteger(value)) throw new Mistake("A whole number is needed here.", input);
    return value;
  }

  /** @param {number | undefined} value */
  function write(value) {
    written = { text: typeof value === "number" ? plainNumber(shownValue(value, unit)) : "", value };
    input.value = written.text;
  }

  /**
   * Changes the number by some steps at once: an "input" whose detail says that nothing is being typed.
   * @param {number} count
   */
  function step(count) {
    let value = shownOr(undefined);
    if (value === undefined) return;
    for (let i = 0; i < Math.abs(count); i++) value = stepped(value, count > 0 ? 1 : -1, whole);
    push(value);
  }

  /** @param {number} value */
  function push(value) {
    input.value = plainNumber(value);
    input.dispatchEvent(new CustomEvent("input", { bubbles: true, detail: "stepped" }));
  }

  /**
   * What is typed, in the shown unit; `otherwise` where that is no quantity.
   * @param {undefined} [otherwise]
   */
  function shownOr(otherwise) {
    try {
      return typedAsShown(input.value, unit);
    } catch {
      return otherwise;
    }
  }

  function understood() {
    const value = input.disabled || isPlain(input.value) ? undefined : shownOr(undefined);
    return value === undefined ? "" : `${plainNumber(Number(value.toPrecision(7)))} ${shownUnit(unit)}`.trim();
  }

  input.addEventListener("keydown", (event) => {
    const direction = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (!direction || event.altKey || event.ctrlKey || event.metaKey || shownOr(undefined) === undefined) return;
    event.preventDefault();
    step(direction);
  });
  // Once it is left, an expression is the number that it stands for.
  input.addEventListener("change", () => shownOr(undefined) !== undefined && isLegal() && write(read()));

  function isLegal() {
    try {
      return Number.isFinite(read());
    } catch {
      return false;
    }
  }

  /** Writes what it was given in the units of the settings; what is being typed stays. */
  const relabel = () => {
    if (input.value === written.text) write(written.value);
  };

  return { input, read, write, step, push, understood, relabel };
}

/**
 * What was understood of several cells, of those that hold more than plain numbers.
 * @param {Cell[]} cells
 */
export const allUnderstood = (cells) =>
  cells
    .map((cell) => cell.understood())
    .filter(Boolean)
    .join(", ");
