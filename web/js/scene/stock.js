// What the path is cut from, in its place: the stock like glass; without one, a light outline around the path.

import { plus } from "./camera.js";
import { vertex } from "./line-gl.js";
import { GlassPainter } from "./glass-gl.js";

const STRENGTH = 0.13; // of a face's colour

/** @typedef {import("../../pkg/armill.js").StockSolid} Solid */

/** @typedef {{ outline_mm: ArrayLike<number>, bottom_mm: number, top_mm: number }} Outline one that is as high everywhere */

export class Stock {
  /** @type {Solid | null} */
  #solid = null;
  /** @type {GlassPainter | null} */
  #painter = null;
  /** @type {number[][]} */
  #lines = []; // its edges, as pairs of places in the workpiece frame

  /**
   * Takes over the stock of the core, or without one the box [low, high] in the workpiece frame.
   * @param {Solid | undefined} solid
   * @param {import("./camera.js").Box} box
   */
  take(solid, box) {
    this.#solid = solid ?? null;
    this.#lines = solid ? edgesOf(solid) : edgesOfBox(box);
    this.#paint();
  }

  /**
   * Draws with another WebGL, or with none.
   * @param {WebGL2RenderingContext | null} gl
   */
  drawWith(gl) {
    this.#painter = gl && new GlassPainter(gl);
    this.#paint();
  }

  #paint() {
    if (this.#solid) this.#painter?.take(facesOf(this.#solid));
    else this.#painter?.clear();
  }

  /** Whether there is a stock. */
  get given() {
    return Boolean(this.#solid);
  }

  /**
   * The corners of its box, or of that around the path; `frame` is the workpiece's.
   * @param {import("./arm.js").Frame} frame
   */
  corners(frame) {
    return this.#lines.map((place) => placed(frame, place));
  }

  /**
   * Its edges as pairs of points for the painter.
   * @param {import("./arm.js").Frame} frame
   */
  edges(frame) {
    return new Float32Array(this.corners(frame).flatMap((point) => vertex(point)));
  }

  /**
   * Draws its faces; `style` = { camera, frame, colour }.
   * @param {{ camera: Float32Array, frame: Float32Array, colour: number[] }} style
   */
  draw(style) {
    this.#painter?.draw({ ...style, strength: STRENGTH });
  }
}

/**
 * @param {{ origin: number[], x: number[], y: number[], z: number[] }} given
 * @param {number[]} place
 */
const placed = ({ origin, x, y, z }, [a, b, c]) => plus(plus(plus(origin, x, a), y, b), z, c);

/**
 * The corners of an outline at a height.
 * @param {Pick<Outline, "outline_mm">} outline
 * @param {number} height
 */
function ring({ outline_mm }, height) {
  const corners = [];
  for (let i = 0; i < outline_mm.length; i += 2) corners.push([outline_mm[i], outline_mm[i + 1], height]);
  return corners;
}

const UPRIGHT = 20; // degrees that a corner turns by if the edge under it is to be drawn

/** @param {Outline} solid */
function edgesOf(solid) {
  const [bottom, top] = [ring(solid, solid.bottom_mm), ring(solid, solid.top_mm)];
  const count = top.length;
  const lines = [];
  for (let i = 0; i < count; i++) {
    const [before, here, next] = [top[(i + count - 1) % count], top[i], top[(i + 1) % count]];
    lines.push(here, next, bottom[i], bottom[(i + 1) % count]);
    const turn =
      Math.atan2(next[1] - here[1], next[0] - here[0]) - Math.atan2(here[1] - before[1], here[0] - before[0]);
    if (Math.cos(turn) < Math.cos((UPRIGHT * Math.PI) / 180)) lines.push(here, bottom[i]);
  }
  return lines;
}

/** @param {import("./camera.js").Box} box */
const edgesOfBox = ([low, high]) =>
  edgesOf({
    outline_mm: [low[0], low[1], high[0], low[1], high[0], high[1], low[0], high[1]],
    bottom_mm: low[2],
    top_mm: high[2],
  });

/**
 * Sides as triangles, bottom and top as outlines; a mesh has its upper side for a top.
 * @param {Solid} solid
 */
function facesOf(solid) {
  const [bottom, top] = [ring(solid, solid.bottom_mm), ring(solid, solid.top_mm)];
  if (solid.relief_mm.length) return { triangles: solid.relief_mm, fans: [bottom.flat()] };
  const sides = top.flatMap((here, i) => {
    const next = (i + 1) % top.length;
    return [bottom[i], bottom[next], top[next], bottom[i], top[next], here];
  });
  return { triangles: sides.flat(), fans: [bottom.flat(), top.flat()] };
}
