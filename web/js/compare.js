// A pinned result, A, beside the shown one, B: every figure with its difference, and the inputs that differ.

import { byId, make } from "./dom.js";
import { formatNumber } from "./number.js";
import { forceText, lengthText } from "./units.js";
import { inWords } from "./words.js";

const signed = (value, text) => `${value < 0 ? "\u2212" : "+"}${text(Math.abs(value))}`;
const FIGURES = {
  "before-max": { of: ({ before_mm }) => before_mm.both.max, text: lengthText },
  "after-max": { of: ({ after_mm }) => after_mm.max, text: lengthText },
  passes: { of: ({ passes }) => passes, text: formatNumber },
  force: { of: ({ mean_force_n }) => Math.hypot(...mean_force_n), text: forceText },
  duration: { of: ({ duration_s }) => duration_s, text: formatNumber },
};

let pinned = null; // { json, job, summary }

/** The pinned result, or null. */
export const pinnedResult = () => pinned;

/** Pins a result `{ json, job, summary }`, the shown one, or none. */
export function pin(shown) {
  pinned = shown;
  showCompared(shown);
}

/** Shows what is compared: the pinned result with `shown`. */
export function showCompared(shown) {
  const box = byId("compare");
  box.hidden = !pinned;
  for (const [id, figure] of Object.entries(FIGURES)) showFigure(byId(id), figure, shown);
  if (pinned) showInputs(box, shown);
}

function showFigure(output, { of, text }, shown) {
  const cell = output.closest(".number");
  cell.querySelector(".versus")?.remove();
  if (!pinned) return;
  const [a, b] = [of(pinned.summary), of(shown.summary)];
  const change = b - a;
  const share = a === 0 || change === 0 ? "" : `(${signed((100 * change) / a, (percent) => formatNumber(percent, 2))}\u00a0%)`;
  const told = change === 0 ? "no change" : `${signed(change, text)} ${share}`;
  const line = make("dd", { className: "sub versus" }, make("strong", {}, "A"), ` ${text(a)} `, make("span", {}, `B − A ${told}`));
  line.dataset.value = String(change);
  cell.append(line);
}

function showInputs(box, shown) {
  const differences = shown.job.differences(JSON.parse(pinned.json));
  const count = differences.length;
  byId("compare-title").textContent =
    count === 0 ? "A is pinned. Change an input, and the next result stands beside it as B." : `A is pinned, B is shown: ${count === 1 ? "one input differs" : `${count} inputs differ`}.`;
  const rows = differences.map(({ field, own, other }) =>
    make("tr", {}, make("th", { scope: "row" }, field.label), make("td", {}, inWords(field, other)), make("td", {}, inWords(field, own))),
  );
  const table = box.querySelector("table");
  table.hidden = count === 0;
  table.tBodies[0].replaceChildren(...rows);
}
