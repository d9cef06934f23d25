// The solids around the path: the stock, the part as it is cut from it, and a section through that. The part takes
// the core a while, so it is asked for once a result has stood for some time.

import * as core from "../core/client.js";
import { Part } from "./part.js";
import { Section } from "./section.js";
import { Stock } from "./stock.js";

/**
 * @import { StockSolid, Summary } from "../../pkg/armill.js"
 * @import { Frame } from "./arm.js"
 */

/**
 * Who has the solids: `isCurrent` says whether the result is still the one to show, `isSeen` whether its part is;
 * `enclose` takes over the stock, if there is one.
 *
 * @typedef {{
 *   isCurrent(): boolean,
 *   isSeen(): boolean,
 *   enclose(solid: StockSolid | undefined): void,
 * }} Simulated
 */

export class Solids {
  stock = new Stock();
  section = new Section();
  /** @type {number | undefined} */
  #waiting; // timer for the part

  /**
   * `changed(first)` is called when the part is to be drawn again; `first` if there was none before.
   * @param {(first?: boolean) => void} changed
   */
  constructor(changed) {
    this.part = new Part(changed);
  }

  /**
   * Offers the solids of a new result.
   * @param {Summary} summary
   */
  offer(summary) {
    clearTimeout(this.#waiting);
    this.part.offer(summary);
    this.section.offer(summary);
  }

  /**
   * Draws with another WebGL, or with none.
   * @param {WebGL2RenderingContext | null} gl
   */
  drawWith(gl) {
    this.part.drawWith(gl);
    this.stock.drawWith(gl);
  }

  /**
   * The corners of what there is; `frame` is the workpiece's.
   * @param {Frame} frame
   */
  corners(frame) {
    return [...this.part.corners(frame), ...this.stock.corners(frame)];
  }

  /**
   * Has the stock drawn and the part simulated once the result has stood for a while.
   * @param {number} quiet [ms]
   * @param {Simulated} by
   */
  simulate(quiet, { isCurrent, isSeen, enclose }) {
    clearTimeout(this.#waiting);
    if (!this.part.offered) return;
    this.#waiting = setTimeout(async () => {
      try {
        const solid = await core.stockSolid();
        if (!isCurrent()) return;
        enclose(solid);
        if (isSeen()) await this.part.load(isCurrent);
        if (isCurrent()) await this.section.begin();
      } catch {
        // Replaced by a newer result or a recovery, which loads its own.
      }
    }, quiet);
  }
}
