// What is drawn, for those who cannot read pixels: the data attributes of the picture.

/**
 * @import { Camera } from "./camera.js"
 * @import { Part } from "./part.js"
 * @import { Paths } from "./paths.js"
 * @import { Pose } from "./pose.js"
 * @import { Stock } from "./stock.js"
 */

/**
 * Facts of a picture; `worst` is the row of the worst place that is shown, or undefined.
 * @param {{
 *   camera: Camera, paths: Paths, pose: Pose, part: Part, stock: Stock, solid: boolean, sample: number, factor: number,
 *   radius: number, worst: number | undefined,
 * }} drawn
 * @returns {Record<string, string>}
 */
export function factsOf({ camera, paths, pose, part, stock, solid, sample, factor, radius, worst }) {
  const { azimuth, elevation, distance, target } = camera;
  /** @param {number} angle */
  const degrees = (angle) => ((angle * 180) / Math.PI).toFixed(2);
  return {
    azimuth: degrees(azimuth),
    elevation: degrees(elevation),
    distance: distance.toFixed(2),
    target: target.map((v) => v.toFixed(2)).join(" "),
    sample: String(sample),
    factor: String(factor),
    points: String(paths.count),
    part: part.drawn && solid ? part.side : "none",
    stock: String(stock.given),
    triangles: String(part.triangles),
    tip: pose.frames.tcp.origin.map((v) => v.toFixed(6)).join(" "),
    beyond: pose.beyond.join(" "),
    tube: radius.toFixed(3),
    worst: worst === undefined ? "none" : String(paths.sample(worst)),
  };
}
