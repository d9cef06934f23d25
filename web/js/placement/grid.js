// The grid of places of a map: where they are, what was found there, and which is best.

/** @import { Drawn, Place } from "./map.js" */

export const AXES = ["x", "y", "z"];

/**
 * Positions [mm]: `columns` along one axis, `rows` along another, and `bands`, for each row the x, y and z of its
 * places one after the other.
 *
 * @typedef {{ columns: number[], rows: number[], bands: Float64Array[] }} Grid
 */

/**
 * The grid in a plane: `axes` are those of columns and rows, and the one across the plane; `values` [mm] are the ends of
 * columns and rows, and the position of the plane.
 * @param {[number, number, number]} axes
 * @param {number[]} values
 * @param {number} count of places along a side
 * @returns {Grid}
 */
export function gridOf([i, k, rest], values, count) {
  /**
   * @param {number} from
   * @param {number} to
   */
  const line = (from, to) => Array.from({ length: count }, (_, n) => from + ((to - from) * n) / (count - 1));
  const [columns, rows] = [line(values[0], values[1]), line(values[2], values[3])];
  const bands = rows.map((row) =>
    Float64Array.from(
      columns.flatMap((column) => {
        const at = [0, 0, 0];
        [at[i], at[k], at[rest]] = [column, row, values[4]];
        return at;
      }),
    ),
  );
  return { columns, rows, bands };
}

/**
 * What was found at a place: `found` has three numbers for each place of a row, or null for a row to come.
 * @param {(Float64Array | null)[]} found
 * @param {number} column
 * @param {number} row
 * @returns {Place | null}
 */
export function placeAt(found, column, row) {
  const numbers = found[row];
  return numbers && placeIn(numbers, column);
}

/**
 * One of the places whose numbers were found, by its index.
 * @param {Float64Array} numbers
 * @param {number} index
 * @returns {Place}
 */
export function placeIn(numbers, index) {
  const [max, mean, mark] = numbers.subarray(3 * index, 3 * index + 3);
  return { max, mean, mark };
}

/**
 * What a map comes to: the `best` of the places that violate no limit, and the end of the scale, `limit` [mm]; both
 * undefined if there is none. A few places near singularities would take the whole scale.
 * @param {Drawn} map
 */
export function ranked({ rows, columns, at }) {
  const places = rows.flatMap((_, k) =>
    columns.flatMap((_, i) => {
      const place = at(i, k);
      return place ? [{ i, k, ...place }] : [];
    }),
  );
  const errors = places
    .filter(({ mark }) => mark < 3)
    .map(({ max }) => max)
    .sort((a, b) => a - b);
  /** @type {number | undefined} */
  const limit = errors[Math.floor(0.95 * (errors.length - 1))];
  const best = places.filter(({ mark }) => mark === 0).sort((a, b) => a.max - b.max)[0];
  return { best: /** @type {typeof best | undefined} */ (best), limit };
}
