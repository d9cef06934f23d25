// Places of a map, computed by several Workers at once, a band of rows each time.

import { shareOut } from "../core/pool.js";

/**
 * Asks for every band, an array of positions [mm], and calls `onband(index, numbers)` as they come. Resolves when all are there;
 * rejects when `signal` aborts, or with what is wrong with the job.
 * @param {string} json
 * @param {Float64Array[]} bands
 * @param {(index: number, numbers: Float64Array) => void} onband
 * @param {AbortSignal} signal
 */
export const survey = (json, bands, onband, signal) =>
  shareOut(
    bands.length,
    (worker, index) => worker.ask("survey", json, bands[index]),
    (/** @type {Float64Array} */ numbers, index) => onband(index, numbers),
    signal,
  );
