// How solid the parts of the arm are drawn: faint where they would cover the path.

import { project } from "./camera.js";

const [SOLID, FAINT] = [0.85, 0.15]; // shares of a part's colour
/** @type {Record<string, number>} */
const LEAST = { tool: 0.5, beyond: 0.5 }; // of parts to be seen even there
const SOFT = 14; // a part this far beside the path is solid again, so that none flickers [px]

/** @typedef {{ matrix: Float32Array, width: number, height: number, pixelsPerMm: number }} View */

/**
 * The parts with their `strength`. `points` are of the path, `view` = { matrix, width, height, pixelsPerMm }; `all` has
 * every part faint.
 * @template {import("./arm.js").Tube} Part
 * @param {Part[]} parts
 * @param {number[][]} points
 * @param {View} view
 * @param {boolean} all
 */
export function veiled(parts, points, view, all) {
  const seen = points.map((point) => project(view.matrix, point, view.width, view.height));
  return parts.map((part) => {
    const clear = all ? 0 : Math.min(1, clearance(part, seen, view) / SOFT);
    const least = all && part.tone === "tool" ? FAINT : (LEAST[part.tone] ?? FAINT);
    return { ...part, strength: least + (SOLID - least) * clear };
  });
}

/**
 * How far beside the nearest point that it could cover a part is drawn [px]; 0 where it covers one.
 * @param {import("./arm.js").Tube} part
 * @param {number[][]} seen
 * @param {View} view
 */
function clearance({ model, top }, seen, { matrix, width, height, pixelsPerMm }) {
  const from = [model[12], model[13], model[14]];
  const to = from.map((v, i) => v + model[8 + i]);
  const radius = Math.hypot(model[0], model[1], model[2]);
  const [a, b] = [from, to].map((point) => project(matrix, point, width, height));
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  let least = Infinity;
  for (const [x, y, depth] of seen) {
    const along = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1);
    const share = Math.min(1, Math.max(0, along));
    const wide = radius * (1 + (top - 1) * share);
    const ahead = a[2] + (b[2] - a[2]) * share - wide;
    if (ahead > depth || ahead <= 0) continue; // behind the point, or behind the eye
    const away = Math.hypot(x - a[0] - share * dx, y - a[1] - share * dy) - (wide * pixelsPerMm) / ahead;
    least = Math.min(least, Math.max(0, away));
  }
  return least;
}
