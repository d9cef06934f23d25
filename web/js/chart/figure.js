// One chart of the page: the core's drawing, its legend, tools and table, and what is read off it.

import * as core from "../core/client.js";
import { cursor } from "../page/cursor.js";
import { make } from "../page/dom.js";
import { download } from "../page/download.js";
import { choose, setting } from "../page/settings.js";
import { stretch } from "../page/stretch.js";
import { units } from "../page/units.js";
import { chooseOver, overIn } from "./along.js";
import { Cursor } from "./cursor.js";
import { drawingOf, layBelow, moveDrawing } from "./drawing.js";
import { fileOf } from "./export.js";
import { listen } from "./gestures.js";
import { Legend } from "./legend.js";
import { Marks } from "./readout.js";
import { tableOf } from "./table.js";
import { Samples } from "./samples.js";
import { Picker } from "./select.js";
import { drawnTogether } from "./together.js";
import { toolbar } from "./toolbar.js";
import { Zoom } from "./zoom.js";

/**
 * @import { Chart, ChartColumn, ChartEntry, ChartOptions, ChartUnits, ChartValues, Over } from "../../pkg/armill.js"
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

export class Figure {
  fills = false; // whether it is as high as its place instead of as suits its width
  /** @type {Beside[]} */
  beside = []; // pinned results, { letter, name, chart(name, options) }, that are drawn with it
  selecting = false; // whether a drag selects
  marks = new Marks();
  #plot = make("div", { className: "drawing", tabIndex: 0, role: "slider", "aria-describedby": "chart-keys" });
  #table = make("div", { className: "chart-table", tabIndex: 0, role: "region", hidden: true });
  #caption = make("figcaption");
  #legend;
  #title;
  #tools;
  #values;
  #samples;
  /** @type {any} */
  #svg = null;
  /** @type {Chart} */
  #chart = /** @type {any} */ (null); // as drawn last
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
    this.axes = over; // what it can be drawn over
    this.name = name;
    this.kind = kind;
    this.overRun = kind !== "curve";
    this.plane = kind === "space";
    this.zoom = new Zoom({
      plane: this.plane,
      chart: () => this.#chart,
      at: () => this.cursor.across,
      changed: () => this.#changed(),
      link: (range) => kind === "time" && link(this, range),
    });
    this.cursor = new Cursor({
      plot: this.#plot,
      overRun: this.overRun,
      plane: this.plane,
      samples: this.#samples,
      zoom: this.zoom,
      content: () => this.#content,
      moved: (index) => (this.picker.extend(index), this.#mark()),
    });
    this.picker = new Picker(this, {
      axis: () => this.zoom.axes.x,
      content: () => this.#content,
      samples: this.#samples,
      lengths: () => shownOf(values).column("arc_length_mm"),
      mark: () => this.#chart && this.#mark(),
    });
    this.#title = make("h3", {}, title);
    this.#legend = new Legend(title, () => this.#changed());
    const source = make("span", { className: "source" }, figure ? `Thesis fig. ${figure}` : "");
    this.#tools = toolbar(title, {
      zoomIn: () => this.zoom.in(),
      zoomOut: () => this.zoom.out(),
      reset: () => this.zoom.reset(),
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
      make("div", { className: "below" }, this.cursor.node, this.#caption),
      this.picker.node,
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
      const { x, y } = this.zoom.ranges;
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
        this.#show(await drawnTogether(this.name, options, this.zoom.ranges, this.#values, pins));
      } catch (error) {
        if (!this.#waiting) throw error; // what was asked for meanwhile is drawn all the same
      }
    }
  }

  /** Whether it shows a drawing, of whichever result. */
  get isDrawn() {
    return Boolean(this.#chart);
  }

  /** Forgets the values: those of another result, in other units, or not looked at. */
  forget() {
    this.#samples.forget();
    this.cursor.forget();
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
    this.#plot.replaceChildren(this.#svg, this.marks.node);
    const { width, height } = chart;
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` }))
      this.marks.node.setAttribute(name, String(value));
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

  /** What gestures, marks and tables read. */
  get #content() {
    return { chart: this.#chart, data: this.#data, hidden: this.#legend.hidden };
  }

  /** Moves the drawing to where the exact one will be. */
  #move() {
    moveDrawing(this.#svg, this.#chart, this.zoom.axes);
    this.node.classList.toggle("zoomed", this.zoom.zoomed);
  }

  /**
   * Draws by decades or in even steps from now on; a range of values chosen on the other scale goes.
   * @param {any} log
   */
  #rescale(log) {
    choose(`scale-${this.name}`, log ? "log" : "linear");
    this.zoom.show(undefined, null);
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
   * Follows the page's cursor, at an instant of the run [s] or at none.
   * @param {number | null} time
   */
  follow(time) {
    if (!this.#chart || this.node.closest("[hidden]")) return; // it follows when it is shown
    return this.cursor.follow(time);
  }

  /**
   * Follows the stretch that is selected.
   * @param {boolean} complete
   */
  followStretch(complete) {
    return this.picker.follow(complete);
  }

  #mark() {
    this.marks.show(this.#content, this.zoom.axes, this.#data ? this.cursor.index : null);
    this.marks.stretch(this.#content, this.zoom.axes, this.picker.samples());
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
    this.#table.replaceChildren(tableOf(this.#content, this.zoom.axes));
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
