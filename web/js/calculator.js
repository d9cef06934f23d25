// What becomes of an edit: it is computed, previewed, shown, refused or stopped. One controller for the
// page and for the embedded calculator; it knows neither the DOM nor the Worker, so that its states can
// be tested without a browser.
//
//   empty ───► computing ───► current ◄──┐      empty     nothing is shown and nothing is computed
//     │          │   │ ▲         │       │      computing  the inputs' result is on its way
//     │          │   │ └─ edit ──┤       │      preview    one with fewer samples is shown until then
//     │          │   ▼           ▼       │      current    what is shown belongs to the inputs
//     └──────► stale │        preview ───┘      stale      the inputs are refused; the last valid result stays
//                    ▼                          stopped    cancelled, or the core failed; can be computed again
//                 stopped

import { formatNumber } from "./page/number.js";

/**
 * @import { ChartEntry, Summary } from "../pkg/armill.js"
 * @import { Events, Failure, Result } from "./core/client.js"
 * @import { Job } from "./job/job.js"
 * @import { Remedy } from "./page/status.js"
 */

/** @typedef {"empty" | "computing" | "preview" | "current" | "stale" | "stopped"} State */

/**
 * A result on show: `text` is its job, `took` how long it took [ms].
 *
 * @typedef {{ text: string, readonly job: Job, summary: Summary, charts: ChartEntry[], preview: boolean, took: number }} Shown
 */

/**
 * The inputs. `flawed` says that a field holds something else than what the job has, `problem` what it is;
 * `showError` shows an error of the core beside its field, and returns whether there is one.
 *
 * @typedef {{
 *   flawed: boolean,
 *   reload(): void,
 *   problem: { message: string, go(): void, limit?: { label: string, go(): void } } | undefined,
 *   clearErrors(): void,
 *   showError(error: Failure): boolean,
 * }} Inputs
 */

/**
 * What shows it all.
 *
 * @typedef {{
 *   become(state: State): void,
 *   say(status: string): void,
 *   warn(message: string, remedy?: Remedy): void,
 *   calm(): void,
 *   slow(whether: boolean): void,
 *   progress(fraction: number): void,
 *   show(shown: Shown): void,
 *   remedyFor?(error: Failure): Remedy | undefined,
 * }} View
 */

const TYPING_MS = 150; // results follow this long after the last key
const PUSHED = 2000; // samples of a run that follows a number while it is pushed
const COARSE_S = 0.01; // but no further apart than this
const PATIENCE_MS = 150; // a run that takes longer shows its progress
const SILENCE_MS = 30_000; // without progress: browsers do not report a killed Worker

/**
 * The states, in the order of the picture above.
 * @type {State[]}
 */
export const STATES = ["empty", "computing", "preview", "current", "stale", "stopped"];

/**
 * A form that is not built yet.
 * @type {Inputs}
 */
const NO_FORM = { flawed: false, problem: undefined, clearErrors() {}, reload() {}, showError: () => false };

export class Calculator {
  /** @type {State} */
  state = "empty";
  /** @type {Shown | null} */
  shown = null;
  form = NO_FORM;
  /** @type {{ run(text: string): void, cancel(): void }} */
  #core;
  /** @type {View} */
  #view;
  /** @type {Job} */
  #job;
  /** @type {Set<string>} */
  #previews = new Set(); // texts of jobs with fewer samples that were asked for since the last full result
  /** @type {number | undefined} */
  #typing;
  /** @type {number | undefined} */
  #slow;
  #isSlow = false;
  /** @type {number | undefined} */
  #silent;

  /**
   * `core` has run(text) and cancel(); `view` shows what happens: become(state), say(status),
   * warn(message, remedy) with remedy { label, go }, calm(), slow(whether), progress(fraction),
   * show(shown) for a result, and remedyFor(error), which may be undefined.
   * @param {{ run(text: string): void, cancel(): void }} core
   * @param {View} view
   */
  constructor(core, view) {
    this.#core = core;
    this.#view = view;
  }

  /**
   * The job that is computed from now on, a `Job`.
   * @param {Job} job
   */
  open(job) {
    this.#job = job;
  }

  /** Whether what is shown belongs to the inputs, with all its samples. */
  get current() {
    return this.state === "current";
  }

  /**
   * After every edit: computes, or says what is wrong and keeps the last result. A number that is
   * pushed (`stepped`) is complete at every step; one that is typed is not.
   * @param {boolean} [stepped]
   */
  edited(stepped = false) {
    this.#view.calm();
    if (this.form.flawed) {
      if (this.shown) this.#core.cancel();
      else this.#core.run(this.#job.text); // the last valid value of what is wrong
      return this.#refuse();
    }
    this.form.clearErrors();
    this.#become(this.shown?.preview ? "preview" : "computing");
    if (!this.shown) this.compute();
    else if (stepped) this.#pushed();
    else this.#later();
  }

