// What the feed rule gains over the programmed feed: a sentence, and its figures side by side.

import { byId, make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { errorText, forceText, forceUnit, lengthUnit } from "../page/units.js";

/** @import { FeedOutcome, FeedRuleGain } from "../../pkg/armill.js" */

/** @type {[name: string, unit: () => string, key: keyof FeedOutcome, text: (value: number) => string][]} */
const ROWS = [
  ["Largest mean force", forceUnit, "largest_force_n", forceText],
  ["Force, mean", forceUnit, "mean_force_n", forceText],
  ["Largest contour error before", lengthUnit, "largest_error_mm", errorText],
  ["Time", () => "s", "time_s", (value) => formatNumber(value)],
];

/**
 * Writes a summary's `feed_rule`, or hides where it would stand.
 * @param {FeedRuleGain | undefined} gain
 */
export function showFeedRule(gain) {
  byId("feed-gain").hidden = byId("feed-figures").hidden = !gain;
  byId("feed-gain").textContent = gain?.sentence ?? "";
  /**
   * @param {number} value
   * @param {(value: number) => string} text
   */
  const cell = (value, text) => {
    const td = make("td", {}, text(value));
    td.dataset.value = String(value);
    return td;
  };
  /** @param {FeedRuleGain} gain */
  const rows = (gain) =>
    ROWS.map(([name, unit, key, text]) =>
      make(
        "tr",
        {},
        make("th", { scope: "row" }, `${name} `, make("span", { className: "unit" }, unit())),
        cell(gain.programmed[key], text),
        cell(gain.constant_force[key], text),
      ),
    );
  byId("feed-figures").tBodies[0].replaceChildren(...(gain ? rows(gain) : []));
}
