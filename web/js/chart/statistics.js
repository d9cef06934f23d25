// Statistics of a stretch of samples. They are evenly spaced in time, so means are over time.

/**
 * Mean, maximum, root mean square and 95 % quantile of the values from one index to another, both
 * included; undefined if none of them is a number.
 * @param {Float64Array} values
 * @param {number} from
 * @param {number} to
 */
export function statisticsOf(values, from, to) {
  const sorted = Float64Array.from(values.subarray(from, to + 1).filter(Number.isFinite)).sort();
  const count = sorted.length;
  if (!count) return undefined;
  let [sum, squares] = [0, 0];
  for (const value of sorted) {
    sum += value;
    squares += value * value;
  }
  return { mean: sum / count, max: sorted[count - 1], rms: Math.sqrt(squares / count), p95: quantile(sorted, 0.95) };
}

/**
 * The quantile of sorted values, linear between them (JCGM 101:2008, 7.7, D.1), as the core takes it.
 * @param {ArrayLike<number>} sorted
 * @param {number} share
 */
function quantile(sorted, share) {
  const last = sorted.length - 1;
  const place = Math.min(last, Math.max(0, share * sorted.length - 0.5));
  const below = Math.floor(place);
  const above = Math.min(last, below + 1);
  return sorted[below] + (sorted[above] - sorted[below]) * (place - below);
}
