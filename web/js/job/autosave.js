// The inputs as they stand, kept in this browser so that a reload loses nothing that was typed.
//
// Every tab keeps its own (session storage) and opens with it again; a new tab opens with what was
// changed last anywhere (local storage). So two tabs never change each other's inputs, and
// `onshared` is called when they compete.

import { debounced } from "../page/dom.js";
import { isDown, named, pickUp, putDown } from "./long-texts.js";

const KEY = "armill-inputs";
const FORMAT = 1;
const PAUSE_MS = 300; // of typing, before anything is written

/** @import { JobState } from "./data.js" */

/** @typedef {JobState & { typed?: Record<string, any> }} Inputs the job, and what the form holds besides */

let events = { onrefused: (/** @type {boolean} */ _full) => {}, onshared() {} };
/** @type {Inputs | undefined} */
let waiting; // state that is not written yet
let refused = false;
let shared = false;

/**
 * `onrefused(full)` is called once if nothing can be kept, `onshared()` once if another tab keeps
 * inputs too.
 * @param {typeof events} handlers
 */
export function start(handlers) {
  events = handlers;
  addEventListener("pagehide", flush);
  document.addEventListener("visibilitychange", () => document.hidden && flush());
  addEventListener("storage", ({ key, newValue }) => {
    if (key !== KEY || newValue === null || shared) return;
    shared = true;
    events.onshared();
  });
}

/**
 * Resolves with the inputs that this tab, or else any tab, kept last; undefined if there are none.
 * @returns {Promise<Inputs | undefined>}
 */
export async function kept() {
  for (const store of [() => sessionStorage, () => localStorage]) {
    try {
      const { format, state } = JSON.parse(store().getItem(KEY) ?? "{}") ?? {};
      if (format === FORMAT && state && typeof state.job === "object") return await pickUp(state);
    } catch {
      // Denied, or not ours.
    }
  }
  return undefined;
}

/**
 * Keeps inputs that have not been changed yet, for this tab alone.
 * @param {Inputs} state
 */
export const keepHere = (state) => void write(() => sessionStorage, state);

/**
 * Keeps inputs, a moment from now.
 * @param {Inputs} state
 */
export function keep(state) {
  waiting = state;
  later();
  if (!isDown(state)) putDown(state).then(later);
}

const later = debounced(flush, PAUSE_MS);

function flush() {
  if (waiting === undefined || !isDown(waiting)) return;
  const state = waiting;
  waiting = undefined;
  const here = write(() => sessionStorage, state);
  const everywhere = write(() => localStorage, state);
  if (refused || (here === true && everywhere === true)) return;
  refused = true;
  events.onrefused([here, everywhere].includes("full"));
}

/**
 * Writes a state; true, or "full" or "denied".
 * @param {() => Storage} store
 * @param {Inputs} state
 */
function write(store, state) {
  try {
    store().setItem(KEY, named({ format: FORMAT, state }));
    return true;
  } catch (error) {
    return error.name === "QuotaExceededError" ? "full" : "denied";
  }
}
