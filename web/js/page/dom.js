// The few lines of DOM that every module needs.

/**
 * The ids of elements whose kind matters to the code.
 *
 * @typedef {{
 *   "budget-table": HTMLTableElement,
 *   "download-columns": HTMLButtonElement,
 *   "download-compensated": HTMLButtonElement,
 *   "download-job": HTMLButtonElement,
 *   "download-program": HTMLButtonElement,
 *   "export-format": HTMLSelectElement,
 *   "feed-figures": HTMLTableElement,
 *   "group-frames": HTMLDetailsElement,
 *   "group-path": HTMLDetailsElement,
 *   "job-file": HTMLInputElement,
 *   "job-name": HTMLInputElement,
 *   "open": HTMLAnchorElement,
 *   "pin": HTMLButtonElement,
 *   "progress": HTMLProgressElement,
 *   "redo": HTMLButtonElement,
 *   "remarks": HTMLDetailsElement,
 *   "share": HTMLButtonElement,
 *   "share-link": HTMLInputElement,
 *   "thesis": HTMLTableElement,
 *   "undo": HTMLButtonElement,
 *   "wall-table": HTMLTableElement,
 *   "warnings": HTMLDetailsElement,
 * }} Elements
 */

/**
 * @template {string} K
 * @param {K} id
 * @returns {K extends keyof Elements ? Elements[K] : HTMLElement}
 */
export const byId = (id) => /** @type {any} */ (document.getElementById(id));

/**
 * An element with properties (or attributes, where the name has a dash or is `role`) and children.
 * Text children stay text.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, unknown>} props
 * @param {(Node | string)[]} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function make(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, String(value));
    else Object.assign(element, { [name]: value });
  }
  element.append(...children);
  return element;
}

/**
 * A choice among words, by their values.
 * @param {string} id
 * @param {Record<string, string>} words
 */
export const select = (id, words) =>
  make("select", { id }, ...Object.entries(words).map(([value, text]) => make("option", { value }, text)));

const SVG = "http://www.w3.org/2000/svg";

/**
 * The same for drawings; here every property is an attribute.
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, string | number>} attributes
 * @param {(Node | string)[]} children
 * @returns {SVGElementTagNameMap[K]}
 */
export function makeSvg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

/**
 * Makes one stop for Tab of the buttons in `group`: arrows, Home and End move among them.
 * @param {HTMLElement} group
 */
export function rove(group) {
  const buttons = () => [...group.querySelectorAll("button")];
  /** @param {EventTarget | null} chosen */
  const stop = (chosen) => buttons().forEach((button) => (button.tabIndex = button === chosen ? 0 : -1));
  group.addEventListener("focusin", ({ target }) => stop(target));
  group.addEventListener("keydown", (event) => {
    const all = buttons().filter((button) => button.checkVisibility());
    const at = all.indexOf(/** @type {HTMLButtonElement} */ (document.activeElement));
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1 + all.length, Home: 0, End: all.length - 1 }[event.key];
    if (at < 0 || to === undefined) return;
    event.preventDefault();
    all[to % all.length].focus();
  });
  stop(buttons()[0]);
}

/**
 * Calls `action` once, `delay` ms after the last call.
 * @template {unknown[]} A
 * @param {(...args: A) => void} action
 * @param {number} delay
 * @returns {(...args: A) => void}
 */
export function debounced(action, delay) {
  /** @type {number | undefined} */
  let timer;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(action, delay, ...args);
  };
}

/**
 * The core's messages start in lower case.
 * @param {string} text
 */
export const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);
