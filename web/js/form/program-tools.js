// Programs opened, dropped, pasted or taken from the examples, and the way from one of their lines to
// the charts and back.

import { readText } from "../core/assets.js";
import { make } from "../page/dom.js";
import { timeOf } from "../page/program-lines.js";
import { languageOf, notRead } from "./language.js";
import { listing } from "./program-text.js";

/** @import { Stock } from "../../pkg/armill.js" */

/** @typedef {{ file: string, kind: string, title: string, note: string, stock?: Stock, tool?: object }} Example a program of the site */

/** @typedef {(kind: string, text: string, example?: Partial<Example>) => Promise<boolean>} Use makes a program the path of the job */

/** @type {Promise<Example[]> | undefined} */
let examplesListed;

/**
 * The example programs.
 * @returns {Promise<Example[]>}
 */
const listOfExamples = () => (examplesListed ??= readText("examples/index.json").then((text) => JSON.parse(text)));

/**
 * Whether a stock is that of an example program: it has nothing to do with another one.
 * @param {Stock} stock
 */
export async function isOfExample(stock) {
  const list = await listOfExamples().catch(() => /** @type {Example[]} */ ([]));
  return list.some((example) => JSON.stringify(example.stock) === JSON.stringify(stock));
}

/**
 * Buttons for programs; `use(kind, text, example)` is called with what was opened, `fail(message)`
 * where that did not work.
 * @param {Use} use
 * @param {(message: string) => void} fail
 */
export function programTools(use, fail) {
  const file = make("input", { type: "file", id: "program-file", hidden: true, "aria-label": "Program file" });
  const open = make("button", { type: "button", id: "open-program" }, "Open program…");
  const examples = make(
    "select",
    { id: "examples", "aria-label": "Example programs" },
    make("option", { value: "" }, "Examples…"),
  );
  open.addEventListener("click", () => file.click());
  file.addEventListener("change", async () => {
    const [chosen] = file.files ?? [];
    file.value = "";
    if (chosen) await openProgram(chosen, use, fail);
  });
  const listed = listOfExamples();
  listed.then(
    (list) =>
      examples.append(
        ...list.map(({ file: name, title, note }) => make("option", { value: name, title: note }, title)),
      ),
    () => (examples.hidden = true),
  );
  examples.addEventListener("change", async () => {
    const chosen = (await listed).find((example) => example.file === examples.value);
    examples.value = "";
    if (!chosen) return;
    try {
      if (await use(chosen.kind, await readText(`examples/${chosen.file}`), chosen)) listing.name = chosen.file;
    } catch ({ message }) {
      fail(message);
    }
  });
  const hint = make("p", { className: "drop-here" }, "or drop a program here");
  return make("div", { className: "program-tools" }, open, examples, file, hint);
}

/**
 * The text of a file; nothing, after `fail(message)`, if it cannot be read or is no text.
 * @param {File} file
 * @param {(message: string) => void} fail
 */
export async function textIn(file, fail) {
  try {
    const text = await file.text();
    if (!text.includes("\0")) return text;
    fail(`“${file.name}” was not opened: it is not plain text in UTF-8.`);
  } catch ({ message }) {
    fail(`“${file.name}” was not opened: ${message}`); // a folder, or it has gone
  }
  return undefined;
}

/**
 * Reads a file into the job.
 * @param {File} file
 * @param {Use} use
 * @param {(message: string) => void} fail
 */
export async function openProgram(file, use, fail) {
  const foreign = notRead(file.name);
  if (foreign) return fail(`“${file.name}” was not opened: ${foreign}`);
  const text = await textIn(file, fail);
  if (text === undefined) return;
  if (await use(languageOf(file.name, text), text, { file: file.name })) listing.name = file.name;
}

/**
 * A program pasted in place of the whole text is opened as one from a file is.
 * @param {Use} use
 */
export function followPaste(use) {
  listing.onreplaced = (text) => use(languageOf("", text), text);
}

/**
 * Points at a line of the program where it was typed.
 * @param {number} line
 */
export function showLine(line) {
  if (listing.node.closest("[hidden]")) return;
  const group = listing.node.closest("details");
  if (group) group.open = true;
  listing.show(line);
}

/**
 * Calls `point(time)` whenever the caret comes to a line that runs.
 * @param {(time: number) => void} point
 */
export function followCaret(point) {
  listing.onpoint = (line) => {
    const time = timeOf(line);
    if (time !== undefined) point(time);
  };
}
