// Boxes [low, high] along the axes.

/** @import { Box } from "./camera.js" */

/**
 * A box around nothing.
 * @returns {Box}
 */
export const nowhere = () => [Array(3).fill(Infinity), Array(3).fill(-Infinity)];

/**
 * Widens a box so that it holds the point at `i` in a row of numbers.
 * @param {Box} box
 * @param {ArrayLike<number>} numbers
 * @param {number} i
 */
export function widen([low, high], numbers, i) {
  for (let axis = 0; axis < 3; axis++) {
    const v = numbers[i + axis];
    if (v < low[axis]) low[axis] = v;
    if (v > high[axis]) high[axis] = v;
  }
}

/**
 * A box that also holds `points`.
 * @param {Box} box
 * @param {ArrayLike<number>[]} points
 * @returns {Box}
 */
export function around([low, high], points) {
  /**
   * @param {(...values: number[]) => number} pick
   * @param {number[]} ends
   */
  const every = (pick, ends) => ends.map((end, i) => pick(end, ...points.map((point) => point[i])));
  return [every(Math.min, low), every(Math.max, high)];
}

/**
 * The longest side of a box.
 * @param {Box} box
 */
export const extent = ([low, high]) => Math.max(...high.map((v, i) => v - low[i]));

/**
 * Whether a box is so different from another that a picture of one does not show the other well.
 * @param {Box} box
 * @param {Box} other
 */
export function isElsewhere(box, other) {
  const size = Math.max(extent(box), extent(other));
  return box.flat().some((v, i) => Math.abs(v - other.flat()[i]) > 0.1 * size);
}
