// A chart's cursor: the sample that is read off. Charts over the run share the page's cursor, an instant; any other
// chart has one of its own.

import { showLine } from "../form/program-tools.js";
import { cursor, setCursor } from "../page/cursor.js";
import { lineAt } from "../page/program-lines.js";
import { Readout, nearestInSpace } from "./readout.js";
import { ends, fractionOf, nearest, scan, valueAt } from "./view.js";

/**
 * @import { ChartColumn } from "../../pkg/armill.js"
 * @import { Content } from "./readout.js"
 * @import { Samples } from "./samples.js"
 * @import { Zoom } from "./zoom.js"
 */

/**
 * The chart it is in: `plot` is the element whose value is the cursor's place, `overRun` whether its samples are
 * instants of the run, `plane` whether it is a picture of space. `moved(index)` is called after every move, with the
 * sample that was asked for.
 *
 * @typedef {{
 *   plot: HTMLElement,
 *   overRun: boolean,
 *   plane: boolean,
 *   samples: Samples,
 *   zoom: Zoom,
 *   content(): Content,
 *   moved(index: number | null): void,
 * }} Of
 */

const REACH_PX = 60; // a path in space is read off from no further away

export class Cursor {
  #of;
  #readout = new Readout();
  /** @type {number | null} */
  #index = null; // the sample at the cursor
  /** @type {number | null} */
  #local = null; // that of a chart that is not over the run
  /** @type {number | null | undefined} */
  #before = undefined; // where the cursor was when the pointer came

  /** @param {Of} of */
  constructor(of) {
    this.#of = of;
  }

  /** The line of text about the sample, to be put below the chart. */
  get node() {
    return this.#readout.node;
  }

  /** The sample at the cursor, or null. */
  get index() {
    return this.#index;
  }

  /** The fraction of the plot where it is; NaN without one, and in a picture of space. */
  get across() {
    if (this.#of.plane || this.#index === null || !this.#data) return NaN;
    return fractionOf(this.#of.zoom.axes.x, this.#data[0].values[this.#index]);
  }

  /** Forgets the sample: the values are gone. */
  forget() {
    this.#index = null;
  }

  // -- By the pointer, which it follows until that leaves --

  enter() {
    this.#before = undefined;
  }

  /** @param {[number, number] | null} place */
  async point(place) {
    if (this.#before === undefined) this.#before = this.#now;
    if (!this.#data && !(await this.#of.samples.fetch())) return;
    if (this.#before === undefined) return; // the pointer has left meanwhile
    if (!place) return;
    const { axes } = this.#of.zoom;
    if (!this.#of.plane) return this.#set(scan(this.#data[0].values, valueAt(axes.x, place[0])));
    const { index, distance } = nearestInSpace(this.#of.content(), axes, place);
    if (distance <= REACH_PX) this.#set(index);
  }

  /** The pointer leaves: the cursor goes back to where it was. */
  leave() {
    if (this.#before === undefined) return;
    const before = this.#before;
    this.#before = undefined;
    if (this.#of.overRun) setCursor(before, null);
    else this.#set(before);
  }

  /**
   * The cursor comes to a place and stays.
   * @param {[number, number] | null} place
   */
  async pin(place) {
    await this.point(place);
    this.#before = this.#now;
  }

  // -- By keys --

  clear() {
    this.#before = undefined;
    this.#set(null);
  }

  /**
   * Moves by pixels, at least by one sample, or by a share of what is seen.
   * @param {number} pixels
   * @param {number} share
   */
  async step(pixels, share) {
    if (!this.#data && !(await this.#of.samples.fetch())) return;
    const { values } = this.#data[0];
    const [from, to] = this.#ends(values);
    const now = this.#index ?? from;
    const by = pixels ? Math.max(1, (to - from) / this.#of.zoom.area.width) * pixels : (to - from) * share;
    const rounded = Math.sign(by) * Math.max(1, Math.round(Math.abs(by)));
    this.#keep(this.#index === null && pixels > 0 ? from : Math.min(values.length - 1, Math.max(0, now + rounded)));
  }

  /** @param {boolean} last */
  async ends(last) {
    if (!this.#data && !(await this.#of.samples.fetch())) return;
    const [from, to] = this.#ends(this.#data[0].values);
    this.#keep(last ? to : from);
  }

  /** Leads to the line of the program that runs at the cursor. */
  go() {
    const line = this.#line;
    if (line) showLine(line);
  }

  /**
   * Follows the page's cursor, at an instant of the run [s] or at none.
   * @param {number | null} time
   */
  async follow(time) {
    if ((this.#of.overRun ? time : this.#local) === null) return this.#at(null);
    if (!this.#data && !(await this.#of.samples.fetch())) return;
    if (!this.#of.overRun) this.#at(this.#local);
    else if (time === cursor()) this.#at(nearest(this.#times, Number(time)));
  }

  /** Where it is: an instant of the run [s], or a sample. */
  get #now() {
    return this.#of.overRun ? cursor() : this.#local;
  }

  /**
   * The first and the last sample that are seen.
   * @param {ArrayLike<number>} values
   */
  #ends(values) {
    return this.#of.plane ? [0, values.length - 1] : ends(values, this.#of.zoom.axes.x);
  }

  /**
   * Comes to a sample to stay, and brings it into view.
   * @param {number} index
   */
  #keep(index) {
    this.#set(index);
    this.#before = this.#now;
    const at = this.across;
    if (at < 0 || at > 1) this.#of.zoom.shift(at < 0 ? at - 0.1 : at - 0.9, 0);
  }

  /** @param {number | null} index */
  #set(index) {
    if (!this.#of.overRun) this.#local = index;
    this.#at(index);
    if (this.#of.overRun) setCursor(index === null ? null : this.#times[index], this);
  }

  /** @param {number | null} index */
  #at(index) {
    const beyond = index !== null && (!this.#data || index >= this.#data[0].values.length);
    this.#index = beyond ? null : index;
    this.#of.moved(index);
    const time = this.#times !== this.#data?.[0].values ? this.#times : null; // beside what it is drawn over
    this.#readout.show({ ...this.#of.content(), time }, this.#index, this.#line, () => this.go());
    this.#tell();
  }

  /** Tells the cursor to those who do not see it. */
  #tell() {
    const along = this.#data?.[0].values ?? [0, 1];
    const { x } = this.#of.zoom.axes;
    const [min, max] = this.#of.plane ? [along[0], along[along.length - 1]] : [x.min, x.max];
    const now = this.#index === null ? min : Math.min(max, Math.max(min, along[this.#index]));
    const text = this.#readout.text || "no sample chosen";
    for (const [name, value] of Object.entries({ valuemin: min, valuemax: max, valuenow: now, valuetext: text })) {
      this.#of.plot.setAttribute(`aria-${name}`, String(value));
    }
  }

  get #line() {
    return this.#of.overRun && this.#index !== null ? lineAt(this.#times[this.#index]) : undefined;
  }

  /** @returns {ChartColumn[]} */
  get #data() {
    return /** @type {any} */ (this.#of.samples.data); // those who need them wait for them
  }

  /** @returns {Float64Array} */
  get #times() {
    return /** @type {any} */ (this.#of.samples.times);
  }
}
