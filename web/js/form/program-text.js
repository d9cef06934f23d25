// The text of a program. A short one is typed into a textarea. Browsers lay out megabytes in a
// textarea for half a minute and again with every change, so a long one is kept aside, and only as
// many of its lines as fit are shown.

import { make } from "../page/dom.js";

const LONG = 200_000; // characters
const TALLEST = 8e6; // px: browsers draw nothing beyond some 16 million
/** @type {Record<string, number>} */
const KEYS = { ArrowUp: -1, ArrowDown: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity };

class Listing {
  #area;
  #window = make("div", {
    className: "window",
    tabIndex: 0,
    role: "listbox",
    hidden: true,
    "aria-label": "Program, line by line",
  });
  #spacer = make("div", { className: "spacer" });
  #rows = make("div", { className: "rows", role: "presentation" });
  #about = make("p", { className: "note" });
  #text = "";
  #name = "";
  /** @type {number[] | null} */
  #starts = null; // where each line of a long text starts; null while it is short
  #line = 1; // the line that is pointed at
  #visible = 12;
  #height = 18; // of a line, px
  #onpoint = (/** @type {number} */ _line) => {};
  /** @type {(text: string) => unknown} */
  #onreplaced = (text) => (this.text = text);

  /** @param {string} id */
  constructor(id) {
    this.#area = make("textarea", { id, rows: 8, spellcheck: false });
    this.#window.id = `${id}-window`;
    this.#spacer.append(this.#rows);
    this.#window.append(this.#spacer);
    this.node = make("div", { className: "listing" }, this.#area, this.#window, this.#about);
    this.inputs = [this.#area, this.#window];
    this.#window.addEventListener("scroll", () => this.#draw());
    this.#window.addEventListener("click", (/** @type {any} */ { target }) =>
      this.#point(Number(target.closest("[data-line]")?.dataset.line)),
    );
    this.#window.addEventListener("keydown", (event) => {
      const step = KEYS[event.key];
      if (!step || event.altKey || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      this.#point(Math.min(this.#lines.length, Math.max(1, this.#line + step)));
    });
    this.#area.addEventListener("paste", (event) => this.#paste(event));
    const follow = () => this.#onpoint(this.#area.value.slice(0, this.#area.selectionStart).split("\n").length);
    this.#area.addEventListener("click", follow);
    this.#area.addEventListener("keyup", ({ key }) => key.startsWith("Arrow") && follow());
    new ResizeObserver(() => this.#starts && this.#show()).observe(this.#window);
  }

  /** What the field's errors and keys are about. */
  get input() {
    return this.#starts ? this.#window : this.#area;
  }

  get text() {
    return this.#starts ? this.#text : this.#area.value;
  }

  set text(text) {
    if (text === this.text) return;
    this.#text = text;
    this.#name = "";
    this.#line = 1;
    this.#starts = text.length > LONG ? linesOf(text) : null;
    this.#area.value = this.#starts ? "" : text;
    this.#area.hidden = this.#starts !== null;
    this.#window.hidden = !this.#area.hidden;
    this.#show();
  }

  /**
   * Names the file that the text comes from.
   * @param {string} name
   */
  set name(name) {
    this.#name = name;
    this.#show();
  }

  /**
   * `point(line)` is called whenever the caret, or a click, comes to a line.
   * @param {(line: number) => void} point
   */
  set onpoint(point) {
    this.#onpoint = point;
  }

  /**
   * `replace(text)` is called with a text of several lines that is pasted in place of the whole one.
   * @param {(text: string) => unknown} replace
   */
  set onreplaced(replace) {
    this.#onreplaced = replace;
  }

  /**
   * Points at a line, where it can be seen.
   * @param {number} line
   */
  show(line) {
    if (this.#starts) {
      this.mark(line);
    } else {
      const { value } = this.#area;
      const before = value.split("\n", line - 1).reduce((length, each) => length + each.length + 1, 0);
      const end = value.indexOf("\n", before);
      this.#area.setSelectionRange(before, end < 0 ? value.length : end);
      this.#area.scrollTop = (line - 3) * (this.#area.scrollHeight / value.split("\n").length);
    }
    this.input.focus({ preventScroll: true });
    this.input.scrollIntoView({ block: "nearest" });
  }

  /**
   * Brings a line of a long text into its window, and leaves the focus where it is.
   * @param {number} line
   */
  mark(line) {
    if (!this.#starts) return;
    this.#window.scrollTop = (line - 3) * this.#pitch;
    this.#line = line;
    this.#draw();
  }

  /**
   * Opens a whole program; takes a long text aside before the browser lays it out.
   * @param {ClipboardEvent} event
   */
  #paste(event) {
    const pasted = event.clipboardData?.getData("text/plain") ?? "";
    const { value, selectionStart, selectionEnd } = this.#area;
    if (pasted.includes("\n") && selectionEnd - selectionStart === value.length) {
      event.preventDefault();
      this.#onreplaced(pasted);
      return;
    }
    if (pasted.length <= LONG) return;
    event.preventDefault();
    this.text = value.slice(0, selectionStart) + pasted + value.slice(selectionEnd);
    this.node.dispatchEvent(new Event("input", { bubbles: true }));
    this.#window.focus();
  }

  /** @param {number} line */
  #point(line) {
    if (!line) return;
    this.#line = line;
    const top = this.#top;
    if (line <= top || line >= top + this.#visible)
      this.#window.scrollTop = (line - (line <= top ? 1 : this.#visible - 1)) * this.#pitch;
    this.#draw();
    this.#onpoint(line);
  }

  /** Way to scroll from one line to the next [px]. */
  get #pitch() {
    return Math.min(this.#height, TALLEST / this.#lines.length);
  }

  /** Where each line of the long text starts. */
  get #lines() {
    return this.#starts ?? [];
  }

  /** The first line that is shown, from 0. */
  get #top() {
    return Math.max(
      0,
      Math.min(this.#lines.length - this.#visible + 1, Math.round(this.#window.scrollTop / this.#pitch)),
    );
  }

  #show() {
    const lines = this.#starts?.length;
    const size = `${(this.#text.length / 1e6).toFixed(1)} MB`;
    const name = this.#name && `${this.#name}: `;
    this.#about.textContent = lines
      ? `${name}${lines.toLocaleString("en").replaceAll(",", "\u202f")} lines, ${size}. Too long to type into; open ` +
        `the file again after a change.`
      : this.#name && `Opened from ${this.#name}.`;
    if (!lines) return this.#rows.replaceChildren();
    this.#draw();
    this.#height = /** @type {HTMLElement | null} */ (this.#rows.firstChild)?.offsetHeight || this.#height;
    this.#visible = Math.max(1, Math.ceil(this.#window.clientHeight / this.#height));
    this.#spacer.style.setProperty("height", `${lines * this.#pitch + (this.#window.clientHeight % this.#height)}px`);
    this.#draw();
  }

  #draw() {
    const from = this.#top;
    const shown = Array.from({ length: Math.min(this.#visible, this.#lines.length - from) }, (_, i) =>
      this.#row(from + i),
    );
    this.#rows.replaceChildren(...shown);
    const active = shown.find((row) => row.id);
    if (active) this.#window.setAttribute("aria-activedescendant", active.id);
    else this.#window.removeAttribute("aria-activedescendant");
  }

  /** @param {number} index */
  #row(index) {
    const [start, next = Infinity] = this.#lines.slice(index, index + 2);
    const line = this.#text.slice(start, Math.min(next, start + 200));
    const at = index + 1 === this.#line;
    const row = make(
      "div",
      { role: "option", "aria-selected": String(at) },
      make("span", { className: "unit" }, String(index + 1)),
      ` ${line.trimEnd()}`,
    );
    row.dataset.line = String(index + 1);
    if (at) row.id = `${this.#window.id}-line`;
    return row;
  }
}

/** The text of the job's program; a job has one at most. */
export const listing = new Listing("path-text");

/**
 * Where each line of a text starts.
 * @param {string} text
 */
function linesOf(text) {
  const starts = [0];
  for (let at = text.indexOf("\n"); at >= 0 && at + 1 < text.length; at = text.indexOf("\n", at + 1))
    starts.push(at + 1);
  return starts;
}
