// A short message at the foot of the page, over it, so that nothing moves. It goes by itself or
// when it is closed; one with something to do stays.

import { byId, make } from "./dom.js";

const SHOWN_MS = 20_000;
/** @type {number | undefined} */
let timer;

/**
 * Shows a message in place of the last one, with a button for its `remedy` if it has one; an empty message
 * only removes the last one.
 * @param {string} message
 * @param {import("./status.js").Remedy} [remedy]
 */
export function notify(message, remedy) {
  clearTimeout(timer);
  const box = byId("notice");
  box.replaceChildren();
  if (!message) return;
  const close = make("button", { type: "button", className: "quiet" }, "Close");
  close.addEventListener("click", () => notify(""));
  box.append(make("p", {}, message), close);
  if (remedy) {
    const button = make("button", { type: "button" }, remedy.label);
    button.addEventListener("click", remedy.go);
    close.before(button);
  } else {
    timer = setTimeout(notify, SHOWN_MS, "");
  }
}
