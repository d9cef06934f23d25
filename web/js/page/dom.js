// The few lines of DOM that every module needs.

export const byId = (id) => document.getElementById(id);

/**
 * An element with properties (or attributes, where the name has a dash or is `role`) and children.
 * Text children stay text.
 */
export function make(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children);
  return element;
}

const SVG = "http://www.w3.org/2000/svg";

/** The same for drawings; here every property is an attribute. */
export function makeSvg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Makes one stop for Tab of the buttons in `group`: arrows, Home and End move among them. */
export function rove(group) {
  const buttons = () => [...group.querySelectorAll("button")];
  const stop = (chosen) => buttons().forEach((button) => (button.tabIndex = button === chosen ? 0 : -1));
  group.addEventListener("focusin", ({ target }) => stop(target));
  group.addEventListener("keydown", (event) => {
    const all = buttons().filter((button) => button.checkVisibility());
    const at = all.indexOf(document.activeElement);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1 + all.length, Home: 0, End: all.length - 1 }[event.key];
    if (at < 0 || to === undefined) return;
    event.preventDefault();
    all[to % all.length].focus();
  });
  stop(buttons()[0]);
}

/** Calls `action` once, `delay` ms after the last call. */
export function debounced(action, delay) {
  let timer;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(action, delay, ...args);
  };
}

/** The core's messages start in lower case. */
export const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);
