// The values of a chart, fetched when they are first needed.

/** @import { ChartColumn } from "../../pkg/armill.js" */

/** @typedef {[data: ChartColumn[], times: Float64Array | null]} Found */

export class Samples {
  /** As columns, the first axis first; null until they are there. */
  data = /** @type {ChartColumn[] | null} */ (null);
  /** The time of each sample [s], of a chart over the run. */
  times = /** @type {Float64Array | null} */ (null);
  #ask;
  /** @type {Promise<Found | null> | null} */
  #fetching = null;

  /**
   * `ask()` resolves with `[data, times]`.
   * @param {() => Promise<Found>} ask
   */
  constructor(ask) {
    this.#ask = ask;
  }

  /** Those of another result, in other units, or of a chart that is not looked at go. */
  forget() {
    this.data = this.times = this.#fetching = null;
  }

  /** Resolves to whether they are there, and still those of what is shown. */
  async fetch() {
    if (this.data) return true;
    this.#fetching ??= this.#ask().catch(() => null);
    const mine = this.#fetching;
    const found = await mine;
    if (mine !== this.#fetching) return false;
    if (found) [this.data, this.times] = found;
    else this.#fetching = null;
    return Boolean(found);
  }
}
