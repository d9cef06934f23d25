// The inputs over time: what the page opens with, undo and redo, and what is kept of them.

import * as autosave from "./autosave.js";
import { byId } from "../page/dom.js";
import { History } from "./undo.js";
import { viewIn } from "../page/tabs.js";
import { exampleIn, holdsJob, jobIn } from "./link.js";
import { notify } from "../page/toast.js";

const TYPED = "input:not([type=checkbox], [type=range]), textarea"; // what the browser undoes by itself while it is typed into
const EARLIER = "Computed with an earlier model; figures differ.";
const LISTED =
  "The path has too many points for a field. They are shown as rows of points instead; the path is the same.";
const LINKED = "Opened from the link. Undo restores your own inputs.";

/**
 * @import { Form } from "../form/form.js"
 * @import { Inputs } from "./autosave.js"
 * @import { JobData } from "./data.js"
 * @import { Job } from "./job.js"
 */

export class Session {
  /** @type {Job} */
  #job;
  /** @type {Form} */
  #form;
  /** @type {{ job: JobData, opening: JobData }} */
  #examples;
  /** @type {{ check(json: string): Promise<void> }} */
  #core;
  /** @type {(stepped?: boolean) => void} */
  #changed;
  /** @type {(message: string) => void} */
  #warn;
  #history = new History();
  #found = ""; // what the focused text field held when it got the focus
  /** @type {EventTarget | undefined} */
  #own; // the focused text field, while it holds something else

  /**
   * `examples` has the core's own jobs, `opening` and `job`. `changed(stepped)` is called whenever the
   * inputs are others than before, `warn(message)` with what could not be shown.
   * @param {{
   *   job: Job, form: Form, examples: { job: JobData, opening: JobData },
   *   core: { check(json: string): Promise<void> },
   *   changed(stepped?: boolean): void, warn(message: string): void,
   * }} page
   */
  constructor({ job, form, examples, core, changed, warn }) {
    this.#job = job;
    this.#form = form;
    this.#examples = examples;
    this.#core = core;
    this.#changed = changed;
    this.#warn = warn;
  }

  /** Shows what the link holds; without one, what this browser kept; without that, the opening job. */
  async open() {
    autosave.start({
      onrefused: (full) =>
        notify(
          `Inputs are not kept: this browser’s storage for the page is ${full ? "full" : "blocked"}. Save the job as a file to keep it.`,
        ),
      onshared: () =>
        notify(
          "Armill is open in another tab too. Each tab keeps its own inputs; a new tab opens with those changed last.",
        ),
    });
    this.#wire();
    const kept = await autosave.kept();
    const named = exampleIn(location.hash, this.#examples);
    if (named) {
      if (kept) this.#history.record(kept);
      this.#show({ job: named }, Boolean(kept));
    } else if (holdsJob(location.hash)) {
      if (kept) this.#history.record(kept);
      await this.#openLink((why) => {
        this.#show({ job: this.#examples.opening });
        this.#warn(`${why} This is the example.`);
      });
    } else if (!kept) {
      this.#show({ job: this.#examples.opening });
    } else {
      try {
        this.#show(kept);
      } catch {
        this.#show({ job: this.#examples.opening });
        this.#warn("The inputs kept in this browser can no longer be read. This is the example.");
      }
    }
  }

  /**
   * Shows another job; undo goes back.
   * @param {JobData} job
   */
  load(job) {
    this.#show({ job });
    this.#keep();
  }

  /**
   * After an edit in the form; `group` names the field while it is typed into, `stepped` says that
   * it is rather pushed.
   * @param {unknown} [group]
   * @param {boolean} [stepped]
   */
  edited(group, stepped) {
    this.#history.record(this.#state, group);
    this.#keep();
    this.#buttons();
    this.#changed(stepped);
  }

  /**
   * Undoes (`step` -1) or redoes (1) the last change.
   * @param {1 | -1} step
   */
  move(step) {
    const before = this.#state.job;
    const state = this.#history.move(step);
    if (!state) return;
    this.#put(state);
    this.#keep();
    this.#form.reveal(before);
  }

  /** @returns {Inputs} */
  get #state() {
    return { ...this.#job.state, typed: this.#form.typed };
  }

  /**
   * Shows a state of the inputs, of a link or not, and says what there is to know about it.
   * @param {Inputs} state
   * @param {boolean} [linked]
   */
  #show(state, linked = false) {
    this.#put(state, () => this.#history.record(this.#state));
    const messages = [
      this.#job.isAfter(state.job) && EARLIER,
      state.job.path?.kind !== this.#state.job.path?.kind && LISTED,
      linked && this.#history.canUndo && LINKED,
    ].filter(Boolean);
    if (messages.length) notify(messages.join(" "));
  }

  /**
   * @param {Inputs} state
   * @param {() => void} [then]
   */
  #put({ job, drafts, typed }, then = () => {}) {
    this.#job.load(job, drafts);
    this.#form.reload(typed);
    then();
    this.#buttons();
    this.#changed();
  }

  #keep() {
    this.#unlink();
    autosave.keep(this.#state);
  }

  /** Once the inputs are not the link's any more, the address must not say so. */
  #unlink() {
    if (!holdsJob(location.hash) && !exampleIn(location.hash, this.#examples)) return;
    const view = viewIn(location.hash);
    history.replaceState(history.state, "", location.pathname + location.search + (view ? `#view=${view}` : ""));
  }

  /** @param {(why: string) => void} fail */
  async #openLink(fail) {
    try {
      const text = await jobIn(location.hash);
      await this.#core.check(text);
      this.#show({ job: JSON.parse(text) }, true);
    } catch ({ code, message }) {
      fail(code === "link" ? message : `The job in the link was not opened: ${message.replace(/[.]?$/, ".")}`);
    }
  }

  #buttons() {
    byId("undo").disabled = !this.#history.canUndo;
    byId("redo").disabled = !this.#history.canRedo;
  }

  #wire() {
    byId("undo").addEventListener("click", () => this.move(-1));
    byId("redo").addEventListener("click", () => this.move(1));
    addEventListener("hashchange", () => this.#moved());
    addEventListener("focusin", (/** @type {any} */ { target }) => {
      [this.#found, this.#own] = [target.value, undefined];
      this.#history.rest();
    });
    addEventListener(
      "input",
      (/** @type {any} */ { target }) =>
        (this.#own = target.matches(TYPED) && target.value !== this.#found ? target : undefined),
    );
    addEventListener("keydown", (event) => {
      const key = event.key.toLowerCase();
      const step = key === "y" || (key === "z" && event.shiftKey) ? 1 : key === "z" ? -1 : 0;
      if (!step || event.altKey || !(event.ctrlKey || event.metaKey) || this.#own === document.activeElement) return;
      if (document.querySelector(":modal")) return;
      event.preventDefault();
      this.move(step);
    });
  }

  /**
   * Another fragment: a job takes the place of the inputs, anything else must not lose a job that
   * only the address had.
   */
  #moved() {
    const named = exampleIn(location.hash, this.#examples);
    if (!named && !holdsJob(location.hash)) return autosave.keepHere(this.#state);
    scrollTo({ top: 0 }); // the link may stand far below what it opens
    if (named) return this.#show({ job: named }, true);
    this.#openLink((why) => {
      this.#unlink();
      this.#warn(`${why} The inputs are as they were.`);
    });
  }
}
