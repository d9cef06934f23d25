// Places of a map in words.

import { shownUnit, shownValue } from "../form/shown.js";
import { plainNumber } from "../page/number.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { AXES } from "./grid.js";
import { MARKS } from "./map.js";

/** @import { Place } from "./map.js" */

/**
 * A coordinate to a tenth of a millimetre or a hundredth of an inch.
 * @param {number} mm
 */
export function coordinate(mm) {
  const places = shownUnit("mm") === "mm" ? 10 : 100;
  return plainNumber(Math.round(shownValue(mm, "mm") * places) / places);
}

/**
 * Where a cell is: "x 300, y -20 mm".
 * @param {{ axes: number[], columns: number[], rows: number[] }} map
 * @param {number} i
 * @param {number} k
 */
export const spot = ({ axes, columns, rows }, i, k) =>
  `${AXES[axes[0]]} ${coordinate(columns[i])}, ${AXES[axes[1]]} ${coordinate(rows[k])} ${shownUnit("mm")}`;

/**
 * What the part would be like there.
 * @param {Place} place
 */
export function prospect({ max, mean, mark }) {
  if (mark === 3) return MARKS[3];
  const also = mark ? `; ${MARKS[mark]}` : "";
  return `at most ${lengthText(max)} ${lengthUnit()}, mean ${lengthText(mean)}${also}`;
}

/**
 * A place and how far off the path the tip would be.
 * @param {string} where
 * @param {Place} place
 */
export const sized = (where, { max }) =>
  `${where}, at most ${lengthText(max)} ${lengthUnit()} off the path before compensation`;
