// The inputs, built from the core's list of fields, and the job: keeps them in step.

import { byId, make } from "../page/dom.js";
import { onSetting } from "../page/settings.js";
import { badgesOf } from "./badges.js";
import { showCoreError } from "./core-error.js";
import { editorFor, idOf } from "./editors.js";
import { withOwn } from "./field-text.js";
import { frameIn } from "./frame-text.js";
import { makeGroups } from "./groups.js";
import { makeNotes } from "./notes.js";
import { Mistake } from "./number-cell.js";
import { goTo, label, makeRow, retype, setError, typedIn, unfold } from "./row.js";

/**
 * @import { Field, Presets, Understood } from "../../pkg/armill.js"
 * @import { Failure } from "../core/client.js"
 * @import { JobData } from "../job/data.js"
 * @import { Job } from "../job/job.js"
 * @import { Row } from "./row.js"
 */

/** @typedef {(typing?: string, stepped?: boolean) => void} OnChange called with the field's path while it is typed into */

/** @type {Record<string, string>} */
const BRANDS = { kuka: "KUKA", abb: "ABB", staubli: "Stäubli", fanuc: "FANUC" };

export class Form {
  #job;
  #onchange;
  #robots;
  #groups;
  #note;
  /** @type {Understood | undefined} */
  #program;
  /** @type {Row[]} */
  #rows;

