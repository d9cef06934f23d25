// Pinned results, A to E: each a job with its figures and a name. One Worker computes them again, in
// turn, when their curves are first asked for or the page was loaded again.

import { helper } from "../core/client.js";

/**
 * @import { Chart, ChartOptions, Summary } from "../../pkg/armill.js"
 * @import { Asked } from "../core/asked.js"
 */

/** The letters that there are. */
export const LETTERS = ["A", "B", "C", "D", "E"];

const KEY = "armill-pins";

/** @type {Asked | null} */
let worker = null;
/** @type {Pin[]} */
let pins = []; // in the order of their letters
/** @type {string | null} */
let reference = null; // letter of the one that the others are compared with

/** One pinned result. */
export class Pin {
  /** @type {Promise<Summary> | null} */
  #held = null; // promise of its summary, once the Worker holds it

  /** @param {{ letter: string, text: string, name?: string, summary?: Summary }} pin */
  constructor({ letter, text, name = "", summary }) {
    this.letter = letter;
    this.text = text; // of its job
    this.name = name; // as the user calls it
    this.summary = /** @type {Summary} */ (summary); // of one from before a reload, once it is computed
  }

  /**
   * Has the Worker compute it, and resolves with its summary.
   * @returns {Promise<Summary>}
   */
  hold() {
    this.#held ??= ask("hold", this.letter, this.text).catch((error) => {
      this.#held = null;
      throw error;
    });
    return this.#held;
  }

  /**
   * One of its charts, as the core draws it.
   * @param {string} name
   * @param {ChartOptions} options
   * @returns {Promise<Chart>}
   */
  async chart(name, options) {
    await this.hold();
    return ask("held_chart", this.letter, name, options);
  }

  /** Forgets the Worker, which is gone. */
  lose() {
    this.#held = null;
  }
}

/**
 * Asks the Worker; one that has died is replaced at the next question.
 * @param {string} kind
 * @param {...unknown} args
 */
async function ask(kind, ...args) {
  const asked = (worker ??= helper());
  try {
    return await asked.ask(kind, ...args);
  } catch (error) {
    if (error.fatal && worker === asked) {
      worker = null;
      for (const pin of pins) pin.lose();
    }
    throw error;
  }
}

/** The pinned results. */
export const pinned = () => pins;

/** The one that the others are compared with, or undefined. */
export const referencePin = () => pins.find(({ letter }) => letter === reference) ?? pins[0];

/**
 * Chooses the one that the others are compared with.
 * @param {string} letter
 */
export function compareWith(letter) {
  reference = letter;
  keep();
}

/** The letter that the next result gets, or undefined if all are given. */
export const nextLetter = () => LETTERS.find((letter) => !pins.some((pin) => pin.letter === letter));

/**
 * Pins a result under the next letter.
 * @param {{ text: string, summary: import("../../pkg/armill.js").Summary }} given
 */
export function addPin({ text, summary }) {
  const letter = nextLetter();
  if (!letter) return;
  insert(new Pin({ letter, text, summary }));
  keep();
}

/**
 * Unpins the result with a letter; without one, all.
 * @param {string} [letter]
 */
export function removePin(letter) {
  const gone = pins.filter((pin) => !letter || pin.letter === letter);
  pins = pins.filter((pin) => !gone.includes(pin));
  if (pins.length) for (const pin of gone) worker?.ask("drop", pin.letter).catch(() => {});
  else stop();
  keep();
}

/**
 * @param {string} letter
 * @param {string} name
 */
export function renamePin(letter, name) {
  const pin = pins.find((each) => each.letter === letter);
  if (pin) pin.name = name;
  keep();
}

/**
 * Pins again what was pinned before a reload, and calls `added()` after each.
 * @param {() => void} added
 */
export async function restorePins(added) {
  const kept = read();
  reference = kept.reference ?? null;
  for (const saved of kept.pins ?? []) {
    const pin = new Pin(saved);
    try {
      pin.summary = await pin.hold();
    } catch {
      continue; // an older Armill's job, perhaps
    }
    if (pins.some(({ letter }) => letter === pin.letter)) continue; // taken meanwhile
    insert(pin);
    added();
  }
  if (pins.length) keep();
}

/** @param {Pin} pin */
function insert(pin) {
  pins = [...pins, pin].sort((a, b) => (a.letter < b.letter ? -1 : 1));
}

function stop() {
  worker?.stop({ code: "cancelled", message: "Cancelled." });
  worker = null;
  reference = null;
}

function read() {
  try {
    return JSON.parse(sessionStorage.getItem(KEY) ?? "{}") ?? {};
  } catch {
    return {}; // denied, or not ours
  }
}

function keep() {
  try {
    if (!pins.length) return sessionStorage.removeItem(KEY);
    const saved = pins.map(({ letter, text, name }) => ({ letter, text, name }));
    sessionStorage.setItem(KEY, JSON.stringify({ reference, pins: saved }));
  } catch {
    // Denied or full: they are pinned until the page is left.
  }
}
