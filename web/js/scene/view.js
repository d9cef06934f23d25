// The run in space: paths with their deviation magnified, the part or its stock, the arm at the cursor.

import * as core from "../core/client.js";
import { cursor, onCursor, setCursor } from "../page/cursor.js";
import { onSetting } from "../page/settings.js";
import { inLength, lengthText, lengthUnit } from "../page/units.js";
import { around, extent, isElsewhere } from "./boxes.js";
import { length, project } from "./camera.js";
import { steer } from "./controls.js";
import { factsOf } from "./facts.js";
import { Labels, axisLabels } from "./labels.js";
import { eachFrame, paced } from "./pace.js";
import { furnish } from "./panel.js";
import { Paths } from "./paths.js";
import { pictureOn } from "./picture.js";
import { Player } from "./play.js";
import { Pose } from "./pose.js";
import { Readout, momentText } from "./readout.js";
import { Solids } from "./solids.js";
import { sharpen, watch } from "./stage.js";
import { tonesOf } from "./tones.js";
import { Viewpoint, viewOf } from "./viewpoint.js";

/**
 * @import { StockSolid, Summary } from "../../pkg/armill.js"
 * @import { Named, Rectangle } from "./labels.js"
 * @import { Picture } from "./picture.js"
 * @import { Worst } from "./paths.js"
 */

