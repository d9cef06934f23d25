// Selecting a stretch of the run in a chart over it, by dragging or by keys.

import { isHome, setStretch, stretch } from "../page/stretch.js";
import { Selection } from "./selection.js";
import { ends, nearest, valueAt } from "./view.js";

/**
 * @import { Axis } from "../../pkg/armill.js"
 * @import { Content } from "./readout.js"
 * @import { Samples } from "./samples.js"
 */

/**
 * @typedef {{
 *   axis(): Pick<Axis, "min" | "max" | "log">,
 *   content(): Content,
 *   samples: Samples,
 *   lengths(): Promise<ArrayLike<number>>,
 *   mark(): void,
 * }} Of
 */

export class Picker {
  #figure;
  #of;
  /** @type {number | null} */
  #anchor = null; // the sample at which keys began
  #selection = new Selection(() => this.clear());

  /**
   * `of` has what is shown: `axis()`, `content()`, `samples`, `lengths()` resolving with the path lengths
   * [mm], and `mark()` to draw the marks again.
   * @param {import("./figure.js").Figure} figure
   * @param {Of} of
   */
  constructor(figure, of) {
    this.#figure = figure;
    this.#of = of;
  }

  /** The statistics, to be put below the chart. */
  get node() {
    return this.#selection.node;
  }

  /** The samples at the ends of the stretch, or null. */
  samples() {
    const { times } = this.#of.samples;
    const range = this.#figure.kind === "time" && times ? stretch() : null;
    return range && times && /** @type {[number, number]} */ (range.map((time) => nearest(times, time)));
  }

  /**
   * Selects between two fractions of the plot.
   * @param {number} a
   * @param {number} b
   * @param {boolean} complete
   */
  async drag(a, b, complete) {
    const { samples } = this.#of;
    if (!(await samples.fetch()) || !samples.data) return;
    const axis = this.#of.axis();
    const [min, max] = [valueAt(axis, Math.min(a, b)), valueAt(axis, Math.max(a, b))];
    const [from, to] = ends(samples.data[0].values, { min, max });
    this.#choose([from, to], complete);
  }

  /**
   * Begins at a sample, by default the first that is seen; the next time it ends there.
   * @param {number | null} index
   */
  async markEnd(index) {
    const { samples } = this.#of;
    if (!(await samples.fetch()) || !samples.data) return;
    const at = index ?? ends(samples.data[0].values, this.#of.axis())[0];
    const begun = this.#anchor;
    this.#anchor = begun === null ? at : null;
    this.#choose([begun ?? at, at], begun !== null);
  }

  /**
   * While keys select, the stretch goes with the cursor.
   * @param {number | null} index
   */
  extend(index) {
    if (this.#anchor !== null && index !== null) this.#choose([this.#anchor, index], false);
  }

  /** Selects nothing. */
  clear() {
    if (stretch()) setStretch(null, null, false);
  }

  /**
   * @param {[number, number]} pair
   * @param {boolean} complete
   */
  #choose([a, b], complete) {
    const { times } = this.#of.samples;
    if (times) setStretch([times[Math.min(a, b)], times[Math.max(a, b)]], this, complete);
  }

  /**
   * Marks the selected stretch; once it is complete its statistics stand where it was selected.
   * @param {boolean} complete
   */
  async follow(complete) {
    const range = stretch();
    if (!range || !isHome(this)) this.#anchor = null;
    if (!range || !isHome(this) || !complete) this.#selection.hide();
    if (range && !(await this.#of.samples.fetch())) return;
    this.#of.mark();
    if (!range || !isHome(this) || !complete) return;
    const lengths = await this.#of.lengths().catch(() => null);
    const [{ times }, ends] = [this.#of.samples, this.samples()];
    if (lengths && times && ends && range === stretch()) this.#selection.show(this.#of.content(), times, lengths, ends);
  }
}
