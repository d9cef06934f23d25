// The job's name at the top of the inputs, in the title of the page and in the names of files.

import { byId } from "../page/dom.js";
import { nameFilesAfter } from "../page/download.js";
import { fileStem, legal, named } from "./name.js";

/**
 * @import { Job } from "./job.js"
 * @import { Session } from "./session.js"
 */

const TITLE = document.title;

/**
 * Wires the input of the name; the function it returns shows the name of `job()` after every change of it.
 * @param {() => Job} job
 * @param {() => Session} session
 */
export function makeTitle(job, session) {
  const input = byId("job-name");
  // When it is left: a name is no number that a result should follow while it is typed.
  input.addEventListener("change", () => {
    const name = legal(input.value);
    if (name !== job().data.name) session().load(named(job().data, name));
  });
  return () => {
    const { name = "" } = job().data;
    if (document.activeElement !== input || input.value.trim() !== name) input.value = name;
    document.title = name ? `${name} – Armill` : TITLE;
    nameFilesAfter(fileStem(name));
  };
}
