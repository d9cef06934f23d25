// Values of the job in the units of the settings. The job itself stays in mm, mm/s and N.

import { setting } from "../page/settings.js";
import { convert, readQuantity } from "./quantity.js";

const DIGITS = 7; // of a converted value; what is not edited keeps all of its own

/** @type {Record<string, string>} */
const INCH = { mm: "in", "mm/s": "in/s", "mm/s²": "in/s²" };
/** @type {Record<string, string>} */
const PER_MINUTE = { "mm/s": "mm/min", "in/s": "in/min" };

/**
 * The unit in which values of a field's unit are shown and typed.
 * @param {string} unit
 */
export function shownUnit(unit) {
  if (unit === "N") return setting("force");
  const length = (setting("length") === "inch" && INCH[unit]) || unit;
  return (setting("feed") === "minute" && PER_MINUTE[length]) || length;
}

/**
 * The units of a table, separated by commas, as they are shown.
 * @param {string} units
 */
export const shownUnits = (units) => units.split(", ").map(shownUnit).join(", ");

/**
 * A value of the job as a number in the shown unit.
 * @param {number} value
 * @param {string} unit
 */
export const shownValue = (value, unit) => convert(value, unit, shownUnit(unit), DIGITS);

/**
 * What was typed, as a value of the job. Throws NotAQuantity.
 * @param {string} text
 * @param {string} unit
 */
export const typedValue = (text, unit) => readQuantity(text, unit, shownUnit(unit));

/**
 * What was typed, in the shown unit. Throws NotAQuantity.
 * @param {string} text
 * @param {string} unit
 */
export const typedAsShown = (text, unit) => readQuantity(text, shownUnit(unit));
