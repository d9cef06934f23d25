// Programs opened, dropped, pasted or taken from the examples, and the way from one of their lines to
// the charts and back.

import { readText } from "../core/assets.js";
import { make } from "../page/dom.js";
import { timeOf } from "../page/program-lines.js";
import { listing } from "./program-text.js";

const ENDINGS = {
  apt: ["apt", "aptsource", "cls", "cl", "ncl"],
  csv: ["csv", "txt", "tsv", "xyz"],
  gcode: ["nc", "ngc", "gcode", "g", "tap", "cnc", "mpf", "spf", "eia", "iso"],
};

/**
 * The language of a program by what stands in it; where that does not tell, by the ending of its
 * name.
 */
function languageOf(name, text) {
  const head = text.slice(0, 20_000);
  if (/^\s*(GOTO|FROM|FEDRAT|PARTNO|UNITS|MULTAX|SPINDL)\b/im.test(head)) return "apt";
  if (/^\s*%|^[^A-FH-LO-Z\n]*[GM]\s*\d/im.test(head.replace(/\([^)]*\)|;.*$/gm, ""))) return "gcode";
  const ending = name.split(".").pop().toLowerCase();
  return Object.keys(ENDINGS).find((language) => ENDINGS[language].includes(ending)) ?? "csv";
}

/** The example programs, `{ file, kind, title, note, stock, tool }`, of which the last two may be left out. */
const listOfExamples = () => (examplesListed ??= readText("examples/index.json").then(JSON.parse));
let examplesListed;

/** Whether a stock is that of an example program: it has nothing to do with another one. */
export async function isOfExample(stock) {
  const list = await listOfExamples().catch(() => []);
  return list.some((example) => JSON.stringify(example.stock) === JSON.stringify(stock));
}

/**
 * Buttons for programs; `use(kind, text, example)` is called with what was opened, `fail(message)`
 * where that did not work.
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
    const [chosen] = file.files;
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
  return make("div", { className: "program-tools" }, open, examples, file);
}

/** The text of a file; nothing, after `fail(message)`, if it cannot be read or is no text. */
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

/** Reads a file into the job. */
export async function openProgram(file, use, fail) {
  const text = await textIn(file, fail);
  if (text === undefined) return;
  if (await use(languageOf(file.name, text), text, { file: file.name })) listing.name = file.name;
}

/** A program pasted in place of the whole text is opened as one from a file is. */
export function followPaste(use) {
  listing.onreplaced = (text) => use(languageOf("", text), text);
}

/** Points at a line of the program where it was typed. */
export function showLine(line) {
  if (listing.node.closest("[hidden]")) return;
  listing.node.closest("details").open = true;
  listing.show(line);
}

/** Calls `point(time)` whenever the caret comes to a line that runs. */
export function followCaret(point) {
  listing.onpoint = (line) => {
    const time = timeOf(line);
    if (time !== undefined) point(time);
  };
}
