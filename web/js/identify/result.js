// What both parts of the view do with a text: compute when it changes, latest wins; show the result
// and its chart, or what is wrong.

import { Figure } from "../chart/figure.js";
import { debounced, make } from "../page/dom.js";
import { onSetting } from "../page/settings.js";

/**
 * @import { ChartOptions, ChartUnits } from "../../pkg/armill.js"
 * @import { Source } from "./input.js"
 * @import { Ask } from "./panel.js"
 */

/** @typedef {"stiffness" | "response" | "gear" | "pass"} Kind */

/** @template Found what the core finds */
export class Outcome {
  /** @type {Ask} */
  #ask;
  /** @type {Kind} */
  #kind;
  /** @type {Source} */
  #source;
  /** @type {(found: Found) => Node[]} */
  #show;
  /** @type {(error: import("../core/client.js").Failure) => Source} */
  #faulty;
  #result = make("div", { className: "result", hidden: true });
  /** @type {Figure} */
  #figure;
  #turn = 0;
  #asked = ""; // what was asked last
  /** @type {Found | null} */
  #found = null;

  /**
   * `source` is the text, `show(found)` gives the nodes of a result; `chart` is { name, title }. Where there is another text,
   * `faulty(error)` is the one that the error is about.
   * @param {{
   *   ask: Ask, kind: Kind, source: Source,
   *   chart: { name: string, title: string }, show(found: Found): Node[],
   *   faulty?(error: import("../core/client.js").Failure): Source,
   * }} options
   */
  constructor({ ask, kind, source, chart, show, faulty = () => source }) {
    this.#ask = ask;
    this.#kind = kind;
    this.#source = source;
    this.#show = show;
    this.#faulty = faulty;
    const drawn = {
      chart: (/** @type {string} */ _, /** @type {ChartOptions} */ options) => ask("identified_chart", kind, options),
      chartData: (/** @type {string} */ _, /** @type {ChartUnits} */ units) => ask("identified_data", kind, units),
    };
    this.#figure = new Figure({ ...chart, figure: "", kind: "curve" }, () => {}, drawn);
    this.node = make("div", { className: "outcome", "aria-live": "polite" }, this.#result);
    const redraw = debounced(() => this.#figure.fits || this.#draw(), 120);
    new ResizeObserver(() => this.#found && redraw()).observe(this.node);
    onSetting((key) => {
      if (!this.#found || key === "theme") return;
      this.#fill();
      this.#figure.forget();
      this.#figure.zoom.show(null, null, true);
    });
  }

  /**
   * Computes with the text and `args` (plain data), unless that is what is shown.
   * @param {unknown[]} args
   */
  async compute(...args) {
    const { text } = this.#source;
    const asked = JSON.stringify([text, args]);
    if (asked === this.#asked) return void (this.#found && !this.#figure.fits && this.#draw());
    this.#asked = asked;
    const mine = ++this.#turn;
    if (!text.trim()) {
      this.#found = null;
      this.#result.hidden = true;
      return this.#source.fail(null);
    }
    try {
      const found = await this.#ask("identify", this.#kind, ...this.#order(text, args));
      if (mine !== this.#turn) return;
      this.#source.fail(null);
      this.#found = found;
      this.#result.hidden = false;
      this.#result.classList.remove("stale");
      this.#fill();
      this.#figure.forget();
      this.#figure.zoom.show(null, null, true);
      this.#draw();
    } catch (error) {
      if (mine !== this.#turn) return;
      if (error.fatal) this.#asked = "";
      this.#faulty(error).fail(error);
      this.#result.classList.add("stale");
    }
  }

  /**
   * The core takes the job before the text where there is one.
   * @param {string} text
   * @param {unknown[]} args
   */
  #order(text, args) {
    const [job, ...rest] = args;
    return this.#kind === "response" ? [text, ...args] : [job, text, ...rest];
  }

  #fill() {
    if (this.#found) this.#result.replaceChildren(...this.#show(this.#found), this.#figure.node);
  }

  #draw() {
    this.#figure.draw().catch(() => {}); // the next look draws again
  }
}

/**
 * Sentences that make a result doubtful.
 * @param {string[]} texts
 */
export const remarks = (texts) =>
  texts.length ? [make("ul", { className: "remarks" }, ...texts.map((text) => make("li", {}, text)))] : [];
