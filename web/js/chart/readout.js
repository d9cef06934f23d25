// What stands at a chart's cursor: the sample's own values as text, and marks over the drawing.

import { make, makeSvg } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { fractionOf } from "./view.js";

/** @import { Axis, Chart, ChartColumn } from "../../pkg/armill.js" */

/** @typedef {{ chart: Chart, data: ChartColumn[], hidden: string[] }} Content a chart, its values, and the keys of series not drawn */

/** @typedef {NonNullable<Chart["camera"]>} Camera the directions to the right and up in a picture of space */

/** @type {Record<string, number>} */
const PLACES = { mm: 4, inch: 6, N: 2, lbf: 3, deg: 4, "%": 2 }; // as fine as is known of it

/**
 * A value as read in its unit; what would round to nothing is given with its power of ten.
 * @param {number} value
 * @param {string} unit
 * @param {number} [places]
 */
export function read(value, unit, places = PLACES[unit] ?? 4) {
  const text = value.toFixed(places);
  return value !== 0 && Number(text) === 0 ? formatNumber(value, 2) : text.replace("-", "\u2212");
}

/**
 * A value of the first axis with the digits that tell it from its neighbours; of a line, its number.
 * @param {{ key?: string, values: ArrayLike<number> }} column
 * @param {number} index
 */
export function readAlong({ key, values }, index) {
  if (key === "program_line") return String(Math.floor(values[index]));
  const step = values.length > 2 ? (values[values.length - 1] - values[0]) / (values.length - 1) : 1;
  return read(values[index], "", Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-6))));
}

/**
 * The columns of a chart's series: one each, or x, y and z.
 * @param {Chart} chart
 * @param {ChartColumn[]} data
 * @returns {ChartColumn[][]}
 */
export const columnsOf = (chart, data) =>
  chart.series.map((_, i) => (chart.camera ? data.slice(1 + 3 * i, 4 + 3 * i) : [data[1 + i]]));

/** Line of text under a chart. */
export class Readout {
  node = make("p", { className: "readout" });

  /**
   * Shows a sample, or none if `index` is null: also its time, if `time` has them. `line` is the
   * program's, `go` leads there.
   * @param {Content & { time?: ArrayLike<number> | null }} content
   * @param {number | null} index
   * @param {number | null | undefined} [line]
   * @param {() => void} [go]
   */
  show({ chart, data, hidden, time }, index, line, go) {
    if (index === null) return this.node.replaceChildren();
    const [first] = data;
    const at = make("b", {}, readAlong(first, index));
    at.dataset.value = String(first.values[index]);
    /** @type {HTMLElement[]} */
    const parts = [make("span", {}, `${first.label} `, at, first.unit && ` ${first.unit}`)];
    if (time) parts.push(make("span", {}, `Time ${readAlong({ values: time }, index)} s`));
    columnsOf(chart, data).forEach((columns, i) => {
      const { key, label } = chart.series[i];
      if (hidden.includes(key)) return;
      const values = columns.map((column) => {
        const value = make("b", {}, read(column.values[index], column.unit));
        value.dataset.value = String(column.values[index]);
        return value;
      });
      const part = make("span", {}, `${label} `, ...values.flatMap((value, k) => (k ? [", ", value] : [value])));
      part.dataset.key = key;
      parts.push(part);
    });
    if (data[1]?.unit) parts[parts.length - 1].append(` ${data[1].unit}`);
    if (line) {
      const button = make("button", { type: "button", className: "quiet" }, `line ${line} of the program`);
      if (go) button.addEventListener("click", go);
      parts.push(button);
    }
    this.node.replaceChildren(...parts);
  }

  get text() {
    return [...this.node.children].map((part) => part.textContent).join(", ");
  }
}

/** Marks over a drawing: the cursor's line, a dot on each series, the box of a zoom. */
export class Marks {
  node = makeSvg("svg", { class: "marks", "aria-hidden": "true" });
  #line = makeSvg("line", { class: "mark" });
  #dots = makeSvg("g");
  #box = makeSvg("rect", { class: "box" });
  #stretch = makeSvg("rect", { class: "selected" });

