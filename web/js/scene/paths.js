// The paths of a run, as the core hands them out for a picture: made into lines, measured, picked
// from.

import { length, plus } from "./camera.js";
import { VERTEX, vertex } from "./gl.js";

const ROW = 17; // numbers in a row of the core's `track`, and where its vectors start
const [DESIRED, CLOSEST, BEFORE, AFTER, CORRECTION] = [2, 5, 8, 11, 14];
const WHISKERS = 120;

export class Paths {
  #track;
  count;
  largest = 0; // largest deviation before compensation [mm]
  stride = 0; // largest distance from one row to the next [mm]
  #size = 0;

  /** `track` is the core's answer. */
  constructor(track) {
    this.#track = track;
    this.count = track.length / ROW;
    for (let row = 0; row < this.count; row++) {
      this.largest = Math.max(this.largest, length(this.before(row)));
      if (row) this.stride = Math.max(this.stride, length(plus(this.desired(row), this.desired(row - 1), -1)));
    }
    const [low, high] = this.box(0);
    this.#size = Math.max(...high.map((v, i) => v - low[i]));
  }

  #vector(row, at) {
    return this.#track.subarray(row * ROW + at, row * ROW + at + 3);
  }

  sample(row) {
    return this.#track[row * ROW];
  }

  /**
   * The point where the tool should be, the closest point of the path to where it is, and the ways
   * from there to the tip.
   */
  desired = (row) => this.#vector(row, DESIRED);
  closest = (row) => this.#vector(row, CLOSEST);
  before = (row) => this.#vector(row, BEFORE);
  after = (row) => this.#vector(row, AFTER);
  correction = (row) => this.#vector(row, CORRECTION);

  /** The row nearest to a sample. */
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
    const wanted = Math.max(1, (0.1 * this.#size) / this.largest);
    const decade = 10 ** Math.floor(Math.log10(wanted));
    return [5, 2, 1].find((step) => step * decade <= wanted) * decade;
  }

  /** The box [low, high] around the desired and the magnified paths. */
  box(factor) {
    const [low, high] = [
      [Infinity, Infinity, Infinity],
      [-Infinity, -Infinity, -Infinity],
    ];
    for (let row = 0; row < this.count; row++) {
      for (const [place, way] of [
        [this.desired(row), this.correction(row)],
        [this.closest(row), this.before(row)],
      ]) {
        for (let i = 0; i < 3; i++) {
          const moved = place[i] + factor * way[i];
          low[i] = Math.min(low[i], place[i], moved);
          high[i] = Math.max(high[i], place[i], moved);
        }
      }
    }
    return [low, high];
  }

  /** The points of a line for the painter. */
  points(place, way) {
    const points = new Float32Array(this.count * VERTEX);
    let along = 0;
    for (let row = 0; row < this.count; row++) {
      const here = place(row);
      if (row) along += length(plus(here, place(row - 1), -1));
      const off = way(row);
      // As `vertex` would, without a list for each.
      points.set(here, row * VERTEX);
      points[row * VERTEX + 3] = length(off);
      points.set(off, row * VERTEX + 4);
      points[row * VERTEX + 7] = this.#track[row * ROW + 1] ? along : -1 - along;
    }
    return points;
  }

  /** Pairs of points from the path to the actual one, evenly over the path's length. */
  whiskers() {
    const step = (this.#track.length && this.#pathLength()) / WHISKERS;
    const points = [];
    let [along, next] = [0, 0];
    for (let row = 0; row < this.count; row++) {
      if (row) along += length(plus(this.closest(row), this.closest(row - 1), -1));
      if (along < next) continue;
      next += step;
      const [place, way] = [this.closest(row), this.before(row)];
      points.push(...vertex(place, { value: length(way) }), ...vertex(place, { way, value: length(way) }));
    }
    return new Float32Array(points);
  }

  #pathLength() {
    let sum = 0;
    for (let row = 1; row < this.count; row++) sum += length(plus(this.closest(row), this.closest(row - 1), -1));
    return sum;
  }

  /**
   * The row whose drawn point is nearest to a place in the picture, or -1 if none is within `reach`
   * pixels; `m` is the camera's matrix.
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
