// The warnings of a result, most severe first, and what cures them.

import { byId, make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";

/** @import { Remedy, Warning } from "../../pkg/armill.js" */

/**
 * Writes the warnings of a summary; `apply(patch)` changes the job by the merge patch of a remedy.
 * @param {Warning[]} warnings
 * @param {(patch: Remedy["patch"]) => void} apply
 */
export function showWarnings(warnings, apply) {
  const count = warnings.length;
  const box = byId("warnings");
  byId("warnings-count").textContent = count === 0 ? "No warnings" : `${count} ${count === 1 ? "warning" : "warnings"}`;
  byId("warnings-first").textContent = count === 0 ? "" : `: ${impossible(warnings[0])}${warnings[0].message}`;
  box.classList.toggle("none", count === 0);
  if (count === 0) box.open = false;
  byId("warnings-list").replaceChildren(...warnings.map((warning) => warningItem(warning, apply)));
  showFirstRemedy(warnings, apply);
}

/**
 * The cure of the most severe warning that has one, beside the warnings.
 * @param {Warning[]} warnings
 * @param {(patch: Remedy["patch"]) => void} apply
 */
function showFirstRemedy(warnings, apply) {
  const { remedy } = warnings.find((warning) => warning.remedy && warning.severity !== "note") ?? {};
  const button = byId("remedy-first");
  button.hidden = !remedy;
  if (!remedy) return;
  button.textContent = remedy.label.split(", ")[0]; // what it does; the list has all of it
  button.title = remedy.label;
  button.onclick = () => apply(remedy.patch);
}

/**
 * What the arm cannot run is said before what it would achieve.
 * @param {{ severity: Warning["severity"] }} given
 */
const impossible = ({ severity }) => (severity === "cannot-run" ? "cannot run: " : "");

/** The names of the severities. */
export const SEVERITY = { "cannot-run": "Cannot run", matters: "Matters", note: "Note" };

/**
 * @param {Warning} warning
 * @param {(patch: Remedy["patch"]) => void} apply
 */
function warningItem({ code, severity, message, spans_s, remedy }, apply) {
  const when = spans_s ? stretches(spans_s) : "";
  const mark = make("strong", {}, `${SEVERITY[severity]}: `);
  const item = make("li", {}, mark, message, when && ": ", make("span", { className: "unit" }, when));
  item.dataset.code = code;
  item.dataset.severity = severity;
  if (remedy) item.append(" ", remedyButton(remedy, apply));
  return item;
}

const MOST_STRETCHES = 3; // in words; of more, the first and the last instant

/**
 * When a warning applies, from its stretches of time [s].
 * @param {[number, number][]} spans
 */
function stretches(spans) {
  /** @param {[number, number]} pair */
  const one = ([from, to]) =>
    from === to ? `at ${formatNumber(from)} s` : `${formatNumber(from)} to ${formatNumber(to)} s`;
  if (spans.length <= MOST_STRETCHES) return spans.map(one).join(", ");
  return `${one([spans[0][0], spans[spans.length - 1][1]])}, in ${spans.length} stretches`;
}

/**
 * The button that applies a warning's remedy. The list is rebuilt afterwards, so the focus moves to its heading.
 * @param {{ label: string, patch: any }} given
 * @param {(patch: Remedy["patch"]) => void} apply
 */
function remedyButton({ label, patch }, apply) {
  const button = make("button", { type: "button", className: "remedy" }, label);
  button.addEventListener("click", () => {
    byId("warnings").querySelector("summary")?.focus();
    apply(patch);
  });
  return button;
}
