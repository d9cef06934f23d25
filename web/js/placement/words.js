// Places of a map in words.

import { shownUnit, shownValue } from "../form/shown.js";
import { plainNumber } from "../page/number.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { rangeOf } from "./around.js";
import { AXES } from "./grid.js";
import { MARKS } from "./map.js";

/**
 * @import { Around } from "./around.js"
 * @import { Layer } from "./grid.js"
 * @import { Measure, Place } from "./map.js"
 */

/**
 * A coordinate to a tenth of a millimetre or a hundredth of an inch.
 * @param {number} mm
 */
export function coordinate(mm) {
  const places = shownUnit("mm") === "mm" ? 10 : 100;
  return plainNumber(Math.round(shownValue(mm, "mm") * places) / places);
}

/**
 * A length with its unit.
 * @param {number} mm
 */
const length = (mm) => `${lengthText(mm)} ${lengthUnit()}`;

/**
 * Where a layer is: "z 700 mm".
 * @param {{ axes: number[], layers: Layer[] }} map
 * @param {number} layer
 */
export const layerName = ({ axes, layers }, layer) =>
  `${AXES[axes[2]]} ${coordinate(layers[layer].fixed)} ${shownUnit("mm")}`;

/**
 * Where a cell is: "x 300, y -20 mm", and with several layers "x 300, y -20, z 700 mm".
 * @param {{ axes: number[], columns: number[], rows: number[], layers: Layer[] }} map
 * @param {number} i
 * @param {number} k
 * @param {number} layer
 */
export const spot = (map, i, k, layer) =>
  `${AXES[map.axes[0]]} ${coordinate(map.columns[i])}, ${AXES[map.axes[1]]} ${coordinate(map.rows[k])}` +
  (map.layers.length > 1 ? `, ${layerName(map, layer)}` : ` ${shownUnit("mm")}`);

/**
 * From where to where the part is: "x 200 to 400, y -100 to 60 mm".
 * @param {Around} around
 * @param {number[]} axes
 * @param {[number, number]} place of its frame in the plane [mm]
 */
export function reaches(around, axes, place) {
  const along = place.map((from, n) => {
    const [low, high] = rangeOf(around, axes[n], from);
    return `${AXES[axes[n]]} ${coordinate(low)} to ${coordinate(high)}`;
  });
  return `${along.join(", ")} ${shownUnit("mm")}`;
}

/**
 * What the part would be like there.
 * @param {Place} place
 */
export function prospect({ max, mean, mark, p95 }) {
  if (mark === 3) return MARKS[3];
  const also = mark ? `; ${MARKS[mark]}` : "";
  return (
    `before compensation at most ${length(max)}, mean ${length(mean)}; ` +
    `after it at most ${length(p95)} in 95 of 100${also}`
  );
}

/**
 * The error that counts, in words.
 * @param {Place} place
 * @param {Measure} measure
 */
export const errorWords = (place, measure) =>
  `at most ${length(place[measure])} off the path ` +
  (measure === "max" ? "before compensation" : "after compensation in 95 of 100");

/**
 * A place and how far off the path the tip would be.
 * @param {string} where
 * @param {Place} place
 * @param {Measure} measure
 */
export const sized = (where, place, measure) => `${where}, ${errorWords(place, measure)}`;
