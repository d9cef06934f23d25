// What only paper has: the job's name, the day, and a link that opens the job again.

import { LONGEST_LINK, fragmentOf } from "../job/link.js";
import { byId, debounced, make } from "../page/dom.js";

/** @import { Shown } from "../calculator.js" */

const SETTLED_MS = 1000; // a result that is dragged past is not printed

/** @type {string | undefined} */
let link; // of the shown result; undefined while there is none, or if it is too long

const follow = debounced(async (/** @type {string} */ text) => {
  const page = location.href.replace(/#.*/, "");
  const address = `${page}#${await fragmentOf(JSON.stringify(JSON.parse(text)))}`;
  link = address.length > LONGEST_LINK ? undefined : address;
}, SETTLED_MS);

/**
 * Has the link of a result at hand: a browser that prints does not wait for it.
 * @param {Shown} shown
 */
export function preparePaper({ text }) {
  link = undefined;
  follow(text);
}

/** Fills the head of the paper whenever the page is printed. */
export function makePaper() {
  addEventListener("beforeprint", () => {
    const day = new Date().toLocaleDateString("en", { dateStyle: "long" });
    const open = link ? [" ", make("a", { href: link }, "Open this job")] : [];
    byId("paper").replaceChildren(make("strong", {}, document.title), make("span", {}, day), ...open);
  });
}
