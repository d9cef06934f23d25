// What the charts over the run are drawn over: time, path length or program line, the same for all of
// them.

import * as core from "../core/client.js";
import { choose, setting } from "../page/settings.js";
import { ends } from "./view.js";

let apart = false; // whether a result of another duration is drawn with the shown one

/**
 * Takes over whether results of different durations are compared: those line up by length only.
 * @param {boolean} whether
 */
export const setApart = (whether) => void (apart = whether);

/** @import { ChartUnits, Over } from "../../pkg/armill.js" */

/** @returns {Over} */
const automatic = () => (apart ? "length" : "time");

/**
 * What holds for a chart that has the axes `list`.
 * @param {Over[]} list
 * @returns {Over}
 */
export function overIn(list) {
  const chosen = setting("over") === "auto" ? automatic() : /** @type {Over} */ (setting("over"));
  return list.includes(chosen) ? chosen : "time";
}

/**
 * Chooses an axis for all charts. What would hold anyway is no choice: it may change again.
 * @param {Over} over
 */
export const chooseOver = (over) => choose("over", over === automatic() ? "auto" : over);

/**
 * The range of one axis as the range of another that shows the same samples; null for all.
 * @param {[number, number] | null} range
 * @param {Over} from
 * @param {Over} to
 * @returns {Promise<[number, number] | null>}
 */
export async function carried(range, from, to) {
  if (!range) return null;
  try {
    const length = /** @type {ChartUnits["length"]} */ (setting("length"));
    /** @param {Over} over */
    const values = async (over) => (await core.chartData("coordinates", { length, over }))[0].values;
    const [before, after] = [await values(from), await values(to)];
    const [low, high] = ends(before, { min: range[0], max: range[1] }).map((index) => after[index]);
    return high > low ? [low, high] : null;
  } catch {
    return null; // the new result has no such axis, or a newer one comes
  }
}
