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

/** What is measured, by the names that addresses have for it. */
const KINDS = { pass: makePass, stiffness: makeStiffness, gear: makeGear, response: makeResponse, cuts: makeCuts };

/**
 * The kind whose example a fragment asks for, as `measured=pass`, or undefined.
 * @param {string} fragment
 */
export function measuredIn(fragment) {
  const [, kind] = /(?:^#?|&)measured=(\w+)/.exec(fragment) ?? [];
  return kind && Object.hasOwn(KINDS, kind) ? /** @type {keyof typeof KINDS} */ (kind) : undefined;
}

/**
 * Fills `node`. `job()` gives the job as plain data, `use(job)` takes another one over. `look()` of
 * what comes back brings the view up to date, and opens the example that the address asks for, once.
 * @param {HTMLElement} node
 * @param {Present} present
 */
export function makeIdentify(node, { job, use }) {
  const parts = Object.entries(KINDS).map(([kind, make]) => ({ kind, ...make({ ask, job, use }) }));
  node.append(...parts.map((part) => part.node));
  let opened = ""; // the address whose example was opened

  function look() {
    // A link may open this view before there is a job.
    if (!job() || node.closest("[hidden]")) return;
    for (const part of parts) part.look();
    const wanted = parts.find(({ kind }) => kind === measuredIn(location.hash));
    if (!wanted || opened === location.hash) return;
    opened = location.hash;
    wanted.example();
    wanted.node.scrollIntoView();
  }

  window.addEventListener("hashchange", look);
  return { look };
}
