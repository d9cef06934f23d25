// A text of measurements: pasted, opened, dropped or an example; and where in it something is
// wrong.

import { debounced, make, sentence } from "../page/dom.js";
import { readText } from "../core/assets.js";

/** @import { Failure } from "../core/client.js" */

const LONG = 200_000; // characters: browsers lay out more than that for seconds
const TYPING_MS = 300;

export class Source {
  #area;
  #error = make("div", { className: "wrong", role: "alert" });
  #note = make("p", { className: "note" });
  /** @type {string | null} */
  #aside = null; // a long text, kept out of the textarea

  /**
   * `changed()` is called when there is another text, `example()` when the example is asked for;
   * `more` stands beside the buttons.
   * @param {{
   *   id: string, label: string, placeholder: string, exampleName: string,
   *   changed(): void, example(): void, more?: Node[],
   * }} options
   */
  constructor({ id, label, placeholder, exampleName, changed, example, more = [] }) {
    const file = make("input", { type: "file", id: `${id}-file`, hidden: true, "aria-label": `${label}: file` });
    const open = make("button", { type: "button", id: `${id}-open` }, "Open file…");
    const show = make("button", { type: "button", id: `${id}-example` }, exampleName);
    this.#area = make("textarea", { id, rows: 7, spellcheck: false, placeholder, "aria-label": label, wrap: "off" });
    open.addEventListener("click", () => file.click());
    file.addEventListener("change", async () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen) this.#take(await chosen.text(), changed);
    });
    show.addEventListener("click", () => example());
    const typed = debounced(changed, TYPING_MS);
    this.#area.addEventListener("input", () => (this.#forget(), typed()));
    this.#area.addEventListener("paste", (event) => {
      const text = event.clipboardData?.getData("text/plain") ?? "";
      if (text.length < LONG) return;
      event.preventDefault();
      this.#take(text, changed);
    });
    this.node = make(
      "div",
      { className: "source", "data-drop": "Drop measurements (CSV)" },
      make("div", { className: "identify-tools" }, open, show, file, ...more),
      this.#area,
      this.#note,
      this.#error,
    );
    this.node.addEventListener("drop", async (event) => {
      const [dropped] = event.dataTransfer?.files ?? [];
      if (!dropped) return;
      event.preventDefault();
      event.stopPropagation(); // elsewhere on the page a file is a program or a job
      this.#take(await dropped.text(), changed);
    });
  }

  get text() {
    return this.#aside ?? this.#area.value;
  }

  set text(text) {
    this.#forget();
    const short = text.length < LONG;
    this.#area.value = short ? text : "";
    if (short) return;
    this.#aside = text;
    this.#note.textContent = `${text.split("\n").length.toLocaleString("en")} lines, too many to show; type or paste to replace them.`;
  }

  /**
   * A text of the site's examples.
   * @param {string} name
   */
  async read(name) {
    this.text = await readText(`examples/${name}`);
  }

  /**
   * Says what is wrong, and where; nothing takes that away.
   * @param {Pick<Failure, "message" | "line"> | null} error
   */
  fail(error) {
    this.#area.setAttribute("aria-invalid", String(Boolean(error)));
    this.#error.replaceChildren();
    if (!error) return;
    this.#error.append(make("p", {}, sentence(error.message)));
    if (!error.line || this.#aside !== null) return;
    const { line } = error;
    const show = make("button", { type: "button", className: "quiet" }, `Show line ${line}`);
    show.addEventListener("click", () => this.show(line));
    this.#error.append(show);
  }

  /**
   * Selects a line.
   * @param {number} line
   */
  show(line) {
    const lines = this.#area.value.split("\n");
    const start = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
    this.#area.focus();
    this.#area.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
    const height = this.#area.scrollHeight / lines.length;
    this.#area.scrollTop = Math.max(0, (line - 3) * height);
  }

  /**
   * @param {string} text
   * @param {() => void} changed
   */
  #take(text, changed) {
    this.text = text;
    changed();
  }

  #forget() {
    this.#aside = null;
    this.#note.textContent = "";
  }
}