const MOST = 50_000; // points of a path that are drawn
const REACH = 14; // how near a path a pointer must be [px]
const STREAM_MS = 200; // while results stream in, the picture rests at least so long
const QUIET_MS = 300; // a result that has stood this long has its part simulated
const FITTED = 400; // points of the path that a view is fitted to

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
  #solids = new Solids((first) => (first ? this.#refit() : this.#redraw()));
  #viewpoint = new Viewpoint();
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
  /** @type {[number, number]} */
  #room = [0, 0]; // of the picture [px]
  #near = true; // whether the picture is on the screen or about to be
  #redraw = eachFrame(() => {
    if (this.#picture && this.#paths && this.#room[0] && this.#near) this.#draw();
  });
  #catchUp = paced(() => this.#appear().then(painted), STREAM_MS);

  /** @param {HTMLElement} node */
  constructor(node) {
    this.#node = node;
    this.#panel = furnish(node, {
      view: (name) => this.#look(name),
      shown: (name, on) => this.#switch(name, on),
      factor: (value) => ((this.#chosen.factor = value), this.#redraw()),
      worst: () => {
        const worst = this.#paths.worstOf(this.#shown);
        if (worst) this.#goTo(worst.row);
      },
    });
    const { canvas, stage, labels } = this.#panel;
    this.#labels = new Labels(labels);
    this.#panel.corner(this.#solids.part.node);
    this.#panel.below(this.#player.node, this.#readout.node);
    this.#panel.after(this.#readout.text);
    // On the page it has a place of its own, in the view of the result.
    const place = document.getElementById("section");
    if (place) place.append(this.#solids.section.node);
    else this.#panel.after(this.#solids.section.node);
    steer(canvas, this.#viewpoint.camera, {
      move: () => ((this.#viewpoint.steered = true), this.#redraw()),
      point: eachFrame((x, y, pressed) => this.#point(x, y, pressed)),
      key: (key) => this.#key(key),
    });
    watch(canvas, stage, {
      resized: (room) => ((this.#room = room), this.#appear()),
      near: (near) => ((this.#near = near), this.#appear()),
      lost: () => this.#lose(),
      restored: () => (this.#begin(), this.#appear()),
    });
    onCursor(() => this.#follow());
    onSetting(() => requestAnimationFrame(() => this.#recolour())); // a theme that has just been chosen is applied by then
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#recolour());
  }

  /** @param {Summary} summary */
  show(summary) {
    this.#summary = summary;
    this.#player.duration = summary.duration_s;
    this.#solids.offer(summary);
    this.#panel.menu.offerPart(this.#solids.part.offered);
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
    if (sharpen(canvas, this.#room)) {
      [this.#viewpoint.camera.width, this.#viewpoint.camera.height] = [width, height];
      this.#refit();
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

  #lose() {
    this.#drawWith(null);
    this.#panel.say("The graphics were lost; waiting for the browser to restore them. The charts show the same paths.");
  }

  /**
   * Draws with another picture, or with none.
   * @param {Picture | null} picture
   */
  #drawWith(picture) {
    this.#picture = picture;
    this.#solids.drawWith(picture?.gl ?? null);
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
    const summary = this.#loaded;
    this.#solids.simulate(quiet, {
      isCurrent: () => summary === this.#summary,
      isSeen: () => this.#shown.solid && Boolean(this.#picture),
      enclose: (solid) => this.#enclose(solid),
    });
  }

  /**
   * Draws the stock, or without one a box, around the path.
   * @param {StockSolid | undefined} solid
   */
  #enclose(solid) {
    const { stock } = this.#solids;
    const first = stock.given !== Boolean(solid);
    stock.take(solid, this.#paths.boxIn(this.#pose.frames.workpiece));
    this.#upload();
    if (first) this.#refit();
  }

  async #load() {
    const summary = (this.#loaded = this.#summary);
    try {
      const [track] = await Promise.all([core.track(MOST), this.#pose.load(this.#sample())]);
      if (summary !== this.#loaded) return;
      const before = this.#paths?.box;
      this.#paths = new Paths(track);
      // Until its own stock is there, the one before is as good a guess as any.
      if (summary.surface && this.#solids.stock.given) this.#upload();
      else this.#enclose(undefined);
      if (!before || isElsewhere(before, this.#paths.box)) this.#look(before ? this.#viewpoint.fitted : "iso");
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
    const { stock } = this.#solids;
    const part = around(this.#paths.cutBox, stock.corners(workpiece));
    this.#axes = [
      { name: "base", frame: base, long: extent(box) / 9 },
      { name: "workpiece", frame: workpiece, long: extent(part) / 7 },
    ];
    const spacing = this.#picture.take({
      paths: this.#paths,
      stock,
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
    this.#solids.section.follow();
    this.#pose.follow(
      () => this.#sample(),
      () => this.#redraw(),
    );
  }

  /**
   * The pointer is at a place of the picture [px].
   * @param {number} x
   * @param {number} y
   * @param {boolean} pressed
   */
  #point(x, y, pressed) {
    if (!this.#paths || this.#player.playing) return;
    const { camera } = this.#viewpoint;
    const { width, height } = camera;
    const view = { width, height, factor: this.#factor(), shown: this.#shown, reach: pressed ? 2 * REACH : REACH };
    const row = this.#paths.pick(camera.matrix(), [x, y], view);
    if (row >= 0) this.#goTo(row);
  }

  /** @param {string} key */
  #key(key) {
    const view = viewOf(key);
    if (key === " ") this.#player.toggle();
    else if (view) this.#look(view);
    else return false;
    return true;
  }

  /**
   * Looks from a side, or (`fit`, `all`) shows the part or the arm too from where one looks.
   * @param {string} name
   */
  #look(name) {
    if (!this.#paths) return;
    const { frames } = this.#pose;
    const solid = this.#shown.solid ? this.#solids.corners(frames.workpiece) : [];
    const path = this.#paths.cutRows(FITTED).map((row) => this.#paths.tip(row, "before", this.#factor()));
    const points = [...path, ...this.#paths.cutPoints(FITTED), ...solid];
    this.#viewpoint.look(name, frames, points, this.#panel.edges());
    this.#redraw();
  }

  /** Shows all again, unless the camera was moved by hand. */
  #refit() {
    if (!this.#viewpoint.steered) this.#look(this.#viewpoint.fitted);
    else this.#redraw();
  }

  #factor() {
    return this.#chosen.factor ?? this.#paths?.factor() ?? 1;
  }

  #recolour() {
    this.#picture?.recolour(tonesOf(this.#node));
    this.#solids.part.recolour(tonesOf(this.#node).dark);
    if (!this.#paths) return;
    this.#upload();
    this.#describe();
  }

  #draw() {
    const [paths, pose, shown] = [this.#paths, this.#pose, this.#shown];
    const { camera } = this.#viewpoint;
    const { part, stock, section } = this.#solids;
    const [factor, worst] = [this.#factor(), paths.worstOf(shown)];
    const taken = this.#panel.taken();
    const row = paths.rowOf(this.#sample());
    const summary = this.#loaded ?? this.#summary;
    // Half as wide as passes are apart, so that it leaves them in sight.
    const radius = shown.tube ? Math.min(summary.tolerance_mm * factor, paths.spacing / 4) : 0;
    this.#picture?.draw({
      camera,
      shown,
      pose,
      part,
      stock,
      factor,
      radius,
      marks: { row, side: worst?.side ?? null, worst: worst?.row ?? 0 },
    });
    section.magnify(factor);
    this.#write(worst, factor, taken);
    this.#readout.at(this.#timeOf(row), paths, row);
    this.#panel.beyond(pose);
    const sample = this.#sample();
    Object.assign(
      this.#node.dataset,
      factsOf({ camera, paths, pose, part, stock, solid: shown.solid, sample, factor, radius, worst: worst?.row }),
    );
  }

  /**
   * The labels over the picture.
   * @param {Worst | undefined} worst
   * @param {number} factor
   * @param {Rectangle[]} taken
   */
  #write(worst, factor, taken) {
    const { worst: button } = this.#panel;
    const { camera } = this.#viewpoint;
    const matrix = camera.matrix();
    button.hidden = !worst;
    let first;
    if (worst) {
      const error = length(this.#paths[worst.side](worst.row));
      const words = `${lengthText(error)} ${lengthUnit()}, ${momentText(this.#timeOf(worst.row))}`;
      if (button.textContent !== words) button.textContent = words;
      first = { node: button, point: this.#paths.tip(worst.row, worst.side, factor) };
    }
    /** @param {number[]} point */
    const place = (point) => project(matrix, point, camera.width, camera.height);
    if (first) this.#node.dataset.worstAt = place(first.point).slice(0, 2).join(" ");
    this.#labels.write(axisLabels(this.#axes), first, place, this.#room, taken);
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
