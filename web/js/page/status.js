// How the calculator's state is shown: an attribute for the styles, one line of status, one alert.

import { announce } from "./announce.js";
import { byId, make, sentence } from "./dom.js";

/** @typedef {{ label: string, go: () => void }} Remedy what a button beside a message does */

/**
 * The calculator's state, which the styles depend on.
 * @param {import("../calculator.js").State} state
 */
export const become = (state) => (byId("results").dataset.state = state);

/**
 * The line of status; it is read out once the page has settled.
 * @param {string} text
 */
export function say(text) {
  byId("status").textContent = text;
  announce("status", text);
}

/**
 * Shows what is wrong, with a button for its `remedy` { label, go }, if there is one.
 * @param {string} message
 * @param {Remedy} [remedy]
 */
export function warn(message, remedy) {
  const box = byId("alert");
  box.replaceChildren(make("p", {}, sentence(message)));
  if (!remedy) return;
  const button = make("button", { type: "button" }, remedy.label);
  button.addEventListener("click", remedy.go);
  box.append(button);
}

/** Nothing is wrong any more. */
export const calm = () => byId("alert").replaceChildren();

/**
 * Whether a run takes long enough to show its progress.
 * @param {boolean} on
 */
export const slow = (on) => byId("results").classList.toggle("slow", on);
