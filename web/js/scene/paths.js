// The paths of a run, as the core hands them out for a picture: made into lines, measured, picked from.

import { length, plus, project } from "./camera.js";
import { VERTEX } from "./gl.js";

const ROW = 17; // numbers in a row of the core's `track`
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

  /** The point where the tool should be, the closest point of the path to where it is, and the ways from there to the tip. */
  desired = (row) => this.#vector(row, 2);
  closest = (row) => this.#vector(row, 5);
  before = (row) => this.#vector(row, 8);
  after = (row) => this.#vector(row, 11);
  correction = (row) => this.#vector(row, 14);

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

  /** 1, 2 or 5 times a power of ten, so that the largest deviation shows as about a tenth of the path's size: as the charts do. */
  factor() {
    if (this.largest < 1e-6) return 1;
    const wanted = Math.max(1, (0.1 * this.#size) / this.largest);
    const decade = 10 ** Math.floor(Math.log10(wanted));
    return [5, 2, 1].find((step) => step * decade <= wanted) * decade;
  }

  /** The box [low, high] around the desired and the magnified paths. */
  box(factor) {
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (let row = 0; row < this.count; row++) {
      for (const [place, way] of [[this.desired(row), this.correction(row)], [this.closest(row), this.before(row)]]) {
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
      points.set(here, row * VERTEX);
      points.set(off, row * VERTEX + 3);
      points.set([length(off), along, this.#track[row * ROW + 1] > 0 ? 1 : 0], row * VERTEX + 6);
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
      const facts = [length(way), 0, 1];
      points.push(...place, 0, 0, 0, ...facts, ...place, ...way, ...facts);
    }
    return new Float32Array(points);
  }

  #pathLength() {
    let sum = 0;
    for (let row = 1; row < this.count; row++) sum += length(plus(this.closest(row), this.closest(row - 1), -1));
    return sum;
  }

  /** The row whose drawn point is nearest to a place in the picture, or -1 if none is within `reach` pixels. */
  pick(camera, [x, y], { width, height, factor, shown, reach }) {
    const drawn = [];
    if (shown.desired) drawn.push([this.desired, this.correction, 0]);
    if (shown.compensated) drawn.push([this.desired, this.correction, factor]);
    if (shown.actual) drawn.push([this.closest, this.before, factor]);
    let [best, least] = [-1, reach * reach];
    for (const [place, way, times] of drawn) {
      for (let row = 0; row < this.count; row++) {
        const [px, py, depth] = project(camera, plus(place(row), way(row), times), width, height);
        const away = (px - x) ** 2 + (py - y) ** 2;
        if (depth > 0 && away < least) [best, least] = [row, away];
      }
    }
    return best;
  }
}
