// A short message at the foot of the page, over it, so that nothing moves. It goes by itself or
// when it is closed.

import { byId, make } from "./dom.js";

const SHOWN_MS = 20_000;
/** @type {number | undefined} */
let timer;

/**
 * Shows a message in place of the last one; an empty one only takes that away.
 * @param {string} message
 */
export function notify(message) {
  clearTimeout(timer);
  const box = byId("notice");
  box.replaceChildren();
  if (!message) return;
  const close = make("button", { type: "button", className: "quiet" }, "Close");
  close.addEventListener("click", () => notify(""));
  box.append(make("p", {}, message), close);
  timer = setTimeout(notify, SHOWN_MS, "");
}
