// Frequency and damping from a step or impact response.

import { make, sentence } from "../page/dom.js";
import { notify } from "../page/toast.js";
import { numberCell } from "../form/number-cell.js";
import { formatNumber } from "../page/number.js";
import { Outcome, remarks } from "./result.js";
import { Source } from "./input.js";

/**
 * @import { ResponseSummary } from "../../pkg/armill.js"
 * @import { Ask, Present } from "./panel.js"
 */

/** @param {{ ask: Ask } & Present} page */
export function makeResponse({ ask, job, use }) {
  const cell = numberCell("identify-from", "s");
  const from = cell.input;
  from.placeholder = "largest peak";
  const source = new Source({
    id: "identify-response",
    label: "Measured response",
    placeholder: "time_s, acceleration\n0.000, 0.02\n0.004, 1.41\n…",
    exampleName: "Example: computed response",
    changed: () => look(),
    example,
    more: [
      make("label", { htmlFor: "identify-from" }, "Free decay from ", make("span", { className: "unit" }, "s "), from),
    ],
  });
  const outcome = new Outcome({
    ask,
    kind: "response",
    source,
    chart: { name: "response", title: "Measured response and fitted vibration" },
    show,
  });
  from.addEventListener("change", () => look());

  function example() {
    source.read("identify-response.csv").then(look, (error) => source.fail(error));
  }

  function look() {
    let start;
    try {
      start = from.value.trim() ? cell.read() : undefined;
      from.removeAttribute("aria-invalid");
    } catch ({ message }) {
      from.setAttribute("aria-invalid", "true");
      return source.fail({
        message: `The free decay starts at a number of seconds, such as 0.25; empty: at the largest peak. ${message}`,
      });
    }
    outcome.compute(start);
  }

  /** @param {ResponseSummary} found */
  function take({ frequency_rad_s, frequency_hz, damping }) {
    const next = job();
    /** @param {number} value */
    const digits = (value) => Number(value.toPrecision(6));
    const before = typeof next.shaper === "object" ? next.shaper : { kind: "zvd" };
    const frequency =
      before.frequency_hz === undefined
        ? { frequency_rad_s: digits(frequency_rad_s) }
        : { frequency_hz: digits(frequency_hz) };
    use({ ...next, shaper: { kind: before.kind, ...frequency, damping: digits(damping) } });
    notify("The job’s shaper now has this frequency and damping. Undo removes them.");
  }

  /** @param {ResponseSummary} found */
  function show(found) {
    const button = make(
      "button",
      { type: "button", className: "primary", id: "use-mode" },
      "Use this frequency and damping in the job",
    );
    button.addEventListener("click", () => take(found));
    /**
     * @param {string} id
     * @param {string} name
     * @param {string} unit
     * @param {number} value
     * @param {[number | null, number | null]} interval
     */
    const fact = (id, name, unit, value, [low, high]) =>
      make(
        "div",
        {},
        make("dt", {}, name, make("span", { className: "unit" }, ` ${unit}`)),
        make(
          "dd",
          {},
          make("output", { id }, formatNumber(value, 5)),
          make("span", { className: "unit" }, ` ± ${formatNumber(((high ?? Infinity) - (low ?? -Infinity)) / 2, 2)}`),
        ),
      );
    return [
      make(
        "dl",
        { className: "mode" },
        fact("identified-hz", "Natural frequency", "Hz", found.frequency_hz, found.frequency_interval_hz),
        fact("identified-rad", "Natural frequency", "rad/s", found.frequency_rad_s, found.frequency_interval_rad_s),
        fact("identified-damping", "Damping ratio", "", found.damping, found.damping_interval),
      ),
      make(
        "p",
        { className: "found" },
        found.sentence +
          (found.decrement
            ? ` By the peaks alone (logarithmic decrement): ${formatNumber(found.decrement.frequency_rad_s)} rad/s and ` +
              `${formatNumber(found.decrement.damping)}.`
            : " The peaks alone say something else, so they are disturbed."),
      ),
      ...remarks(found.remarks.map(({ message }) => sentence(message))),
      make(
        "p",
        { className: "note" },
        "± is half a 95 % interval, if the residual of the fit is noise. The frequency is the undamped one, which the shaper needs.",
      ),
      make("div", { className: "identify-tools" }, button),
    ];
  }

  return {
    node: make(
      "section",
      { className: "identify", "aria-labelledby": "identify-mode" },
      make("h2", { id: "identify-mode" }, "Frequency and damping from a measured response"),
      make(
        "p",
        { className: "lead" },
        "Stop the arm abruptly, or strike it, and record the acceleration until it is at rest. One row per instant: time " +
          "and signal. The signal’s unit does not matter.",
      ),
      source.node,
      outcome.node,
    ),
    look,
    example,
  };
}
