// A slider under a number, over the values of usual jobs. Keyboards and assistive tools have the number itself,
// with its arrow keys; to them the slider would say everything twice.

import { make } from "../page/dom.js";
import { shownValue } from "./shown.js";

const STEPS = 400;
const DIGITS = 2; // of a value that is slid to

/**
 * Where a value is between `low` and `high`, from 0 to 1, on a logarithmic scale; at an end beyond it.
 * @param {number} value
 * @param {[number, number]} pair
 */
export const placeOf = (value, [low, high]) =>
  value > low ? Math.min(1, Math.log(value / low) / Math.log(high / low)) : 0;

/**
 * The value at a place.
 * @param {number} place
 * @param {[number, number]} pair
 */
export const valueAt = (place, [low, high]) => low * (high / low) ** place;

/**
 * A slider for a number cell whose unit is `unit`, over `usual`.
 * @param {import("./number-cell.js").Cell} cell
 * @param {string} unit
 * @param {[number, number]} usual
 */
export function makeSlider(cell, unit, usual) {
  const node = make("input", {
    type: "range",
    className: "slider",
    min: "0",
    max: String(STEPS),
    step: "1",
    tabIndex: -1,
    "aria-hidden": "true",
  });
  let sliding = false;

  /** Follows the number, but not its own rounding while it is slid. */
  function follow() {
    if (sliding) return;
    try {
      node.value = String(Math.round(STEPS * placeOf(cell.read(), usual)));
    } catch {
      // What is typed is no number yet.
    }
  }

  node.addEventListener("input", (event) => {
    event.stopPropagation(); // the number's own "input" is the edit
    sliding = true;
    cell.push(Number(shownValue(valueAt(Number(node.value) / STEPS, usual), unit).toPrecision(DIGITS)));
    sliding = false;
  });
  node.addEventListener("change", (event) => (event.stopPropagation(), follow()));
  cell.input.addEventListener("input", follow);
  return { node, follow };
}
