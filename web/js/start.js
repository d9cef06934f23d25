// What does not wait for the rest of the page: its colours, and the core with the job that the page
// opens with.

import { kept } from "./job/autosave.js";
import * as core from "./core/client.js";
import { textOf } from "./job/data.js";
import { exampleIn, holdsJob } from "./job/link.js";
import { applyTheme } from "./page/theme.js";

applyTheme();

const PATIENCE_MS = 100; // on a slow line the page does not wait for the core

/**
 * Has the job computed while the form is built. A link's is checked first, so it waits for the
 * page.
 */
async function begin() {
  const [hello, state] = await Promise.all([core.load(), kept()]);
  if (holdsJob(location.hash)) return;
  core.foresee(textOf(exampleIn(location.hash, hello) ?? state?.job ?? hello.opening));
}

/** Settled when the Worker computes the first result: from then on the page is not in its way. */
export const begun = Promise.race([
  begin().catch(() => {}),
  new Promise((resolve) => setTimeout(resolve, PATIENCE_MS)),
]);
