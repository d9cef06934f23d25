// A Worker with the core in it, which answers questions with promises.

import { compileCore, startWorker } from "./assets.js";

/** @import { Failure, Progress } from "./client.js" */

/**
 * `large` says whether it holds a long run, `ended` whether it answers no more.
 *
 * @typedef {{
 *   stop(reason: Failure): void,
 *   large: boolean,
 *   ended: boolean,
 *   ask(kind: string, ...args: unknown[]): Promise<any>,
 * }} Asked
 */

/** @type {Promise<WebAssembly.Module> | undefined} */
let compiled; // promise of the core's module: every Worker starts from the same one

/** The core's module, loaded and compiled once; after a failure the next Worker tries again. */
function moduleOfCore() {
  compiled ??= compileCore().catch((error) => {
    compiled = undefined;
    throw error;
  });
  return compiled;
}

/**
 * Starts one; `onprogress` hears of its runs, `onfail` that it could not load.
 * @param {{ onprogress(progress: Progress): void, onfail(worker: Asked): void }} on
 * @returns {Asked}
 */
export function startAsked({ onprogress, onfail }) {
  const worker = startWorker();
  /** @type {Map<number, { resolve(value: unknown): void, reject(reason: Failure): void }>} */
  const waiting = new Map();
  let count = 0;
  /** @type {Failure | undefined} */
  let ended; // why it answers no more
  /** @param {Failure} reason */
  const stop = (reason) => {
    ended = reason;
    worker.terminate();
    for (const { reject } of waiting.values()) reject(reason);
    waiting.clear();
  };
  /** @param {{ message: string }} error */
  const fail = ({ message }) => {
    onfail(own);
    stop({ code: "load", message: message || "the browser does not say why", fatal: true });
  };
  worker.addEventListener("message", ({ data: { id, value, error, progress } }) => {
    if (progress) return onprogress(progress);
    const question = waiting.get(id);
    waiting.delete(id);
    if (error) question?.reject(error);
    else question?.resolve(value);
  });
  worker.addEventListener("error", (event) => {
    event.preventDefault();
    fail(event);
  });
  /** @type {Asked} */
  const own = {
    stop,
    large: false, // whether it holds a long run
    get ended() {
      return Boolean(ended);
    },
    ask: (kind, ...args) =>
      new Promise((resolve, reject) => {
        if (ended) return reject(ended);
        waiting.set(++count, { resolve, reject });
        worker.postMessage({ id: count, kind, args });
      }),
  };
  moduleOfCore().then((module) => worker.postMessage({ module }), fail);
  return own;
}
