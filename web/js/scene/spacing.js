// How far apart the passes of a path are.

import { length, plus } from "./camera.js";

/** @import { Vector } from "./camera.js" */

const LOOKS = 100; // places where it is measured
const DETOUR = 3; // so many times as far along the path as straight: another pass
const SAME = 0.05; // passes nearer than this lie on each other [mm]
const PARTED = 1e9; // the way along a rapid move: what it parts are always two passes [mm]

/**
 * The distance between neighbouring passes of a path [mm], from its points in order, with null for a
 * rapid move: from a place straight to another leg, where the way along the path is far longer. It
 * is the median over places, for where passes cross or touch the distance falls to zero.
 * @param {(Vector | null)[]} points
 */
export function spacingOf(points) {
  const along = [0];
  for (let i = 1; i < points.length; i++) {
    const [a, b] = [points[i - 1], points[i]];
    along.push(along[i - 1] + (a && b ? length(plus(b, a, -1)) : PARTED));
  }
  const step = Math.max(1, Math.floor(points.length / LOOKS));
  const nearest = [];
  for (let i = 0; i < points.length; i += step) {
    const here = points[i];
    if (!here) continue;
    let least = Infinity;
    for (let k = 1; k < points.length; k++) {
      const [from, to] = [points[k - 1], points[k]];
      if (!from || !to) continue;
      const way = toLeg(here, from, to);
      const detour = k > i ? along[k - 1] - along[i] : along[i] - along[k];
      if (way > SAME && way < least && detour > DETOUR * way) least = way;
    }
    nearest.push(least);
  }
  return nearest.sort((a, b) => a - b)[nearest.length >> 1] ?? Infinity;
}

/**
 * The distance of a point from a leg between two others.
 * @param {Vector} point
 * @param {Vector} from
 * @param {Vector} to
 */
function toLeg(point, from, to) {
  const [wx, wy, wz] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const [x, y, z] = [point[0] - from[0], point[1] - from[1], point[2] - from[2]];
  const share = Math.min(1, Math.max(0, (x * wx + y * wy + z * wz) / (wx * wx + wy * wy + wz * wz || 1)));
  return Math.hypot(x - share * wx, y - share * wy, z - share * wz);
}
