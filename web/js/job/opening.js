// Opens what a person brings: a job file, or a program that becomes the path of the job.

import { isOfExample, openProgram, textIn } from "../form/program-tools.js";
import { byId } from "../page/dom.js";
import { merged } from "./job.js";

/**
 * `openJob(file)`, `useProgram(kind, text, example)` and `wireDrop()` for the page. `session()`, `job()`
 * and `standard()`, the default job, are asked for when they are needed; `warn(message)` says what could
 * not be opened.
 */
export function makeOpening({ core, job, session, standard, warn }) {
  let opened = 0; // programs, to know the latest

  async function openJob(file) {
    byId("job-file").value = "";
    if (!file) return;
    const text = await textIn(file, warn);
    if (text === undefined) return;
    core.cancel();
    try {
      await core.check(text);
      session().load(JSON.parse(text));
    } catch ({ message, line, column }) {
      const where = line && !/\bline\b/.test(message) ? ` (line ${line}, column ${column})` : "";
      warn(`“${file.name}” was not opened: ${message}${where}`);
    }
  }

  /**
   * Makes a program the path of the job, whatever the job was before. The thesis's shaper goes: hardly
   * any controller has one, and commands for it are wrong without. An example brings its stock and its
   * tool; any other program gets a stock unless the job has one. False if another program came meanwhile.
   */
  async function useProgram(kind, text, { stock, tool } = {}) {
    const mine = ++opened;
    core.cancel();
    const given = stock ?? (await stockFor(kind, text));
    if (mine !== opened) return false;
    const { shaper, stock: _, ...rest } = job().data;
    const own = JSON.stringify(shaper) !== JSON.stringify(standard().shaper);
    const next = { ...rest, path: { kind, text }, shaper: own ? shaper : "none" };
    session().load(merged(next, { ...(given && { stock: given }), ...(tool && { tool }) }));
    byId("group-path").open = true;
    return true;
  }

  /** The stock for a program: the job's own, or its extents as the core proposes them. */
  async function stockFor(kind, text) {
    const { stock, ...rest } = job().data;
    const path = { kind, text };
    const kept = stock && stock.kind !== "extents" && !(await isOfExample(stock));
    if (kept) return stock;
    try {
      const proposed = await core.proposedStock(JSON.stringify({ ...rest, path }));
      const allowance = stock?.allowance_mm === undefined ? {} : { allowance_mm: stock.allowance_mm };
      return proposed && { ...proposed, ...allowance };
    } catch {
      return undefined; // what is wrong with the program is said when it is computed
    }
  }

  /** Files dropped anywhere on the page. */
  function wireDrop() {
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault();
      const [file] = event.dataTransfer.files;
      if (!file) return;
      if (file.name.endsWith(".json")) openJob(file);
      else openProgram(file, useProgram, warn);
    });
  }

  return { openJob, useProgram, wireDrop };
}
