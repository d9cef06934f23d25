// The part of an axis that is shown. An axis is { min, max, log, floor, full: [low, high] }; a fraction
// counts from 0 at min to 1 at max. Below its floor a logarithmic axis shows nothing.

/** @typedef {{ min: number, max: number, log: boolean, full: [number, number] }} Axis */

/** @typedef {[low: number, high: number]} Range */

const FINEST = 1e-6; // the least part of the whole that can be shown
const DIGITS = 1e-8; // and of the values themselves: what a double still tells apart

/**
 * @param {Pick<Axis, "min" | "max" | "log">} axis
 * @param {number} fraction
 */
export const valueAt = ({ min, max, log }, fraction) =>
  log ? min * (max / min) ** fraction : min + fraction * (max - min);

/**
 * @param {Pick<Axis, "min" | "max" | "log"> & { floor?: number }} axis
 * @param {number} value
 */
export const fractionOf = ({ min, max, log, floor = 0 }, value) =>
  log ? Math.log(Math.max(value, floor) / min) / Math.log(max / min) : (value - min) / (max - min);

/**
 * The range between two fractions of what is shown, moved and grown to lie inside the whole; null
 * if it is the whole.
 * @param {Axis} axis
 * @param {number} from
 * @param {number} to
 * @returns {Range | null}
 */
export function between(axis, from, to) {
  const [low, high] = axis.full;
  const whole = { ...axis, min: low, max: high };
  const a = fractionOf(whole, valueAt(axis, from));
  const b = fractionOf(whole, valueAt(axis, to));
  const finest = axis.log
    ? FINEST
    : Math.max(FINEST, (DIGITS * Math.max(Math.abs(low), Math.abs(high))) / (high - low));
  const size = Math.max(b - a, finest);
  if (!(size < 1 - 1e-9)) return null;
  const start = Math.min(1 - size, Math.max(0, (a + b - size) / 2));
  return [valueAt(whole, start), valueAt(whole, start + size)];
}

/**
 * The range that is `factor` times as long, with the value at a fraction staying where it is.
 * @param {Axis} axis
 * @param {number} fraction
 * @param {number} factor
 */
export const scaled = (axis, fraction, factor) =>
  between(axis, fraction - fraction * factor, fraction + (1 - fraction) * factor);

/**
 * The range moved by a fraction of its length.
 * @param {Axis} axis
 * @param {number} by
 */
export const shifted = (axis, by) => between(axis, by, 1 + by);

/**
 * The axis as it is to be shown: a range of its own, or as it was drawn.
 * @template {Axis} A
 * @param {A} axis
 * @param {Range | null} range
 * @returns {A}
 */
export const ranged = (axis, range) => (range ? { ...axis, min: range[0], max: range[1] } : axis);

/**
 * The index of the value nearest to `value` among growing ones.
 * @param {ArrayLike<number>} values
 * @param {number} value
 */
export function nearest(values, value) {
  let [low, high] = [0, values.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low > 0 && value - values[low - 1] < values[low] - value ? low - 1 : low;
}

/**
 * The same among values in any order: of equals the first, or the last.
 * @param {ArrayLike<number>} values
 * @param {number} value
 */
export function scan(values, value, last = false) {
  let [best, least] = [0, Infinity];
  for (let k = 0; k < values.length; k++) {
    const away = Math.abs(values[k] - value);
    if (away < least || (last && away === least)) [best, least] = [k, away];
  }
  return best;
}

/**
 * The indices at the ends of a range, with all that stand there.
 * @param {ArrayLike<number>} values
 * @param {{ min: number, max: number }} given
 */
export const ends = (values, { min, max }) => [scan(values, min), scan(values, max, true)];
