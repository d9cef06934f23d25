// The run in space: paths with their deviation magnified, the part or its stock, the arm at the cursor.

import * as core from "../core/client.js";
import { cursor, onCursor, setCursor } from "../page/cursor.js";
import { onSetting } from "../page/settings.js";
import { inLength, lengthText, lengthUnit } from "../page/units.js";
import { armPoints } from "./arm.js";
import { around, extent, isElsewhere } from "./boxes.js";
import { Camera, VIEWS, length, project } from "./camera.js";
import { steer } from "./controls.js";
import { Labels, axisLabels } from "./labels.js";
import { paced } from "./pace.js";
import { furnish } from "./panel.js";
import { Part } from "./part.js";
import { Paths } from "./paths.js";
import { pictureOn } from "./picture.js";
import { Player } from "./play.js";
import { Pose } from "./pose.js";
import { Readout, momentText } from "./readout.js";
import { Section } from "./section.js";
import { Stock } from "./stock.js";
import { tonesOf } from "./tones.js";

/**
 * @import { StockSolid, Summary } from "../../pkg/armill.js"
 * @import { Frames } from "./arm.js"
 * @import { Named, Rectangle } from "./labels.js"
 * @import { Picture } from "./picture.js"
 */

/** @typedef {{ side: "before" | "after", row: number }} Worst the worst place that is shown */

/** @typedef {[x: number, y: number, pressed: boolean]} Pointed where the pointer is [px] */

const MOST = 50_000; // points of a path that are drawn
const REACH = 14; // how near a path a pointer must be [px]
const STREAM_MS = 200; // while results stream in, the picture rests at least so long
const QUIET_MS = 300; // a result that has stood this long has its part simulated
const FITTED = 400; // points of the path that a view is fitted to
/** @type {Record<string, string>} */
const VIEW_KEYS = { 1: "top", 2: "front", 3: "side", 4: "iso", 5: "tool", f: "fit", a: "all", 0: "fit" };

/**
 * The picture in `node`; `show(summary)` takes over a new result.
 * @param {HTMLElement} node
 */
export function makeScene(node) {
  const scene = new Scene(node);
  return { show: (/** @type {Summary} */ summary) => scene.show(summary) };
}

class Scene {
  #node;
  #panel;
  #labels;
  #player = new Player();
  #readout = new Readout();
  #section = new Section();
  #stock = new Stock();
  #part = new Part((first) => (first && !this.#steered ? this.#look(this.#fitted) : this.#redraw()));
  #camera = new Camera();
  /** @type {Picture | null | undefined} */
  #picture; // undefined until it is first seen, null while there are no graphics
  /** @type {Summary} */
  #summary; // of the newest result
  /** @type {Summary | null} */
  #loaded; // of the one that is drawn
  /** @type {Paths} */
  #paths;
  #pose = new Pose(); // of the arm at the cursor
  /** @type {Named[]} */
  #axes = [];
  /** @type {Record<string, boolean>} */
  #shown = { desired: true, actual: true, after: false, compensated: true, tube: false, arm: true, solid: true };
  /** @type {{ factor: number | null, tube: boolean | null }} */
  #chosen = { factor: null, tube: null }; // what was chosen by hand
  #fitted = "fit";
  #steered = false; // whether the camera was moved by hand since it showed all
  #due = false;
  #room = [0, 0]; // of the picture [px]
  #near = true; // whether the picture is on the screen or about to be
  /** @type {Pointed | null} */
  #pointed = null; // where the pointer is, until it has been looked up
  /** @type {number | undefined} */
  #waiting; // timer for the part
  #catchUp = paced(() => this.#appear().then(painted), STREAM_MS);

