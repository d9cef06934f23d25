// A table of any length as text: a row of numbers a line.

import { make } from "../page/dom.js";
import { plainNumber } from "../page/number.js";
import { Mistake, mistaken } from "./number-cell.js";
import { isPlain } from "./quantity.js";
import { shownValue, typedValue } from "./shown.js";

const MIXED = "commas or spaces between the numbers, not both"; // or "1,000 5" might be three numbers

/**
 * An editor for rows of numbers; `columns` are `[name, unit]`.
 * @param {string} id
 * @param {string[][]} columns
 */
export function rowsEditor(id, columns, { lines = 2 } = {}) {
  const names = columns.map(([name]) => name).join(", ");
  const input = make("textarea", { id, rows: lines, spellcheck: false, placeholder: names });
  let written = new Map(); // text of a line -> its row in the job

  /** @param {number[]} row */
  const textOf = (row) => row.map((value, i) => plainNumber(shownValue(value, columns[i][1]))).join(", ");

  /**
   * @param {string} line
   * @param {number} number
   */
  function rowOf(line, number) {
    if (written.has(line)) return [...written.get(line)];
    const parts = partsOf(line);
    if (!parts) throw new Mistake(`Line ${number}: ${MIXED}.`, input);
    if (parts.length !== columns.length) throw new Mistake(`Line ${number}: the numbers ${names} are needed.`, input);
    return parts.map((part, i) => {
      try {
        return mistaken(input, () => typedValue(part, columns[i][1]));
      } catch (error) {
        if (error instanceof Mistake) throw new Mistake(`Line ${number}, ${columns[i][0]}: ${error.message}`, input);
        throw error;
      }
    });
  }

  const typedLines = () =>
    input.value
      .split("\n")
      .map((line, i) => ({ line: line.trim(), number: i + 1 }))
      .filter(({ line }) => line);

  return {
    node: input,
    inputs: [input],
    at: () => input,
    read: () => typedLines().map(({ line, number }) => rowOf(line, number)),
    /** @param {number[][]} rows */
    write(rows) {
      const texts = rows.map(textOf);
      written = new Map(texts.map((text, i) => [text, rows[i]]));
      input.value = texts.join("\n");
    },
    understood() {
      try {
        return typedLines()
          .filter(({ line }) => !partsOf(line)?.every(isPlain))
          .map(({ line, number }) => `line ${number}: ${textOf(rowOf(line, number))}`)
          .join("; ");
      } catch {
        return ""; // the mistake is shown instead
      }
    },
  };
}

/**
 * The parts of a line, by one kind of separator; undefined if it mixes them.
 * @param {string} line
 */
function partsOf(line) {
  if (line.includes(";")) return line.split(";");
  const words = line.split(/\s+/);
  if (!line.includes(",")) return words.every((word) => isPlain(word)) ? words : undefined;
  const parts = line.replace(/,\s*$/, "").split(",");
  const mixed = parts.some((part) => /\S\s+\S/.test(part.trim()) && part.trim().split(/\s+/).every(isPlain));
  return mixed ? undefined : parts;
}
