// A chart's legend: each entry is a button that hides its series, or shows it alone.

import { make, makeSvg, rove } from "../page/dom.js";

/** @import { Chart } from "../../pkg/armill.js" */

/** @typedef {Chart["series"][number]} Series */

export class Legend {
  node = make("ul", { className: "legend" });
  /** @type {Set<string>} */
  #hidden = new Set();
  /** @type {string[]} */
  #keys = [];
  #change;

  /**
   * `change()` is called after a series was hidden or shown.
   * @param {string} title
   * @param {() => void} change
   */
  constructor(title, change) {
    this.#change = change;
    this.node.setAttribute("aria-label", `Series of ${title}`);
    this.node.addEventListener("click", ({ target, shiftKey }) => this.#choose(target, shiftKey));
    this.node.addEventListener("dblclick", ({ target }) => this.#choose(target, true));
  }

  /** Keys of the series that are not to be drawn. */
  get hidden() {
    return this.#keys.filter((key) => this.#hidden.has(key));
  }

  /**
   * Takes over the series of a drawing, and the pinned results, { letter, name }, whose curves are below.
   * @param {Series[]} series
   * @param {{ letter: string, name: string }[]} pinned
   */
  show(series, pinned) {
    const said = JSON.stringify([series, pinned]);
    if (this.node.dataset.series === said) return; // buttons keep the focus
    this.node.dataset.series = said;
    this.#keys = series.map(({ key }) => key);
    this.node.replaceChildren(...series.map(entry));
    this.node.append(...pinned.map(pinnedEntry));
    rove(this.node);
    this.#mark();
  }

  /**
   * @param {EventTarget | null} target
   * @param {boolean} alone
   */
  #choose(target, alone) {
    const key = /** @type {Element} */ (target).closest("button")?.dataset.key;
    if (!key) return;
    const others = this.#keys.filter((each) => each !== key);
    if (alone) {
      const isAlone = !this.#hidden.has(key) && others.every((each) => this.#hidden.has(each));
      this.#hidden = new Set(isAlone ? [] : others);
    } else if (!this.#hidden.delete(key)) this.#hidden.add(key);
    this.#mark();
    this.#change();
  }

  #mark() {
    for (const button of this.node.querySelectorAll("button")) {
      button.setAttribute("aria-pressed", String(!this.#hidden.has(button.dataset.key ?? "")));
    }
  }
}

/**
 * A short line in the look of a series.
 * @param {{ key: string, class: string }} series
 */
export const sample = ({ key, class: name }) =>
  makeSvg(
    "svg",
    { viewBox: "0 0 28 8", class: "sample", "aria-hidden": "true" },
    makeSvg("g", { class: `series ${name}`, "data-key": key }, makeSvg("path", { d: "M0 4H28" })),
  );

/** @param {Series} series */
function entry(series) {
  const button = make(
    "button",
    { type: "button", title: "Click: hide or show. Double-click or Shift: show alone, or all again." },
    sample(series),
    series.label,
  );
  button.dataset.key = series.key;
  return make("li", {}, button);
}

/**
 * A pinned result has one colour in all its curves, and the dashes of theirs.
 * @param {{ letter: string, name: string }} given
 */
const pinnedEntry = ({ letter, name }) =>
  make(
    "li",
    {
      className: `pinned pin-${letter.toLowerCase()}`,
      title: `Pinned as ${letter}: thin lines, dashed like the others`,
    },
    sample({ key: "", class: "" }),
    name ? `${letter}, ${name}` : letter,
  );
