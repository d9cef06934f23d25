// What the picture shows, in words and numbers: at the cursor, and as a whole.

import { make } from "../page/dom.js";
import { lineAt } from "../page/program-lines.js";
import { inLength, lengthText, lengthUnit } from "../page/units.js";
import { length } from "./camera.js";

/** @import { Summary, SurfaceFigures } from "../../pkg/armill.js" */

/** @param {number} mm */
const withUnit = (mm) => `${lengthText(mm)} ${lengthUnit()}`;

/**
 * The line of the program that runs at a time, or else the time.
 * @param {number} time
 */
export function momentText(time) {
  const line = lineAt(time);
  return line ? `line ${line}` : `${time.toFixed(2)} s`;
}

export class Readout {
  #moment = make("span", { className: "moment" });
  #errors = make("span");
  #place = make("span", { className: "place" });
  node = make("p", { className: "read" }, this.#moment, this.#errors, this.#place);
  text = make("p", { id: "scene-text", className: "hidden-text" });

  /**
   * Reads the row of the paths at the cursor.
   * @param {number} time
   * @param {import("./paths.js").Paths} paths
   * @param {number} row
   */
  at(time, paths, row) {
    const line = lineAt(time);
    const [before, after] = [paths.before(row), paths.after(row)].map((way) => withUnit(length(way)));
    const [x, y, z] = [...paths.desired(row)].map(coordinate);
    set(this.#moment, `At ${time.toFixed(2)} s${line ? `, line ${line} of the program` : ""}: contour `);
    set(this.#errors, `error ${before} before, ${after} after`);
    set(this.#place, `; x ${x}, y ${y}, z ${z} ${lengthUnit()}`);
  }

  /**
   * What a new result, or another unit, changes.
   * @param {Summary} summary
   * @param {number} largest
   * @param {number} factor
   */
  describe({ path_length_mm, after_mm, surface }, largest, factor) {
    const left = surface?.worst_after_mm === undefined ? "" : ` ${leftText(surface)}`;
    set(
      this.text,
      `The desired path is ${lengthText(path_length_mm, 4)} ${lengthUnit()} long. The actual path leaves it by at most ` +
        `${withUnit(largest)} before compensation and ${withUnit(after_mm.max)} after; the deviation is drawn ${factor} ` +
        `times as large as it is.${left} The charts show the same paths.`,
    );
  }
}

/**
 * @param {HTMLElement} node
 * @param {string} words
 */
const set = (node, words) => node.textContent !== words && (node.textContent = words);

/** @param {number} mm */
const coordinate = (mm) =>
  inLength(mm)
    .toFixed(lengthUnit() === "mm" ? 1 : 3)
    .replace("-", "\u2212");

/**
 * What the surface of the part says to those who do not see it.
 * @param {SurfaceFigures} surface
 */
const leftText = ({ worst_before_mm = 0, worst_after_mm = 0 }) =>
  `The part is coloured by the deviation of its surface, at most ${withUnit(worst_before_mm)} before and ` +
  `${withUnit(worst_after_mm)} after compensation.`;
