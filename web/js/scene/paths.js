// The paths of a run, as the core hands them out for a picture: made into lines, measured, picked
// from.

import { extent, nowhere, widen } from "./boxes.js";
import { dot, length, plus } from "./camera.js";
import { VERTEX, vertex } from "./line-gl.js";
import { spacingOf } from "./spacing.js";

/** @import { Box, Vector } from "./camera.js" */

const ROW = 17; // numbers in a row of the core's `track`, and where its vectors start
const [DESIRED, CLOSEST, BEFORE, AFTER, CORRECTION] = [2, 5, 8, 11, 14];
const AT = { desired: DESIRED, closest: CLOSEST, before: BEFORE, after: AFTER, correction: CORRECTION };
const WHISKERS = 120;
const MOST_LEGS = 1500; // of a path when its spacing is measured

/** @typedef {{ side: "before" | "after", row: number }} Worst a worst place, before or after compensation */

export class Paths {
  /** @type {Float64Array} */
  #track;
  count;
  worst = { before: 0, after: 0 }; // the cutting rows that deviate most before and after compensation
  stride = 0; // largest distance from one row to the next [mm]
  box = nowhere(); // [low, high] around the desired points
  cutBox = nowhere(); // the same where the tool cuts
  /** @type {number | undefined} */
  #spacing; // see `spacing`

  /**
   * `track` is the core's answer.
   * @param {Float64Array} track
   */
  constructor(track) {
    this.#track = track;
    this.count = track.length / ROW;
    const most = { before: -1, after: -1 };
    const cutsSomewhere = this.#hasCuts();
    for (let row = 0; row < this.count; row++) {
      widen(this.box, track, row * ROW + DESIRED);
      if (row) this.stride = Math.max(this.stride, this.#step(row, DESIRED));
      if (cutsSomewhere && !this.cuts(row)) continue;
      widen(this.cutBox, track, row * ROW + DESIRED);
      const errors = { before: this.#size(row, BEFORE), after: this.#size(row, AFTER) };
      for (const side of /** @type {const} */ (["before", "after"]))
        if (errors[side] > most[side]) [most[side], this.worst[side]] = [errors[side], row];
    }
  }

  // The loops over all rows make no lists: they run while results stream in.

  /**
   * The length of a vector of a row.
   * @param {number} row
   * @param {number} at
   */
  #size(row, at) {
    const [track, i] = [this.#track, row * ROW + at];
    return Math.sqrt(track[i] * track[i] + track[i + 1] * track[i + 1] + track[i + 2] * track[i + 2]);
  }

  /**
   * How far a row's point is from that of the row before.
   * @param {number} row
   * @param {number} at
   */
  #step(row, at) {
    const [track, i] = [this.#track, row * ROW + at];
    const x = track[i] - track[i - ROW];
    const y = track[i + 1] - track[i + 1 - ROW];
    const z = track[i + 2] - track[i + 2 - ROW];
    return Math.sqrt(x * x + y * y + z * z);
  }

  /**
   * @param {number} row
   * @param {number} at
   */
  #vector(row, at) {
    return this.#track.subarray(row * ROW + at, row * ROW + at + 3);
  }

  /** @param {number} row */
  sample(row) {
    return this.#track[row * ROW];
  }

  /**
   * Whether a row cuts; else it is part of a rapid move.
   * @param {number} row
   */
  cuts(row) {
    return this.#track[row * ROW + 1] > 0;
  }

  #hasCuts() {
    for (let row = 0; row < this.count; row++) if (this.cuts(row)) return true;
    return false;
  }

  /**
   * The worst place of what is `shown`, or none; before compensation first.
   * @param {Record<string, boolean>} shown
   * @returns {Worst | undefined}
   */
  worstOf({ actual, after }) {
    if (actual) return { side: "before", row: this.worst.before };
    return after ? { side: "after", row: this.worst.after } : undefined;
  }

  /** Largest deviation before compensation where the tool cuts [mm]. */
  get largest() {
    return length(this.before(this.worst.before));
  }

  /**
   * About `count` rows that cut, evenly; of a path that nowhere cuts, all.
   * @param {number} count
   */
  cutRows(count) {
    const step = Math.max(1, Math.ceil(this.count / count));
    const rows = Array.from({ length: Math.ceil(this.count / step) }, (_, i) => i * step);
    const cutting = rows.filter((row) => this.cuts(row));
    return cutting.length ? cutting : rows;
  }

  /**
   * About `count` desired points where the tool cuts.
   * @param {number} count
   */
  cutPoints(count) {
    return this.cutRows(count).map((row) => [...this.desired(row)]);
  }

  /**
   * The box around the desired points where the tool cuts, along the axes of another frame.
   * @param {{ origin: number[], x: number[], y: number[], z: number[] }} given
   */
  boxIn({ origin, x, y, z }) {
    const box = nowhere();
    const off = [0, 0, 0];
    const whole = !this.#hasCuts();
    for (let row = 0; row < this.count; row++) {
      if (!whole && !this.cuts(row)) continue;
      for (let axis = 0; axis < 3; axis++) off[axis] = this.#track[row * ROW + DESIRED + axis] - origin[axis];
      widen(box, [dot(x, off), dot(y, off), dot(z, off)], 0);
    }
    return box;
  }