  /**
   * Fills `parent`; `onchange` is called after every edit, with the field's path while it is typed
   * into.
   * @param {HTMLElement} parent
   * @param {Job} job
   * @param {Field[]} fields
   * @param {Presets} presets
   * @param {OnChange} onchange
   */
  constructor(parent, job, fields, presets, onchange) {
    this.#job = job;
    this.#onchange = onchange;
    this.#robots = presets.robots;
    this.#groups = makeGroups(parent);
    this.#note = makeNotes(job, presets);
    const given = { badges: badgesOf(presets), brand: () => this.#brand() };
    this.#rows = fields.map(withOwn).map((field) => this.#row(field, given));
    for (const row of this.#rows) this.#groups.put(row);
    this.refresh();
    onSetting((key) => key !== "theme" && this.#relabel());
  }

  /** Whether something typed is not a value. */
  get flawed() {
    return this.#rows.some((row) => row.mistake);
  }

  /** The first message beside a field, and the way there; undefined if there is none. */
  get problem() {
    const row = this.#rows.find((candidate) => candidate.message);
    if (!row) return undefined;
    const { message } = row;
    const named = message.startsWith(row.field.label) ? message : `${row.field.label}: ${message}`;
    return { message: named, go: () => goTo(row), limit: row.limit };
  }

  /** What was typed and is not a value: path of the field -> what each of its inputs holds. */
  get typed() {
    return Object.fromEntries(this.#rows.filter((row) => row.mistake).map((row) => [row.field.path, typedIn(row)]));
  }

  /**
   * Shows another job: whatever was wrong before is forgotten, `typed` takes its place.
   * @param {Record<string, any>} [typed]
   */
  reload(typed = {}) {
    for (const row of this.#rows) setError(row, "");
    this.refresh();
    for (const row of this.#rows) {
      if (!typed[row.field.path] || row.node.hidden) continue;
      retype(row, typed[row.field.path]);
      this.#take(row);
    }
    this.#digest();
  }

  /**
   * Brings the first field that differs from `before`, a job's plain object, into view.
   * @param {JobData} before
   */
  reveal(before) {
    const changed = new Set(this.#job.differences(before).map(({ field }) => field.path));
    const row = this.#rows.find(({ node, mistake, field }) => !node.hidden && (mistake || changed.has(field.path)));
    if (!row) return;
    unfold(row);
    row.node.scrollIntoView({ block: "nearest" });
  }

  /** Shows the job: values, which fields exist, digests. */
  refresh() {
    const robot = this.#robot;
    for (const row of this.#rows) {
      row.node.hidden = !this.#job.shows(row.field);
      if (row.node.hidden) setError(row, "");
      if (row.mistake && !row.node.hidden) continue;
      if (!row.editor.inputs.includes(document.activeElement) || !this.#says(row))
        row.editor.write(this.#job.get(row.field));
      row.reset.classList.toggle("idle", !this.#job.changed(row.field));
      if (row.editor.meaning) label(row);
      this.#note(row, robot, this.#program);
    }
    for (const row of this.#rows) {
      const read = row.mistake ? "" : row.editor.understood?.();
      row.understood.textContent = read ? `= ${read}` : "";
    }
    this.#digest();
  }

  /**
   * Says beside feed and speed what the program of the shown result states itself.
   * @param {Understood | undefined} program
   */
  takeProgram(program) {
    this.#program = program;
    this.#renote();
  }

  #renote() {
    const robot = this.#robot;
    for (const row of this.#rows) this.#note(row, robot, this.#program);
  }

  /**
   * Puts an error of the core beside its field. False if it has none here.
   * @param {Failure} error
   */
  showError(error) {
    this.clearErrors();
    const shown = showCoreError(this.#rows, error, ({ field }, value) => {
      this.#job.set(field, value);
      this.#changed();
    });
    if (shown) this.#digest();
    return shown;
  }

  /** Takes back what the core said; what was typed wrong stays marked. */
  clearErrors() {
    for (const row of this.#rows) if (!row.mistake) setError(row, "");
    this.#digest();
  }

  /**
   * @param {Field} field
   * @param {Parameters<typeof editorFor>[1]} given
   */
  #row(field, given) {
    return makeRow(field, editorFor(field, given), this.#job.otherUnit(field), {
      edited: (row, typing, stepped) => {
        this.#take(row);
        this.#changed(typing ? field.path : undefined, stepped);
      },
      reset: (row) => {
        setError(row, "");
        this.#job.reset(field);
        this.#changed();
        row.editor.inputs[0].focus();
      },
      swapUnit: (_, other) => {
        this.#job.swapUnit(field);
        this.#changed();
        byId(idOf(other.path)).focus();
      },
      paste: (frame, event) => this.#paste(frame, event),
    });
  }

  /** Writes every number and text in the units of the settings. What is typed and wrong stays as it is. */
  #relabel() {
    for (const row of this.#rows) {
      label(row);
      row.editor.relabel?.();
      if (!row.mistake) row.editor.write(this.#job.get(row.field));
    }
    this.refresh();
  }

  /** The library's robot, if the job has one. */
  get #robot() {
    const id = this.#job.valueAt("robot.preset");
    return this.#robots.find((robot) => robot.id === id);
  }

  /** Whose way of writing orientations holds: the controller's that programs are for, else the arm's. */
  #brand() {
    return BRANDS[this.#job.valueAt("program.controller")] ?? this.#robot?.maker;
  }

  /**
   * A whole frame, as a controller writes it, is taken at once.
   * @param {string} frame
   * @param {ClipboardEvent} event
   */
  #paste(frame, event) {
    const found = frameIn(event.clipboardData?.getData("text/plain") ?? "", this.#brand());
    const parts = Object.entries(found ?? {}).flatMap(([key, value]) => {
      const row = this.#rows.find(({ field }) => field.path === `${frame}.${key}`);
      return row ? [{ row, value }] : [];
    });
    if (parts.length < 2) return; // not of a frame, or the form does not show all of it
    event.preventDefault();
    for (const { row, value } of parts) {
      setError(row, "");
      this.#job.set(row.field, value);
      row.editor.write(value);
    }
    this.#changed();
  }

  /**
   * Puts what a row holds into the job, or says why not.
   * @param {Row} row
   */
  #take(row) {
    try {
      this.#job.set(row.field, row.editor.read());
      setError(row, "");
    } catch (error) {
      if (!(error instanceof Mistake)) throw error;
      const { input, readings } = error;
      setError(row, error.message, { input, mistake: true });
      if (input) row.error.append(...readings.map((reading) => readingButton(input, reading)));
    }
  }

  /**
   * @param {string} [typing]
   * @param {boolean} [stepped]
   */
  #changed(typing, stepped) {
    this.refresh();
    this.#onchange(typing, stepped);
  }

  /**
   * Whether a row holds what the job has.
   * @param {Row} row
   */
  #says(row) {
    try {
      const [said, held] = [row.editor.read(), this.#job.get(row.field)];
      return said === held || JSON.stringify(said) === JSON.stringify(held);
    } catch {
      return false;
    }
  }

  #digest() {
    this.#groups.digest(this.#rows, this.#job);
  }
}

/**
 * One of the things that an ambiguous number may mean.
 * @param {HTMLInputElement | HTMLTextAreaElement} input
 * @param {string} reading
 */
function readingButton(input, reading) {
  const button = make("button", { type: "button", className: "reading" }, reading);
  button.addEventListener("click", () => {
    input.value = reading;
    input.dispatchEvent(new Event("input", { bubbles: true }));
    input.focus();
  });
  return button;
}
