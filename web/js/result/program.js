// What the core understood of the program.

import { showLine } from "../form/program-tools.js";
import { byId, make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { inLength, lengthUnit } from "../page/units.js";

/** @import { Understood } from "../../pkg/armill.js" */

const LANGUAGES = { gcode: "G-code", apt: "APT / CLDATA", csv: "Points" };
/** @type {Record<string, string>} */
const DIALECTS = {
  fanuc: " for Fanuc or Haas",
  linuxcnc: " for LinuxCNC",
  grbl: " for grbl",
  siemens: " for Siemens",
  mach: " for Mach",
};

const MOST_IGNORED = 40; // words listed

/**
 * What the core understood, above the path's charts; nothing for a path that was drawn.
 * @param {Understood | undefined} program
 * @param {number} duration [s]
 */
export function showProgram(program, duration) {
  const box = byId("program");
  box.hidden = !program;
  if (!program) return;
  /** @param {number} value */
  const read = (value) => String(Number(inLength(value).toFixed(lengthUnit() === "mm" ? 3 : 4))).replace("-", "\u2212");
  /**
   * @param {number} low
   * @param {number} high
   */
  const span = (low, high) => (read(low) === read(high) ? read(low) : `${read(low)} to ${read(high)}`);
  const extents = ["X", "Y", "Z"].map((axis, i) => `${axis} ${span(program.lowest_mm[i], program.highest_mm[i])}`);
  const facts = [
    [
      "Language",
      `${LANGUAGES[program.language]}${DIALECTS[program.dialect ?? ""] ?? ""}, ${program.lines} lines in ${program.unit}`,
    ],
    [
      "Moves",
      `${program.cutting_moves} that cut, ${program.rapid_moves} rapid${program.multi_axis ? "; the tool axis turns" : ""}`,
    ],
    [`Extents, ${lengthUnit()}`, extents.join(", ")],
    [
      `Feeds, ${lengthUnit()}/s`,
      program.feeds_mm_s ? span(...program.feeds_mm_s) : "none in the program: the job's feed is used",
    ],
    ["Time, s", formatNumber(duration, 4)],
    ["Without effect", program.ignored.length ? "" : "nothing"],
  ];
  byId("understood").replaceChildren(
    ...facts.map(([name, text]) => make("div", {}, make("dt", {}, name), make("dd", {}, text))),
  );
  if (program.ignored.length)
    byId("understood").lastElementChild?.lastElementChild?.append(ignoredList(program.ignored));
}

/** @param {Understood["ignored"]} ignored */
function ignoredList(ignored) {
  const rest = ignored.length - MOST_IGNORED;
  const more = rest > 0 ? [make("li", {}, `and ${rest} more`)] : [];
  return make("ul", {}, ...ignored.slice(0, MOST_IGNORED).map(ignoredItem), ...more);
}

/** @param {Understood["ignored"][number]} item */
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
