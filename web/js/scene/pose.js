// Where the arm stands at the cursor.

import * as core from "../core/client.js";
import { framesOf } from "./arm.js";

/** @import { Frames } from "./arm.js" */

export class Pose {
  /** @type {Frames} */
  frames; // of base, joints, tip and workpiece
  /** @type {ArrayLike<number>} */
  excess = []; // of each joint over its range [deg]; empty if no ranges are known
  #asked = -1; // the sample that was asked for last
  #asking = false;

  /**
   * Loads the pose at a sample of another result.
   * @param {number} sample
   */
  async load(sample) {
    this.#asked = sample;
    this.#take(await core.pose(sample));
  }

  /**
   * Follows `sample()`, one question at a time; `changed()` is called after each answer.
   * @param {() => number} sample
   * @param {() => void} changed
   */
  async follow(sample, changed) {
    if (this.#asking) return;
    this.#asking = true;
    try {
      while (this.#asked !== sample()) {
        this.#asked = sample();
        this.#take(await core.pose(this.#asked));
        changed();
      }
    } catch {
      this.#asked = -1; // a newer result brings its own pose
    }
    this.#asking = false;
  }

  /** @param {{ frames: Float64Array, excess: Float64Array }} pose */
  #take({ frames, excess }) {
    [this.frames, this.excess] = [framesOf(frames), excess];
  }

  /** The numbers of the joints that are out of range. */
  get beyond() {
    return Array.from(this.excess).flatMap((angle, i) => (angle > 0 ? [i + 1] : []));
  }
}
