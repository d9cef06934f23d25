// The robot's table as a picture: the arm from its side with all joints at zero, so that a wrong
// number is seen at once.

import { makeSvg, make } from "../page/dom.js";
import { formatLength } from "../page/number.js";
import { framesOf } from "./arm.js";

/**
 * @import { Job } from "../job/job.js"
 * @import { Frames } from "./arm.js"
 */

const [WIDTH, HEIGHT, MARGIN] = [320, 160, 16];

/**
 * The figure, and `show(job)`; `ask(json)` gives the frames of a job's arm at zero.
 * @param {(json: string) => Promise<Float64Array>} ask
 */
export function makeArmView(ask) {
  const svg = makeSvg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" });
  const caption = make("figcaption", {});
  const node = make("figure", { className: "arm-view" }, svg, caption);
  let drawn = "";
  /** @param {Job} job */
  const show = async (job) => {
    const { robot, tool_frame } = job.data;
    const wanted = JSON.stringify([robot, tool_frame]);
    if (wanted === drawn) return;
    drawn = wanted;
    try {
      const frames = framesOf(await ask(job.text));
      if (wanted === drawn) draw(svg, caption, frames);
    } catch {
      drawn = ""; // the form says what is wrong; the next edit asks again
    }
  };
  return { node, show };
}

/**
 * @param {SVGElement} svg
 * @param {HTMLElement} caption
 * @param {Frames} frames
 */
function draw(svg, caption, { base, joints, tcp }) {
  const stations = [base, ...joints, tcp].map(({ origin: [x, , z], z: axis }) => ({ x, z, axis }));
  const [xs, zs] = [stations.map(({ x }) => x), stations.map(({ z }) => z)];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(0, ...zs), Math.max(...zs)];
  const scale = Math.min(
    (WIDTH - 2 * MARGIN) / Math.max(right - left, 1),
    (HEIGHT - 2 * MARGIN) / Math.max(high - low, 1),
  );
  const middle = (WIDTH - scale * (left + right)) / 2;
  /** @param {{ x: number, z: number }} point */
  const at = ({ x, z }) => [middle + scale * x, HEIGHT - MARGIN - scale * (z - low)].map((v) => Number(v.toFixed(1)));
  /**
   * @param {number[]} a
   * @param {number[]} b
   * @param {string} name
   */
  const line = (a, b, name) => makeSvg("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], class: name });
  const floor = at({ x: 0, z: 0 })[1];
  /** @type {SVGElement[]} */
  const parts = [line([4, floor], [WIDTH - 4, floor], "floor")];
  stations
    .slice(1)
    .forEach((station, i) => parts.push(line(at(stations[i]), at(station), i === joints.length ? "tool" : "link")));
  for (const { x, z, axis } of stations.slice(1, -1)) {
    const [cx, cy] = at({ x, z });
    const across = Math.hypot(axis[0], axis[2]);
    // An axis that points at the viewer is a ring, one in the picture's plane a bar along it.
    if (across < 0.5) parts.push(makeSvg("circle", { cx, cy, r: 5, class: "axis" }));
    else
      parts.push(
        line(
          [cx - (7 * axis[0]) / across, cy + (7 * axis[2]) / across],
          [cx + (7 * axis[0]) / across, cy - (7 * axis[2]) / across],
          "axis",
        ),
      );
  }
  const [tx, ty] = at(stations[stations.length - 1]);
  parts.push(makeSvg("circle", { cx: tx, cy: ty, r: 2.5, class: "tip" }));
  svg.replaceChildren(...parts);
  const [x, y, z] = tcp.origin.map((v) => formatLength(Math.round(v * 10) / 10));
  caption.textContent = `All joints at zero, from the side: tip at ${x}, ${y}, ${z} mm`;
  svg.setAttribute("aria-label", caption.textContent);
}
