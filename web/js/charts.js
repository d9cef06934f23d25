// Draws the charts of one panel: SVG text from the core, legend and readout in HTML around it.

import * as core from "./core.js";
import { cursor, onCursor, setCursor } from "./cursor.js";
import { debounced, make } from "./dom.js";
import { lineAt, showLine } from "./program.js";

const SVG = "http://www.w3.org/2000/svg";

let available = []; // { name, title, view, figure, kind } of the shown result
let panel = null;
let turn = 0; // drawing that is no longer the latest one stops
const figures = new Map(); // chart name -> Figure

/** Takes over the charts of a new result. */
export function setCharts(list) {
  available = list;
  draw();
}

/** Draws the charts of `shown`, and again whenever its width changes. */
export function showPanel(shown) {
  if (panel) resized.unobserve(panel);
  panel = shown;
  resized.observe(panel);
  draw();
}

onCursor((time, from) => {
  for (const figure of figures.values()) if (figure !== from) figure.readAt(time);
});

const redraw = debounced(() => draw(), 120);
let width = 0;
const resized = new ResizeObserver(([entry]) => {
  const now = Math.round(entry.contentRect.width);
  if (now > 0 && now !== width) redraw();
  width = now;
});

async function draw() {
  const mine = ++turn;
  const view = panel.id.replace("panel-", "");
  const wanted = available.filter((chart) => chart.view === view);
  const shown = wanted.map((chart) => figures.get(chart.name) ?? new Figure(chart));
  wanted.forEach((chart, i) => figures.set(chart.name, shown[i]));
  const place = panel.querySelector(".charts");
  if (shown.some((figure, i) => place.children[i] !== figure.node) || place.children.length !== shown.length) {
    place.replaceChildren(...shown.map((figure) => figure.node));
  }
  for (const figure of shown) {
    const size = figure.size();
    if (size.width < 1) return;
    try {
      const chart = await core.chart(figure.name, size);
      if (mine !== turn) return;
      figure.show(chart);
    } catch {
      return; // a newer result, or a recovery, draws again
    }
  }
}

class Figure {
  #plot = make("div", { className: "drawing" });
  #legend = make("ul", { className: "legend" });
  #caption = make("figcaption");
  #readout = make("p", { className: "readout" });
  #cursor = make("input", { type: "range", className: "cursor", min: "0", max: "400", step: "1" });
  #mark = make("div", { className: "mark" });
  #title;
  #chart;
  #lines = [];
  #line; // of the program, where the chart is read off
  #dotted = false; // of a few marked points, numbered by whole numbers

  constructor({ name, title, figure, kind }) {
    this.name = name;
    this.spatial = kind === "space";
    this.#title = make("h3", {}, title);
    const source = make("span", { className: "source" }, figure ? `Thesis fig. ${figure}` : "");
    this.node = make("figure", { className: "chart-figure", id: `chart-${name}` },
      make("header", {}, this.#title, source), this.#legend, this.#plot, make("div", { className: "below" }, this.#readout, this.#caption));
    this.#plot.style.setProperty("min-height", "15rem");
    this.#cursor.setAttribute("aria-label", `Read values off: ${title}`);
    this.#cursor.addEventListener("input", () => this.#move(Number(this.#cursor.value) / 400));
    this.#cursor.addEventListener("focus", () => this.#move(Number(this.#cursor.value) / 400));
    this.#cursor.addEventListener("blur", () => this.#leave());
    this.#plot.addEventListener("pointermove", (event) => this.#point(event));
    this.#plot.addEventListener("pointerdown", (event) => this.#point(event));
    this.#plot.addEventListener("click", () => this.#line && showLine(this.#line));
    this.#plot.addEventListener("pointerleave", (event) => event.pointerType === "touch" || this.#leave());
  }

  /** The size to draw at [px]. */
  size() {
    const width = Math.round(this.#plot.clientWidth);
    const height = this.spatial ? Math.min(560, Math.max(230, width * 0.6)) : Math.min(300, Math.max(220, width * 0.38));
    return { width, height: Math.round(height) };
  }

  show(chart) {
    this.#chart = chart;
    const parsed = new DOMParser().parseFromString(chart.svg, "image/svg+xml");
    const svg = document.importNode(parsed.documentElement, true);
    svg.setAttribute("aria-hidden", "true"); // heading and caption say it; a <title> would pop up under the pointer
    svg.querySelectorAll(":scope > :is(title, desc)").forEach((element) => element.remove());
    const readable = chart.x?.label && !this.spatial;
    this.#plot.style.setProperty("min-height", `${chart.height}px`);
    this.#plot.replaceChildren(svg, ...(readable ? [this.#mark, this.#cursor] : []));
    this.#title.textContent = chart.title;
    this.#caption.textContent = chart.description;
    this.#legend.replaceChildren(...chart.series.map(legendItem));
    this.#lines = readable ? chart.series.map((series) => ({ ...series, points: pointsOf(svg, series.key) })) : [];
    this.#dotted = svg.querySelector(".series circle") !== null && this.#lines[0]?.points.length > 0;
    this.#clear();
    this.#place();
    if (cursor() !== null) this.readAt(cursor());
  }

  #place() {
    const { left, top, width, height } = this.#chart.plot;
    for (const [name, value] of Object.entries({ left, top, width, height })) {
      this.#cursor.style.setProperty(name, `${value}px`);
      if (name === "top" || name === "height") this.#mark.style.setProperty(name, `${value}px`);
    }
  }

  #point(event) {
    if (!this.#lines.length) return;
    const { left, width } = this.#chart.plot;
    const across = (event.clientX - this.#plot.getBoundingClientRect().left - left) / width;
    if (across < 0 || across > 1) return this.#leave();
    this.#cursor.value = String(Math.round(across * 400));
    this.#move(across);
  }

  /** Shows the values at a fraction of the plot's width, as exactly as the drawing has them. */
  #read(across) {
    const { plot, x, y } = this.#chart;
    const pointed = plot.left + across * plot.width;
    const at = this.#dotted ? nearestTo(this.#lines[0].points, pointed) : pointed;
    const parts = this.#lines.flatMap(({ label, points }) => {
      const height = heightAt(points, at);
      return height === undefined ? [] : [`${label} ${valueAt(y, 1 - (height - plot.top) / plot.height, plot.height)}`];
    });
    this.#line = this.#overRun ? lineAt(x.min + across * (x.max - x.min)) : undefined;
    const line = this.#line ? `, line ${this.#line} of the program` : "";
    const where = this.#dotted ? Math.round(x.min + ((at - plot.left) / plot.width) * (x.max - x.min)) : valueAt(x, across, plot.width);
    const text = [x.label, where, x.unit].filter((part) => part !== "").join(" ") + `: ${parts.join(", ")} ${y.unit}`.trimEnd() + line;
    this.#readout.textContent = text;
    this.#cursor.setAttribute("aria-valuetext", text);
    this.#mark.style.setProperty("left", `${at}px`);
    this.#mark.classList.add("on");
  }

