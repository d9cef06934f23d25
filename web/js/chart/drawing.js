// The core's drawing on the page. What is data can be moved within the plot, until the exact
// drawing arrives.

import { makeSvg } from "../page/dom.js";
import { fractionOf } from "./view.js";

/**
 * @import { Chart } from "../../pkg/armill.js"
 * @import { Axis } from "./view.js"
 */

const MOST_LETTERS = 3; // curves of a result that have its letter each
const LETTER_PX = 14; // height of a letter with some room
const SPILL = 4; // what a line at the edge needs beside the plot [px]

/**
 * The core's text of a drawing as elements.
 * @param {string} text
 * @returns {SVGSVGElement}
 */
export function svgOf(text) {
  const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
  const svg = /** @type {any} */ (document.importNode(parsed.documentElement, true));
  svg.setAttribute("aria-hidden", "true"); // heading and caption say it; a <title> would pop up under the pointer
  svg.querySelectorAll(":scope > :is(title, desc)").forEach((/** @type {Element} */ element) => element.remove());
  return svg;
}

/**
 * The drawing of a chart, whose data can be moved.
 * @param {Chart} chart
 * @returns {SVGSVGElement}
 */
export function drawingOf(chart) {
  const svg = svgOf(chart.svg);
  const { left, top, width, height } = chart.plot;
  const id = `clip-${chart.name}`;
  const room = makeSvg("rect", {
    x: left - SPILL,
    y: top - SPILL,
    width: width + 2 * SPILL,
    height: height + 2 * SPILL,
  });
  for (const layer of svg.querySelectorAll(":scope > g:not(.axis)")) {
    const clip = makeSvg("g", { "clip-path": `url(#${id})` });
    layer.replaceWith(clip);
    clip.append(makeSvg("g", { class: "moving" }, layer));
  }
  svg.prepend(makeSvg("defs", {}, makeSvg("clipPath", { id }, room)));
  return svg;
}

/**
 * Puts a pinned result's curves below those of this drawing, whose axes are the same. Its letter stands
 * at them: at each, or where they are many at the first.
 * @param {SVGElement} svg
 * @param {SVGElement} other
 * @param {string} letter
 * @param {Chart["plot"]} area
 */
export function layBelow(svg, other, letter, area) {
  const curves = ":scope > g:has(.series)";
  const first = svg.querySelector(curves);
  const layers = [...other.querySelectorAll(curves)];
  for (const [i, layer] of layers.entries()) {
    layer.classList.add("pinned", `pin-${letter.toLowerCase()}`);
    if (layers.length <= MOST_LETTERS || i === 0) mark(layer, letter, area);
    first?.before(layer);
  }
}

/**
 * Writes a letter at a curve, each letter at a place of its own along the plot.
 * @param {Element} layer
 * @param {string} letter
 * @param {Chart["plot"]} area
 */
function mark(layer, letter, { left, top, width }) {
  const wanted = left + width * (0.1 + 0.15 * (letter.charCodeAt(0) - "A".charCodeAt(0)));
  const at = placeOn([...layer.querySelectorAll("polyline")].map(pointsOf), wanted);
  if (!at) return;
  const y = at[1] - top > LETTER_PX ? at[1] - 4 : at[1] + LETTER_PX; // above the curve, if that is in the plot
  layer
    .querySelector(".series")
    ?.append(makeSvg("text", { class: "letter", x: at[0], y, "text-anchor": "middle" }, letter));
}

/** @param {Element} line */
const pointsOf = (line) =>
  String(line.getAttribute("points"))
    .split(" ")
    .map((point) => point.split(",").map(Number));

/**
 * The point of these lines at `x`, or their nearest end.
 * @param {number[][][]} lines
 * @param {number} x
 */
function placeOn(lines, x) {
  for (const line of lines)
    for (let k = 1; k < line.length; k++) {
      const [[x0, y0], [x1, y1]] = [line[k - 1], line[k]];
      if (x0 <= x && x <= x1 && x1 > x0) return [x, y0 + ((x - x0) / (x1 - x0)) * (y1 - y0)];
    }
  const ends = lines.flatMap((line) => [line[0], line[line.length - 1]]);
  return ends.sort((a, b) => Math.abs(a[0] - x) - Math.abs(b[0] - x))[0];
}

/**
 * Moves and stretches the data of a drawing to where they stand with the axes `x` and `y`.
 * @param {SVGElement} svg
 * @param {Chart} chart
 * @param {{ x: Axis, y: Axis }} axes
 */
export function moveDrawing(svg, { plot, x: drawnX, y: drawnY }, { x, y }) {
  const [left, right] = [fractionOf(drawnX, x.min), fractionOf(drawnX, x.max)];
  const [low, high] = [fractionOf(drawnY, y.min), fractionOf(drawnY, y.max)];
  const [sx, sy] = [1 / (right - left), 1 / (high - low)];
  const same =
    Math.abs(sx - 1) + Math.abs(sy - 1) + Math.abs(left) + Math.abs(low) < 1e-9 || ![sx, sy].every(Number.isFinite);
  const tx = plot.left - (plot.left + left * plot.width) * sx;
  const ty = plot.top - (plot.top + (1 - high) * plot.height) * sy;
  for (const layer of svg.querySelectorAll(".moving")) {
    if (same) layer.removeAttribute("transform");
    else layer.setAttribute("transform", `matrix(${sx} 0 0 ${sy} ${tx} ${ty})`);
  }
}
