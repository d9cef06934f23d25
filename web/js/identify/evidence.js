// The view Evidence: what others measured, beside what the model says of it, computed when the view is first seen.

import { readText } from "../core/assets.js";
import { Figure } from "../chart/figure.js";
import { debounced, make, sentence } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { onSetting } from "../page/settings.js";
import { ask } from "./ask.js";

/** @import { ChartOptions, ChartUnits, Evidence } from "../../pkg/armill.js" */

const texts = (/** @type {string[]} */ ...names) => Promise.all(names.map((name) => readText(`examples/${name}`)));

/** What is shown, by the core's kinds, and the measured data of each. */
const KINDS = {
  loads: () => texts("identify-fanuc-r2000ic.json", "identify-fanuc-r2000ic.csv"),
  encoders: () => texts("gear-kuka-kr300-a.csv", "gear-kuka-kr300-b.csv"),
  slots: () => texts(),
};

/** @param {HTMLElement} node */
export function makeEvidence(node) {
  const parts = Object.entries(KINDS).map(([kind, data]) => makePart(kind, data));
  node.append(...parts.map((part) => part.node));
  return {
    look() {
      if (!node.closest("[hidden]")) for (const part of parts) part.look();
    },
  };
}

/**
 * @param {string} kind
 * @param {() => Promise<string[]>} data
 */
function makePart(kind, data) {
  const drawn = {
    chart: (/** @type {string} */ _, /** @type {ChartOptions} */ options) => ask("identified_chart", kind, options),
    chartData: (/** @type {string} */ _, /** @type {ChartUnits} */ units) => ask("identified_data", kind, units),
  };
  const node = make("section", { className: "identify evidence", id: `evidence-${kind}` }, make("p", {}, "Computing…"));
  /** @type {Figure | undefined} */
  let figure;
  let asked = false;
  const redraw = debounced(() => figure?.fits || draw(), 120);
  new ResizeObserver(() => redraw()).observe(node);
  onSetting(redraw);

  const draw = () => figure?.draw().catch(() => {}); // the next look draws again

  async function look() {
    if (asked) return void (figure && !figure.fits && draw());
    asked = true;
    try {
      /** @type {Evidence} */
      const found = await ask("identify", kind, ...(await data()));
      const chart = { name: found.key, title: "Measured and predicted", figure: "", kind: "curve" };
      figure = new Figure(/** @type {any} */ (chart), () => {}, /** @type {any} */ (drawn));
      node.replaceChildren(...show(found, figure.node));
      draw();
    } catch (error) {
      asked = false;
      node.replaceChildren(make("p", { className: "wrong", role: "alert" }, sentence(error.message)));
    }
  }

  return { node, look };
}

/**
 * @param {Evidence} found
 * @param {HTMLElement} chart
 */
function show({ title, sentence: said, rests_on: restsOn, source, heads, rows }, chart) {
  const [name, ...others] = heads;
  /** @param {Evidence["rows"][number]} row */
  const line = (row) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, row.name),
      ...row.values.map((value, at) => make("td", { "data-label": others[at] }, formatNumber(value, 3))),
    );
  const table = make(
    "table",
    { className: "evidence-rows" },
    make("thead", {}, make("tr", {}, ...[name, ...others].map((head) => make("th", { scope: "col" }, head)))),
    make("tbody", {}, ...rows.map(line)),
  );
  return [
    make("h2", {}, title),
    make("p", { className: "found" }, said),
    make("p", { className: "note" }, `Prediction: ${restsOn}`),
    chart,
    make("details", {}, make("summary", {}, `All ${rows.length} rows`), table),
    make("p", { className: "note" }, `Measured by others: ${source}.`),
  ];
}
