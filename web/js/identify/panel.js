// The view Identify: joint compliances from measured loads, frequency and damping from a measured
// response.

import * as core from "../core/client.js";
import { makeResponse } from "./response.js";
import { makeStiffness } from "./stiffness.js";

let worker; // computes and draws here only; started when it is first needed

/** Asks the core; a Worker that died is replaced when the next question comes. */
async function ask(...question) {
  worker ??= core.helper();
  try {
    return await worker.ask(...question);
  } catch (error) {
    if (error.fatal) {
      worker.stop(error);
      worker = undefined;
    }
    throw error;
  }
}

/**
 * Fills `node`. `job()` gives the job as plain data, `use(job)` takes another one over. `look()` of
 * what comes back brings the view up to date.
 */
export function makeIdentify(node, { job, use }) {
  const parts = [makeStiffness({ ask, job, use }), makeResponse({ ask, job, use })];
  node.append(...parts.map((part) => part.node));
  return {
    look() {
      if (!node.closest("[hidden]")) for (const part of parts) part.look();
    },
  };
}
