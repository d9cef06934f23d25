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
 */

/** @typedef {{ of(summary: Summary): number, text(value: number): string }} Compared a figure that is compared */

/**
 * @param {number} value
 * @param {(size: number) => string} text
 */
const signed = (value, text) => `${value < 0 ? "\u2212" : "+"}${text(Math.abs(value))}`;

/** The rows: what of a summary, and as what it is read; without `text`, `of` is in words. */
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

/** What holds of both bands: half of the draws and 95 % of them lie below their ends. */
const overlap = ({ expected_mm: a }, { expected_mm: b }) => a.p50 <= b.p95 && b.p50 <= a.p95;

/**
 * Wires the comparison: `shown()` is the shown result, `load(job)` takes over a job. Returns `show()`,
 * to be called with every result, and `restore()`, which pins again what was pinned before a reload.
 */
export function makeCompare({ shown, load }) {
  const box = byId("compare");
  const show = () => shown() && showCompared(box, shown());
  byId("pin").addEventListener("click", () => {
    const same = pinned().find(({ text }) => text === shown().text);
    if (same) return say(`${same.letter} is this result already.`);
    if (!nextLetter()) return say("Five results are pinned. Unpin one first.");
    addPin(shown());
    show();
  });
  byId("unpin").addEventListener("click", () => {
    removePin();
    show();
    byId("pin").focus();
  });
  const letterOf = (target) => target.closest("[data-letter]").dataset.letter;
  box.addEventListener("click", ({ target }) => {
    const action = target.closest("button")?.dataset.action;
    if (action === "back") load(JSON.parse(pinned().find(({ letter }) => letter === letterOf(target)).text));
    if (action !== "unpin") return;
    removePin(letterOf(target));
    show();
    (box.querySelector("[data-action=unpin]") ?? byId("pin")).focus();
  });
  box.addEventListener("change", ({ target }) => {
    if (target.type === "radio") compareWith(target.value);
    else renamePin(letterOf(target), target.value.trim());
    show();
  });
  return { show, restore: () => restorePins(show) };
}

const say = (text) => (byId("compare-title").textContent = text);

/** Shows what is compared: the pinned results with `shown`. */
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
  fill(box.querySelector("thead"), pins);
  const [figures, differing] = box.querySelectorAll("tbody");
  figures.replaceChildren(
    ...FIGURES.filter(({ of }) => columns.some(({ summary }) => of(summary) !== undefined)).map((figure) =>
      figureRow(figure, columns),
    ),
  );
  const at = columns.indexOf(referencePin());
  differing.replaceChildren(...inputs.map((line) => inputRow(line, at)));
}

/** What the shown result is to the reference. */
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

/** The heads: letter, name and what can be done with each; they keep the focus. */
function fill(head, pins) {
  const state = JSON.stringify([pins.map(({ letter, name }) => [letter, name]), referencePin().letter]);
  if (head.dataset.state === state) return;
  const focus = document.activeElement?.id;
  head.dataset.state = state;
  const cell = (...children) => make("th", { scope: "col" }, ...children);
  head.rows[0].replaceChildren(cell("Result"), ...pins.map((pin) => pinHead(pin, pins.length)), cell(SHOWN));
  if (focus && head.querySelector(`#${focus}`)) byId(focus).focus();
}

function pinHead({ letter, name }, count) {
  const id = letter.toLowerCase();
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

function figureRow(figure, columns) {
  const { id, label, unit } = figure;
  const head = make("th", { scope: "row" }, label, ...(unit ? [" ", make("span", { className: "unit" }, unit())] : []));
  return make("tr", { id: `compare-${id}` }, head, ...columns.map((column) => figureCell(figure, column)));
}

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

/** A difference in words; what is too small to read is none. */
function changeText(value, base, text, equal) {
  const change = value - base;
  if (change === 0) return "no change";
  if (text(Math.abs(change)).startsWith("<")) return "hardly a change";
  if (equal) return `${signed(change, text)}, within the bands`;
  const share = base === 0 ? "" : ` (${signed((100 * change) / base, (percent) => formatNumber(percent, 2))}\u00a0%)`;
  return signed(change, text) + share;
}

/** An input that differs; what is as in the reference is plain. */
function inputRow({ label, texts }, at) {
  const cells = texts.map((text) => make("td", { className: text === texts[at] ? "" : "differs" }, text));
  return make("tr", {}, make("th", { scope: "row" }, label), ...cells);
}