  /** Computes the inputs as they are. */
  compute() {
    if (this.form.flawed) return;
    clearTimeout(this.#typing);
    this.#view.calm();
    this.form.clearErrors();
    this.#core.run(this.#job.text);
  }

  /**
   * What the core calls.
   * @type {Events}
   */
  events = {
    onstart: () => {
      this.#become(this.shown?.preview ? "preview" : "computing");
      this.#view.progress(0);
      clearTimeout(this.#slow);
      this.#slow = setTimeout(() => {
        this.#isSlow = true;
        this.#view.slow(true);
        this.#view.say(`${this.#computing}…`);
      }, PATIENCE_MS);
    },
    onprogress: ({ fraction, stage }) => {
      this.#heard();
      this.#view.progress(fraction);
      if (this.#isSlow) this.#view.say(`${this.#computing}: ${stage}`);
    },
    onresult: (result, took) => this.#take(result, took),
    onerror: (error) => this.#fail(error),
    oncancel: () => {
      this.#idle();
      if (this.form.flawed) return this.#refuse();
      this.#become("stopped");
      this.#view.say(`Cancelled.${this.#lastValid}`);
    },
    ontrap: (error) => {
      this.#idle();
      if (error.code === "load") return this.cannotStart(error);
      this.#become("stopped");
      this.#view.warn(`The core stopped unexpectedly and was started again; your inputs are kept. (${error.message})`, {
        label: "Compute again",
        go: () => this.compute(),
      });
      this.#view.say("The core was restarted.");
    },
  };

  /**
   * The core could not be loaded, at first or for another Worker. `again` is what to try where a network
   * that comes back mends that.
   * @param {Partial<Failure>} error
   * @param {() => void} [again]
   */
  cannotStart(error, again = () => this.edited()) {
    this.#become("stopped");
    const why =
      `The core could not be loaded: ${error.message ?? error}. ` +
      "Armill needs a browser with WebAssembly and module workers.";
    this.#view.warn(why, error.code === "load" ? { label: "Try again", go: again } : undefined);
    this.#view.say(this.#lastValid.trim());
  }

  /**
   * @param {Result} result
   * @param {number} took
   */
  #take({ text, summary, charts }, took) {
    this.#idle();
    const current = text === this.#job.text;
    const job = this.#job;
    this.shown = {
      text,
      summary,
      charts,
      took,
      preview: !current && this.#previews.has(text),
      get job() {
        return job.of(JSON.parse(text));
      },
    };
    if (current) this.#previews.clear();
    this.#view.show(this.shown);
    if (this.form.flawed) return this.#refuse();
    const samples = formatNumber(summary.samples, 1);
    if (this.shown.preview) {
      this.#become("preview");
      this.#view.say(`A preview of ${samples} samples`);
    } else if (current) {
      this.#become("current");
      this.#view.say(`${samples} samples in ${formatNumber(took / 1000, 2)} s`);
    } else this.#become("computing"); // shown, but of an earlier edit
  }

  /** @param {Failure} error */
  #fail(error) {
    this.#idle();
    if (this.form.showError(error)) return this.#refuse();
    this.#become("stale");
    const where = error.line ? ` (line ${error.line}, column ${error.column})` : "";
    const remedy = this.#view.remedyFor?.(error);
    this.#view.warn(remedy ? error.message : `${error.message}${where}`, remedy);
    this.#view.say(this.#lastValid.trim() || "No result yet.");
  }

  /** The inputs are refused where they stand. */
  #refuse() {
    this.#become("stale");
    const { problem } = this.form;
    if (problem) this.#view.warn(problem.message, problem.limit ?? { label: "Show the field", go: problem.go });
    this.#view.say(this.#lastValid.trim() || "No result yet.");
  }

  /** Has a long run follow a number that is pushed with fewer samples; all of them come when it rests. */
  #pushed() {
    const { duration_s } = /** @type {Shown} */ (this.shown).summary;
    const time = this.#job.sampleTime;
    const every = Math.floor(Math.min(duration_s / PUSHED, COARSE_S) / time);
    if (every < 2) return this.compute();
    const preview = this.#job.sampledEvery(every * time);
    this.#previews.add(preview);
    this.#core.run(preview);
    this.#later();
  }

  #later() {
    clearTimeout(this.#typing);
    this.#typing = setTimeout(() => this.compute(), TYPING_MS);
  }

  /** @param {State} state */
  #become(state) {
    this.state = state;
    this.#view.become(state);
  }

  get #computing() {
    return this.shown?.preview ? "A preview; computing" : "Computing";
  }

  get #lastValid() {
    if (!this.shown) return "";
    return this.shown.preview ? " Showing a preview with fewer samples." : " Showing the last valid result.";
  }

  /** The run in progress is alive. */
  #heard() {
    clearTimeout(this.#silent);
    this.#silent = setTimeout(
      () =>
        this.#view.say(`No progress for ${SILENCE_MS / 1000} s: the browser may have ended the run. Cancel, or wait.`),
      SILENCE_MS,
    );
  }

  #idle() {
    clearTimeout(this.#slow);
    clearTimeout(this.#silent);
    this.#isSlow = false;
    this.#view.slow(false);
  }
}
