// The job as the page holds it: a plain object in the shape of the job file, read and written by
// path.
//
// Some parts of a job take one of several shapes (shape.js). A choice ending in `.preset` or `.kind` decides; the other
// fields of that part name in `when` what they need: a value of that choice, or the state of the
// part itself ("preset", "table", "opw", "kienzle" or "hz").

import { copy, frozen, listed, textOf } from "./data.js";
import { decides, draftKey, keyOf, keysOf, parentOf, twin } from "./field-path.js";
import { EXTENTS, shapeNow, shaped } from "./shape.js";

/**
 * @import { Field, Presets } from "../../pkg/armill.js"
 * @import { JobData, JobState } from "./data.js"
 */

const TURN = 2 * Math.PI;
export const FROM_STOCK = "from-stock"; // the engagement that a stock brings with it

const ENGAGEMENT = "cutting.engagement";
const FEED_RULE = "motion.feed_rule";

export class Job {
  /** @type {Field[]} */
  #fields;
  /** @type {Presets} */
  #presets;
  /** @type {number} */
  #model;
  /** @type {JobData} */
  #thesis; // the default job
  /** @type {Map<string, any>} */
  #drafts = new Map(); // values of fields whose shape is not chosen now, kept for the way back
  /** @type {JobData} */
  #data;
  /** @type {JobData | undefined} */
  #frozen; // #data as it is handed out, until the next edit
  /** @type {string | undefined} */
  #text; // the same as text

  /**
   * A job from its plain object, and what the core says of jobs: fields, presets `{ robots, materials }`,
   * number of the model, and `job`, the default one.
   * @param {JobData} data
   * @param {{ fields: Field[], presets: Presets, model: number, job: JobData }} core
   */
  constructor(data, { fields, presets, model, job }) {
    this.#fields = fields;
    this.#presets = presets;
    this.#model = model;
    this.#thesis = job;
    this.load(data);
  }