  /** @param {HTMLElement} node */
  constructor(node) {
    this.#node = node;
    this.#panel = furnish(node, {
      view: (name) => this.#look(name),
      shown: (name, on) => this.#switch(name, on),
      factor: (value) => ((this.#chosen.factor = value), this.#redraw()),
      worst: () => this.#worst && this.#goTo(this.#worst.row),
    });
    const { canvas, stage, labels } = this.#panel;
    this.#labels = new Labels(labels);
    this.#panel.corner(this.#part.node);
    this.#panel.below(this.#player.node, this.#readout.node);
    this.#panel.after(this.#readout.text);
    // On the page it has a place of its own, in the view of the result.
    const place = document.getElementById("section");
    if (place) place.append(this.#section.node);
    else this.#panel.after(this.#section.node);
    steer(canvas, this.#camera, {
      move: () => ((this.#steered = true), this.#redraw()),
      point: (x, y, pressed) => this.#pointSoon(x, y, pressed),
      key: (key) => this.#key(key),
    });
    this.#camera.look(VIEWS.iso);
    this.#observe(canvas, stage);
    onCursor(() => this.#follow());
    onSetting(() => requestAnimationFrame(() => this.#recolour())); // a theme that has just been chosen is applied by then
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#recolour());
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLElement} stage
   */
  #observe(canvas, stage) {
    new ResizeObserver(() => {
      this.#room = [stage.clientWidth, stage.clientHeight];
      this.#appear();
    }).observe(stage);
    new IntersectionObserver(
      (entries) => {
        this.#near = entries[entries.length - 1].isIntersecting;
        this.#appear();
      },
      { rootMargin: "100%" },
    ).observe(stage);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.#drawWith(null);
      this.#panel.say(
        "The graphics were lost; waiting for the browser to restore them. The charts show the same paths.",
      );
    });
    canvas.addEventListener("webglcontextrestored", () => (this.#begin(), this.#appear()));
  }

  /** @param {Summary} summary */
  show(summary) {
    this.#summary = summary;
    this.#player.duration = summary.duration_s;
    clearTimeout(this.#waiting);
    this.#part.offer(summary);
    this.#section.offer(summary);
    this.#panel.menu.offerPart(this.#part.offered);
    // Around the legs of a program a tube would hide what it is to show.
    this.#shown.tube = this.#chosen.tube ?? !summary.program;
    this.#panel.menu.set("tube", this.#shown.tube);
    this.#catchUp();
  }

  /** Starts drawing, or loads the newest paths, once the picture can be seen. */
  async #appear() {
    const { canvas } = this.#panel;
    const [width, height] = this.#room;
    if (!width || !this.#summary) return;
    const sharp = Math.min(2, devicePixelRatio || 1);
    if (canvas.width !== Math.round(width * sharp) || canvas.height !== Math.round(height * sharp)) {
      [canvas.width, canvas.height] = [Math.round(width * sharp), Math.round(height * sharp)];
      [this.#camera.width, this.#camera.height] = [width, height];
      if (this.#paths && !this.#steered) this.#look(this.#fitted);
      if (this.#picture && this.#paths) this.#draw(); // a canvas is cleared by its new size
    }
    if (!this.#near) return;
    if (this.#picture === undefined) this.#begin();
    this.#redraw();
    if (this.#picture && this.#loaded !== this.#summary) await this.#load();
  }

  #begin() {
    this.#drawWith(pictureOn(this.#panel.canvas));
    this.#panel.say(
      this.#picture
        ? ""
        : "This browser does not offer WebGL 2, so the paths are not drawn in space here. The charts show them.",
    );
  }

  /**
   * Draws with another picture, or with none.
   * @param {Picture | null} picture
   */
  #drawWith(picture) {
    this.#picture = picture;
    this.#part.drawWith(picture?.gl ?? null);
    this.#stock.drawWith(picture?.gl ?? null);
    if (picture) this.#recolour();
  }

  /**
   * @param {string} name
   * @param {boolean} on
   */
  #switch(name, on) {
    this.#shown[name] = on;
    if (name === "tube") this.#chosen.tube = on;
    if (name === "solid") {
      this.#panel.stage.classList.toggle("bare", !on); // without the part its scale has nothing to say
      this.#simulate(0);
    }
    this.#redraw();
  }

  /**
   * Has the stock drawn and the part simulated once the result has stood for a while.
   * @param {number} quiet [ms]
   */
  #simulate(quiet) {
    clearTimeout(this.#waiting);
    if (!this.#part.offered) return;
    const summary = this.#loaded;
    const isCurrent = () => summary === this.#summary;
    this.#waiting = setTimeout(async () => {
      try {
        const solid = await core.stockSolid();
        if (!isCurrent()) return;
        this.#enclose(solid);
        if (this.#shown.solid && this.#picture) await this.#part.load(isCurrent);
        if (isCurrent()) await this.#section.begin();
      } catch {
        // Replaced by a newer result or a recovery, which loads its own.
      }
    }, quiet);
  }

  /**
   * Draws the stock, or without one a box, around the path.
   * @param {StockSolid | undefined} solid
   */
  #enclose(solid) {
    const first = this.#stock.given !== Boolean(solid);
    this.#stock.take(solid, this.#paths.boxIn(this.#pose.frames.workpiece));
    this.#upload();
    if (first && !this.#steered) this.#look(this.#fitted);
  }

  async #load() {
    const summary = (this.#loaded = this.#summary);
    try {
      const [track] = await Promise.all([core.track(MOST), this.#pose.load(this.#sample())]);
      if (summary !== this.#loaded) return;
      const before = this.#paths?.box;
      this.#paths = new Paths(track);
      // Until its own stock is there, the one before is as good a guess as any.
      if (summary.surface && this.#stock.given) this.#upload();
      else this.#enclose(undefined);
      if (!before || isElsewhere(before, this.#paths.box)) this.#look(before ? this.#fitted : "iso");
      this.#describe();
      if (summary === this.#summary) this.#simulate(QUIET_MS);
    } catch {
      if (this.#loaded === summary) this.#loaded = null; // replaced by a newer result or a recovery: the next one loads again
    }
  }

  #upload() {
    if (!this.#picture) return;
    const { base, joints, workpiece } = this.#pose.frames;
    const box = around(this.#paths.box, [base.origin, ...joints.map((joint) => joint.origin)]);
    const part = around(this.#paths.cutBox, this.#stock.corners(workpiece));
    this.#axes = [
      { name: "base", frame: base, long: extent(box) / 9 },
      { name: "workpiece", frame: workpiece, long: extent(part) / 7 },
    ];
    const spacing = this.#picture.take({
      paths: this.#paths,
      stock: this.#stock,
      frame: workpiece,
      axes: this.#axes,
      box,
      unit: 1 / inLength(1),
    });
    this.#panel.floor.textContent = `Grid ${spacing} ${lengthUnit()}`;
    this.#redraw();
  }

  #sample() {
    const { samples, duration_s } = this.#loaded ?? this.#summary;
    return Math.round((Math.min(duration_s, cursor() ?? 0) / (duration_s || 1)) * (samples - 1));
  }

  /**
   * When a row of the paths is [s].
   * @param {number} row
   */
  #timeOf(row) {
    const { samples, duration_s } = this.#loaded ?? this.#summary;
    return (this.#paths.sample(row) / (samples - 1)) * duration_s;
  }

  /** @param {number} row */
  #goTo(row) {
    setCursor(this.#timeOf(row), "scene");
  }

  /** The cursor has moved. */
  #follow() {
    if (!this.#paths || !this.#picture || !this.#room[0]) return;
    this.#redraw();
    this.#section.follow();
    this.#pose.follow(
      () => this.#sample(),
      () => this.#redraw(),
    );
  }

  /**
   * Once a picture is often enough, however often the pointer moves.
   * @param {Pointed} where
   */
  #pointSoon(...where) {
    if (!this.#pointed)
      requestAnimationFrame(() => {
        if (this.#pointed) this.#point(...this.#pointed);
        this.#pointed = null;
      });
    this.#pointed = where;
  }

  /** @param {Pointed} where */
  #point(...[x, y, pressed]) {
    if (!this.#paths || this.#player.playing) return;
    const { width, height } = this.#camera;
    const view = { width, height, factor: this.#factor(), shown: this.#shown, reach: pressed ? 2 * REACH : REACH };
    const row = this.#paths.pick(this.#camera.matrix(), [x, y], view);
    if (row >= 0) this.#goTo(row);
  }

  /** @param {string} key */
  #key(key) {
    if (key === " ") this.#player.toggle();
    else if (VIEW_KEYS[key.toLowerCase()]) this.#look(VIEW_KEYS[key.toLowerCase()]);
    else return false;
    return true;
  }

  /**
   * Looks from a side, or (`fit`, `all`) shows the part or the arm too from where one looks.
   * @param {string} name
   */
  #look(name) {
    if (!this.#paths) return;
    const { tcp, workpiece } = this.#pose.frames;
    if (name === "fit" || name === "all") this.#fitted = name;
    else if (name === "tool") this.#camera.lookFrom(tcp.z.map((v) => -v));
    else this.#camera.look(VIEWS[name]);
    if (name === "top" || name === "tool") this.#fitted = "fit";
    this.#steered = false;
    const solid = this.#shown.solid ? [...this.#part.corners(workpiece), ...this.#stock.corners(workpiece)] : [];
    const arm = this.#fitted === "all" ? armPoints(this.#pose.frames) : [];
    const path = this.#paths.cutRows(FITTED).map((row) => this.#paths.tip(row, "before", this.#factor()));
    this.#camera.fit([...path, ...this.#paths.cutPoints(FITTED), ...solid, ...arm], this.#panel.edges());
    this.#redraw();
  }

  #factor() {
    return this.#chosen.factor ?? this.#paths?.factor() ?? 1;
  }

  #recolour() {
    this.#picture?.recolour(tonesOf(this.#node));
    this.#part.recolour(tonesOf(this.#node).dark);
    if (!this.#paths) return;
    this.#upload();
    this.#describe();
  }

  #redraw() {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      if (this.#picture && this.#paths && this.#room[0] && this.#near) this.#draw();
    });
  }

  /** The worst place of what is shown, or none; before compensation first. */
  get #worst() {
    const { before, after } = this.#paths.worst;
    if (this.#shown.actual) return { side: /** @type {const} */ ("before"), row: before };
    return this.#shown.after ? { side: /** @type {const} */ ("after"), row: after } : undefined;
  }

  #draw() {
    const [paths, camera, factor, worst] = [this.#paths, this.#camera, this.#factor(), this.#worst];
    const taken = this.#panel.taken();
    const row = paths.rowOf(this.#sample());
    const summary = this.#loaded ?? this.#summary;
    // Half as wide as passes are apart, so that it leaves them in sight.
    const radius = this.#shown.tube ? Math.min(summary.tolerance_mm * factor, paths.spacing / 4) : 0;
    this.#picture?.draw({
      camera,
      shown: this.#shown,
      pose: this.#pose,
      part: this.#part,
      stock: this.#stock,
      factor,
      radius,
      marks: { row, side: worst?.side ?? null, worst: worst?.row ?? 0 },
    });
    this.#section.magnify(factor);
    this.#write(worst, factor, taken);
    this.#readout.at(this.#timeOf(row), paths, row);
    this.#panel.beyond(this.#pose);
    this.#report(row, factor, radius, worst);
  }

  /**
   * The labels over the picture.
   * @param {Worst | undefined} worst
   * @param {number} factor
   * @param {Rectangle[]} taken
   */
  #write(worst, factor, taken) {
    const { worst: button } = this.#panel;
    const matrix = this.#camera.matrix();
    button.hidden = !worst;
    let first;
    if (worst) {
      const error = length(this.#paths[worst.side](worst.row));
      const words = `${lengthText(error)} ${lengthUnit()}, ${momentText(this.#timeOf(worst.row))}`;
      if (button.textContent !== words) button.textContent = words;
      first = { node: button, point: this.#paths.tip(worst.row, worst.side, factor) };
    }
    /** @param {number[]} point */
    const place = (point) => project(matrix, point, this.#camera.width, this.#camera.height);
    if (first) this.#node.dataset.worstAt = place(first.point).slice(0, 2).join(" ");
    this.#labels.write(axisLabels(this.#axes), first, place, this.#room, taken);
  }

  /**
   * What is drawn, for those who cannot read pixels.
   * @param {number} row
   * @param {number} factor
   * @param {number} radius
   * @param {Worst | undefined} worst
   */
  #report(row, factor, radius, worst) {
    const { azimuth, elevation, distance, target } = this.#camera;
    /** @param {number} angle */
    const degrees = (angle) => ((angle * 180) / Math.PI).toFixed(2);
    Object.assign(this.#node.dataset, {
      azimuth: degrees(azimuth),
      elevation: degrees(elevation),
      distance: distance.toFixed(2),
      target: target.map((v) => v.toFixed(2)).join(" "),
      sample: String(this.#sample()),
      factor: String(factor),
      points: String(this.#paths.count),
      part: this.#part.drawn && this.#shown.solid ? this.#part.side : "none",
      stock: String(this.#stock.given),
      triangles: String(this.#part.triangles),
      tip: this.#pose.frames.tcp.origin.map((v) => v.toFixed(6)).join(" "),
      beyond: this.#pose.beyond.join(" "),
      tube: radius.toFixed(3),
      worst: worst ? String(this.#paths.sample(worst.row)) : "none",
    });
  }

  /** What a new result, or another unit, changes around the picture. */
  #describe() {
    const { largest } = this.#paths;
    const summary = this.#loaded ?? this.#summary;
    this.#panel.factors(this.#paths.factor(), this.#chosen.factor);
    this.#panel.legend.show(inLength(largest), inLength(summary.tolerance_mm), lengthUnit());
    this.#readout.describe(summary, largest, this.#factor());
  }
}

/** Resolves when what was drawn is on the screen. */
const painted = () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
