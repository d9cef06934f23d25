// A chart of the shown result with those of pinned ones, all on the same axes.

/**
 * @import { Chart, ChartOptions } from "../../pkg/armill.js"
 * @import { Pin } from "../result/pinned.js"
 * @import { Values } from "./figure.js"
 */

/**
 * A pinned result that is drawn.
 *
 * @typedef {Pick<Pin, "letter" | "name" | "text"> & {
 *   chart(name: string, options: ChartOptions): Promise<Chart>,
 * }} Beside
 */

/**
 * Resolves with `{ own, others }`: the chart `name` that `values` draws and those of the pinned results
 * `pins` as [{ pin, chart }], on axes that hold all of them where `view`, { x, y }, asks for no range.
 * @param {string} name
 * @param {ChartOptions} options
 * @param {{ x?: [number, number] | null, y?: [number, number] | null }} view
 * @param {Values} values
 * @param {Beside[]} pins
 * @returns {Promise<{ own: Chart, others: { pin: Beside, chart: Chart }[] }>}
 */
export async function drawnTogether(name, options, view, values, pins) {
  const own = await values.chart(name, options);
  if (!pins.length) return { own, others: [] };
  /** @type {ChartOptions} */
  const alike = { ...options, ...(own.y.floor !== undefined && { scale: own.y.log ? "log" : "linear" }) };
  /**
   * @param {Beside} pin
   * @param {ChartOptions} how
   */
  const ask = (pin, how) => pin.chart(name, how).catch(() => null); // it may be unpinned meanwhile
  const found = (await Promise.all(pins.map((pin) => ask(pin, alike)))).filter((chart) => chart !== null);
  if (!found.length) return { own, others: [] };
  const [x, y] = /** @type {const} */ (["x", "y"]).map((axis) =>
    joined([own, ...found].map((chart) => chart[axis].full)),
  );
  /** @type {ChartOptions} */
  const all = { ...alike, x_range: view.x ?? x, y_range: view.y ?? y };
  const [drawn, ...charts] = await Promise.all([values.chart(name, all), ...pins.map((pin) => ask(pin, all))]);
  [drawn.x.full, drawn.y.full] = [x, y];
  return {
    own: drawn,
    others: pins.flatMap((pin, i) => {
      const chart = charts[i];
      return chart ? [{ pin, chart }] : [];
    }),
  };
}

/**
 * The range that holds all of these.
 * @param {[number, number][]} ranges
 * @returns {[number, number]}
 */
const joined = (ranges) => [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