  /** How far apart neighbouring passes of the path are [mm]; of one pass about its size, or infinite. */
  get spacing() {
    if (this.#spacing !== undefined) return this.#spacing;
    const step = Math.max(1, Math.ceil(this.count / MOST_LEGS));
    const points = [];
    for (let row = 0; row < this.count; row += step) points.push(this.cuts(row) ? this.desired(row) : null);
    return (this.#spacing = spacingOf(points));
  }

  /**
   * The point where the tool should be, the closest point of the path to where it is, and the ways
   * from there to the tip.
   */
  desired = (/** @type {number} */ row) => this.#vector(row, DESIRED);
  closest = (/** @type {number} */ row) => this.#vector(row, CLOSEST);
  before = (/** @type {number} */ row) => this.#vector(row, BEFORE);
  after = (/** @type {number} */ row) => this.#vector(row, AFTER);
  correction = (/** @type {number} */ row) => this.#vector(row, CORRECTION);

  /** Where the tip is drawn `before` or `after` compensation, its deviation magnified. */
  tip = (/** @type {number} */ row, /** @type {"before" | "after"} */ side, /** @type {number} */ factor) =>
    plus(this.closest(row), this[side](row), factor);

  /**
   * The row nearest to a sample.
   * @param {number} sample
   */
  rowOf(sample) {
    let [low, high] = [0, this.count - 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.sample(middle) < sample) low = middle + 1;
      else high = middle;
    }
    return low > 0 && sample - this.sample(low - 1) < this.sample(low) - sample ? low - 1 : low;
  }

  /**
   * 1, 2 or 5 times a power of ten, so that the largest deviation shows as about a tenth of the
   * path's size: as the charts do.
   */
  factor() {
    if (this.largest < 1e-6) return 1;
    const wanted = Math.max(1, (0.1 * extent(this.box)) / this.largest);
    const decade = 10 ** Math.floor(Math.log10(wanted));
    return ([5, 2].find((step) => step * decade <= wanted) ?? 1) * decade;
  }

  /**
   * The points of a line for the painter: "desired" or "closest" ones, each with a way off it or (null) with none.
   * @param {"desired" | "closest"} place
   * @param {"before" | "after" | "correction" | null} way
   */
  line(place, way) {
    const track = this.#track;
    const [from, off] = [AT[place], way ? AT[way] : 0];
    const points = new Float32Array(this.count * VERTEX);
    let along = 0;
    for (let row = 0, i = 0; row < this.count; row++, i += VERTEX) {
      if (row) along += this.#step(row, from);
      for (let axis = 0; axis < 3; axis++) {
        points[i + axis] = track[row * ROW + from + axis];
        points[i + 4 + axis] = way ? track[row * ROW + off + axis] : 0;
      }
      points[i + 3] = way ? this.#size(row, off) : 0;
      points[i + 7] = this.cuts(row) ? along : -1 - along;
    }
    return points;
  }

  /** Pairs of points from the path to the actual one, evenly over the path's length. */
  whiskers() {
    let whole = 0;
    for (let row = 1; row < this.count; row++) whole += this.#step(row, CLOSEST);
    const points = [];
    let [along, next] = [0, 0];
    for (let row = 0; row < this.count; row++) {
      if (row) along += this.#step(row, CLOSEST);
      if (along < next) continue;
      next += whole / WHISKERS;
      if (!this.cuts(row)) continue;
      const [place, way] = [this.closest(row), this.before(row)];
      points.push(...vertex(place, { value: length(way) }), ...vertex(place, { way, value: length(way) }));
    }
    return new Float32Array(points);
  }

  /**
   * The row whose drawn point is nearest to a place in the picture, or -1 if none is within `reach`
   * pixels; `m` is the camera's matrix.
   * @param {Float32Array} m
   * @param {[x: number, y: number]} place
   * @param {{ width: number, height: number, factor: number, shown: Record<string, boolean>, reach: number }} view
   */
  pick(m, [x, y], { width, height, factor, shown, reach }) {
    const drawn = [];
    if (shown.desired) drawn.push([DESIRED, BEFORE, 0]);
    if (shown.compensated) drawn.push([DESIRED, CORRECTION, factor]);
    if (shown.actual) drawn.push([CLOSEST, BEFORE, factor]);
    const track = this.#track;
    let [best, least] = [-1, reach * reach];
    for (const [place, way, times] of drawn) {
      for (let row = 0; row < this.count; row++) {
        const p = row * ROW + place,
          w = row * ROW + way;
        const px = track[p] + times * track[w],
          py = track[p + 1] + times * track[w + 1],
          pz = track[p + 2] + times * track[w + 2];
        const depth = m[3] * px + m[7] * py + m[11] * pz + m[15];
        const right = (((m[0] * px + m[4] * py + m[8] * pz + m[12]) / depth + 1) * width) / 2 - x;
        const down = ((1 - (m[1] * px + m[5] * py + m[9] * pz + m[13]) / depth) * height) / 2 - y;
        const away = right * right + down * down;
        if (depth > 0 && away < least) [best, least] = [row, away];
      }
    }
    return best;
  }
}
