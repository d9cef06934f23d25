// Draws the run with WebGL: floor, paths, part, stock, arm and marks, each over what it may cover.

import { armParts, shadow } from "./arm.js";
import { dot, length, plus } from "./camera.js";
import { axesOf, grid } from "./floor.js";
import { vertex } from "./line-gl.js";
import { painterOn } from "./painter.js";
import { colour, texels } from "./ramp.js";
import { matrixOf } from "./part.js";
import { veiled } from "./veil.js";

/**
 * @import { Frame, Frames } from "./arm.js"
 * @import { Box, Camera, Vector } from "./camera.js"
 * @import { Line, LineStyle } from "./line-gl.js"
 * @import { Painter } from "./painter.js"
 * @import { Part } from "./part.js"
 * @import { Paths } from "./paths.js"
 * @import { Stock } from "./stock.js"
 * @import { Tones } from "./tones.js"
 */

/** @typedef {"desired" | "compensated" | "actual" | "after" | "whiskers" | "outline" | "grid"} LineName */

/** @typedef {{ row: number, side: "before" | "after" | null, worst: number }} Marks */

const CROWDED = 1.5; // points nearer than this need not all be joined [px]
const LOOKS = 60; // points of the path that the arm must not cover
const DOWN = Math.cos(Math.PI / 9); // looking this steeply on the part, the arm is always faint
const TUBE = 0.28; // share of the tolerance tube's colour

/**
 * The picture on a canvas, or null where the browser has no WebGL 2.
 * @param {HTMLCanvasElement} canvas
 */
export function pictureOn(canvas) {
  const painter = painterOn(canvas);
  return painter && new Picture(canvas, painter);
}