  /** The job as plain data, frozen. */
  get data() {
    return (this.#frozen ??= frozen(copy(this.#data)));
  }

  /** The job as the text that is computed and saved. */
  get text() {
    return (this.#text ??= textOf(this.#data));
  }

  /** Time between samples [s]. */
  get sampleTime() {
    return this.get({ path: "motion.sample_time_s" });
  }

  /**
   * Its text with another time between samples [s], for a preview: what a sensor would bring comes with the whole result.
   * @param {number} seconds
   */
  sampledEvery(seconds) {
    const { online, ...rest } = this.#data;
    return textOf({ ...rest, motion: { ...this.#data.motion, sample_time_s: seconds } });
  }

  /**
   * The job and what is kept for the way back, as plain data of its own.
   * @returns {JobState}
   */
  get state() {
    return { job: copy(this.#data), drafts: copy(Object.fromEntries(this.#drafts)) };
  }

  /**
   * Replaces the whole job; one of an earlier model is of this one from now on.
   * @param {JobData} data
   * @param {Record<string, any>} [drafts]
   */
  load(data, drafts = {}) {
    this.#edit();
    const own = copy(listed(data));
    this.#data = this.isAfter(own) ? { ...own, model: this.#model } : own;
    this.#drafts = new Map(Object.entries(copy(drafts)));
  }

  /**
   * The value at `field.path`; where the job leaves it out, what then holds.
   * @param {Pick<Field, "path"> & Partial<Field>} field
   * @returns {any}
   */
  get(field) {
    const part = this.#read(parentOf(field.path));
    if (decides(field) && part === "none") return "none";
    const value = this.#read(field.path);
    if (value !== undefined) return value;
    if (field.path.endsWith(".preset") && part) return this.#shapeOf(parentOf(field.path));
    return this.#presetOf(parentOf(field.path))[keyOf(field.path)] ?? this.#standard(field);
  }

  /**
   * The value at a path that has a field.
   * @param {string} path
   * @returns {any}
   */
  valueAt(path) {
    return this.get(/** @type {Field} */ (this.#find(path)));
  }

  /** Whether the job has a stock. */
  get hasStock() {
    return (this.#read("stock.kind") ?? "none") !== "none";
  }

  /**
   * Whether the field belongs to the job's present shape.
   * @param {Field} field
   * @returns {boolean}
   */
  shows(field) {
    if (this.#isOtherUnit(field)) return false;
    if (!field.when) return true;
    const decider = this.#find(field.when.path);
    if (decider) return this.shows(decider) && field.when.is.includes(this.get(decider));
    return field.when.is.includes(this.#shapeOf(field.when.path));
  }

  /**
   * @param {Field} field
   * @param {any} value
   * @returns {void}
   */
  set(field, value) {
    this.#edit();
    if (field.path.startsWith("robot.") && field.path !== "robot.name") this.#forgetCovariance();
    if (field.path === "robot.preset") this.#leaveThesis(value);
    if (decides(field)) return this.#reshape(field, value);
    if (field.path === ENGAGEMENT && value === FROM_STOCK) return this.#forget(ENGAGEMENT);
    this.#write(field.path, value);
    // What the choice asks for starts as the form shows it.
    for (const { path, when, default: standard } of this.#fields) {
      if (when?.path === field.path && when.is.includes(value) && this.#read(path) === undefined)
        this.#write(path, structuredClone(standard));
    }
  }

  /**
   * Takes the field back to its default.
   * @param {Field} field
   */
  reset(field) {
    this.#edit();
    const optional = this.#overrules(field) || field.when?.path === "uncertainty" || this.#isOptional(field);
    if (optional) this.#forget(field.path);
    else this.set(field, structuredClone(field.default));
  }

  /**
   * Whether the field differs from its default.
   * @param {Field} field
   */
  changed(field) {
    if (this.#read(parentOf(field.path))?.preset && !decides(field)) return this.#overrules(field);
    const [value, standard] = [this.get(field), this.#standard(field)];
    return typeof value === "string" ? value !== standard : JSON.stringify(value) !== JSON.stringify(standard);
  }

  /**
   * Another job of the same kind, from its plain object.
   * @param {JobData} data
   */
  of(data) {
    return new Job(data, {
      fields: this.#fields,
      presets: this.#presets,
      model: this.#model,
      job: this.#thesis,
    });
  }

  /**
   * Whether another job, a plain object, was saved by an earlier model; before model 2 it named none.
   * @param {JobData} data
   */
  isAfter({ model = 1 }) {
    return model < this.#model;
  }

  /**
   * The fields in which another job, a plain object, differs: [{ field, own, other }]; undefined
   * where there is no such field.
   * @param {JobData} data
   */
  differences(data) {
    const other = this.of(data);
    return this.#fields.flatMap((field) => {
      const [here, there] = [this, other].map((job) => (job.shows(field) ? job.get(field) : undefined));
      return JSON.stringify(here) === JSON.stringify(there) ? [] : [{ field, own: here, other: there }];
    });
  }

  /**
   * The field that holds the same quantity in another unit, or undefined.
   * @param {Field} field
   */
  otherUnit(field) {
    const other = twin(field.path);
    return other ? this.#find(other) : undefined;
  }

  /**
   * Gives the frequency in the other unit: same value, other key. Returns the other field.
   * @param {Field} field
   */
  swapUnit(field) {
    this.#edit();
    const other = /** @type {Field} */ (this.otherUnit(field));
    const value = this.get(field);
    const part = this.#read(parentOf(field.path));
    delete part[keyOf(field.path)];
    const factor = field.path.endsWith("_hz") ? TURN : 1 / TURN;
    part[keyOf(other.path)] = Number((value * factor).toPrecision(12));
    return other;
  }

  /**
   * The thesis's shaper is for its own arm: hardly another controller has one.
   * @param {string} robot
   */
  #leaveThesis(robot) {
    const { robot: its, shaper } = this.#thesis;
    const another = this.#presets.robots.some(({ id }) => id === robot) && robot !== its.preset;
    if (another && JSON.stringify(this.#data.shaper) === JSON.stringify(shaper)) this.#data.shaper = "none";
  }

  /** What was handed out before is not the job any more. */
  #edit() {
    this.#frozen = this.#text = undefined;
  }

  /** A covariance belongs to the compliances that it was identified with. */
  #forgetCovariance() {
    delete this.#data.uncertainty?.compliance_covariance;
  }

  /**
   * What holds where the job leaves a field out.
   * @param {{ path: string, default?: unknown }} field
   */
  #standard(field) {
    if (field.path === ENGAGEMENT && this.hasStock) return FROM_STOCK;
    if (field.path === "stock.allowance_mm") return this.#read("tool.diameter_mm") ?? field.default;
    return field.default;
  }

  /**
   * Whether a field is better left out than given by its default.
   * @param {Field} field
   */
  #isOptional({ path }) {
    return path === ENGAGEMENT || (this.#read("stock.kind") === "extents" && EXTENTS.includes(path));
  }

  /**
   * Leaves a field out; a radial depth is refused without the engagement that it belongs to.
   * @param {string} path
   */
  #forget(path) {
    delete this.#read(parentOf(path))?.[keyOf(path)];
    if (path === ENGAGEMENT) delete this.#data.cutting?.radial_depth_mm;
  }

  /** @param {string} path */
  #find(path) {
    return this.#fields.find((field) => field.path === path);
  }

  /**
   * @param {string} path
   * @returns {any}
   */
  #read(path) {
    return keysOf(path).reduce((value, key) => value?.[key], this.#data);
  }

  /**
   * @param {string} path
   * @param {any} value
   */
  #write(path, value) {
    const parent = parentOf(path);
    if (parent && typeof this.#read(parent) !== "object")
      this.#write(parent, shaped(this.#fields, parent, { drafts: this.#drafts }));
    const part = parent ? this.#read(parent) : this.#data;
    part[keyOf(path)] = value;
  }

  /** @param {string} path */
  #shapeOf(path) {
    return shapeNow(path, this.#read(path), this.#presetOf(path));
  }

  /**
   * Whether the quantity is given by this field's twin.
   * @param {Field} field
   */
  #isOtherUnit(field) {
    const other = twin(field.path);
    return other !== undefined && this.#read(other) !== undefined;
  }

  /**
   * Whether the job gives a number that its preset has too.
   * @param {Field} field
   */
  #overrules(field) {
    const part = this.#read(parentOf(field.path));
    return part?.preset !== undefined && !decides(field) && part[keyOf(field.path)] !== undefined;
  }

  /**
   * The numbers behind the preset that a part of the job names.
   * @param {string} path
   * @returns {any}
   */
  #presetOf(path) {
    const id = this.#read(path)?.preset;
    const { robots, materials } = this.#presets;
    const list = path === "robot" ? robots : path === "material" ? materials : [];
    return list.find((preset) => preset.id === id) ?? {};
  }

  /**
   * Gives the part of the job around `decider` the shape that `choice` asks for.
   * @param {Field} decider
   * @param {string} choice
   */
  #reshape(decider, choice) {
    const path = parentOf(decider.path);
    const known = new Map(Object.entries(this.#presetOf(path)));
    const old = this.#read(path);
    if (typeof old === "object") {
      for (const [key, value] of Object.entries(old)) {
        const field = this.#find(`${path}.${key}`);
        this.#drafts.set(draftKey(field ?? { path: `${path}.${key}` }, this.get(decider)), value);
        if (!field?.defaults) known.set(key, value);
      }
    }
    if (path === "stock" && choice === "none") return this.#dropStock();
    const given = { known, drafts: this.#drafts, decider, choice };
    this.#write(path, choice === "none" ? "none" : shaped(this.#fields, path, given));
  }

  /** Without a stock, neither engagement nor feed can follow from it. */
  #dropStock() {
    delete this.#data.stock;
    if (this.#read(FEED_RULE)) this.#write(FEED_RULE, "programmed");
    if (this.#read(ENGAGEMENT) === FROM_STOCK) this.#forget(ENGAGEMENT);
  }
}
