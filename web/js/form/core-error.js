// An error of the core beside the field that it is about.

import { sentence } from "../page/dom.js";
import { outOfRange, quantity } from "./field-text.js";
import { setError } from "./row.js";

/**
 * @import { Failure } from "../core/client.js"
 * @import { Limit, Row } from "./row.js"
 */

/**
 * Shows an error in the row that it is about. False if there is none, or it is not to be seen. `use(row, value)` puts
 * an allowed number in the place of one that is not.
 * @param {Row[]} rows
 * @param {Failure} error
 * @param {(row: Row, value: number) => void} use
 */
export function showCoreError(rows, error, use) {
  const { field: path, message, line, column } = error;
  const row = rows.find(({ field, node }) => path && !node.hidden && belongs(path, field.path));
  if (!path || !row) return false;
  const where = line && !/\bline\b/i.test(message) ? `Line ${line}${column ? `, column ${column}` : ""}: ` : "";
  const own = outOfRange(error) ?? message;
  const text = own.startsWith(path) ? row.field.label + own.slice(path.length) : sentence(own);
  const input = row.editor.at(path.slice(row.field.path.length));
  const limit = path === row.field.path ? limitOf(row, error, (value) => use(row, value)) : undefined;
  setError(row, where + text, { input, line, limit });
  if (line) row.editor.mark?.(line);
  return true;
}

/**
 * The nearest number that is allowed, and how to take it: { label, go }.
 * @param {Row} row
 * @param {Failure} error
 * @param {(value: number) => void} use
 * @returns {Limit | undefined}
 */
function limitOf({ field, editor }, { value = NaN, min, max }, use) {
  if (field.kind === "vector" || editor.inputs.length > 1) return undefined;
  const nearest = min !== undefined && value < min ? min : max;
  if (nearest === undefined) return undefined;
  return { label: `Use ${quantity(nearest, field.unit)}`, go: () => use(nearest) };
}

/**
 * Whether an error path such as "path.points_mm[3]" is about the field `own`.
 * @param {string} path
 * @param {string} own
 */
const belongs = (path, own) => path === own || (path.startsWith(own) && "[.".includes(path[own.length]));