export class Picture {
  #canvas;
  #painter;
  /** @type {Tones} */
  #tones;
  /** @type {Paths} */
  #paths;
  /** @type {Record<LineName, Line> & { axes: Line[][] }} */
  #lines;
  /** @type {number[][]} */
  #looks = []; // points of the path

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Painter} painter
   */
  constructor(canvas, painter) {
    this.#canvas = canvas;
    this.#painter = painter;
  }

  /** What it draws with. */
  get gl() {
    return this.#painter.gl;
  }

  /**
   * Draws in other tones of the page.
   * @param {Tones} tones
   */
  recolour(tones) {
    this.#tones = tones;
    this.#painter.lines.ramp(texels());
  }

  /**
   * Takes over paths, the stock, and axes { frame, long }, over a floor that is as wide as `box`; `unit`
   * [mm] is that of its grid. Returns the grid's spacing in units.
   * @param {{ paths: Paths, stock: Stock, frame: Frame, axes: { frame: Frame, long: number }[], box: Box, unit: number }} run
   */
  take({ paths, stock, frame, axes, box, unit }) {
    this.#paths = paths;
    this.#looks = paths.cutPoints(LOOKS);
    const painter = this.#painter;
    painter.lines.clear();
    const { spacing, points } = grid(box, unit);
    this.#lines = {
      desired: painter.lines.take(paths.line("desired", null)),
      compensated: painter.lines.take(paths.line("desired", "correction")),
      actual: painter.lines.take(paths.line("closest", "before")),
      after: painter.lines.take(paths.line("closest", "after")),
      whiskers: painter.lines.take(paths.whiskers(), true),
      outline: painter.lines.take(stock.edges(frame), true),
      grid: painter.lines.take(points, true),
      axes: axes.map(({ frame, long }) => axesOf(frame, long).map((line) => painter.lines.take(line, true))),
    };
    return spacing;
  }

  /**
   * Draws one picture. `shown` says what, from `camera`, of the arm's pose { frames, excess }, `part` and `stock`; deviations
   * are magnified by `factor`, the tolerance tube has the `radius` [mm], `marks` are { row, side, worst }.
   * @param {{
   *   camera: Camera, shown: Record<string, boolean>, pose: { frames: Frames, excess: ArrayLike<number> },
   *   part: Part, stock: Stock, factor: number, radius: number, marks: Marks,
   * }} given
   */
  draw({ camera, shown, pose, part, stock, factor, radius, marks }) {
    const [painter, tones, canvas] = [this.#painter, this.#tones, this.#canvas];
    const sharp = canvas.height / camera.height;
    const matrix = camera.matrix();
    const { right, up, out } = camera.axes();
    const above = plus(plus(out, up, 0.7), right, -0.4);
    const light = above.map((v) => v / length(above));
    const steep = Math.hypot(matrix[1], matrix[5], matrix[9]);
    painter.begin({
      camera: matrix,
      width: canvas.width,
      height: canvas.height,
      paper: tones.paper,
      rapidColour: tones.rapid,
      light,
      pixelsPerMm: (canvas.height / 2) * steep,
    });
    const { frames, excess } = pose;
    const view = { matrix, width: camera.width, height: camera.height, pixelsPerMm: (camera.height / 2) * steep };
    const looksDown = out[2] > DOWN || dot(out, frames.tcp.z) < -DOWN;
    const parts = shown.arm
      ? veiled(armParts(frames, excess), this.#looks, view, looksDown).map((part) => ({
          ...part,
          colour: tones[part.tone],
        }))
      : [];
    painter.tubes.stains(looksDown ? [] : parts.map((part) => ({ ...shadow(part), colour: tones.shadow })));
    this.#drawLines(camera, sharp, shown, factor);
    const frame = matrixOf(frames.workpiece);
    if (shown.solid) part.draw({ camera: matrix, frame, factor, light, eye: out });
    const tube = { radius, width: 0, colour: tones.tube, strength: TUBE, every: this.#every(camera) };
    if (radius) painter.lines.veil(this.#lines.desired, tube);
    const whole = Math.max(0, ...parts.map(({ strength }) => strength));
    painter.tubes.solids(parts.filter(({ strength }) => strength === whole));
    if (shown.solid && !part.drawn) stock.draw({ camera: matrix, frame, colour: tones.glass });
    painter.tubes.solids(parts.filter(({ strength }) => strength < whole));
    this.#drawMarks(marks, factor, sharp);
  }

  /**
   * Of points that crowd one of so many is joined.
   * @param {Camera} camera
   */
  #every(camera) {
    return Math.max(1, Math.floor((CROWDED * camera.pixel()) / (this.#paths.stride || 1)));
  }

  /**
   * Floor, axes and paths.
   * @param {Camera} camera
   * @param {number} sharp
   * @param {Record<string, boolean>} shown
   * @param {number} factor
   */
  #drawLines(camera, sharp, shown, factor) {
    const [painter, tones, lines] = [this.#painter, this.#tones, this.#lines];
    painter.lines.draw(lines.grid, { width: sharp, colour: tones.grid });
    for (const axes of lines.axes)
      axes.forEach((axis, i) => painter.lines.draw(axis, { width: 2 * sharp, colour: tones.axes[i], bias: 1e-6 }));
    painter.lines.draw(lines.outline, { width: 1.25 * sharp, colour: tones.outline });
    const dash = 10 * camera.pixel();
    const largest = this.#paths.largest || 1e-9;
    const every = this.#every(camera);
    /**
     * @param {Line} line
     * @param {LineStyle} style
     */
    const draw = (line, style) => painter.lines.draw(line, { ...style, every });
    if (shown.desired) draw(lines.desired, { width: 1.75 * sharp, rapid: sharp, colour: tones.desired, bias: 1e-6 });
    if (shown.actual) draw(lines.whiskers, { factor, largest, width: sharp, fade: 0.45, bias: 1e-6 });
    if (shown.compensated)
      draw(lines.compensated, { factor, width: 2 * sharp, colour: tones.command, dash, bias: 2e-6 });
    if (shown.after) draw(lines.after, { factor, largest, width: 2 * sharp, bias: 3e-6 });
    if (shown.actual) draw(lines.actual, { factor, largest, width: 3.25 * sharp, bias: 3e-6 });
  }

  /**
   * The cursor, from the desired path to the actual tip, and the worst place as a ring.
   * @param {Marks} marks
   * @param {number} factor
   * @param {number} sharp
   */
  #drawMarks({ row, side, worst }, factor, sharp) {
    const [paths, painter, { ink, paper }] = [this.#paths, this.#painter, this.#tones];
    /**
     * @param {ArrayLike<number> & Iterable<number>} point
     * @param {number} width
     * @param {number[]} colour
     */
    const dot = (point, width, colour) =>
      painter.lines.dot(new Float32Array([...vertex(point), ...vertex(point)]), { width: width * sharp, colour });
    if (side) {
      const place = paths.tip(worst, side, factor);
      const own = colour(length(paths[side](worst)) / (paths.largest || 1)).map((v) => v / 255);
      dot(place, 16, ink);
      dot(place, 12.5, paper);
      dot(place, 8, own);
    }
    const from = [...paths.closest(row)];
    const to = paths.tip(row, "before", factor);
    painter.lines.dot(new Float32Array([...vertex(from), ...vertex(to)]), { width: 1.5 * sharp, colour: ink });
    dot(from, 8, ink);
    dot(from, 4.5, paper);
    dot(to, 11, paper);
    dot(to, 8, ink);
  }
}
