// A chart as a table: some of its samples, the extremes among them.

import { make } from "../page/dom.js";
import { columnsOf, read, readAlong } from "./readout.js";
import { ends } from "./view.js";

/**
 * @import { Axis, ChartColumn } from "../../pkg/armill.js"
 * @import { Content } from "./readout.js"
 */

const ROWS = 16; // besides the extremes

/**
 * The table of the samples between the ends of the shown range.
 * @param {Content} content
 * @param {{ x: Axis }} axes
 */
export function tableOf({ chart, data, hidden }, { x }) {
  const [first] = data;
  const columns = columnsOf(chart, data).flatMap((group, i) => (hidden.includes(chart.series[i].key) ? [] : group));
  const [from, to] = chart.camera ? [0, first.values.length - 1] : ends(first.values, x);
  const extremes = columns.map(({ values }) => extremesOf(values, from, to));
  const even = Array.from({ length: Math.min(ROWS, to - from + 1) }, (_, k, n = Math.min(ROWS, to - from + 1)) =>
    Math.round(from + (k * (to - from)) / Math.max(1, n - 1)),
  );
  const rows = [...new Set([...even, ...extremes.flatMap(({ low, high }) => [low, high])])].sort((a, b) => a - b);
  /** @param {ChartColumn} column */
  const head = ({ label, unit }) =>
    make("th", { scope: "col" }, label, unit && make("span", { className: "unit" }, ` ${unit}`));
  /**
   * @param {ChartColumn} column
   * @param {number} k
   * @param {number} index
   */
  const cell = (column, k, index) => {
    const { low, high } = extremes[k];
    const mark = low === high ? "" : index === low ? "min" : index === high ? "max" : "";
    const value = make("td", {}, read(column.values[index], column.unit), mark && make("strong", {}, mark));
    value.dataset.value = String(column.values[index]);
    return value;
  };
  const caption = `${chart.title}: ${rows.length} of ${to - from + 1} samples, the least and the greatest of each series among them.`;
  return make(
    "table",
    {},
    make("caption", {}, caption),
    make("thead", {}, make("tr", {}, head(first), ...columns.map(head))),
    make(
      "tbody",
      {},
      ...rows.map((index) =>
        make(
          "tr",
          {},
          make("th", { scope: "row" }, readAlong(first, index)),
          ...columns.map((column, k) => cell(column, k, index)),
        ),
      ),
    ),
  );
}

/**
 * @param {Float64Array} values
 * @param {number} from
 * @param {number} to
 */
function extremesOf(values, from, to) {
  let [low, high] = [from, from];
  for (let k = from; k <= to; k++) {
    if (values[k] < values[low]) low = k;
    if (values[k] > values[high]) high = k;
  }
  return { low, high };
}
