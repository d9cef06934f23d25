// What the charts over the run are drawn over: time, path length or program line, the same for all of
// them.

import * as core from "../core/client.js";
import { choose, setting } from "../page/settings.js";
import { ends } from "./view.js";

let apart = false; // whether a result of another duration is drawn with the shown one

/** Takes over whether results of different durations are compared: those line up by length only. */
export const setApart = (whether) => void (apart = whether);

const automatic = () => (apart ? "length" : "time");

/** What holds for a chart that has the axes `list`. */
export function overIn(list) {
  const chosen = setting("over") === "auto" ? automatic() : setting("over");
  return list.includes(chosen) ? chosen : "time";
}

/** Chooses an axis for all charts. What would hold anyway is no choice: it may change again. */
export const chooseOver = (over) => choose("over", over === automatic() ? "auto" : over);

/** The range of one axis as the range of another that shows the same samples; null for all. */
export async function carried(range, from, to) {
  if (!range) return null;
  try {
    const values = async (over) => (await core.chartData("coordinates", { length: setting("length"), over }))[0].values;
    const [before, after] = [await values(from), await values(to)];
    const [low, high] = ends(before, { min: range[0], max: range[1] }).map((index) => after[index]);
    return high > low ? [low, high] : null;
  } catch {
    return null; // the new result has no such axis, or a newer one comes
  }
}
