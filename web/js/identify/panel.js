// The view Measure: what a measured pass teaches, joint compliances from measured loads, frequency and damping from a
// measured response.

import * as core from "../core/client.js";
import { makeCuts } from "./cuts.js";
import { makePass } from "./pass.js";
import { makeResponse } from "./response.js";
import { makeStiffness } from "./stiffness.js";

/**
 * @import { Asked } from "../core/asked.js"
 * @import { JobData } from "../job/data.js"
 */

/** @typedef {(kind: string, ...args: unknown[]) => Promise<any>} Ask a question to the core */

/** @typedef {{ job(): JobData, use(job: JobData): void }} Present the job as it is, and how another takes its place */

/** @type {Asked | undefined} */
let worker; // computes and draws here only; started when it is first needed

/**
 * Asks the core; a Worker that died is replaced when the next question comes.
 * @type {Ask}
 */
async function ask(kind, ...args) {
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

/**
 * Fills `node`. `job()` gives the job as plain data, `use(job)` takes another one over. `look()` of
 * what comes back brings the view up to date.
 * @param {HTMLElement} node
 * @param {Present} present
 */
export function makeIdentify(node, { job, use }) {
  const parts = [makePass, makeStiffness, makeResponse, makeCuts].map((make) => make({ ask, job, use }));
  node.append(...parts.map((part) => part.node));
  return {
    look() {
      // A link may open this view before there is a job.
      if (job() && !node.closest("[hidden]")) for (const part of parts) part.look();
    },
  };
}
