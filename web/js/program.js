// Programs: opened, dropped or taken from the examples; what was understood of them; the way from a
// line to the charts and back.

import { byId, make } from "./dom.js";
import { readText } from "./files.js";
import { listing } from "./listing.js";
import { formatNumber } from "./number.js";
import { inLength, lengthUnit } from "./units.js";

const LANGUAGES = { gcode: "G-code", apt: "APT / CLDATA", csv: "Points" };
const DIALECTS = {
  fanuc: " for Fanuc or Haas",
  linuxcnc: " for LinuxCNC",
  grbl: " for grbl",
  siemens: " for Siemens",
  mach: " for Mach",
};
const ENDINGS = {
  apt: ["apt", "aptsource", "cls", "cl", "ncl"],
  csv: ["csv", "txt", "tsv", "xyz"],
  gcode: ["nc", "ngc", "gcode", "g", "tap", "cnc", "mpf", "spf", "eia", "iso"],
};

const MOST_IGNORED = 40; // words listed

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
      await use(chosen.kind, await readText(`examples/${chosen.file}`), chosen);
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
  if (await use(languageOf(file.name, text), text)) listing.name = file.name;
}

/** A program pasted in place of the whole text is opened as one from a file is. */
export function followPaste(use) {
  listing.onreplaced = (text) => use(languageOf("", text), text);
}

/** What the core understood, above the path's charts; nothing for a path that was drawn. */
export function showProgram(program, duration) {
  const box = byId("program");
  box.hidden = !program;
  if (!program) return;
  const read = (value) => String(Number(inLength(value).toFixed(lengthUnit() === "mm" ? 3 : 4))).replace("-", "\u2212");
  const span = (low, high) => (read(low) === read(high) ? read(low) : `${read(low)} to ${read(high)}`);
  const extents = ["X", "Y", "Z"].map((axis, i) => `${axis} ${span(program.lowest_mm[i], program.highest_mm[i])}`);
  const facts = [
    [
      "Language",
      `${LANGUAGES[program.language]}${DIALECTS[program.dialect] ?? ""}, ${program.lines} lines in ${program.unit}`,
    ],
    [
      "Moves",
      `${program.cutting_moves} that cut, ${program.rapid_moves} rapid${program.multi_axis ? "; the tool axis turns" : ""}`,
    ],
    [`Extents, ${lengthUnit()}`, extents.join(", ")],
    [
      `Feeds, ${lengthUnit()}/s`,
      program.feeds_mm_s ? span(...program.feeds_mm_s) : "none in the program: the job's feed holds",
    ],
    ["Time, s", formatNumber(duration, 4)],
    ["Without effect", program.ignored.length ? "" : "nothing"],
  ];
  byId("understood").replaceChildren(
    ...facts.map(([name, text]) => make("div", {}, make("dt", {}, name), make("dd", {}, text))),
  );
  if (program.ignored.length) byId("understood").lastChild.lastChild.append(ignoredList(program.ignored));
}

function ignoredList(ignored) {
  const rest = ignored.length - MOST_IGNORED;
  const more = rest > 0 ? [make("li", {}, `and ${rest} more`)] : [];
  return make("ul", {}, ...ignored.slice(0, MOST_IGNORED).map(ignoredItem), ...more);
}

function ignoredItem({ word, lines }) {
  const shown = lines.slice(0, 5).map((line) => {
    const button = make("button", { type: "button", className: "quiet" }, String(line));
    button.setAttribute("aria-label", `Show line ${line}`);
    button.addEventListener("click", () => showLine(line));
    return button;
  });
  return make(
    "li",
    {},
    make("code", {}, word),
    lines.length === 1 ? " in line " : " in lines ",
    ...shown,
    lines.length > 5 ? ` and ${lines.length - 5} more` : "",
  );
}

let lines = null; // program line of each sample of the shown result
let sampleTime = 1;

/** Takes over the lines of a new result; `null` for a path that was drawn. */
export function setLines(column, time) {
  [lines, sampleTime] = [column, time];
}

/** The line that runs at a time [s], or undefined. */
export const lineAt = (time) =>
  lines?.[Math.min(lines.length - 1, Math.max(0, Math.round(time / sampleTime)))] || undefined;

/** The time [s] at which a line starts to run, or undefined. */
function timeOf(line) {
  const sample = lines?.indexOf(line) ?? -1;
  return sample < 0 ? undefined : sample * sampleTime;
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
