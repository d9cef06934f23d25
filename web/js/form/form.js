// Builds the inputs from the core's list of fields and keeps them and the job in step.

import { byId, make, sentence } from "../page/dom.js";
import { onSetting } from "../page/settings.js";
import { badgesOf } from "./badges.js";
import { editorFor, idOf } from "./editors.js";
import { FROM_STOCK } from "../job/job.js";
import { scrub } from "./drag-number.js";
import { asText, brief, helpText, outOfRange, quantity, withOwn } from "./field-text.js";
import { frameIn } from "./frame-text.js";
import { Mistake } from "./number-cell.js";
import { shownUnits } from "./shown.js";

/**
 * @import { Field, Presets, RobotPreset } from "../../pkg/armill.js"
 * @import { Failure } from "../core/client.js"
 * @import { JobData } from "../job/data.js"
 * @import { Job } from "../job/job.js"
 * @import { Editor } from "./editors.js"
 */

/** @typedef {{ label: string, go(): void }} Limit the nearest number that is allowed */

/**
 * A field on the page: `mistake` says that what is typed is no value, `line` which line of a text is wrong.
 *
 * @typedef {{
 *   field: Field,
 *   editor: Editor,
 *   node: HTMLElement,
 *   reset: HTMLElement,
 *   error: HTMLElement,
 *   note: HTMLElement,
 *   notes: Record<string, string>,
 *   unit: HTMLElement,
 *   help: HTMLElement,
 *   understood: HTMLElement,
 *   mistake: boolean,
 *   message: string,
 *   limit?: Limit,
 *   line?: number,
 * }} Row
 */

/** @typedef {(typing?: string, stepped?: boolean) => void} OnChange called with the field's path while it is typed into */

/** @type {Record<string, string>} */
const GROUPS = {
  robot: "Robot",
  frames: "Frames",
  path: "Path",
  stock: "Stock",
  motion: "Motion",
  tool: "Tool",
  material: "Material",
  cutting: "Cutting",
  shaper: "Vibration",
  compensation: "Compensation",
  uncertainty: "How sure",
  program: "Program",
};
/** @type {Record<string, string>} */
const BRANDS = { kuka: "KUKA", abb: "ABB", staubli: "Stäubli", fanuc: "FANUC" };
const OPEN = ["path", "motion"]; // the groups that most visits change

