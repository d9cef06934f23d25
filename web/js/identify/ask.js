// A Worker that computes and draws what is measured, apart from the shown result.

import * as core from "../core/client.js";

/** @import { Asked } from "../core/asked.js" */

/** @typedef {(kind: string, ...args: unknown[]) => Promise<any>} Ask a question to the core */

/** @type {Asked | undefined} */
let worker; // started when it is first needed

/**
 * Asks the core; a Worker that died is replaced when the next question comes.
 * @type {Ask}
 */
export async function ask(kind, ...args) {
  worker ??= core.helper();
  try {
    return await worker.ask(kind, ...args);
  } catch (error) {
    if (error.fatal) {
      worker.stop(error);
      worker = undefined;
    }
    throw error;
  }
}
