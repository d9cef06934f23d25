// Fields and their values in words.

import { KIENZLE, OWN } from "../job/shape.js";
import { plainNumber } from "../page/number.js";
import { shownUnit, shownUnits, shownValue } from "./shown.js";

/** @import { Field } from "../../pkg/armill.js" */

/**
 * A preset choice that also offers one's own numbers.
 * @param {Field} field
 * @returns {Field}
 */
export function withOwn(field) {
  if (!field.path.endsWith(".preset")) return field;
  const own =
    field.path === "robot.preset"
      ? [
          { value: "opw", label: "Ortho-parallel lengths", heading: "My own numbers" },
          { value: OWN, label: "Modified DH table", heading: "My own numbers" },
        ]
      : [{ value: OWN, label: "My own coefficients", heading: "My own numbers" }];
  if (field.path === "material.preset")
    own.push({ value: KIENZLE, label: "My own k_c1.1 and m_c", heading: "My own numbers" });
  return { ...field, choices: [...(field.choices ?? []), ...own] };
}

/**
 * What a word of a choice is called.
 * @param {Field} field
 * @param {string} value
 */
export const choiceLabel = (field, value) =>
  field.choices?.find((choice) => choice.value === value)?.label ?? String(value);

/** @param {string} unit */
const numberIn = (unit) => (/** @type {number} */ value) => plainNumber(shownValue(value, unit));

/**
 * A number with the unit that it is shown in.
 * @param {number} value
 * @param {string} unit
 */
export const quantity = (value, unit) => [numberIn(unit)(value), shownUnit(unit)].filter(Boolean).join(" ");

/**
 * @param {number} value
 * @param {string} unit
 */
const saved = (value, unit) => [plainNumber(value), unit].filter(Boolean).join(" ");

/**
 * A value in a few words, with its unit or name; nothing for tables and texts.
 * @param {Field} field
 * @param {any} value
 * @returns {string}
 */
export function brief(field, value) {
  if (field.kind === "set") return value.map((/** @type {string} */ one) => choiceLabel(field, one)).join(" + ");
  if (field.choices && typeof value === "string") return choiceLabel(field, value);
  if (typeof value !== "number") return "";
  return field.unit ? quantity(value, field.unit) : `${plainNumber(value)} ${field.label.toLowerCase()}`;
}

/**
 * A value in words: numbers with their unit, of tables and texts only how long they are. `asSaved` keeps the units of
 * the job.
 * @param {Field} field
 * @param {any} value
 * @returns {string}
 */
export function inWords(field, value, { asSaved = false } = {}) {
  if (value === undefined) return "–";
  if (field.kind === "set") return brief(field, value) || "none";
  if (field.choices && typeof value === "string") return choiceLabel(field, value);
  if (typeof value === "number") return (asSaved ? saved : quantity)(value, field.unit);
  if (field.kind === "vector") {
    const [number, unit] = asSaved ? [plainNumber, field.unit] : [numberIn(field.unit), shownUnit(field.unit)];
    return [value.map(number).join(", "), unit].filter(Boolean).join(" ");
  }
  if (typeof value !== "string") return `${value.length} rows`;
  return value.includes("\n") ? `${value.trimEnd().split("\n").length} lines` : value;
}

/**
 * The core's error about a number out of range, where another unit is shown than it names.
 * @param {import("../core/client.js").Failure} error
 */
export function outOfRange({ code, field: path, value = NaN, min = -Infinity, max = Infinity, unit = "" }) {
  if (code !== "out-of-range" || shownUnit(unit) === unit) return undefined;
  const [is, low, high] = [value, min, max].map((number) => quantity(number, unit));
  return `${path} is ${is}; it must be ${low} to ${high}`;
}

/**
 * The default in words.
 * @param {Field} field
 */
export const asText = (field) =>
  ["table", "text"].includes(field.kind) ? "its default" : inWords(field, field.default);

/**
 * What a field is, its range and default.
 * @param {Field} field
 */
export function helpText(field) {
  const { min, max, kind } = field;
  const mixed = field.unit.includes(", "); // a table whose range holds in the job's own units
  const number = numberIn(mixed ? "" : field.unit);
  const boundless = min !== undefined && max !== undefined && min <= -1e6 && max >= 1e6; // only there to keep arithmetic finite
  const range =
    boundless || (mixed && shownUnits(field.unit) !== field.unit)
      ? ""
      : min != null && max != null
        ? `${number(min)} to ${number(max)}`
        : min != null
          ? `At least ${number(min)}`
          : max != null
            ? `At most ${number(max)}`
            : "";
  const standard = ["table", "text"].includes(kind) ? "" : `default ${inWords(field, field.default)}`;
  const hint = [range, standard].filter(Boolean).join(", ");
  return [field.help, hint && `${hint[0].toUpperCase()}${hint.slice(1)}.`].filter(Boolean).join(" ");
}