export class Form {
  #job;
  #onchange;
  /** @type {Row[]} */
  #rows = [];
  /** @type {Record<string, RobotPreset>} */
  #robots; // id -> preset
  /** @type {Map<string, { details: HTMLElement, digest: HTMLElement, body: HTMLElement }>} */
  #groups = new Map();

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
    const notes = Object.fromEntries([...presets.robots, ...presets.materials].map(({ id, note }) => [id, note]));
    this.#robots = Object.fromEntries(presets.robots.map((robot) => [robot.id, robot]));
    const badges = badgesOf(presets);
    for (const field of fields.map(withOwn)) {
      if (!this.#groups.has(field.group)) this.#addGroup(parent, field.group);
      const row = this.#row(field, editorFor(field, { badges, brand: () => this.#brand() }), notes);
      this.#groups.get(field.group)?.body.append(row.node);
      this.#rows.push(row);
    }
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
    return { message: named, go: () => this.#go(row), limit: row.limit };
  }

  /** What was typed and is not a value: path of the field -> what each of its inputs holds. */
  get typed() {
    const flawed = this.#rows.filter((row) => row.mistake);
    return Object.fromEntries(
      flawed.map(({ field, editor }) => [
        field.path,
        editor.inputs.map((input) => (isBox(input) ? input.checked : input.value)),
      ]),
    );
  }

  /**
   * Shows another job: whatever was wrong before is forgotten, `typed` takes its place.
   * @param {Record<string, any>} [typed]
   */
  reload(typed = {}) {
    for (const row of this.#rows) this.#setError(row, "");
    this.refresh();
    for (const row of this.#rows)
      if (typed[row.field.path] && !row.node.hidden) this.#retype(row, typed[row.field.path]);
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
    unfold(row.node);
    row.node.scrollIntoView({ block: "nearest" });
  }

  /** Shows the job: values, which fields exist, digests. */
  refresh() {
    for (const row of this.#rows) {
      row.node.hidden = !this.#job.shows(row.field);
      if (row.node.hidden) this.#setError(row, "");
      if (row.mistake && !row.node.hidden) continue;
      if (!row.editor.inputs.includes(document.activeElement) || !this.#says(row))
        row.editor.write(this.#job.get(row.field));
      this.#decorate(row);
    }
    for (const row of this.#rows) {
      const read = row.mistake ? "" : row.editor.understood?.();
      row.understood.textContent = read ? `= ${read}` : "";
    }
    this.#digest();
  }

  /**
   * Puts an error of the core beside its field. False if it has none here.
   * @param {Failure} error
   */
  showError(error) {
    const { field: path, message, line, column } = error;
    this.clearErrors();
    const row = this.#rows.find(({ field, node }) => path && !node.hidden && belongs(path, field.path));
    if (!path || !row) return false;
    const where = line && !/\bline\b/i.test(message) ? `Line ${line}${column ? `, column ${column}` : ""}: ` : "";
    const own = outOfRange(error) ?? message;
    const text = own.startsWith(path) ? row.field.label + own.slice(path.length) : sentence(own);
    this.#setError(row, where + text, row.editor.at(path.slice(row.field.path.length)));
    row.line = line;
    if (path === row.field.path) row.limit = this.#limitOf(row, error);
    if (line) row.editor.mark?.(line);
    this.#digest();
    return true;
  }

  /**
   * The nearest number that is allowed, and how to take it: { label, go }.
   * @param {Row} row
   * @param {Failure} error
   * @returns {Limit | undefined}
   */
  #limitOf({ field, editor }, { code, value = NaN, min, max }) {
    if (code !== "out-of-range" || field.kind === "vector" || editor.inputs.length > 1) return undefined;
    const nearest = min !== undefined && value < min ? min : max;
    if (nearest === undefined) return undefined;
    const go = () => {
      this.#job.set(field, nearest);
      this.#changed();
    };
    return { label: `Use ${quantity(nearest, field.unit)}`, go };
  }

  /** Takes back what the core said; what was typed wrong stays marked. */
  clearErrors() {
    for (const row of this.#rows) if (!row.mistake) this.#setError(row, "");
    this.#digest();
  }

  /**
   * @param {HTMLElement} parent
   * @param {string} name
   */
  #addGroup(parent, name) {
    const digest = make("span", { className: "digest" });
    const title = GROUPS[name] ?? name;
    const body = make("fieldset", {}, make("legend", { className: "hidden-text" }, title));
    const details = make("details", { className: "group", id: `group-${name}`, open: OPEN.includes(name) });
    details.append(make("summary", {}, make("span", { className: "group-title" }, title), digest), body);
    parent.append(details);
    this.#groups.set(name, { details, digest, body });
  }

  /**
   * @param {Field} field
   * @param {Record<string, string>} notes
   * @param {Editor} editor
   * @returns {Row}
   */
  #row(field, editor, notes) {
    const id = idOf(field.path);
    const grouped = editor.node.getAttribute("role") === "group" || editor.node.tagName === "TABLE";
    const title = make(grouped ? "span" : "label", { className: "label", id: `${id}-label` }, field.label);
    if (grouped) editor.node.setAttribute("aria-labelledby", title.id);
    else title.setAttribute("for", editor.inputs[0].id);
    const other = this.#job.otherUnit(field);
    const unit = other ? this.#unitButton(field, other) : make("span", { className: "unit" });
    if (field.unit) title.append(" ", unit);
    const reset = make("button", { type: "button", className: "reset" }, "↺");
    const help = make("p", { className: "help", id: `${id}-help`, hidden: true });
    const understood = make("output", { className: "understood", htmlFor: id });
    const note = make("p", { className: "note", id: `${id}-note` });
    const error = make("p", { className: "error", id: `${id}-error` });
    for (const input of editor.inputs) input.setAttribute("aria-describedby", `${id}-error ${id}-help`);
    const wide =
      grouped || editor.inputs[0].tagName === "TEXTAREA" || field.kind === "text" || editor.inputs.length > 1;
    const head = make("div", { className: "head" }, title, helpButton(field, help), reset);
    const node = make(
      "div",
      { className: wide ? "field wide" : "field" },
      head,
      editor.node,
      editor.slider ?? "",
      understood,
      error,
      help,
      note,
    );
    /** @type {Row} */
    const row = { field, editor, node, reset, unit, help, understood, error, note, notes, mistake: false, message: "" };
    label(row);
    // Some assistive tools and drivers choose an option with "change" alone.
    const kind = editor.inputs.some(({ tagName }) => tagName === "SELECT") ? "change" : "input";
    node.addEventListener(kind, (event) => {
      const { target, detail } = /** @type {CustomEvent} */ (event);
      const box = isBox(/** @type {HTMLInputElement} */ (target));
      this.#edited(row, kind === "change" || box ? undefined : field.path, detail === "stepped");
    });
    const frame = /^(.*_frame)\./.exec(field.path)?.[1];
    if (frame) node.addEventListener("paste", (event) => this.#paste(frame, event));
    if (editor.step) scrub(title, (count) => editor.step?.(count));
    reset.addEventListener("click", () => {
      this.#setError(row, "");
      this.#job.reset(field);
      this.#changed();
      editor.inputs[0].focus();
    });
    return row;
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

  /**
   * @param {Field} field
   * @param {Field} other
   */
  #unitButton(field, other) {
    const button = make("button", { type: "button", className: "unit", title: `Give it in ${other.unit}` }, field.unit);
    button.setAttribute("aria-label", `${field.unit}; give it in ${other.unit} instead`);
    button.addEventListener("click", () => {
      this.#job.swapUnit(field);
      this.#changed();
      byId(idOf(other.path)).focus();
    });
    return button;
  }

  /** Whose way of writing orientations holds: the controller's that programs are for, else the arm's. */
  #brand() {
    return BRANDS[this.#job.valueAt("program.controller")] ?? this.#preset()?.maker;
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
      this.#setError(row, "");
      this.#job.set(row.field, value);
      row.editor.write(value);
    }
    this.#changed();
  }

  /**
   * @param {Row} row
   * @param {string} [typing]
   * @param {boolean} [stepped]
   */
  #edited(row, typing, stepped) {
    this.#take(row);
    this.#changed(typing, stepped);
  }

  /**
   * Puts what a row holds into the job, or says why not.
   * @param {Row} row
   */
  #take(row) {
    try {
      this.#job.set(row.field, row.editor.read());
      this.#setError(row, "");
    } catch (error) {
      if (!(error instanceof Mistake)) throw error;
      this.#setError(row, error.message, error.input);
      row.mistake = true;
      const { input, readings } = error;
      if (input) row.error.append(...readings.map((reading) => this.#readingButton(input, reading)));
    }
  }

  /**
   * One of the things that an ambiguous number may mean.
   * @param {HTMLInputElement | HTMLTextAreaElement} input
   * @param {string} reading
   */
  #readingButton(input, reading) {
    const button = make("button", { type: "button", className: "reading" }, reading);
    button.addEventListener("click", () => {
      input.value = reading;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.focus();
    });
    return button;
  }

  /**
   * @param {Row} row
   * @param {any[]} texts
   */
  #retype(row, texts) {
    row.editor.inputs.forEach((input, i) => {
      input.disabled = false;
      if (isBox(input)) input.checked = texts[i];
      else input.value = texts[i] ?? "";
    });
    this.#take(row);
  }

  /**
   * @param {string} [typing]
   * @param {boolean} [stepped]
   */
  #changed(typing, stepped) {
    this.refresh();
    this.#onchange(typing, stepped);
  }

