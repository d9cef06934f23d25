// A choice of many, found by typing: an editable combobox with a list under headings. A select that
// is not shown holds the value, so that a form, a test or an assistive tool may set it as any other.

import { make } from "../page/dom.js";
import { found } from "./search.js";

/**
 * @import { Badge } from "./badges.js"
 * @import { Editor } from "./editors.js"
 */

/** @typedef {{ value: string, label: string, heading?: string }} Choice */

/**
 * An editor for `choices`, `{ value, label, heading }`. `badges` has a few words for each value, `{ text, kind }`, by which
 * it is found too.
 * @param {string} id
 * @param {Choice[]} choices
 * @param {Map<string, Badge[]>} badges
 * @returns {Editor}
 */
export function searchList(id, choices, badges) {
  const select = make("select", { id, hidden: true, tabIndex: -1 }, ...grouped(choices, optgroup, option));
  const list = make("div", { id: `${id}-list`, className: "options", role: "listbox", hidden: true });
  const input = make("input", {
    id: `${id}-search`,
    type: "text",
    role: "combobox",
    autocomplete: "off",
    spellcheck: false,
    "aria-autocomplete": "list",
    "aria-expanded": "false",
    "aria-controls": list.id,
  });
  const chosen = make("p", { className: "chosen" });
  const none = make("p", { className: "none", hidden: true, role: "status" }, "None in the list fits.");
  const node = make("div", { className: "search-list" }, input, list, none, chosen, select);
  list.setAttribute("aria-labelledby", `${id}-label`);

  /** @param {string} value */
  const badgesOf = (value) => badges.get(value) ?? [];
  /** @param {{ value: string, label: string }} given */
  const textOf = ({ value, label }) => [label, ...badgesOf(value).map(({ text }) => text)].join(" ");
  const options = () => /** @type {HTMLElement[]} */ ([...list.querySelectorAll("[role=option]")]);
  const isOpen = () => !list.hidden;
  /** @type {HTMLElement | undefined} */
  let active; // the option that Enter takes
  /** @type {string | undefined} */
  let shown; // what stands in the input

  /** @param {HTMLElement | undefined} target */
  function point(target) {
    active?.classList.remove("active");
    active = target;
    active?.classList.add("active");
    active?.scrollIntoView({ block: "nearest" });
    if (active) input.setAttribute("aria-activedescendant", active.id);
    else input.removeAttribute("aria-activedescendant");
  }

  /** @param {string} query */
  function open(query) {
    const fitting = found(choices, query, textOf);
    list.replaceChildren(...grouped(fitting, group, entry));
    list.hidden = fitting.length === 0;
    none.hidden = fitting.length > 0;
    input.setAttribute("aria-expanded", String(isOpen()));
    point(query ? options()[0] : options().find(({ dataset }) => dataset.value === select.value));
  }

  function close() {
    list.hidden = none.hidden = true;
    input.setAttribute("aria-expanded", "false");
    point(undefined);
    showAgain();
  }

  /**
   * What is chosen, with its badges; a name that is longer than the input stands in full below. Whether it is longer
   * makes the browser lay out the page, so it is looked at once, and again when the width changes.
   */
  function show() {
    if (select.value === shown) return;
    shown = select.value;
    const { label = "" } = choices.find(({ value }) => value === select.value) ?? {};
    if (input.value !== label) input.value = label;
    const fits = input.clientWidth === 0 ? label.length <= FITS : input.scrollWidth <= input.clientWidth;
    chosen.replaceChildren(...(fits ? [] : [make("span", {}, label)]), ...badgesOf(select.value).map(badge));
  }

  function showAgain() {
    shown = undefined;
    show();
  }

  /** @param {string} value */
  function take(value) {
    select.value = value;
    close();
    select.dispatchEvent(new Event("change", { bubbles: true }));
  }

  /** @param {{ value: string, label: string }} given */
  function entry({ value, label }) {
    const node = make(
      "div",
      { id: `${id}-${value}`, role: "option", "aria-selected": String(value === select.value) },
      make("span", { className: "name" }, label),
      " ",
      make("span", { className: "badges" }, ...badgesOf(value).flatMap((each) => [badge(each), " "])),
    );
    node.dataset.value = value;
    return node;
  }

  new ResizeObserver(() => isOpen() || showAgain()).observe(input);
  // What is typed here is a question, no edit of the job.
  for (const kind of ["input", "change"]) input.addEventListener(kind, (event) => event.stopPropagation());
  input.addEventListener("input", () => open(input.value));
  input.addEventListener("focus", () => input.select());
  input.addEventListener("click", () => isOpen() || open(""));
  input.addEventListener("blur", close);
  list.addEventListener("pointerdown", (event) => event.preventDefault()); // the focus stays in the input
  list.addEventListener("click", ({ target }) => {
    /** @type {HTMLElement | null} */
    const picked = /** @type {Element} */ (target).closest("[role=option]");
    if (picked) take(String(picked.dataset.value));
  });
  input.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey) return;
    const { key } = event;
    if (key === "Escape" && (isOpen() || !none.hidden)) return (event.preventDefault(), close());
    if (key === "Enter" && isOpen()) return (event.preventDefault(), active && take(String(active.dataset.value)));
    const step = STEPS[key];
    if (!step) return;
    event.preventDefault();
    if (!isOpen()) return open("");
    const all = options();
    const at = active ? all.indexOf(active) : -1;
    point(all[at < 0 ? (step > 0 ? 0 : all.length - 1) : Math.min(all.length - 1, Math.max(0, at + step))]);
  });

  return {
    node,
    inputs: [input, select],
    read: () => select.value,
    /** @param {string} value */
    write(value) {
      select.value = value;
      if (!isOpen()) show();
    },
    at: () => input,
  };
}

/** @type {Record<string, number>} */
const STEPS = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 };
const FITS = 36; // characters of a name, where the input is not laid out yet

/** @param {Badge} badge */
const badge = ({ text, kind }) => make("span", { className: `badge ${kind ?? ""}`.trim() }, text);

/**
 * Nodes of the items in order, those of one heading inside one node of it.
 * @param {Choice[]} items
 * @param {(heading: string) => HTMLElement} groupNode
 * @param {(choice: Choice) => HTMLElement} itemNode
 */
function grouped(items, groupNode, itemNode) {
  const nodes = [];
  const groups = new Map();
  for (const item of items) {
    const { heading } = item;
    if (heading && !groups.has(heading)) {
      groups.set(heading, groupNode(heading));
      nodes.push(groups.get(heading));
    }
    if (heading) groups.get(heading).append(itemNode(item));
    else nodes.push(itemNode(item));
  }
  return nodes;
}

/** @param {string} label */
const optgroup = (label) => make("optgroup", { label });

/** @param {{ value: string, label: string }} given */
const option = ({ value, label }) => make("option", { value }, label);

/** @param {string} heading */
const group = (heading) =>
  make(
    "div",
    { role: "group", "aria-label": heading },
    make("div", { className: "heading", "aria-hidden": "true" }, heading),
  );
