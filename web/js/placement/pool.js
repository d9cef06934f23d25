// Places of a map, computed by several Workers at once, a band of rows each time.

import { helper } from "../core/client.js";

const MOST = 8;

/**
 * Asks for every band, an array of positions [mm], and calls `onband(index, numbers)` as they come. Resolves when all are there;
 * rejects when `signal` aborts, or with what is wrong with the job.
 */
export async function survey(json, bands, onband, signal) {
  const count = Math.min(bands.length, MOST, Math.max(1, (navigator.hardwareConcurrency ?? 2) - 1));
  const workers = Array.from({ length: count }, helper);
  const stop = (reason) => workers.forEach((worker) => worker.stop(reason));
  const cancelled = () => stop({ code: "cancelled", message: "Cancelled." });
  signal.addEventListener("abort", cancelled);
  let next = 0;
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
