// Writes a summary into the page: verdict, large numbers, warnings, tables.

import { showBudget } from "./budget.js";
import { showCut } from "./cut.js";
import { byId } from "../page/dom.js";
import { showFeedRule } from "./feed-rule.js";
import { formatNumber, plainNumber } from "../page/number.js";
import { showSurface } from "./surface.js";
import { showWarnings } from "./warnings.js";
import { errorText, forceText, forceUnit, largeText, lengthText, lengthUnit } from "../page/units.js";

const LONG = 150; // letters of a verdict from which on they are smaller

/** @import { Remedy, Statistics, Summary, ThesisRow, Warning } from "../../pkg/armill.js" */

/** @typedef {(patch: Remedy["patch"]) => void} Apply changes the job by the merge patch of a warning's remedy */

/**
 * Puts a number on the page: rounded to read, in full in `data-value`.
 * @param {string} id
 * @param {number} value
 * @param {(value: number) => string} [format]
 */
function put(id, value, format = formatNumber) {
  const element = byId(id);
  element.textContent = format(value);
  element.dataset.value = String(value);
}

/** Writes the chosen units wherever a figure has one. */
export function showUnits() {
  for (const unit of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-unit]")))
    unit.textContent = unit.dataset.unit === "force" ? forceUnit() : lengthUnit();
}

/**
 * Writes a summary.
 * @param {Summary} summary
 * @param {Apply} apply
 */
export function showSummary(summary, apply) {
  const { before_mm: before, after_mm: after } = summary;
  showUnits();
  byId("verdict").textContent = summary.verdict;
  byId("verdict").classList.toggle("long", summary.verdict.length > LONG);
  byId("results").dataset.verdict = summary.verdict_state;
  put("before-mean", before.both.mean, lengthText);
  put("before-max", before.both.max, largeText);
  put("expected-p50", summary.expected_mm.p50, largeText);
  put("expected-p95", summary.expected_mm.p95, largeText);
  showHowSure(summary.how_sure);
  put("passes", summary.passes);
  put("force", Math.hypot(...summary.mean_force_n), forceText);
  put("duration", summary.duration_s);
  put("fact-duration", summary.duration_s);
  byId("force-parts").textContent = summary.mean_force_n.map((part, i) => `${"xyz"[i]} ${forceText(part)}`).join(", ");
  byId("length").textContent = `${lengthText(summary.path_length_mm, 4)} ${lengthUnit()}${stopsText(summary)}`;
  showTolerance(summary);
  showErrors(before, after);
  showBudget(summary.budget);
  showCut(summary);
  byId("fact-tolerance").textContent = toleranceText(summary);
  put("samples", summary.samples);
  byId("history").textContent = summary.history_max_mm.map((mm) => lengthText(mm)).join(" → ");
  byId("branch").textContent = summary.branch;
  byId("spin-gain").hidden = !summary.spin;
  const gain = byId("spin-gain").lastElementChild;
  if (gain) gain.textContent = summary.spin?.sentence ?? "";
  showFeedRule(summary.feed_rule);
  showSurface(summary);
  byId("fingerprint").textContent = summary.fingerprint;
  showWarnings(summary.warnings, apply);
}

/**
 * How often the path stops, if it does.
 * @param {Summary} summary
 */
const stopsText = ({ stops: { count } }) => (count ? `, ${count} ${count === 1 ? "stop" : "stops"}` : "");

/**
 * The tolerance as it was typed; in another unit, to three digits.
 * @param {Summary} summary
 */
const toleranceText = ({ tolerance_mm }) =>
  lengthUnit() === "mm" ? plainNumber(tolerance_mm) : lengthText(tolerance_mm);

/**
 * What is known and what is not.
 * @param {Summary["how_sure"]} sure
 */
function showHowSure({ sentence, measure_first, break_even, left_out }) {
  byId("expected").textContent = sentence;
  byId("measure-first").textContent = measure_first?.sentence ?? "";
  byId("break-even").textContent = break_even;
  byId("left-out").textContent = left_out;
}

const TOLERANCE = {
  "cannot-run": "✗ cannot run",
  met: "✓ within",
  "met-if-nominal": "✗ if exact",
  "not-met": "✗ over",
};

/**
 * The verdict in two words, with the tolerance.
 * @param {import("../../pkg/armill.js").Summary} summary
 */
export function toleranceLine(summary) {
  const { verdict_state: state } = summary;
  const tolerance = state === "cannot-run" ? "" : ` ${toleranceText(summary)} ${lengthUnit()}`;
  return TOLERANCE[state] + tolerance;
}

/** @param {Summary} summary */
function showTolerance(summary) {
  const { converged, verdict_state: state } = summary;
  const line = byId("tolerance-met");
  line.textContent = toleranceLine(summary);
  line.classList.toggle("bad", state !== "met");
  line.dataset.state = state;
  line.dataset.converged = String(converged);
}

/**
 * @param {Summary["before_mm"]} before
 * @param {Statistics} after
 */
function showErrors(before, after) {
  const rows = { deflection: before.deflection, shaping: before.shaping, both: before.both, compensated: after };
  for (const [name, { mean, max }] of Object.entries(rows)) {
    put(`${name}-mean`, mean, errorText);
    put(`${name}-max`, max, errorText);
  }
}