  /** @param {Row} row */
  #says(row) {
    try {
      const [said, held] = [row.editor.read(), this.#job.get(row.field)];
      return said === held || JSON.stringify(said) === JSON.stringify(held);
    } catch {
      return false;
    }
  }

  /**
   * @param {Row} row
   * @param {string} message
   * @param {HTMLElement} [input]
   */
  #setError(row, message, input) {
    row.line = row.limit = undefined;
    row.mistake = false;
    row.error.textContent = row.message = message;
    for (const each of row.editor.inputs) {
      if (message && (each === input || !input)) each.setAttribute("aria-invalid", "true");
      else each.removeAttribute("aria-invalid");
    }
  }

  /** @param {Row} row */
  #decorate(row) {
    row.reset.classList.toggle("idle", !this.#job.changed(row.field));
    if (row.editor.meaning) label(row);
    if (row.field.path === "robot.joint_compliance_rad_per_nm") return this.#sourceOfCompliance(row);
    if (row.field.path === "workpiece_frame.xyz_mm") {
      row.note.textContent = this.#preset()?.world_note ?? "";
      return;
    }
    if (row.field.path === "cutting.engagement") return this.#sourceOfEngagement(row);
    row.note.textContent = row.field.kind === "choice" ? (row.notes[this.#job.get(row.field)] ?? "") : "";
  }

  /** The library's robot, if the job has one. */
  #preset() {
    return this.#robots[this.#job.valueAt("robot.preset")];
  }

  /**
   * Beside the numbers: an order of magnitude must not look like a measurement.
   * @param {Row} row
   */
  #sourceOfCompliance(row) {
    const preset = this.#preset();
    const given = this.#job.changed(row.field);
    row.note.textContent = preset && !given ? preset.stiffness_note : "";
    row.node.classList.toggle("assumed", Boolean(preset?.stiffness_assumed && !given));
  }

  /**
   * Without a stock nothing follows from it; with one, nothing else is asked for.
   * @param {Row} row
   */
  #sourceOfEngagement(row) {
    const stock = this.#job.hasStock;
    const follows = this.#job.get(row.field) === FROM_STOCK;
    for (const option of row.editor.inputs[0].options) option.disabled = option.value === FROM_STOCK && !stock;
    row.note.textContent = !stock
      ? "With a stock, it can follow what is left of the material along the path."
      : follows
        ? "Depths and angles come from the stock, place by place."
        : "This engagement holds all along the path: the stock is not used.";
  }

  /** What a folded group holds, in a few words. */
  #digest() {
    for (const [name, { details, digest }] of this.#groups) {
      const rows = this.#rows.filter(({ field, node }) => field.group === name && !node.hidden);
      const broken = rows.some((row) => row.message);
      details.classList.toggle("broken", broken);
      const telling = rows.filter(
        ({ field }, i) => i === 0 || (i === 1 && !field.choices) || (i === 2 && rows[1].field.kind === "vector"),
      );
      digest.textContent = broken
        ? "needs a look"
        : telling
            .map(({ field }) => brief(field, this.#job.get(field)))
            .filter(Boolean)
            .join(", ");
    }
  }

  /** @param {Row} row */
  #go(row) {
    unfold(row.node);
    const input = row.editor.inputs.find((each) => each.getAttribute("aria-invalid")) ?? row.editor.inputs[0];
    input.focus();
    input.scrollIntoView({ block: "center" });
    if (row.line) row.editor.show?.(row.line);
  }
}

