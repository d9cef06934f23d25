// What screen readers say: what the page has settled on, once. While a number is pushed, results, previews and
// stages follow each other faster than anybody can listen.

import { byId } from "./dom.js";

const QUIET_MS = 1000; // without anything new
const UNSETTLED = ["empty", "computing", "preview"];
/** @type {Map<string, string>} */
const waiting = new Map(); // the latest text of each part of the page, in the order they came
/** @type {number | undefined} */
let timer;

/**
 * Has a text said once the page has settled; it takes the place of what `part` of the page had said
 * before, if that is still to come. An empty one only takes it back.
 * @param {string} part
 * @param {string} text
 */
export function announce(part, text) {
  waiting.delete(part);
  if (text) waiting.set(part, text);
  clearTimeout(timer);
  timer = setTimeout(settle, QUIET_MS);
}

function settle() {
  // What comes of the run is announced too, and starts this again.
  if (!waiting.size || UNSETTLED.includes(byId("results").dataset.state ?? "")) return;
  byId("announced").textContent = [...waiting.values()].join(" ");
  waiting.clear();
}