  constructor() {
    this.node.append(this.#stretch, this.#line, this.#dots, this.#box);
    this.box(null);
  }

  /**
   * Marks a sample in a chart whose axes are shown as `x` and `y`; none if `index` is null.
   * @param {Content} content
   * @param {{ x: Axis, y: Axis }} axes
   * @param {number | null} index
   */
  show({ chart, data, hidden }, { x, y }, index) {
    const { left, top, width, height } = chart.plot;
    /** @param {number} value */
    const inside = (value) => value >= -1e-9 && value <= 1 + 1e-9;
    const at = index === null || chart.camera ? NaN : fractionOf(x, data[0].values[index]);
    this.#line.classList.toggle("on", inside(at));
    if (inside(at)) set(this.#line, { x1: left + at * width, x2: left + at * width, y1: top, y2: top + height });
    const dots =
      index === null
        ? []
        : columnsOf(chart, data).flatMap((columns, i) => {
            const series = chart.series[i];
            if (hidden.includes(series.key)) return [];
            const [right, up] = chart.camera
              ? project(chart.camera, columns, index)
              : [data[0].values[index], columns[0].values[index]];
            const [across, high] = [fractionOf(x, right), fractionOf(y, up)];
            if (!inside(across) || !inside(high)) return [];
            const dot = makeSvg("circle", { cx: left + across * width, cy: top + (1 - high) * height, r: 4 });
            return [makeSvg("g", { class: `series ${series.class}`, "data-key": series.key }, dot)];
          });
    this.#dots.replaceChildren(...dots);
  }

  /**
   * Marks the samples between two, or none.
   * @param {Pick<Content, "chart" | "data">} content
   * @param {{ x: Axis }} axes
   * @param {[number, number] | null} samples
   */
  stretch({ chart, data }, { x }, samples) {
    this.#stretch.classList.toggle("on", Boolean(samples));
    if (!samples) return;
    const { left, top, width, height } = chart.plot;
    const [from, to] = samples
      .map((index) => Math.min(1, Math.max(0, fractionOf(x, data[0].values[index]))))
      .sort((a, b) => a - b);
    set(this.#stretch, { x: left + from * width, y: top, width: Math.max(1, (to - from) * width), height });
  }

  /**
   * Draws the box from one corner to another [px], or none.
   * @param {[number, number][] | null} corners
   */
  box(corners) {
    this.#box.classList.toggle("on", Boolean(corners));
    if (!corners) return;
    const [[x1, y1], [x2, y2]] = corners;
    set(this.#box, { x: Math.min(x1, x2), y: Math.min(y1, y2), width: Math.abs(x2 - x1), height: Math.abs(y2 - y1) });
  }
}

/**
 * @param {Element} element
 * @param {Record<string, number>} attributes
 */
function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}

/**
 * Where a point in space stands in the picture: to the right and up.
 * @param {Camera} camera
 * @param {ChartColumn[]} columns
 * @param {number} index
 */
function project(camera, columns, index) {
  return camera.map((axis) => axis.reduce((sum, part, k) => sum + part * columns[k].values[index], 0));
}

/**
 * The sample of a path whose picture is nearest to a place (fractions of the plot), and how far
 * away it is [px].
 * @param {Content} content
 * @param {{ x: Axis, y: Axis }} axes
 * @param {[number, number]} place
 * @returns {{ index: number | null, distance: number }}
 */
export function nearestInSpace({ chart, data, hidden }, { x, y }, [across, high]) {
  const { camera, plot } = chart;
  /** @type {{ index: number | null, distance: number }} */
  let best = { index: null, distance: Infinity };
  if (!camera) return best;
  columnsOf(chart, data).forEach((columns, i) => {
    if (hidden.includes(chart.series[i].key)) return;
    const [px, py, pz] = columns.map((column) => column.values);
    const [[rx, ry, rz], [ux, uy, uz]] = camera;
    const [sx, sy] = [plot.width / (x.max - x.min), plot.height / (y.max - y.min)];
    const [x0, y0] = [x.min * sx + across * plot.width, y.min * sy + high * plot.height];
    for (let k = 0; k < px.length; k++) {
      const dx = (rx * px[k] + ry * py[k] + rz * pz[k]) * sx - x0;
      const dy = (ux * px[k] + uy * py[k] + uz * pz[k]) * sy - y0;
      const distance = dx * dx + dy * dy;
      if (distance < best.distance) best = { index: k, distance };
    }
  });
  return { index: best.index, distance: Math.sqrt(best.distance) };
}
