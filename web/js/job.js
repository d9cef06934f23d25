// The job as the page holds it: a plain object in the shape of the job file, read and written by path.
//
// Some parts of a job take one of several shapes (a robot by preset or by table, a path of some kind, a shaper or
// none). A choice field decides which: the fields that exist only for some of its values name it in `when`.

const TURN = 2 * Math.PI;

/** A number that may also be a word: the word, and how a checkbox beside the number offers it. */
export const WORDS = {
  "cutting.feed_per_tooth_mm": { word: "from_feed", label: "from the feed rate" },
  "motion.corner_dwell": { word: "settle", label: "until the shaper has settled" },
};

const keys = (path) => path.match(/[^.[\]]+/g);
const parentOf = (path) => path.slice(0, Math.max(0, path.lastIndexOf(".")));
const keyOf = (path) => path.slice(path.lastIndexOf(".") + 1);

export class Job {
  #fields;
  #presets;
  #drafts = new Map(); // values of fields whose shape is not chosen now, kept for the way back
  #data;

  constructor(data, fields, presets) {
    this.#data = structuredClone(data);
    this.#fields = fields;
    this.#presets = presets;
  }

  get json() {
    return JSON.stringify(this.#data, null, 2);
  }

  /** Replaces the whole job. */
  load(data) {
    this.#data = structuredClone(data);
    this.#drafts.clear();
  }

  /** The value at `field.path`; where the job leaves it out, the default. */
  get(field) {
    const value = this.#read(field.path);
    if (value !== undefined) return value;
    if (field.kind === "choice" && this.#read(parentOf(field.path)) !== undefined && this.#isSwitch(field)) {
      return missingChoice(field);
    }
    return field.default;
  }

  /** Whether the field belongs to the job's present shape. */
  shows(field) {
    const other = twin(field.path);
    if (other && this.#has(other) && this.#find(other)) return false;
    if (!field.when) return true;
    const decider = this.#find(field.when.path);
    if (!decider) return field.when.is.includes(this.#read(field.when.path));
    return this.shows(decider) && field.when.is.includes(this.get(decider));
  }

  set(field, value) {
    if (field.kind === "choice" && this.#isSwitch(field)) return this.#switch(field, value);
    this.#write(field.path, value);
  }

  /** Whether `field` differs from its default. */
  changed(field) {
    return JSON.stringify(this.get(field)) !== JSON.stringify(field.default);
  }

  /** The other unit that this field can be given in, or undefined. */
  otherUnit(field) {
    return this.#find(twin(field.path));
  }

  /** Gives the frequency in the other unit: same value, other key. */
  swapUnit(field) {
    const other = this.otherUnit(field);
    const value = this.get(field);
    const owner = this.#read(parentOf(field.path));
    delete owner[keyOf(field.path)];
    const factor = field.path.endsWith("_hz") ? TURN : 1 / TURN;
    owner[keyOf(other.path)] = Number((value * factor).toPrecision(12));
    return other;
  }

  #find(path) {
    return this.#fields.find((field) => field.path === path);
  }

  #read(path) {
    return keys(path).reduce((value, key) => value?.[key], this.#data);
  }

  #has(path) {
    return this.#read(path) !== undefined;
  }

  #write(path, value) {
    const parent = parentOf(path);
    if (parent && typeof this.#read(parent) !== "object") {
      this.#write(parent, this.#shape(parent, new Map()));
    }
    const owner = parent ? this.#read(parent) : this.#data;
    owner[keyOf(path)] = value;
  }

  /** A choice that decides which of its siblings exist. */
  #isSwitch(field) {
    return this.#fields.some((other) => other.when?.path === field.path && parentOf(other.path) === parentOf(field.path));
  }

  /** Gives the part of the job around `field` the shape that `choice` asks for. */
  #switch(field, choice) {
    const parent = parentOf(field.path);
    const old = this.#read(parent);
    const known = new Map(Object.entries(this.#preset(parent, old)));
    if (typeof old === "object") {
      for (const [key, value] of Object.entries(old)) {
        this.#drafts.set(`${parent}.${key}`, value);
        known.set(key, value);
      }
    }
    this.#write(parent, choice === "none" ? "none" : this.#shape(parent, known, field, choice));
  }

  /** An object with every field under `parent` that exists when `decider` is `choice`. */
  #shape(parent, known, decider, choice) {
    const shape = {};
    for (const field of this.#fields) {
      const key = keyOf(field.path);
      if (parentOf(field.path) !== parent) continue;
      if (field === decider) {
        if (choice !== "custom") shape[key] = choice;
        continue;
      }
      if (decider && field.when?.path === decider.path && !field.when.is.includes(choice)) continue;
      const other = twin(field.path) && keyOf(twin(field.path));
      if (other && (other in shape || (known.has(other) && !known.has(key)))) continue;
      shape[key] = structuredClone(known.get(key) ?? this.#drafts.get(field.path) ?? field.default);
    }
    return shape;
  }

  /** The numbers behind the preset that `part` names, so that one's own start from them. */
  #preset(parent, part) {
    const list = { robot: this.#presets.robots, material: this.#presets.materials }[parent];
    return list?.find((preset) => preset.id === part?.preset) ?? {};
  }
}

/** The path of the same quantity in another unit: a frequency is in rad/s or in Hz. */
function twin(path) {
  if (path.endsWith("frequency_rad_s")) return path.replace(/rad_s$/, "hz");
  if (path.endsWith("frequency_hz")) return path.replace(/hz$/, "rad_s");
  return undefined;
}

/** What a choice means whose key the job leaves out: "none" for a part that is that word, else one's own table. */
function missingChoice(field) {
  const values = field.choices.map((choice) => choice.value);
  return values.includes("custom") ? "custom" : values.includes("none") ? "none" : field.default;
}
