// The chart of an answer over one number.

import { Figure } from "../chart/figure.js";
import { shownUnit, shownValue } from "../form/shown.js";
import { debounced, make } from "../page/dom.js";
import { askSingle } from "./ask.js";

/**
 * @import { ChartOptions, ChartUnits, Field, SweepRow } from "../../pkg/armill.js"
 * @import { Curves } from "../core/studies.js"
 */

/** A figure that draws the rows it was given last. */
export function makeCurve() {
  /** @type {Curves | undefined} */
  let curves;
  const figure = new Figure({ name: "sweep", title: "Largest contour error", figure: "", kind: "curve" }, () => {}, {
    chart: (_, /** @type {ChartOptions} */ options) => askSingle("study_chart", curves, options),
    chartData: (_, /** @type {ChartUnits} */ units) => askSingle("study_data", curves, units),
  });
  const node = make("div", { className: "answer-curve", hidden: true }, figure.node);
  const redraw = () => figure.draw().catch(() => {}); // the next look draws again
  new ResizeObserver(debounced(() => curves && !node.hidden && !figure.fits && redraw(), 120)).observe(node);

  return {
    node,
    /**
     * Draws rows over a field; hides the figure without rows.
     * @param {SweepRow[]} rows
     * @param {Field} [field]
     * @param {{ now: unknown, tolerance: number }} [job]
     */
    show(rows, field, job) {
      node.hidden = rows.length < 2 || !field;
      if (node.hidden || !field || !job) return;
      const number = (/** @type {number | undefined} */ value) => value ?? NaN;
      curves = {
        label: field.label,
        unit: shownUnit(field.unit),
        tolerance: job.tolerance,
        now: typeof job.now === "number" ? shownValue(job.now, field.unit) : undefined,
        values: Float64Array.from(rows.map(({ value }) => shownValue(Number(value), field.unit))),
        errors: Float64Array.from(
          rows.flatMap((row) => [row.before_max_mm, row.after_max_mm, row.p50_mm, row.p95_mm].map(number)),
        ),
      };
      figure.forget();
      figure.zoom.show(null, null, true);
      redraw();
    },
  };
}
