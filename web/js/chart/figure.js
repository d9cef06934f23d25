// One chart of the page: the core's drawing, and all that a person can do with it.

import * as core from "../core/client.js";
import { cursor, setCursor } from "../page/cursor.js";
import { make } from "../page/dom.js";
import { download } from "../page/download.js";
import { showLine } from "../form/program-tools.js";
import { lineAt } from "../page/program-lines.js";
import { choose, setting } from "../page/settings.js";
import { setStretch, stretch } from "../page/stretch.js";
import { chooseOver, overIn } from "./along.js";
import { drawingOf, layBelow, moveDrawing } from "./drawing.js";
import { fileOf } from "./export.js";
import { listen } from "./gestures.js";
import { Legend } from "./legend.js";
import { Marks, Readout, nearestInSpace } from "./readout.js";
import { tableOf } from "./table.js";
import { Samples } from "./samples.js";
import { Picker } from "./select.js";
import { drawnTogether } from "./together.js";
import { toolbar } from "./toolbar.js";
import { between, ends, fractionOf, nearest, ranged, scaled, scan, shifted, valueAt } from "./view.js";

/**
 * @import { Axis, Chart, ChartColumn, ChartEntry, ChartOptions, ChartUnits, ChartValues, Over } from "../../pkg/armill.js"
 * @import { Pointed } from "./gestures.js"
 * @import { Content } from "./readout.js"
 * @import { Range } from "./view.js"
 * @import { Beside } from "./together.js"
 */

/**
 * What draws a chart and has its values.
 *
 * @typedef {{
 *   chart(name: string, options: ChartOptions): Promise<Chart>,
 *   chartData(name: string, units: ChartValues): Promise<ChartColumn[]>,
 * }} Values
 */

const LOWEST_PX = 120; // of a chart that fills its place
const REACH_PX = 60; // a path in space is read off from no further away

export class Figure {
  fills = false; // whether it is as high as its place instead of as suits its width
  /** @type {Beside[]} */
  beside = []; // pinned results, { letter, name, chart(name, options) }, that are drawn with it
  #plot = make("div", { className: "drawing", tabIndex: 0, role: "slider", "aria-describedby": "chart-keys" });
  #table = make("div", { className: "chart-table", tabIndex: 0, role: "region", hidden: true });
  #caption = make("figcaption");
  #readout = new Readout();
  #marks = new Marks();
  #legend;
  #title;
  #tools;
  #link;
  #values;
  /** @type {any} */
  #svg = null;
  /** @type {Chart} */
  #chart = /** @type {any} */ (null); // as drawn last
  selecting = false; // whether a drag selects
  #picker;
  #samples;
  /** @type {{ x: Range | null, y: Range | null }} */
  #view = { x: null, y: null }; // ranges asked for; null: all
  /** @type {number | null} */
  #index = null; // the sample at the cursor
  /** @type {number | null} */
  #local = null; // that of a chart that is not over the run
  /** @type {number | null | undefined} */
  #before = undefined; // where the cursor was when the pointer came
  #waiting = false;
  /** @type {Promise<void> | null} */
  #drawing = null;
  #drawnAt = { width: 0, height: 0 };
  /** @type {{ width: number, height: number } | null} */
  #room = null; // to draw in, measured when it may have changed: to ask makes the browser lay out the page

