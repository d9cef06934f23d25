// The inputs of a question: which one, about which numbers, over which range.

import { make, select } from "../page/dom.js";
import { MEASURES, PLACES } from "./question.js";
import { askable, choosable, makeRangeFields } from "./range-fields.js";

/**
 * @import { Field } from "../../pkg/armill.js"
 * @import { Job } from "../job/job.js"
 * @import { Measure, Place, Question, Range } from "./question.js"
 */

const COUNT = 20; // values of a sweep over one number
const COUNT_EACH = 7; // of each of two
const WIDE = 10; // from such a ratio of its ends on, a range of positive numbers goes in equal ratios

/** @type {Record<Question["kind"], { button: string, help: string }>} */
const KINDS = {
  largest: {
    button: "How much is too much?",
    help: "The largest value of a number for which the error meets the job’s tolerance.",
  },
  sweep: { button: "Error over a number", help: "How the error follows one number or choice of the job, or two." },
  robots: {
    button: "Which robot?",
    help: "This job on every robot of the library; hollow bars and “guessed” mean that its stiffness is a guess.",
  },
  choices: {
    button: "Which way round?",
    help: "Climb or conventional, direction, start point and turn of the tool: what a programmer may choose.",
  },
  tornado: { button: "What matters most?", help: "Each uncertain input alone, over its own range." },
  loops: {
    button: "What would a sensor bring?",
    help:
      "A force, the tool’s position or the joints’ angles, measured while the arm mills, and corrected every cycle; " +
      "the times of the controllers are in the documentation.",
  },
  measures: { button: "What to measure?", help: "What each measurement would do to the band." },
};

/**
 * The inputs; `ask()` is called when a question is chosen or changed.
 * @param {{ ask(): void, changed(): void }} on
 */
export function makeFields({ ask, changed }) {
  /** @type {Question["kind"] | undefined} */
  let kind;
  const first = makeRangeFields("study-first", "Number", changed);
  const second = makeRangeFields("study-second", "and", changed, true);
  const measure = select("study-measure", MEASURES);
  const place = select("study-place", PLACES);
  const measureField = labelled("Error", measure);
  const placeField = labelled("Part", place);
  const help = make("p", { className: "note" });
  const buttons = Object.entries(KINDS).map(([value, { button }]) => {
    const made = make("button", { type: "button", "data-question": value, "aria-pressed": "false" }, button);
    made.addEventListener("click", () => {
      show(/** @type {Question["kind"]} */ (value));
      ask();
    });
    return made;
  });
  const node = make(
    "div",
    { className: "study-fields" },
    make("div", { className: "study-kinds", role: "group", "aria-label": "Questions" }, ...buttons),
    help,
    make("div", { className: "study-inputs" }, first.node, second.node, measureField, placeField),
  );
  for (const input of [measure, place]) input.addEventListener("change", ask);

  /** @param {Question["kind"]} asked */
  function show(asked) {
    kind = asked;
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.question === asked));
    help.textContent = KINDS[asked].help;
    first.withChoices(asked === "sweep");
    first.node.hidden = asked !== "largest" && asked !== "sweep";
    second.node.hidden = asked !== "sweep";
    measureField.hidden = asked !== "largest";
    placeField.hidden = asked !== "robots";
  }
  for (const part of [first.node, second.node, measureField, placeField]) part.hidden = true;

  /**
   * @param {import("./range-fields.js").Entered} range
   * @param {number} count
   * @returns {Range}
   */
  function walked(range, count) {
    if ("words" in range) return range;
    if (range.from >= range.to) throw new Error("“To” is to be more than “From”.");
    return { ...range, count, log: range.from > 0 && range.to / range.from >= WIDE };
  }

  return {
    node,
    show,
    /**
     * Offers the numbers of a job.
     * @param {Job} job
     * @param {Field[]} fields
     */
    offer(job, fields) {
      const of = (/** @type {string} */ path) => job.valueAt(path);
      const offered = [...askable(job, fields), ...choosable(job, fields)];
      first.offer(offered, of);
      second.offer(offered, of);
    },
    /**
     * Shows a question as it was asked.
     * @param {Question} question
     */
    take(question) {
      show(question.kind);
      if (question.kind === "largest") {
        first.begin(question.path, [question.from, question.to]);
        measure.value = question.measure;
      } else if (question.kind === "sweep") {
        const [a, b] = question.ranges;
        first.begin(a.path, endsOf(a));
        second.begin(b?.path ?? "", b && endsOf(b));
      } else if (question.kind === "robots") place.value = question.place;
    },
    /**
     * Asks for the largest value of a number.
     * @param {string} path
     */
    limit(path) {
      show("largest");
      first.begin(path);
    },
    /**
     * The question; undefined before one is chosen. Throws a Mistake.
     * @returns {Question | undefined}
     */
    read() {
      if (kind === "robots") return { kind, place: /** @type {Place} */ (place.value) };
      if (kind !== "largest" && kind !== "sweep") return kind && { kind };
      const range = first.read();
      if (!range) return undefined;
      if (kind === "largest") {
        if ("words" in range) return undefined;
        const { path, from, to } = range;
        walked(range, COUNT);
        return { kind, path, from, to, measure: /** @type {Measure} */ (measure.value) };
      }
      const other = second.read();
      if (!other) return { kind, ranges: [walked(range, COUNT)] };
      if (other.path === range.path) throw new Error("Choose two different ones.");
      return { kind, ranges: [walked(range, COUNT_EACH), walked(other, COUNT_EACH)] };
    },
    relabel() {
      first.relabel();
      second.relabel();
    },
  };
}

/**
 * Both ends of a range; a choice has none.
 * @param {Range} range
 * @returns {[number, number] | undefined}
 */
const endsOf = (range) => ("words" in range ? undefined : [range.from, range.to]);

/**
 * @param {string} text
 * @param {HTMLElement} input
 */
const labelled = (text, input) => make("div", {}, make("label", { for: input.id }, text), input);
