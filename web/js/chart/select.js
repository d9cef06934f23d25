// Selecting a stretch of the run in a chart over it, by dragging or by keys.

import { isHome, setStretch, stretch } from "../page/stretch.js";
import { Selection } from "./selection.js";
import { ends, nearest, valueAt } from "./view.js";

export class Picker {
  #figure;
  #of;
  #anchor = null; // the sample at which keys began
  #selection = new Selection(() => setStretch(null));

  /**
   * `of` has what is shown: `axis()`, `content()`, `samples`, `lengths()` resolving with the path lengths
   * [mm], and `mark()` to draw the marks again.
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
    return range && range.map((time) => nearest(times, time));
  }

  /** Selects between two fractions of the plot. */
  async drag(a, b, complete) {
    if (!(await this.#of.samples.fetch())) return;
    const axis = this.#of.axis();
    const [min, max] = [Math.min(a, b), Math.max(a, b)].map((fraction) => valueAt(axis, fraction));
    this.#choose(ends(this.#of.samples.data[0].values, { min, max }), complete);
  }

  /** Begins at a sample, by default the first that is seen; the next time it ends there. */
  async markEnd(index) {
    if (!(await this.#of.samples.fetch())) return;
    const at = index ?? ends(this.#of.samples.data[0].values, this.#of.axis())[0];
    const begun = this.#anchor;
    this.#anchor = begun === null ? at : null;
    this.#choose([begun ?? at, at], begun !== null);
  }

  /** While keys select, the stretch goes with the cursor. */
  extend(index) {
    if (this.#anchor !== null && index !== null) this.#choose([this.#anchor, index], false);
  }

  #choose([a, b], complete) {
    const { times } = this.#of.samples;
    setStretch([times[Math.min(a, b)], times[Math.max(a, b)]], this, complete);
  }

  /** Marks the selected stretch; once it is complete its statistics stand where it was selected. */
  async follow(complete) {
    const range = stretch();
    if (!range || !isHome(this)) this.#anchor = null;
    if (!range || !isHome(this) || !complete) this.#selection.hide();
    if (range && !(await this.#of.samples.fetch())) return;
    this.#of.mark();
    if (!range || !isHome(this) || !complete) return;
    const lengths = await this.#of.lengths().catch(() => null);
    if (lengths && this.#of.samples.data && range === stretch())
      this.#selection.show(this.#of.content(), this.#of.samples.times, lengths, this.samples());
  }
}
