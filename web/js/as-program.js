// What the shown path is worth as a program: under the verdict, which is about the joint commands.

import * as core from "./core.js";
import { byId } from "./dom.js";

const QUIET_MS = 400; // inputs that still move are not judged
const LONG_MS = 3000; // a run that takes longer is judged when it is taken away: several runs are to be made for it

let waiting; // timer

/** Judges the shown result once it has stood for a while; `took` is how long its run took [ms]. */
export function judgeAsProgram({ summary: { passes }, preview }, took) {
  const line = byId("as-program");
  line.textContent = "";
  line.classList.remove("bad");
  clearTimeout(waiting);
  if (passes === 0 || preview) return; // nothing is promised
  if (took > LONG_MS)
    line.textContent = "Timed by its own moves and feeds, a program may differ: it is run when it is downloaded.";
  else waiting = setTimeout(judge, QUIET_MS, line, core.shownJob());
}

async function judge(line, json) {
  try {
    const { met, sentence } = await core.promised();
    if (core.shownJob() !== json) return; // of an earlier result
    line.textContent = sentence;
    line.classList.toggle("bad", !met);
  } catch (error) {
    if (!error.fatal && error.code !== "cancelled" && core.shownJob() === json)
      line.textContent = `As a program: ${error.message}`;
  }
}
