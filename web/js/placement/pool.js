// Places of a map, computed by several Workers at once, a band of rows each time.

import { helper } from "../core/client.js";

/**
 * @import { Asked } from "../core/asked.js"
 * @import { Failure } from "../core/client.js"
 */

const MOST = 8;

/**
 * Asks for every band, an array of positions [mm], and calls `onband(index, numbers)` as they come. Resolves when all are there;
 * rejects when `signal` aborts, or with what is wrong with the job.
 * @param {string} json
 * @param {Float64Array[]} bands
 * @param {(index: number, numbers: Float64Array) => void} onband
 * @param {AbortSignal} signal
 */
export async function survey(json, bands, onband, signal) {
  const count = Math.min(bands.length, MOST, Math.max(1, (navigator.hardwareConcurrency ?? 2) - 1));
  const workers = Array.from({ length: count }, () => helper());
  /** @param {Failure} reason */
  const stop = (reason) => workers.forEach((worker) => worker.stop(reason));
  const cancelled = () => stop({ code: "cancelled", message: "Cancelled." });
  signal.addEventListener("abort", cancelled);
  let next = 0;
  /** @param {Asked} worker */
  const work = async (worker) => {
    while (next < bands.length && !signal.aborted) {
      const index = next++;
      onband(index, await worker.ask("survey", json, bands[index]));
    }
  };
  try {
    await Promise.all(workers.map(work));
  } finally {
    signal.removeEventListener("abort", cancelled);
    stop({ code: "cancelled", message: "Cancelled." });
  }
}
