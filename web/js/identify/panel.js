// The view Measure: what a measured pass teaches, joint compliances from measured loads or from encoders behind the gears,
// frequency and damping from a measured response, cutting coefficients from a dynamometer.

import { ask } from "./ask.js";
import { makeCuts } from "./cuts.js";
import { makeGear } from "./gear.js";
import { makePass } from "./pass.js";
import { makeResponse } from "./response.js";
import { makeStiffness } from "./stiffness.js";

/** @import { JobData } from "../job/data.js" */

/** @typedef {import("./ask.js").Ask} Ask */

/** @typedef {{ job(): JobData, use(job: JobData): void }} Present the job as it is, and how another takes its place */

/**
 * Fills `node`. `job()` gives the job as plain data, `use(job)` takes another one over. `look()` of
 * what comes back brings the view up to date.
 * @param {HTMLElement} node
 * @param {Present} present
 */
export function makeIdentify(node, { job, use }) {
  const parts = [makePass, makeStiffness, makeGear, makeResponse, makeCuts].map((make) => make({ ask, job, use }));
  node.append(...parts.map((part) => part.node));
  return {
    look() {
      // A link may open this view before there is a job.
      if (job() && !node.closest("[hidden]")) for (const part of parts) part.look();
    },
  };
}
