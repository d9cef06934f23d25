// The grid of places of a map: where they are, what was found there, and which is best.

/** @import { Measure, Place } from "./map.js" */

export const AXES = ["x", "y", "z"];
const NUMBERS = 4; // of a place

/**
 * Positions [mm]: `columns` along one axis, `rows` along another, and `bands`, for each row the x, y and z of its
 * places one after the other.
 *
 * @typedef {{ columns: number[], rows: number[], bands: Float64Array[] }} Grid
 */

/** @typedef {{ fixed: number, found: (Float64Array | null)[] }} Layer a plane's position [mm], and the numbers of its rows */

/** @typedef {Place & { i: number, k: number, layer: number }} Ranked a place of a map, by column, row and layer */

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
 * What was found at a place: `found` has the numbers of a row's places, or null for a row to come.
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
  const [max, mean, mark, p95] = numbers.subarray(NUMBERS * index, NUMBERS * (index + 1));
  return { max, mean, mark, p95 };
}

/**
 * What a map comes to: the `best` of the places that violate no limit and are `allowed`, and the end of the scale,
 * `limit` [mm]; both undefined if there is none. A few places near singularities would take the whole scale.
 * @param {{ columns: number[], rows: number[], layers: Layer[] }} map
 * @param {Measure} measure that decides
 * @param {(place: Ranked) => boolean} [allowed]
 */
export function ranked({ rows, columns, layers }, measure, allowed = () => true) {
  const places = layers.flatMap(({ found }, layer) =>
    rows.flatMap((_, k) =>
      columns.flatMap((_, i) => {
        const place = placeAt(found, i, k);
        return place ? [{ i, k, layer, ...place }] : [];
      }),
    ),
  );
  const errors = places
    .filter(({ mark }) => mark < 3)
    .map((place) => place[measure])
    .sort((a, b) => a - b);
  /** @type {number | undefined} */
  const limit = errors[Math.floor(0.95 * (errors.length - 1))];
  return { best: least(places.filter(allowed), measure), limit };
}

/**
 * The best of the places that violate no limit; of equal ones the first.
 * @template {Place} T
 * @param {T[]} places
 * @param {Measure} measure
 */
export function least(places, measure) {
  /** @type {T | undefined} */
  let best;
  for (const each of places) if (each.mark === 0 && !(best && best[measure] <= each[measure])) best = each;
  return best;
}

/**
 * Marks places as those in the floor, whose mark is 4; what is out of reach stays so.
 * @param {Float64Array} numbers
 * @param {(index: number) => boolean} isIn whether a place is
 */
export function markFloor(numbers, isIn) {
  for (let n = 0; n < numbers.length / NUMBERS; n++) {
    if (numbers[NUMBERS * n + 2] !== 3 && isIn(n)) numbers[NUMBERS * n + 2] = 4;
  }
}
