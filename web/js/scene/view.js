// The run in space: paths with their deviation magnified, the arm at the cursor, a floor to stand
// on.

import * as core from "../core/client.js";
import { cursor, onCursor, setCursor } from "../page/cursor.js";
import { lineAt } from "../page/program-lines.js";
import { onSetting } from "../page/settings.js";
import { inLength, lengthText, lengthUnit } from "../page/units.js";
import { armParts, framesOf, shadow } from "./arm.js";
import { Camera, VIEWS, length, plus, project } from "./camera.js";
import { axesOf, grid } from "./floor.js";
import { painterOn, vertex } from "./gl.js";
import { placeLabels } from "./labels.js";
import { furnish } from "./panel.js";
import { Part, matrixOf } from "./part.js";
import { Paths } from "./paths.js";
import { Player } from "./play.js";
import { texels } from "./ramp.js";
import { Section } from "./section.js";
import { steer } from "./controls.js";
import { tonesOf } from "./tones.js";

const MOST = 50_000; // points of a path that are drawn
const REACH = 14; // how near a path a pointer must be [px]
const QUIET_MS = 300; // a result that has stood this long has its part simulated
const CROWDED = 1.5; // points nearer than this need not all be joined [px]
const VIEW_KEYS = { 1: "top", 2: "front", 3: "side", 4: "iso", 5: "tool", f: "fit", a: "all", 0: "fit" };

/** The picture in `node`; `show(summary)` takes over a new result. */
export function makeScene(node) {
  const scene = new Scene(node);
  return { show: (summary) => scene.show(summary) };
}

class Scene {
  #node;
  #panel;
  #player = new Player();
  #part = new Part((first) => (first && !this.#steered ? this.#look(this.#fitted) : this.#redraw()));
  #steered = false; // whether the camera was moved by hand since it showed all
  #section = new Section();
  #waiting; // timer for the part
  #camera = new Camera();
  #painter;
  #summary; // of the shown result
  #loaded; // the summary whose paths are shown
  #paths;
  #lines = {};
  #frames;
  #asked = -1; // sample whose frames were asked for last
  #asking = false;
  #shown = { desired: true, actual: true, after: false, compensated: true, arm: true, solid: true };
  #chosen = null; // magnification chosen by hand
  #fitted = "fit";
  #tones;
  #due = false;
  #room = [0, 0]; // of the picture [px]
  #pointed = null; // where the pointer is, until it has been looked up

