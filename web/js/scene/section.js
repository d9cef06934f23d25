// A section through the part across the feed, where the tool is at the cursor.

import * as core from "../core/client.js";
import { cursor } from "../page/cursor.js";
import { make, makeSvg } from "../page/dom.js";
import { lineAt } from "../page/program-lines.js";
import { lengthText, lengthUnit } from "../page/units.js";

/** @import { PartSection, Summary } from "../../pkg/armill.js" */

const LEGEND = [
  ["nominal", "Nominal"],
  ["before", "Before"],
  ["after", "After compensation"],
  ["tool", "Tool"],
];
const AIR = 0.25; // room above and below, as a part of the section's half width

export class Section {
  /** @type {Summary} */
  #summary;
  #ready = false; // whether the core may be asked
  #asked = -1; // the sample that was asked for last
  #asking = false;
  /** @type {PartSection | null} */
  #section = null;
  #factor = 1;
  #drawing = make("div", { className: "cross-section" });
  #caption = make("p", { className: "note" });

  constructor() {
    const entries = LEGEND.map(([name, label]) =>
      make(
        "span",
        {},
        makeSvg("svg", { class: "sample", viewBox: "0 0 28 8", "aria-hidden": "true" }, seriesOf(name, "M0 4H28")),
        label,
      ),
    );
    this.node = make(
      "details",
      { className: "section-at", open: true, hidden: true },
      make("summary", {}, "Section across the feed at the cursor"),
      this.#drawing,
      make("p", { className: "legend-line" }, ...entries),
      this.#caption,
    );
    this.node.addEventListener("toggle", () => this.follow());
    new IntersectionObserver(() => this.follow()).observe(this.node);
  }

  /**
   * Offers the sections of a result, if its part can be cut.
   * @param {Summary} summary
   */
  offer(summary) {
    this.#summary = summary;
    this.node.hidden = !summary.surface;
    this.#ready = false;
    this.#asked = -1;
  }

  /** The core may be asked from now on. */
  begin() {
    this.#ready = true;
    return this.follow();
  }

  /** The sample at the cursor; without one, where the surface errs most. */
  get #sample() {
    const { samples, duration_s, surface } = this.#summary;
    const time = cursor();
    if (time === null) return surface?.worst[0]?.sample ?? 0;
    return Math.round((Math.min(duration_s, time) / (duration_s || 1)) * (samples - 1));
  }

  /** The cursor has moved: asks the core, one question at a time. */
  async follow() {
    if (!this.#ready || this.#asking || !this.node.open || !this.node.checkVisibility()) return;
    this.#asking = true;
    try {
      while (this.#ready && this.#asked !== this.#sample) {
        const sample = (this.#asked = this.#sample);
        this.#section = await core.partSection(sample);
        this.#draw(this.#section, sample);
      }
    } catch {
      this.#asked = -1; // a newer result brings its own
    }
    this.#asking = false;
  }

  /**
   * Magnifies the deviation.
   * @param {number} factor
   */
  magnify(factor) {
    if (factor === this.#factor) return;
    this.#factor = factor;
    if (this.#section && this.#asked >= 0) this.#draw(this.#section, this.#asked);
  }

  /**
   * @param {PartSection} section
   * @param {number} sample
   */
  #draw({ nominal_mm, before_mm, after_mm, tool_mm, bottom_mm }, sample) {
    const [half, high] = [Math.abs(nominal_mm[0]), Math.max(...odd(nominal_mm), Math.min(...odd(tool_mm)))];
    const [top, low] = [high + AIR * half, bottom_mm - 0.1 * half];
    const svg = makeSvg("svg", { viewBox: [-half, -top, 2 * half, top - low].map((v) => v.toFixed(3)).join(" ") });
    svg.setAttribute("role", "img");
    const { samples, duration_s } = this.#summary;
    const time = (sample / (samples - 1)) * duration_s;
    const line = lineAt(time);
    const at = cursor() === null ? "Where the surface errs most, at" : "At";
    const where = `${at} ${time.toFixed(2)} s${line ? `, line ${line} of the program` : ""}`;
    const words =
      `${where}, seen along the feed; ${lengthText(2 * half)} ${lengthUnit()} wide, ` +
      `deviation × ${this.#factor}. The part is finished.`;
    svg.setAttribute("aria-label", words);
    /** @param {Float32Array} shifts */
    const moved = (shifts) => nominal_mm.map((v, i) => v + this.#factor * shifts[i]);
    const surface = lineOf(nominal_mm);
    svg.append(
      makeSvg("path", { class: "solid", d: `${surface}V${-bottom_mm}H${-nominal_mm[0]}Z` }),
      makeSvg("path", { class: "tool", d: lineOf(tool_mm) }),
      seriesOf("nominal", surface),
      seriesOf("before", lineOf(moved(before_mm))),
      seriesOf("after", lineOf(moved(after_mm))),
    );
    this.#drawing.replaceChildren(svg);
    this.#caption.textContent = words;
    Object.assign(this.node.dataset, { sample: String(sample), factor: String(this.#factor) });
  }
}

/** @param {Float32Array} pairs */
const odd = (pairs) => pairs.filter((_, i) => i % 2);

/**
 * Pairs of a distance to the left and a height as a line of the drawing, where right and down count.
 * @param {Float32Array} pairs
 */
function lineOf(pairs) {
  const points = [];
  for (let i = 0; i < pairs.length; i += 2) points.push(`${(-pairs[i]).toFixed(4)} ${(-pairs[i + 1]).toFixed(4)}`);
  return `M${points.join("L")}`;
}

/**
 * @param {string} name
 * @param {string} d
 */
const seriesOf = (name, d) => makeSvg("g", { class: `series ${name}` }, makeSvg("path", { d }));
