// A pinned result, A, beside the shown one, B: every figure with its difference, the inputs that
// differ, the curves in the charts. It stays pinned in this tab when the page is loaded again.

import { setBeside } from "../chart/panel.js";
import { byId, make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { Pinned } from "./pinned.js";
import { forceText, lengthText } from "../page/units.js";
import { inWords } from "../form/field-text.js";

const signed = (value, text) => `${value < 0 ? "\u2212" : "+"}${text(Math.abs(value))}`;
const FIGURES = {
  "before-max": { of: ({ before_mm }) => before_mm.both.max, text: lengthText },
  "expected-p50": { of: ({ expected_mm }) => expected_mm.p50, text: lengthText },
  force: { of: ({ mean_force_n }) => Math.hypot(...mean_force_n), text: forceText },
  duration: { of: ({ duration_s }) => duration_s, text: formatNumber },
};

const KEY = "armill-pin";

let pinned = null; // { json, summary, values }: values draws its charts

/** The pinned result, or null. */
export const pinnedResult = () => pinned;

/** Pins the shown result, `{ text, job, summary }`. */
export function pin(shown) {
  pinned?.values.stop();
  pinned = { text: shown.text, summary: shown.summary, values: new Pinned(shown.text) };
  keep(shown.text);
  showCompared(shown);
}

export function unpin(shown) {
  pinned?.values.stop();
  pinned = null;
  keep(null);
  showCompared(shown);
}

/** Pins again what was pinned before a reload. `current()` is the shown result. */
export async function restorePin(current) {
  const text = kept();
  if (!text) return;
  const values = new Pinned(text);
  try {
    const summary = await values.summary();
    if (pinned) return values.stop();
    pinned = { text, summary, values };
    showCompared(current());
  } catch {
    values.stop(); // an older Armill's job, perhaps
    keep(null);
  }
}

function kept() {
  try {
    return sessionStorage.getItem(KEY);
  } catch {
    return null; // denied
  }
}

function keep(json) {
  try {
    if (json === null) sessionStorage.removeItem(KEY);
    else sessionStorage.setItem(KEY, json);
  } catch {
    // Denied or full: it is pinned until the page is left.
  }
}

/** Shows what is compared: the pinned result with `shown`. */
export function showCompared(shown) {
  const box = byId("compare");
  box.hidden = !pinned;
  for (const [id, figure] of Object.entries(FIGURES)) showFigure(byId(id), figure, shown);
  if (pinned) showInputs(box, shown);
  setBeside(pinned && pinned.text !== shown.text ? pinned.values : null);
}

function showFigure(output, { of, text }, shown) {
  const cell = output.closest(".number");
  cell.querySelector(".versus")?.remove();
  if (!pinned) return;
  const [a, b] = [of(pinned.summary), of(shown.summary)];
  const change = b - a;
  const share =
    a === 0 || change === 0 ? "" : `(${signed((100 * change) / a, (percent) => formatNumber(percent, 2))}\u00a0%)`;
  const difference = change === 0 ? "no change" : `${signed(change, text)} ${share}`;
  const line = make(
    "dd",
    { className: "sub versus" },
    make("strong", {}, "A"),
    ` ${text(a)} `,
    make("span", {}, `B − A ${difference}`),
  );
  line.dataset.value = String(change);
  cell.append(line);
}

function showInputs(box, shown) {
  const differences = shown.job.differences(JSON.parse(pinned.text));
  const count = differences.length;
  byId("compare-title").textContent =
    count === 0
      ? "A is pinned. Change an input, and the next result appears beside it as B."
      : `A is pinned, B is shown: ${count === 1 ? "one input differs" : `${count} inputs differ`}.`;
  const rows = differences.map(({ field, own, other }) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, field.label),
      make("td", {}, inWords(field, other)),
      make("td", {}, inWords(field, own)),
    ),
  );
  const table = box.querySelector("table");
  table.hidden = count === 0;
  table.tBodies[0].replaceChildren(...rows);
}
