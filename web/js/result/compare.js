// Pinned results, A to E, beside the shown one: a table with every figure and the inputs that differ,
// compared with one of them, and their curves in the charts.

import { setBeside } from "../chart/panel.js";
import { byId, make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { forceText, forceUnit, lengthText, lengthUnit } from "../page/units.js";
import { differingInputs } from "./differing.js";
import { addPin, compareWith, nextLetter, pinned, referencePin, removePin, renamePin, restorePins } from "./pinned.js";
import { toleranceLine } from "./summary.js";

const SHOWN = "Shown"; // what the shown result is called

/**
 * @import { Summary } from "../../pkg/armill.js"
 * @import { Shown } from "../calculator.js"
 * @import { JobData } from "../job/data.js"
 * @import { Pin } from "./pinned.js"
 */

/**
 * A figure that is compared: what of a summary, and as what it is read; without `text`, `of` is in words.
 *
 * @typedef {{ id: string, label: string, of(summary: Summary): any, text?: (value: number) => string, unit?: () => string }} Figure
 */

/** @typedef {{ letter: string, summary: Summary }} Column a result beside the others */

/**
 * @param {number} value
 * @param {(size: number) => string} text
 */
const signed = (value, text) => `${value < 0 ? "\u2212" : "+"}${text(Math.abs(value))}`;

/**
 * The rows: what of a summary, and as what it is read; without `text`, `of` is in words.
 * @type {Figure[]}
 */
const FIGURES = [
  { id: "verdict", label: "Verdict", of: toleranceLine },
  {
    id: "before-max",
    label: "Before, largest",
    of: ({ before_mm }) => before_mm.both.max,
    text: lengthText,
    unit: lengthUnit,
  },
  {
    id: "expected-p50",
    label: "Expected",
    of: ({ expected_mm }) => expected_mm.p50,
    text: lengthText,
    unit: lengthUnit,
  },
  {
    id: "expected-p95",
    label: "Expected, 95 of 100",
    of: ({ expected_mm }) => expected_mm.p95,
    text: lengthText,
    unit: lengthUnit,
  },
  {
    id: "surface",
    label: "Surface left, 95 of 100",
    of: ({ surface }) => surface?.after_p95_mm,
    text: lengthText,
    unit: lengthUnit,
  },
  {
    id: "force",
    label: "Mean force",
    of: ({ mean_force_n }) => Math.hypot(...mean_force_n),
    text: forceText,
    unit: forceUnit,
  },
  { id: "duration", label: "Duration", of: ({ duration_s }) => duration_s, text: formatNumber, unit: () => "s" },
  { id: "robot", label: "Robot", of: ({ robot }) => robot },
];

/**
 * What holds of both bands: half of the draws and 95 % of them lie below their ends.
 * @param {Summary} a
 * @param {Summary} b
 */
const overlap = ({ expected_mm: a }, { expected_mm: b }) => a.p50 <= b.p95 && b.p50 <= a.p95;

/**
 * Wires the comparison: `shown()` is the shown result, `load(job)` takes over a job. Returns `show()`,
 * to be called with every result, and `restore()`, which pins again what was pinned before a reload.
 * @param {{ shown(): Shown | null, load(job: JobData): void }} page
 */
export function makeCompare({ shown, load }) {
  const box = byId("compare");
  const show = () => {
    const result = shown();
    if (result) showCompared(box, result);
  };
  byId("pin").addEventListener("click", () => {
    const result = shown();
    if (!result) return;
    const same = pinned().find(({ text }) => text === result.text);
    if (same) return say(`${same.letter} is this result already.`);
    if (!nextLetter()) return say("Five results are pinned. Unpin one first.");
    addPin(result);
    show();
  });
  byId("unpin").addEventListener("click", () => {
    removePin();
    show();
    byId("pin").focus();
  });
  /** @param {Element} target */
  const letterOf = (target) => {
    /** @type {HTMLElement | null} */
    const head = target.closest("[data-letter]");
    return String(head?.dataset.letter);
  };
  box.addEventListener("click", (event) => {
    const target = /** @type {Element} */ (event.target);
    const action = target.closest("button")?.dataset.action;
    const pin = pinned().find(({ letter }) => letter === letterOf(target));
    if (action === "back" && pin) load(JSON.parse(pin.text));
    if (action !== "unpin") return;
    removePin(letterOf(target));
    show();
    /** @type {HTMLElement | null} */
    const next = box.querySelector("[data-action=unpin]");
    (next ?? byId("pin")).focus();
  });
  box.addEventListener("change", (event) => {
    const target = /** @type {HTMLInputElement} */ (event.target);
    if (target.type === "radio") compareWith(target.value);
    else renamePin(letterOf(target), target.value.trim());
    show();
  });
  return { show, restore: () => restorePins(show) };
}

/** @param {string} text */
const say = (text) => (byId("compare-title").textContent = text);

/**
 * Shows what is compared: the pinned results with `shown`.
 * @param {Shown} shown
 * @param {HTMLElement} box
 */
function showCompared(box, shown) {
  const pins = pinned();
  box.hidden = !pins.length;
  const next = nextLetter();
  byId("pin").textContent = next ? `Pin as ${next}` : "Pin";
  const others = pins.filter(({ text }) => text !== shown.text);
  setBeside(
    others,
    others.some(({ summary }) => summary.duration_s !== shown.summary.duration_s),
  );
  if (!pins.length) return;
  const jobs = [...pins.map(({ text }) => shown.job.of(JSON.parse(text))), shown.job];
  const columns = [...pins, { letter: SHOWN, summary: shown.summary }];
  const inputs = differingInputs(jobs);
  say(sentence(shown, others, differingInputs([jobs[pins.indexOf(referencePin())], shown.job]).length));
  fill(/** @type {HTMLTableSectionElement} */ (box.querySelector("thead")), pins);
  const [figures, differing] = box.querySelectorAll("tbody");
  figures.replaceChildren(
    ...FIGURES.filter(({ of }) => columns.some(({ summary }) => of(summary) !== undefined)).map((figure) =>
      figureRow(figure, columns),
    ),
  );
  const at = columns.indexOf(referencePin());
  differing.replaceChildren(...inputs.map((line) => inputRow(line, at)));
}

/**
 * What the shown result is to the reference.
 * @param {Shown} shown
 * @param {Pin[]} others
 * @param {number} count
 */
function sentence(shown, others, count) {
  const { letter, summary } = referencePin();
  if (!others.length) return `${letter} is pinned. Change an input, and the next result stands beside it.`;
  if (!count) return `The shown result is ${letter}.`;
  const inputs = count === 1 ? "one input differs" : `${count} inputs differ`;
  if (overlap(shown.summary, summary))
    return `Shown against ${letter}: ${inputs}. The expected errors are equal as far as is known: their bands overlap.`;
  const less = shown.summary.expected_mm.p50 < summary.expected_mm.p50;
  return `Shown against ${letter}: ${inputs}. Expect ${less ? "less" : "more"} error: the bands do not overlap.`;
}

/**
 * The heads: letter, name and what can be done with each; they keep the focus.
 * @param {HTMLTableSectionElement} head
 * @param {Pin[]} pins
 */
function fill(head, pins) {
  const state = JSON.stringify([pins.map(({ letter, name }) => [letter, name]), referencePin().letter]);
  if (head.dataset.state === state) return;
  const focus = document.activeElement?.id;
  head.dataset.state = state;
  /** @param {...Node | string} children */
  const cell = (...children) => make("th", { scope: "col" }, ...children);
  head.rows[0].replaceChildren(cell("Result"), ...pins.map((pin) => pinHead(pin, pins.length)), cell(SHOWN));
  if (focus && head.querySelector(`#${focus}`)) byId(focus).focus();
}

/**
 * @param {{ letter: string, name: string }} given
 * @param {number} count
 */
function pinHead({ letter, name }, count) {
  const id = letter.toLowerCase();
  /**
   * @param {string} action
   * @param {string} label
   * @param {string} text
   */
  const button = (action, label, text) =>
    make("button", { type: "button", className: "quiet", id: `${label}-${id}`, "data-action": action }, text);
  const input = make("input", {
    id: `name-${id}`,
    value: name,
    placeholder: "Name",
    maxLength: 40,
    autocomplete: "off",
  });
  input.setAttribute("aria-label", `Name of ${letter}`);
  const radio = make("input", { type: "radio", name: "reference", value: letter, id: `reference-${id}` });
  radio.setAttribute("aria-label", `reference ${letter}`);
  radio.checked = referencePin().letter === letter;
  const choice = make("label", { className: "choice" }, radio, make("span", {}, "reference"));
  return make(
    "th",
    { scope: "col", className: `pin-${id}`, "data-letter": letter },
    make(
      "span",
      { className: "whose" },
      make("strong", { className: "letter" }, letter),
      ...(count > 1 ? [choice] : []),
    ),
    input,
    button("back", "back-to", `Back to ${letter}’s inputs`),
    button("unpin", "unpin", "Unpin"),
  );
}

/**
 * @param {Figure} figure
 * @param {Column[]} columns
 */
function figureRow(figure, columns) {
  const { id, label, unit } = figure;
  const head = make("th", { scope: "row" }, label, ...(unit ? [" ", make("span", { className: "unit" }, unit())] : []));
  return make("tr", { id: `compare-${id}` }, head, ...columns.map((column) => figureCell(figure, column)));
}

/**
 * @param {Figure} figure
 * @param {Column} column
 */
function figureCell({ id, of, text }, { letter, summary }) {
  const value = of(summary);
  if (value === undefined) return make("td", {}, "–");
  if (!text) return make("td", {}, value);
  const cell = make("td", { className: "digits" }, text(value));
  const first = referencePin();
  const base = of(first.summary);
  if (letter === first.letter || base === undefined) return cell;
  cell.dataset.value = String(value - base);
  const equal = id.startsWith("expected") && overlap(summary, first.summary);
  cell.append(make("span", { className: "change" }, changeText(value, base, text, equal)));
  return cell;
}

/**
 * A difference in words; what is too small to read is none.
 * @param {number} value
 * @param {number} base
 * @param {(size: number) => string} text
 * @param {boolean} equal
 */
function changeText(value, base, text, equal) {
  const change = value - base;
  if (change === 0) return "no change";
  if (text(Math.abs(change)).startsWith("<")) return "hardly a change";
  if (equal) return `${signed(change, text)}, within the bands`;
  const share = base === 0 ? "" : ` (${signed((100 * change) / base, (percent) => formatNumber(percent, 2))}\u00a0%)`;
  return signed(change, text) + share;
}

/**
 * An input that differs; what is as in the reference is plain.
 * @param {{ label: string, texts: string[] }} given
 * @param {number} at
 */
function inputRow({ label, texts }, at) {
  const cells = texts.map((text) => make("td", { className: text === texts[at] ? "" : "differs" }, text));
  return make("tr", {}, make("th", { scope: "row" }, label), ...cells);
}