/**
 * Writes what a row says of itself, in the units of the settings.
 * @param {Row} row
 */
function label({ field, editor, unit, reset, help }) {
  if (unit.tagName !== "BUTTON") unit.textContent = shownUnits(editor.unit?.() ?? field.unit);
  reset.title = `Back to ${asText(field)}`;
  reset.setAttribute("aria-label", `Reset ${field.label} to ${asText(field)}`);
  help.textContent = [helpText(field), editor.meaning?.()].filter(Boolean).join(" ");
}

/**
 * Shows and hides a field's help. Screen readers have it with the field in either case.
 * @param {Field} field
 * @param {HTMLElement} help
 */
function helpButton(field, help) {
  const button = make(
    "button",
    { type: "button", className: "explain", "aria-expanded": "false", "aria-controls": help.id },
    "?",
  );
  button.setAttribute("aria-label", `Explain ${field.label}`);
  button.addEventListener("click", () => {
    help.hidden = !help.hidden;
    button.setAttribute("aria-expanded", String(!help.hidden));
  });
  return button;
}

/** @param {HTMLElement} node */
function unfold(node) {
  const group = node.closest("details");
  if (group) group.open = true;
}

/** @param {HTMLInputElement} input */
const isBox = (input) => input.type === "checkbox";

/**
 * Whether an error path such as "path.points_mm[3]" is about the field `own`.
 * @param {string} path
 * @param {string} own
 */
const belongs = (path, own) => path === own || (path.startsWith(own) && "[.".includes(path[own.length]));
