// Which ranges of its axes a chart shows, and how gestures, keys and buttons change them.

import { between, ranged, scaled, shifted } from "./view.js";

/**
 * @import { Axis, Chart } from "../../pkg/armill.js"
 * @import { Range } from "./view.js"
 */

/**
 * What is zoomed: `chart()` is the drawing, null before the first; in a `plane` both axes zoom together.
 * `at()` is the fraction of the plot where the cursor is, NaN without one. `changed()` is called for every
 * new range, `link(x)` if other charts are to follow.
 *
 * @typedef {{
 *   plane: boolean,
 *   chart(): Chart | null,
 *   at(): number,
 *   changed(): void,
 *   link(x: Range | null): void,
 * }} Of
 */

export class Zoom {
  #of;
  /** @type {{ x: Range | null, y: Range | null }} */
  #ranges = { x: null, y: null };

  /** @param {Of} of */
  constructor(of) {
    this.#of = of;
  }

  /** The ranges asked for; null is all. */
  get ranges() {
    return this.#ranges;
  }

  get zoomed() {
    return this.#ranges.x !== null || this.#ranges.y !== null;
  }

  /** The axes of the drawing as they are to be seen, which may be ahead of it. */
  get axes() {
    const { x, y } = /** @type {Chart} */ (this.#of.chart());
    return { x: ranged(x, this.#ranges.x ?? x.full), y: ranged(y, this.#ranges.y ?? y.full) };
  }

  /** The plot inside the drawing [px]. */
  get area() {
    return this.#of.chart()?.plot ?? { left: 0, top: 0, width: 1, height: 1 };
  }

  /**
   * Shows these ranges; null is all, undefined as it is. `linked` if it follows another chart.
   * @param {Range | null} [x]
   * @param {Range | null} [y]
   * @param {boolean} [linked]
   */
  show(x = this.#ranges.x, y = this.#ranges.y, linked = false) {
    const moved = String(x) !== String(this.#ranges.x);
    this.#ranges = { x, y };
    if (!this.#of.chart()) return;
    this.#of.changed();
    if (moved && !linked) this.#of.link(x);
  }

  reset() {
    this.show(null, null);
  }

  /**
   * Shows `fx` and `fy` times as much of the axes; by default the cursor stays where it is.
   * @param {[number, number]} factors
   * @param {[number, number]} [place]
   */
  scale([fx, fy], place = this.#middle()) {
    if (!this.#of.chart()) return;
    const { x, y } = this.axes;
    this.show(fx === 1 ? undefined : scaled(x, place[0], fx), fy === 1 ? undefined : scaled(y, place[1], fy));
  }

  /** In and out by a key or a button. */
  in() {
    this.scale([0.5, this.#of.plane ? 0.5 : 1]);
  }

  out() {
    this.scale([2, this.#of.plane ? 2 : 1]);
  }

  /**
   * Moves by fractions of what is shown.
   * @param {number} dx
   * @param {number} dy
   */
  shift(dx, dy) {
    if (!this.#of.chart()) return;
    const { x, y } = this.axes;
    this.show(dx && this.#ranges.x ? shifted(x, dx) : undefined, dy && this.#ranges.y ? shifted(y, dy) : undefined);
  }

  /** What a drag starts from. */
  grab() {
    return this.#of.chart() && this.axes;
  }

  /**
   * The view as it was when it was grabbed, moved by pixels and zoomed about a place.
   * @param {{ x: Axis, y: Axis } | null} grip
   * @param {number} dx
   * @param {number} dy
   * @param {number} [factor]
   * @param {[number, number]} [place]
   */
  drag(grip, dx, dy, factor = 1, place = [0.5, 0.5]) {
    if (!grip) return;
    const { width, height } = this.area;
    /**
     * @param {Axis} axis
     * @param {number} by
     * @param {number} at
     */
    const move = (axis, by, at) => between(axis, at - at * factor - by * factor, at + (1 - at) * factor - by * factor);
    const upright = this.#of.plane || (factor === 1 && this.#ranges.y);
    this.show(move(grip.x, dx / width, place[0]), upright ? move(grip.y, -dy / height, place[1]) : undefined);
  }

  /**
   * Shows what is in a box, given by two of its corners [px].
   * @param {[number, number]} a
   * @param {[number, number]} b
   */
  box([x1, y1], [x2, y2]) {
    const { left, top, width, height } = this.area;
    const { x, y } = this.axes;
    const [from, to] = [x1, x2].map((value) => (value - left) / width).sort((a, b) => a - b);
    const [low, high] = [y1, y2].map((value) => 1 - (value - top) / height).sort((a, b) => a - b);
    /**
     * @param {number} start
     * @param {number} end
     */
    const whole = (start, end) => start < 1e-6 && end > 1 - 1e-6;
    this.show(whole(from, to) ? undefined : between(x, from, to), whole(low, high) ? undefined : between(y, low, high));
  }

  /**
   * Where keys and buttons zoom: at the cursor if it is seen.
   * @returns {[number, number]}
   */
  #middle() {
    const at = this.#of.at();
    return [at >= 0 && at <= 1 ? at : 0.5, 0.5];
  }
}
