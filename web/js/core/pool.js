// Independent parts of an answer, shared among several Workers.

import { helper } from "./client.js";

/**
 * @import { Asked } from "./asked.js"
 * @import { Failure } from "./client.js"
 */

const MOST = 8; // Workers
/** @type {Asked[]} */
const idle = []; // Workers that wait for the next question: to start one takes as long as a run

/** How many Workers compute at once, and how many are kept. */
const most = () => Math.min(MOST, Math.max(1, navigator.hardwareConcurrency ?? 2));

/**
 * Keeps a Worker for the next question, if there are not enough.
 * @param {Asked} worker
 */
function keep(worker) {
  if (idle.length < most()) idle.push(worker);
  else worker.stop({ code: "cancelled", message: "Not needed." });
}

/** A Worker that waits, or a new one: those that have ended meanwhile are forgotten. */
function waiting() {
  let worker = idle.pop();
  while (worker?.ended) worker = idle.pop();
  return worker ?? helper();
}

/**
 * Asks for the parts 0 to `count` - 1 with `ask(worker, index)`, and calls `onpart(part, index)` as they come. Resolves
 * when all are there; rejects when `signal` aborts, or with the first part's error.
 * @template T
 * @param {number} count
 * @param {(worker: Asked, index: number) => Promise<T>} ask
 * @param {(part: T, index: number) => void} onpart
 * @param {AbortSignal} signal
 */
export async function shareOut(count, ask, onpart, signal) {
  const size = Math.min(count, most());
  const workers = Array.from({ length: size }, waiting);
  let failed = false;
  /** @param {Failure} reason */
  const stop = (reason) => {
    failed = true;
    for (const worker of workers) worker.stop(reason);
  };
  const cancelled = () => stop({ code: "cancelled", message: "Cancelled." });
  if (signal.aborted) cancelled();
  signal.addEventListener("abort", cancelled);
  let next = 0;
  /** @param {Asked} worker */
  const work = async (worker) => {
    while (next < count && !failed) {
      const index = next++;
      onpart(await ask(worker, index), index);
    }
  };
  try {
    await Promise.all(workers.map(work));
  } catch (error) {
    stop(error);
    throw error;
  } finally {
    signal.removeEventListener("abort", cancelled);
    if (!failed) for (const worker of workers) keep(worker);
  }
}