  constructor(node) {
    this.#node = node;
    this.#panel = furnish(node, {
      view: (name) => this.#look(name),
      shown: (name, on) => this.#switch(name, on),
      factor: (value) => ((this.#chosen = value), this.#redraw()),
    });
    this.#panel.above(this.#part.node);
    this.#panel.below(this.#player.node, this.#section.node);
    const { canvas, stage } = this.#panel;
    steer(canvas, this.#camera, {
      move: () => ((this.#steered = true), this.#redraw()),
      point: (x, y, pressed) => this.#pointSoon(x, y, pressed),
      key: (key) => this.#key(key),
    });
    this.#camera.look(VIEWS.iso);
    new ResizeObserver(() => {
      this.#room = [stage.clientWidth, stage.clientHeight];
      this.#appear();
    }).observe(stage);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.#painter = null;
      this.#part.drawWith(null);
      this.#panel.say(
        "The graphics were lost; waiting for the browser to give them back. The charts below show the same paths.",
      );
    });
    canvas.addEventListener("webglcontextrestored", () => this.#begin());
    onCursor(() => this.#follow());
    onSetting(() => requestAnimationFrame(() => this.#recolour())); // a theme that has just been chosen is applied by then
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#recolour());
  }

  show(summary) {
    this.#summary = summary;
    this.#player.duration = summary.duration_s;
    clearTimeout(this.#waiting);
    this.#part.offer(summary);
    this.#section.offer(summary);
    this.#panel.offerPart(this.#part.offered);
    this.#appear();
  }

  /** Starts drawing, or loads the newest paths, once the picture can be seen. */
  #appear() {
    const { canvas } = this.#panel;
    const [width, height] = this.#room;
    if (!width || !this.#summary) return;
    const sharp = Math.min(2, devicePixelRatio || 1);
    if (canvas.width !== Math.round(width * sharp) || canvas.height !== Math.round(height * sharp)) {
      [canvas.width, canvas.height] = [Math.round(width * sharp), Math.round(height * sharp)];
      [this.#camera.width, this.#camera.height] = [width, height];
      if (this.#paths) this.#look(this.#fitted, false);
    }
    if (this.#painter === undefined) this.#begin();
    if (this.#painter && this.#loaded !== this.#summary) this.#load();
    this.#redraw();
  }

  #begin() {
    this.#painter = painterOn(this.#panel.canvas);
    this.#panel.say(
      this.#painter
        ? ""
        : "This browser does not offer WebGL 2, so the paths are not drawn in space here. The charts below show them.",
    );
    this.#part.drawWith(this.#painter?.gl);
    if (this.#painter) this.#recolour();
    if (this.#painter && this.#paths) this.#upload();
  }

  #switch(name, on) {
    this.#shown[name] = on;
    if (name === "solid") this.#simulate(0);
    this.#redraw();
  }

  /** Has the part simulated once the result has stood for a while. */
  #simulate(quiet) {
    clearTimeout(this.#waiting);
    if (!this.#part.offered) return;
    const summary = this.#summary;
    const isCurrent = () => summary === this.#summary;
    this.#waiting = setTimeout(async () => {
      try {
        if (this.#shown.solid && this.#painter) await this.#part.load(isCurrent);
        if (isCurrent()) await this.#section.begin();
      } catch {
        // Replaced by a newer result or a recovery, which loads its own.
      }
    }, quiet);
  }

  async #load() {
    const summary = (this.#loaded = this.#summary);
    this.#asked = -1;
    try {
      const [track, frames] = [await core.track(MOST), await core.frames(this.#sample())];
      if (summary !== this.#summary) return;
      const before = this.#paths?.box(0);
      this.#paths = new Paths(track);
      this.#frames = framesOf(frames);
      if (this.#painter) this.#upload();
      if (!before || isElsewhere(before, this.#paths.box(0))) this.#look(before ? this.#fitted : "iso");
      this.#describe();
      this.#simulate(QUIET_MS);
    } catch {
      if (this.#loaded === summary) this.#loaded = null; // replaced by a newer result or a recovery: the next one loads again
    }
  }

  #upload() {
    const [paths, painter] = [this.#paths, this.#painter];
    painter.clearLines();
    const nothing = () => [0, 0, 0];
    this.#lines = {
      desired: painter.line(paths.points(paths.desired, nothing)),
      compensated: painter.line(paths.points(paths.desired, paths.correction)),
      actual: painter.line(paths.points(paths.closest, paths.before)),
      after: painter.line(paths.points(paths.closest, paths.after)),
      whiskers: painter.line(paths.whiskers(), true),
      ...this.#floor(),
    };
    this.#redraw();
  }

  /** The grid and the axes of base and workpiece. */
  #floor() {
    const box = around(this.#paths.box(0), [
      this.#frames.base.origin,
      ...this.#frames.joints.map((joint) => joint.origin),
    ]);
    const { spacing, points } = grid(box, 1 / inLength(1));
    const size = Math.max(...box[1].map((v, i) => v - box[0][i])) / 7;
    this.#panel.floor.textContent = `Grid ${spacing} ${lengthUnit()}`;
    const axes = [
      ["base", this.#frames.base, size * 1.25],
      ["workpiece", this.#frames.workpiece, size],
    ].map(([name, frame, long]) => ({
      name,
      frame,
      long,
      lines: axesOf(frame, long).map((line) => this.#painter.line(line, true)),
    }));
    return { grid: this.#painter.line(points, true), axes };
  }

  #sample() {
    const { samples, duration_s } = this.#summary;
    return Math.round((Math.min(duration_s, cursor() ?? 0) / (duration_s || 1)) * (samples - 1));
  }

  /** The cursor has moved: asks the core where the arm stands, one question at a time. */
  async #follow() {
    if (!this.#paths || !this.#painter || !this.#room[0]) return;
    this.#redraw();
    this.#section.follow();
    if (this.#asking) return;
    this.#asking = true;
    try {
      while (this.#asked !== this.#sample()) {
        this.#asked = this.#sample();
        this.#frames = framesOf(await core.frames(this.#asked));
        this.#redraw();
      }
    } catch {
      this.#asked = -1; // a newer result brings its own frames
    }
    this.#asking = false;
  }

  /** Once a picture is often enough, however often the pointer tells where it is. */
  #pointSoon(...where) {
    if (!this.#pointed) requestAnimationFrame(() => (this.#point(...this.#pointed), (this.#pointed = null)));
    this.#pointed = where;
  }

  #point(x, y, pressed) {
    if (!this.#paths || this.#player.playing) return;
    const { width, height } = this.#camera;
    const view = { width, height, factor: this.#factor(), shown: this.#shown, reach: pressed ? 2 * REACH : REACH };
    const row = this.#paths.pick(this.#camera.matrix(), [x, y], view);
    if (row < 0) return;
    const { samples, duration_s } = this.#summary;
    setCursor((this.#paths.sample(row) / (samples - 1)) * duration_s, "scene");
  }

  #key(key) {
    if (key === " ") this.#player.toggle();
    else if (VIEW_KEYS[key.toLowerCase()]) this.#look(VIEW_KEYS[key.toLowerCase()]);
    else return false;
    return true;
  }

  /** Looks from a side, or (`fit`, `all`) shows the path or the arm too from where one looks. */
  #look(name) {
    if (!this.#paths) return;
    if (name === "fit" || name === "all") this.#fitted = name;
    else if (name === "tool") this.#camera.lookFrom(this.#frames.tcp.z.map((v) => -v));
    else this.#camera.look(VIEWS[name]);
    this.#steered = false;
    const { base, joints, workpiece } = this.#frames;
    const part = this.#shown.solid ? this.#part.corners(workpiece) : [];
    const box = around(this.#paths.box(this.#factor()), part);
    this.#camera.fit(this.#fitted === "all" ? around(box, [base.origin, ...joints.map((joint) => joint.origin)]) : box);
    this.#redraw();
  }

  #factor() {
    return this.#chosen ?? this.#paths?.factor() ?? 1;
  }

  #recolour() {
    this.#tones = tonesOf(this.#node);
    if (this.#painter) this.#painter.ramp(texels(this.#tones.dark));
    this.#part.recolour(this.#tones.dark);
    if (this.#painter && this.#paths) this.#upload();
    if (this.#paths) this.#describe();
  }

  #redraw() {
    if (this.#due) return;
    this.#due = true;
    requestAnimationFrame(() => {
      this.#due = false;
      if (this.#painter && this.#paths && this.#room[0]) this.#draw();
    });
  }

  #draw() {
    const [painter, camera, tones, lines, shown] = [this.#painter, this.#camera, this.#tones, this.#lines, this.#shown];
    const { canvas } = this.#panel;
    const sharp = canvas.height / camera.height;
    const matrix = camera.matrix();
    const factor = this.#factor();
    const { right, up, out } = camera.axes();
    const above = plus(plus(out, up, 0.7), right, -0.4);
    const light = above.map((v) => v / length(above));
    painter.begin({
      camera: matrix,
      width: canvas.width,
      height: canvas.height,
      paper: tones.paper,
      light,
      pixelsPerMm: (canvas.height / 2) * Math.hypot(matrix[1], matrix[5], matrix[9]),
    });
    const parts = shown.arm ? armParts(this.#frames) : [];
    painter.stains(parts.map((part) => ({ ...shadow(part), colour: tones.shadow })));
    painter.draw(lines.grid, { width: sharp, colour: tones.grid });
    for (const { lines: axes } of lines.axes)
      axes.forEach((axis, i) => painter.draw(axis, { width: 2.5 * sharp, colour: tones.axes[i], bias: 1e-6 }));
    const frame = matrixOf(this.#frames.workpiece);
    if (shown.solid) this.#part.draw({ camera: matrix, frame, factor, light, eye: out });

    const dash = 10 * camera.pixel();
    const largest = this.#paths.largest || 1e-9;
    const every = Math.max(1, Math.floor((CROWDED * camera.pixel()) / (this.#paths.stride || 1)));
    const drawn = [];
    if (shown.desired) {
      drawn.push([lines.desired, { radius: this.#summary.tolerance_mm * factor, width: 0, colour: tones.band }]);
      drawn.push([lines.desired, { width: 1.75 * sharp, colour: tones.desired, bias: 1e-6 }]);
    }
    if (shown.actual) drawn.push([lines.whiskers, { factor, largest, width: 1 * sharp, fade: 0.45, bias: 1e-6 }]);
    if (shown.compensated)
      drawn.push([lines.compensated, { factor, width: 2 * sharp, colour: tones.command, dash, bias: 2e-6 }]);
    if (shown.after) drawn.push([lines.after, { factor, largest, width: 2 * sharp, bias: 3e-6 }]);
    if (shown.actual) drawn.push([lines.actual, { factor, largest, width: 3.25 * sharp, bias: 3e-6 }]);
    for (const [line, style] of drawn) painter.draw(line, { ...style, every });
    painter.solids(parts.map((part) => ({ ...part, colour: tones[part.tone] })));
    this.#mark(factor, sharp);
    this.#section.magnify(factor);
    this.#tell(matrix, factor);
  }

  /** The cursor: from the desired path to the actual tip. */
  #mark(factor, sharp) {
    const row = this.#paths.rowOf(this.#sample());
    const [from, way] = [this.#paths.closest(row), this.#paths.before(row)];
    const to = plus(from, way, factor);
    const [painter, { ink, paper }] = [this.#painter, this.#tones];
    const dot = (point, width, colour) =>
      painter.dot(new Float32Array([...vertex(point), ...vertex(point)]), { width: width * sharp, colour });
    painter.dot(new Float32Array([...vertex([...from]), ...vertex(to)]), { width: 1.5 * sharp, colour: ink });
    dot([...from], 8, ink);
    dot([...from], 4.5, paper);
    dot(to, 11, paper);
    dot(to, 8, ink);
  }

  /** Everything in words and numbers that goes with what is drawn. */
  #tell(matrix, factor) {
    const { labels, readout } = this.#panel;
    const [camera, node] = [this.#camera, this.#node];
    placeLabels(labels, this.#lines.axes, (point) => project(matrix, point, camera.width, camera.height));
    const [row, sample] = [this.#paths.rowOf(this.#sample()), this.#sample()];
    const time = (sample / (this.#summary.samples - 1)) * this.#summary.duration_s;
    const line = lineAt(time);
    const [before, after] = [this.#paths.before(row), this.#paths.after(row)].map(
      (way) => `${lengthText(length(way))} ${lengthUnit()}`,
    );
    const where = [...this.#paths.desired(row)]
      .map(
        (v, i) =>
          `${"xyz"[i]} ${inLength(v)
            .toFixed(lengthUnit() === "mm" ? 1 : 3)
            .replace("-", "\u2212")}`,
      )
      .join(", ");
    readout.textContent =
      `At ${time.toFixed(2)} s${line ? `, line ${line} of the program` : ""}: ${where} ` +
      `${lengthUnit()}; contour error ${before} before, ${after} after`;
    Object.assign(node.dataset, {
      azimuth: ((camera.azimuth * 180) / Math.PI).toFixed(2),
      elevation: ((camera.elevation * 180) / Math.PI).toFixed(2),
      distance: camera.distance.toFixed(2),
      target: camera.target.map((v) => v.toFixed(2)).join(" "),
      sample: String(sample),
      factor: String(factor),
      points: String(this.#paths.count),
      part: this.#part.drawn && this.#shown.solid ? this.#part.side : "none",
      triangles: String(this.#part.triangles),
      tip: this.#frames.tcp.origin.map((v) => v.toFixed(6)).join(" "),
    });
  }

  /** What a new result, or another unit, changes around the picture. */
  #describe() {
    const { largest } = this.#paths;
    const unit = lengthUnit();
    this.#panel.factors(this.#paths.factor(), this.#chosen);
    this.#panel.scale(inLength(largest), inLength(this.#summary.tolerance_mm), unit, this.#tones.dark);
    const { path_length_mm, after_mm, surface } = this.#summary;
    const left = surface?.worst_after_mm === undefined ? "" : ` ${leftText(surface)}`;
    this.#panel.text.textContent =
      `The desired path is ${lengthText(path_length_mm, 4)} ${unit} long. The actual one leaves it by at most ` +
      `${lengthText(largest)} ${unit} before compensation ` +
      `and ${lengthText(after_mm.max)} ${unit} after; the deviation is drawn ${this.#factor()} times as large as it ` +
      `is.${left} The charts below show the same paths.`;
  }
}

/** What the surface of the part says to those who do not see it. */
const leftText = ({ worst_before_mm, worst_after_mm }) =>
  `The part is coloured by the deviation of its surface, at most ${lengthText(worst_before_mm)} ${lengthUnit()} before ` +
  `and ${lengthText(worst_after_mm)} ${lengthUnit()} after compensation.`;

/** A box that also holds `points`. */
function around([low, high], points) {
  const every = (pick, ends) => ends.map((end, i) => pick(end, ...points.map((point) => point[i])));
  return [every(Math.min, low), every(Math.max, high)];
}

/**
 * Whether a box is so different from another that a picture of one does not show the other well.
 */
function isElsewhere([low, high], [newLow, newHigh]) {
  const size = Math.max(...high.map((v, i) => v - low[i]), ...newHigh.map((v, i) => v - newLow[i]));
  return [...low, ...high].some((v, i) => Math.abs(v - [...newLow, ...newHigh][i]) > 0.1 * size);
}
