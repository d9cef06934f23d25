// The few lines of DOM that every module needs.

export const byId = (id) => document.getElementById(id);

/** An element with properties (or attributes, where the name has a dash or is `role`) and children. Text children stay text. */
export function make(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children);
  return element;
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
