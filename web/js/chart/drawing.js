// The core's drawing on the page. What is data can be moved within the plot, until the exact
// drawing arrives.

import { makeSvg } from "../page/dom.js";
import { fractionOf } from "./view.js";

const SPILL = 4; // what a line at the edge needs beside the plot [px]

/** The drawing as elements. */
export function drawingOf(chart) {
  const parsed = new DOMParser().parseFromString(chart.svg, "image/svg+xml");
  const svg = document.importNode(parsed.documentElement, true);
  svg.setAttribute("aria-hidden", "true"); // heading and caption say it; a <title> would pop up under the pointer
  svg.querySelectorAll(":scope > :is(title, desc)").forEach((element) => element.remove());
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

/** Puts another drawing's curves below those of this one, whose axes are the same. */
export function layBelow(svg, other) {
  const curves = ":scope > g:has(.series)";
  const first = svg.querySelector(curves);
  for (const layer of other.querySelectorAll(curves)) {
    layer.classList.add("pinned");
    first?.before(layer);
  }
}

/** Moves and stretches the data of a drawing to where they stand with the axes `x` and `y`. */
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