  /** Reads the chart off and takes the page's cursor along. */
  #move(across) {
    const { min, max } = this.#chart.x;
    this.#read(across);
    if (this.#overRun) setCursor(min + across * (max - min), this);
  }

  /** Whether the chart is over the time of the run: the shaper's own step is not. */
  get #overRun() {
    return this.#chart.x.unit === "s" && this.name !== "shaper-step";
  }

  /** Reads the chart off at an instant of the run [s], if it is over it and shown; at none if that is null. */
  readAt(time) {
    const axis = this.#chart?.x;
    if (!this.#lines.length || !this.#overRun || !this.node.isConnected) return;
    if (time === null) return this.#clear();
    const across = (time - axis.min) / (axis.max - axis.min);
    if (across < 0 || across > 1) return;
    this.#cursor.value = String(Math.round(across * 400));
    this.#read(across);
  }

  #leave() {
    if (document.activeElement === this.#cursor) return;
    this.#clear();
    if (this.#chart && this.#overRun) setCursor(null, this);
  }

  #clear() {
    this.#readout.textContent = "";
    this.#mark.classList.remove("on");
  }
}

function legendItem({ key, label, class: name }) {
  const sample = document.createElementNS(SVG, "svg");
  sample.setAttribute("viewBox", "0 0 28 8");
  sample.setAttribute("class", "sample");
  sample.setAttribute("aria-hidden", "true");
  const group = document.createElementNS(SVG, "g");
  group.setAttribute("class", `series ${name}`);
  group.dataset.key = key;
  const line = document.createElementNS(SVG, "path");
  line.setAttribute("d", "M0 4H28");
  group.append(line);
  sample.append(group);
  return make("li", {}, sample, label);
}

/** The drawn points [x, y] of a series, in the SVG's own units; a single point has a mark, but no line. */
function pointsOf(svg, key) {
  const within = (shape) => [...svg.querySelectorAll(`.series[data-key="${CSS.escape(key)}"] ${shape}`)];
  const points = within("polyline").flatMap((line) => {
    const numbers = line.getAttribute("points").match(/-?\d+(\.\d+)?/g) ?? [];
    return numbers.flatMap((x, i) => (i % 2 ? [] : [[Number(x), Number(numbers[i + 1])]]));
  });
  return points.length ? points : within("circle").map((dot) => [Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))]);
}

/** The x of the point nearest to `x`. */
const nearestTo = (points, x) => points.reduce((best, [at]) => (Math.abs(at - x) < Math.abs(best - x) ? at : best), Infinity);

/** How high the line through the points runs at `x`; undefined beside it. */
function heightAt(points, x) {
  const after = points.findIndex(([at]) => at >= x);
  if (after < 0) return undefined;
  const [x1, y1] = points[after];
  if (after === 0) return x1 - x < 1 ? y1 : undefined;
  const [x0, y0] = points[after - 1];
  return y0 + (y1 - y0) * ((x - x0) / (x1 - x0));
}

/** The value at a fraction of an axis that is `length` pixels long, with the digits that one pixel can tell. */
function valueAt({ min, max, log }, fraction, length) {
  const value = log ? min * (max / min) ** fraction : min + fraction * (max - min);
  const pixel = log ? (value * Math.log(max / min)) / length : (max - min) / length;
  const decimals = Math.min(9, Math.max(0, Math.ceil(-Math.log10(pixel))));
  return value.toFixed(decimals).replace("-", "\u2212");
}
