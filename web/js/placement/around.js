// What stands around the places of a map: the part as a box, the robot's base and the floor.

import { makeSvg } from "../page/dom.js";

/** @import { JobData } from "../job/data.js" */

/** @typedef {[number, number]} Point */

/**
 * Corners of the part's box from the workpiece frame's origin, along the cell's axes [mm]; where the robot's base is in
 * the cell, radius and height of the cylinder that stands for it, and the height of the floor, NaN where there is none
 * [mm].
 *
 * @typedef {{
 *   corners: number[][],
 *   base: { at: number[], radius: number, height: number, floor: number },
 * }} Around
 */

const CROSS = 13; // arm of the mark at the frame's origin, in units of the drawing

/** The sides of the base that the part may stay on, counted from its x axis against the clock, a quarter each. */
const SIDES = ["front", "left", "behind", "right"];

/**
 * What the core says of a job's surroundings.
 * @param {{ part: Float64Array, base: Float64Array }} said
 * @returns {Around}
 */
export function aroundOf({ part, base }) {
  const corners = Array.from({ length: part.length / 3 }, (_, n) => Array.from(part.subarray(3 * n, 3 * n + 3)));
  const [x, y, z, radius, height, floor] = base;
  return { corners, base: { at: [x, y, z], radius, height, floor } };
}

/**
 * Smallest and largest coordinates of the part along an axis, with the frame's origin at `from` there [mm].
 * @param {Around} around
 * @param {number} axis
 * @param {number} from
 * @returns {Point}
 */
export function rangeOf({ corners }, axis, from) {
  const values = corners.map((corner) => corner[axis]);
  return [from + Math.min(...values), from + Math.max(...values)];
}

/**
 * Whether the part is lower than the floor, with the frame's origin at a height [mm]; it may stand on it.
 * @param {Around} around
 * @param {number} z
 */
export const isInFloor = (around, z) => rangeOf(around, 2, z)[0] < around.base.floor - 1e-3;

/**
 * The side of the base on which the part's middle is, with its frame at `xyz` [mm]; `any` within the base.
 * @param {Around} around
 * @param {JobData} job
 * @param {number[]} xyz
 */
export function sideOf(around, { base_frame: base }, xyz) {
  const [dx, dy] = [0, 1].map((axis) => {
    const [low, high] = rangeOf(around, axis, xyz[axis]);
    return (low + high) / 2 - around.base.at[axis];
  });
  if (Math.hypot(dx, dy) < around.base.radius) return "any";
  const turn = (Math.atan2(dy, dx) * 180) / Math.PI - (base?.rpy_deg?.[2] ?? 0);
  return SIDES[((Math.round(turn / 90) % 4) + 4) % 4];
}

/**
 * Corners of the smallest convex polygon that holds the points, in order (monotone chain).
 * @param {Point[]} points
 */
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  /** @param {Point[]} ordered */
  const half = (ordered) => {
    /** @type {Point[]} */
    const chain = [];
    for (const p of ordered) {
      while (chain.length > 1 && !turnsLeft(chain[chain.length - 2], chain[chain.length - 1], p)) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/**
 * @param {Point} a
 * @param {Point} b
 * @param {Point} c
 */
const turnsLeft = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 1e-9;

/**
 * The base and the floor in a plane with the `axes`; `x` and `y` bring millimetres to the drawing, whose plot is `box`.
 * @param {Around} around
 * @param {number[]} axes
 * @param {{ x(v: number): number, y(v: number): number, box: { x: number, y: number, width: number, height: number } }} plot
 */
export function ground({ base }, [i, k], { x, y, box }) {
  const { at, radius, height, floor } = base;
  const [cx, cy] = [x(at[i]), y(at[k])];
  const signs = [];
  const stands = Number.isFinite(floor);
  if (k !== 2) {
    const r = Math.abs(x(at[i] + radius) - cx);
    signs.push(makeSvg("circle", { class: "base", cx, cy, r: stands ? r : 6 }), word("base", cx, cy + 5));
    return signs;
  }
  if (stands) {
    const [left, right, top, bottom] = [x(at[i] - radius), x(at[i] + radius), y(at[k] + height), y(floor)];
    signs.push(
      makeSvg("rect", { class: "base", x: left, y: top, width: right - left, height: Math.max(0, bottom - top) }),
      makeSvg("path", { class: "floor", d: `M${box.x} ${bottom}h${box.width}` }),
      word("base", cx, (top + bottom) / 2 + 5),
      word("floor", box.x + box.width - 24, bottom - 6),
    );
  } else signs.push(makeSvg("circle", { class: "base", cx, cy, r: 6 }), word("base", cx, cy - 10));
  return signs;
}

/**
 * The part's outline with its frame at a place of the plane [mm].
 * @param {Around} around
 * @param {number[]} axes
 * @param {Point} place
 * @param {{ x(v: number): number, y(v: number): number }} plot
 * @param {string} name what is drawn so: `now`, `best` or `cursor`
 */
export function outline({ corners }, [i, k], [a, b], { x, y }, name) {
  const points = hull(corners.map((corner) => [x(a + corner[i]), y(b + corner[k])]));
  const d = points.map(([px, py], n) => `${n ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`).join("") + "Z";
  const lines = (name === "cursor" ? ["over"] : ["under", "over"]).map((layer) =>
    makeSvg("path", { class: `part-outline ${name} ${layer}`, d }),
  );
  if (name !== "now") return lines;
  const middle = points.reduce((sum, [px]) => sum + px / points.length, 0);
  const top = Math.min(y(b) - CROSS, ...points.map(([, py]) => py));
  return [...lines, word("part", middle, top - 6)];
}

/**
 * @param {string} text
 * @param {number} x
 * @param {number} y
 */
const word = (text, x, y) => makeSvg("text", { class: "around", x, y, "text-anchor": "middle" }, text);
