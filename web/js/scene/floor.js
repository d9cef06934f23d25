// What stands around the paths: the floor's grid and the axes of frames, as lines for the painter.

import { plus } from "./camera.js";
import { vertex } from "./line-gl.js";

/**
 * @import { Frame } from "./arm.js"
 * @import { Box } from "./camera.js"
 */

const ABOUT = 14; // spaces of the grid along the longer side

/**
 * The grid of the base plane under a box: spacing of 1, 2 or 5 times a power of ten of `unit` [mm],
 * and pairs of points.
 * @param {Box} box
 * @param {number} unit
 */
export function grid([low, high], unit) {
  const wanted = Math.max(high[0] - low[0], high[1] - low[1]) / ABOUT / unit;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  const spacing = ([1, 2, 5].find((step) => step * decade >= wanted) ?? 10) * decade;
  const [from, to] = [low, high].map((end, i) =>
    [0, 1].map((axis) => Math.round(end[axis] / unit / spacing + (i ? 0.5 : -0.5))),
  );
  /** @type {number[]} */
  const numbers = [];
  for (const axis of [0, 1]) {
    const other = 1 - axis;
    for (let k = from[axis]; k <= to[axis]; k++) {
      for (const end of [from[other], to[other]]) {
        const point = [0, 0, 0];
        [point[axis], point[other]] = [k * spacing * unit, end * spacing * unit];
        numbers.push(...vertex(point));
      }
    }
  }
  return { spacing, points: new Float32Array(numbers) };
}

/**
 * The three axes of a frame, each as a pair of points.
 * @param {Frame} frame
 * @param {number} length
 */
export const axesOf = (frame, length) =>
  [frame.x, frame.y, frame.z].map(
    (axis) => new Float32Array([...vertex(frame.origin), ...vertex(plus(frame.origin, axis, length))]),
  );
