// The scale of the colours that paths are drawn in.

import { make } from "../page/dom.js";

const TICKS = 4;

/** The scale, and `show(largest, tolerance, unit)` from 0 to the largest error, with a mark at the tolerance. */
export function makeLegend() {
  const unit = make("span", { className: "unit" });
  const limit = make("span", { className: "limit" });
  const ticks = make("div", { className: "ticks" });
  const bar = make("div", { className: "bar" });
  const node = make("div", { className: "scale" }, make("p", {}, "Error, ", unit, limit), bar, ticks);
  /**
   * @param {number} largest
   * @param {any} tolerance
   * @param {string} name
   */
  const show = (largest, tolerance, name) => {
    node.hidden = !(largest > 0);
    if (node.hidden) return;
    unit.textContent = name;
    const step = niceStep(largest / TICKS);
    const decimals = Math.max(0, -Math.floor(Math.log10(step)));
    /**
     * @param {number} value
     * @param {string} words
     * @param {string} className
     */
    const at = (value, words, className) => {
      const tick = make("span", { className }, words);
      tick.style.setProperty("left", `${(100 * value) / largest}%`);
      return tick;
    };
    const marks = [];
    for (let k = 0; k * step < largest * 0.75; k++) marks.push(at(k * step, (k * step).toFixed(decimals), "tick"));
    marks.push(at(largest, largest.toPrecision(3), "tick last"));
    if (tolerance <= largest) marks.push(at(tolerance, "", "tolerance"));
    ticks.replaceChildren(...marks);
    limit.textContent = `tolerance ${Number(tolerance.toPrecision(3))}`;
  };
  return { node, show };
}

/** @param {any} wanted */
function niceStep(wanted) {
  const decade = 10 ** Math.floor(Math.log10(wanted));
  return ([1, 2, 5].find((step) => step * decade >= wanted * 0.999) ?? 10) * decade;
}
