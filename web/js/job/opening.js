// Opens what a person brings: a job file, or a program that becomes the path of the job.

import { isOfExample, openProgram, textIn } from "../form/program-tools.js";
import { ask } from "../form/still-asked.js";
import { byId } from "../page/dom.js";
import { makeDropZone } from "../page/drop-zone.js";
import { merged } from "./data.js";
import { nameOfFile, named } from "./name.js";

/**
 * @import { Stock } from "../../pkg/armill.js"
 * @import { JobData } from "./data.js"
 * @import { Job } from "./job.js"
 * @import { Session } from "./session.js"
 */

/** @typedef {{ file?: string, title?: string, stock?: Stock, tool?: object }} Opened a file, or an example, which has a title */

/**
 * `openJob(file)`, `useProgram(kind, text, example)` and `wireDrop()` for the page. `session()`, `job()`
 * and `examples()`, the core's own jobs, are asked for when they are needed; `warn(message)` says what could
 * not be opened.
 * @param {{
 *   core: typeof import("../core/client.js"), job(): Job, session(): Session,
 *   examples(): { job: JobData, opening: JobData },
 *   warn(message: string): void,
 * }} page
 */
export function makeOpening({ core, job, session, examples, warn }) {
  let opened = 0; // programs, to know the latest

  /** @param {File | undefined} file */
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
   * any controller has one, and commands for it are wrong without. The spindle speed is the program's, and
   * its file names the job. An example, which has a title, brings its stock and its tool; any other program
   * gets a stock unless the job has one, and the rest of the inputs is asked about. False if another
   * program came meanwhile.
   * @param {string} kind its language
   * @param {string} text
   * @param {Opened} [example]
   */
  async function useProgram(kind, text, { stock, tool, title, file } = {}) {
    const mine = ++opened;
    core.cancel();
    const given = title ? stock : await stockFor(kind, text);
    const { shaper, stock: stockBefore, ...rest } = job().data;
    const own = JSON.stringify(shaper) !== JSON.stringify(examples().job.shaper);
    const plain = { ...rest, path: { kind, text }, shaper: own ? shaper : "none" };
    const next = merged(plain, { ...(given && { stock: given }), ...(tool && { tool }) });
    const said = await changesFor(next, Boolean(title));
    if (mine !== opened) return false;
    const whole = merged(next, said);
    session().load(file ? named(whole, nameOfFile(file)) : whole);
    if (!title) ask(job().data, ...(JSON.stringify(given) === JSON.stringify(stockBefore) ? [] : ["stock"]));
    byId("group-path").open = true;
    return true;
  }

  /**
   * What the program itself decides, and for an example a place in front of the robot.
   * @param {any} next
   * @param {any} placed
   */
  async function changesFor(next, placed) {
    const text = JSON.stringify(next);
    const atHome = JSON.stringify(next.robot) === JSON.stringify(examples().job.robot);
    const [cutting, xyz_mm] = await Promise.all([
      core.proposedCutting(text).catch(() => undefined),
      placed && !atHome ? core.placeInFront(text).catch(() => undefined) : undefined,
    ]);
    return { ...(cutting && { cutting }), ...(xyz_mm && { workpiece_frame: { xyz_mm: [...xyz_mm] } }) };
  }

  /**
   * The stock for a program: the job's own, or its extents as the core proposes them.
   * @param {string} kind
   * @param {string} text
   * @returns {Promise<Stock | undefined>}
   */
  async function stockFor(kind, text) {
    const { stock, ...rest } = job().data;
    const path = { kind, text };
    if (stock && stock.kind !== "extents" && !(await isOfAnother(stock))) return stock;
    try {
      const proposed = await core.proposedStock(JSON.stringify({ ...rest, path }));
      const allowance = stock?.allowance_mm === undefined ? {} : { allowance_mm: stock.allowance_mm };
      return proposed && { ...proposed, ...allowance };
    } catch {
      return undefined; // what is wrong with the program is said when it is computed
    }
  }

  /**
   * Whether a stock came with a job of ours, and so belongs to that job's program.
   * @param {Stock} stock
   */
  const isOfAnother = async (stock) =>
    JSON.stringify(stock) === JSON.stringify(examples().opening.stock) || (await isOfExample(stock));

  /** Files dropped anywhere on the page. */
  function wireDrop() {
    makeDropZone((file) => {
      if (file.name.toLowerCase().endsWith(".json")) openJob(file);
      else openProgram(file, useProgram, warn);
    });
  }

  return { openJob, useProgram, wireDrop };
}