  /**
   * `link(figure, range)` is called when the range of time changes, to take the other charts along.
   * `values` draws it and has its values: the shown result.
   * @param {Pick<ChartEntry, "name" | "title" | "figure" | "kind"> & { over?: Over[] }} entry
   * @param {(figure: Figure, range: Range | null) => void} link
   * @param {Values} [values]
   */
  constructor({ name, title, figure, kind, over = [] }, link, values = core) {
    this.#values = values;
    this.#samples = new Samples(() => this.#ask());
    this.#picker = new Picker(this, {
      axis: () => this.#axes.x,
      content: () => this.#content,
      samples: this.#samples,
      lengths: () => shownOf(values).column("arc_length_mm"),
      mark: () => this.#chart && this.#mark(),
    });
    this.axes = over; // what it can be drawn over
    this.name = name;
    this.kind = kind;
    this.overRun = kind !== "curve";
    this.plane = kind === "space";
    this.#link = link;
    this.#title = make("h3", {}, title);
    this.#legend = new Legend(title, () => this.#changed());
    const source = make("span", { className: "source" }, figure ? `Thesis fig. ${figure}` : "");
    this.#tools = toolbar(title, {
      zoomIn: () => this.scale([0.5, this.plane ? 0.5 : 1]),
      zoomOut: () => this.scale([2, this.plane ? 2 : 1]),
      reset: () => this.reset(),
      table: (on) => this.#tabulate(on),
      save: (format) => this.#save(format),
      log: (on) => this.#rescale(on),
      over: chooseOver,
      select: (on) => (this.selecting = on),
    });
    this.#plot.setAttribute("aria-label", title);
    this.#plot.setAttribute("aria-valuenow", "0");
    this.#table.setAttribute("aria-label", `Table: ${title}`);
    this.node = make(
      "figure",
      { className: "chart-figure", id: `chart-${name}` },
      make("header", {}, this.#title, source),
      make("div", { className: "chart-head" }, this.#legend.node, this.#tools.node),
      this.#plot,
      this.#table,
      make("div", { className: "below" }, this.#readout.node, this.#caption),
      this.#picker.node,
    );
    listen(this.#plot, this);
  }

  /**
   * Draws with what holds now; what is asked for meanwhile is drawn after that.
   * @returns {Promise<void>}
   */
  draw() {
    this.#waiting = true;
    this.#drawing ??= this.#drawAll().finally(() => (this.#drawing = null));
    return this.#drawing;
  }

  async #drawAll() {
    while (this.#waiting) {
      this.#waiting = false;
      const size = this.#size();
      if (size.width < 1) return;
      this.#drawnAt = size;
      if (!this.fills) this.#plot.style.setProperty("min-height", `${size.height}px`);
      const { x, y } = this.#view;
      /** @type {ChartOptions} */
      const options = {
        ...size,
        ...this.#request,
        ...(!this.plane && { scale: /** @type {ChartOptions["scale"]} */ (setting(`scale-${this.name}`)) }),
        hidden: this.#legend.hidden,
        ...(x && { x_range: x }),
        ...(y && { y_range: y }),
      };
      try {
        // Pictures of space magnify too differently to be drawn together.
        const pins = this.plane ? [] : this.beside;
        this.#show(await drawnTogether(this.name, options, this.#view, this.#values, pins));
      } catch (error) {
        if (!this.#waiting) throw error; // what was asked for meanwhile is drawn all the same
      }
    }
  }

  /** Forgets the values: those of another result, in other units, or not looked at. */
  forget() {
    this.#samples.forget();
    this.#index = null;
  }

  /** Whether it is drawn as large as it is, or not to be seen. */
  get fits() {
    this.#room = null;
    if (!this.node.checkVisibility()) return true;
    const { width, height } = this.#size();
    return width === this.#drawnAt.width && height === this.#drawnAt.height;
  }

  /** The room to draw in [px]: all that its place has, or as high as suits the width. */
  #size() {
    const { width, height: room } = (this.#room ??= roomIn(this.#plot.hidden ? this.#table : this.#plot));
    if (this.fills) return { width, height: Math.max(LOWEST_PX, room) };
    const height = this.plane ? Math.min(560, Math.max(230, width * 0.6)) : Math.min(300, Math.max(200, width * 0.38));
    return { width, height: Math.round(height) };
  }

  /** @param {{ own: Chart, others: { pin: Beside, chart: Chart }[] }} drawn */
  #show({ own: chart, others }) {
    this.#chart = chart;
    this.#svg = drawingOf(chart);
    for (const { pin, chart: other } of others) layBelow(this.#svg, drawingOf(other), pin.letter, chart.plot);
    this.#plot.replaceChildren(this.#svg, this.#marks.node);
    const { width, height } = chart;
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` }))
      this.#marks.node.setAttribute(name, String(value));
    this.#title.textContent = chart.title;
    this.#caption.textContent = chart.description;
    this.#legend.show(
      chart.series,
      others.map(({ pin: { letter, name } }) => ({
        letter,
        name,
      })),
    );
    this.#tools.show(chart, this.over, this.axes);
    this.#move();
    this.#fill();
    this.follow(cursor());
    if (stretch() && this.kind === "time") this.followStretch(true);
  }

  /** The axes as they are to be seen, which may be ahead of the drawing. */
  get #axes() {
    const { x, y } = this.#chart;
    return { x: ranged(x, this.#view.x ?? x.full), y: ranged(y, this.#view.y ?? y.full) };
  }

  /** What gestures, marks and tables read. */
  get #content() {
    return { chart: this.#chart, data: this.#data, hidden: this.#legend.hidden };
  }

  /** Moves the drawing to where the exact one will be. */
  #move() {
    moveDrawing(this.#svg, this.#chart, this.#axes);
    this.node.classList.toggle("zoomed", this.zoomed);
  }

  // -- Zoom --

  get zoomed() {
    return this.#view.x !== null || this.#view.y !== null;
  }

  /** The plot inside the drawing [px]. */
  get area() {
    return this.#chart?.plot ?? { left: 0, top: 0, width: 1, height: 1 };
  }

  /**
   * Shows these ranges; null is all, undefined as it is.
   * @param {Range | null} [x]
   * @param {Range | null} [y]
   * @param {boolean} [linked]
   */
  zoom(x = this.#view.x, y = this.#view.y, linked = false) {
    if (!this.#chart) return void (this.#view = { x, y });
    const moved = String(x) !== String(this.#view.x);
    this.#view = { x, y };
    this.#changed();
    if (moved && !linked && this.kind === "time") this.#link(this, x);
  }

  /**
   * Draws by decades or in even steps from now on; a range of values chosen on the other scale goes.
   * @param {any} log
   */
  #rescale(log) {
    choose(`scale-${this.name}`, log ? "log" : "linear");
    this.zoom(undefined, null);
  }

  /** What it is drawn over. */
  get over() {
    return overIn(this.axes);
  }

  /** What drawings and values are asked for with. */
  get #request() {
    return { ...units(), ...(this.axes.length && { over: this.over }) };
  }

  #changed() {
    if (!this.#chart) return;
    this.#move();
    this.#mark();
    this.draw().catch(() => {}); // a newer result, or a recovery, draws again
  }

  /**
   * @param {[number, number]} factors
   * @param {[number, number]} [place]
   */
  scale([fx, fy], place = this.#middle()) {
    if (!this.#chart) return;
    const { x, y } = this.#axes;
    this.zoom(fx === 1 ? undefined : scaled(x, place[0], fx), fy === 1 ? undefined : scaled(y, place[1], fy));
  }

  /**
   * @param {number} dx
   * @param {number} dy
   */
  shift(dx, dy) {
    if (!this.#chart) return;
    const { x, y } = this.#axes;
    this.zoom(dx && this.#view.x ? shifted(x, dx) : undefined, dy && this.#view.y ? shifted(y, dy) : undefined);
  }

  /** What a drag starts from. */
  grab() {
    return this.#chart && this.#axes;
  }

  /**
   * @param {{ x: Axis, y: Axis } | null} grip
   * @param {number} dx
   * @param {number} dy
   * @param {number} [factor]
   * @param {[number, number]} [place]
   */
  drag(grip, dx, dy, factor = 1, place = [0.5, 0.5]) {
    if (!grip) return;
    const { width, height } = this.area;
    /**
     * @param {Axis} axis
     * @param {number} by
     * @param {number} at
     */
    const move = (axis, by, at) => between(axis, at - at * factor - by * factor, at + (1 - at) * factor - by * factor);
    const upright = this.plane || (factor === 1 && this.#view.y);
    this.zoom(move(grip.x, dx / width, place[0]), upright ? move(grip.y, -dy / height, place[1]) : undefined);
  }

  /**
   * @param {[number, number]} a
   * @param {[number, number]} b
   */
  zoomBox([x1, y1], [x2, y2]) {
    const { left, top, width, height } = this.area;
    const { x, y } = this.#axes;
    const [from, to] = [x1, x2].map((value) => (value - left) / width).sort((a, b) => a - b);
    const [low, high] = [y1, y2].map((value) => 1 - (value - top) / height).sort((a, b) => a - b);
    /**
     * @param {number} start
     * @param {number} end
     */
    const whole = (start, end) => start < 1e-6 && end > 1 - 1e-6;
    this.zoom(whole(from, to) ? undefined : between(x, from, to), whole(low, high) ? undefined : between(y, low, high));
  }

  /** @param {[number, number][] | null} corners */
  box(corners) {
    this.#marks.box(corners);
  }

  reset() {
    this.zoom(null, null);
  }

  /**
   * Where keys and buttons zoom: at the cursor if it is seen.
   * @returns {[number, number]}
   */
  #middle() {
    const { x } = this.#axes;
    const at =
      this.plane || this.#index === null || !this.#data ? NaN : fractionOf(x, this.#data[0].values[this.#index]);
    return [at >= 0 && at <= 1 ? at : 0.5, 0.5];
  }

  // -- Cursor --

  /**
   * Where an event is, as fractions of the plot; null beside it unless `anyway`.
   * @param {Pointed} event
   * @param {boolean} [anyway]
   * @returns {[number, number] | null}
   */
  place({ clientX, clientY }, anyway = false) {
    const { left, top, width, height } = this.area;
    const box = this.#plot.getBoundingClientRect();
    const [across, up] = [(clientX - box.left - left) / width, 1 - (clientY - box.top - top) / height];
    /** @param {number} value */
    const inside = (value) => Math.min(1, Math.max(0, value));
    return anyway || (across === inside(across) && up === inside(up)) ? [inside(across), inside(up)] : null;
  }

  enter() {
    this.#before = undefined;
  }

  /** @param {[number, number] | null} place */
  async point(place) {
    if (this.#before === undefined) this.#before = this.overRun ? cursor() : this.#local;
    if (!this.#data && !(await this.#samples.fetch())) return;
    if (this.#before === undefined) return; // the pointer has left meanwhile
    if (!place) return;
    const axes = this.#axes;
    if (!this.plane) return this.#set(scan(this.#data[0].values, valueAt(axes.x, place[0])));
    const { index, distance } = nearestInSpace(this.#content, axes, place);
    if (distance <= REACH_PX) this.#set(index);
  }

  /** The pointer leaves: the cursor goes back to where it was. */
  leave() {
    if (this.#before === undefined) return;
    const before = this.#before;
    this.#before = undefined;
    if (this.overRun) setCursor(before, null);
    else this.#set(before);
  }

  /**
   * The cursor comes to a place and stays.
   * @param {[number, number] | null} place
   */
  async pin(place) {
    await this.point(place);
    this.#stay();
  }

  #stay() {
    this.#before = this.overRun ? cursor() : this.#local;
  }

  clear() {
    this.#before = undefined;
    this.#set(null);
    if (stretch()) setStretch(null, null, false);
  }

  /**
   * Moves by pixels, at least by one sample, or by a share of what is seen.
   * @param {number} pixels
   * @param {number} share
   */
  async step(pixels, share) {
    if (!this.#data && !(await this.#samples.fetch())) return;
    const { values } = this.#data[0];
    const { x } = this.#axes;
    const [from, to] = this.#ends(values, x);
    const now = this.#index ?? from;
    const by = pixels ? Math.max(1, (to - from) / this.area.width) * pixels : (to - from) * share;
    const rounded = Math.sign(by) * Math.max(1, Math.round(Math.abs(by)));
    this.#keep(this.#index === null && pixels > 0 ? from : Math.min(values.length - 1, Math.max(0, now + rounded)));
  }

  /** @param {boolean} last */
  async ends(last) {
    if (!this.#data && !(await this.#samples.fetch())) return;
    const { values } = this.#data[0];
    const { x } = this.#axes;
    const [from, to] = this.#ends(values, x);
    this.#keep(last ? to : from);
  }

  /**
   * The first and the last sample that are seen.
   * @param {ArrayLike<number>} values
   * @param {Axis} x
   */
  #ends(values, x) {
    return this.plane ? [0, values.length - 1] : ends(values, x);
  }

  /**
   * Sets the cursor to stay, and brings it into view.
   * @param {number} index
   */
  #keep(index) {
    this.#set(index);
    this.#stay();
    const { x } = this.#axes;
    const at = this.plane ? 0.5 : fractionOf(x, this.#data[0].values[index]);
    if (at < 0 || at > 1) this.shift(at < 0 ? at - 0.1 : at - 0.9, 0);
  }

  /** @param {number | null} index */
  #set(index) {
    if (this.overRun) {
      const time = index === null ? null : this.#times[index];
      this.#at(index);
      return setCursor(time, this);
    }
    this.#local = index;
    this.#at(index);
  }

  /**
   * Follows the page's cursor, at an instant of the run [s] or at none.
   * @param {number | null} time
   */
  async follow(time) {
    if (!this.#chart || this.node.closest("[hidden]")) return; // it follows when it is shown
    if ((this.overRun ? time : this.#local) === null) return this.#at(null);
    if (!this.#data && !(await this.#samples.fetch())) return;
    if (!this.overRun) this.#at(this.#local);
    else if (time === cursor()) this.#at(nearest(this.#times, Number(time)));
  }

  /** @param {number | null} index */
  #at(index) {
    this.#picker.extend(index);
    const beyond = index !== null && (!this.#data || index >= this.#data[0].values.length);
    this.#index = beyond ? null : index;
    this.#mark();
    const line = this.#line;
    const time = this.#times !== this.#data?.[0].values ? this.#times : null; // beside what it is drawn over
    this.#readout.show({ ...this.#content, time }, this.#index, line, () => this.go());
    this.#tell();
  }

  /** Tells the cursor to those who do not see it. */
  #tell() {
    const along = this.#data?.[0].values ?? [0, 1];
    const { x } = this.#axes;
    const [min, max] = this.plane ? [along[0], along[along.length - 1]] : [x.min, x.max];
    const now = this.#index === null ? min : Math.min(max, Math.max(min, along[this.#index]));
    const text = this.#readout.text || "no sample chosen";
    for (const [name, value] of Object.entries({ valuemin: min, valuemax: max, valuenow: now, valuetext: text })) {
      this.#plot.setAttribute(`aria-${name}`, String(value));
    }
  }

  get #line() {
    return this.overRun && this.#index !== null ? lineAt(this.#times[this.#index]) : undefined;
  }

  /** Leads to the line of the program that runs at the cursor. */
  go() {
    if (this.#line) showLine(this.#line);
  }

  #mark() {
    this.#marks.show(this.#content, this.#axes, this.#data ? this.#index : null);
    this.#marks.stretch(this.#content, this.#axes, this.#picker.samples());
  }

  /** @returns {ChartColumn[]} */
  get #data() {
    return /** @type {any} */ (this.#samples.data); // those who need them wait for them
  }

  /** @returns {Float64Array} */
  get #times() {
    return /** @type {any} */ (this.#samples.times);
  }

  /**
   * The values, and the time of each sample.
   * @returns {Promise<[ChartColumn[], Float64Array]>}
   */
  async #ask() {
    const timed = !this.axes.length || this.over === "time";
    const times = timed ? null : shownOf(this.#values).column("time_s");
    const data = await this.#values.chartData(this.name, this.#request);
    return [data, (await times) ?? data[0].values];
  }

  // -- Selection of a stretch, see select.js --

  /**
   * @param {[number, number] | null} a
   * @param {[number, number] | null} b
   * @param {boolean} complete
   */
  select(a, b, complete) {
    if (a && b) return this.#picker.drag(a[0], b[0], complete);
  }

  markEnd() {
    if (this.kind === "time") return this.#picker.markEnd(this.#index);
  }

  /** @param {boolean} complete */
  followStretch(complete) {
    return this.#picker.follow(complete);
  }

  // -- Table and files --

  /** @param {boolean} on */
  #tabulate(on) {
    this.#table.style.setProperty("height", `${this.#plot.clientHeight || this.#size().height}px`);
    this.#plot.hidden = on;
    this.#table.hidden = !on;
    this.#room = null; // a table has a scroll bar
    this.#fill();
  }

  async #fill() {
    if (this.#table.hidden || (!this.#data && !(await this.#samples.fetch()))) return;
    this.#table.replaceChildren(tableOf(this.#content, this.#axes));
  }

  /** @param {string} format */
  async #save(format) {
    if (!this.#chart || (format === "csv" && !this.#data && !(await this.#samples.fetch()))) return;
    const { type, content } = await this.#file(format);
    download(`armill-${this.name}.${format}`, type, content);
  }

  /** The drawing as an SVG file and all its values as CSV. */
  async texts() {
    if (!this.#data) await this.#samples.fetch();
    const [svg, csv] = await Promise.all(["svg", "csv"].map((format) => this.#file(format)));
    return { svg: svg.content, csv: csv.content };
  }

  /** @param {string} format */
  #file(format) {
    return fileOf(format, { ...this.#content, times: this.#times }, this.#svg, this.#legend.node);
  }
}

/**
 * Charts over the run are drawn by the shown result alone, which has its columns too.
 * @param {Values} values
 */
const shownOf = (values) => /** @type {typeof core} */ (values);

/** @param {HTMLElement} element */
const roomIn = ({ clientWidth, clientHeight }) => ({ width: clientWidth, height: clientHeight });

/** @returns {ChartUnits} */
const units = () => /** @type {any} */ ({ length: setting("length"), force: setting("force") });
