// Where the picture is looked at from: a side, and what is fitted into it, until the camera is moved by hand.

import { armPoints } from "./arm.js";
import { Camera, VIEWS } from "./camera.js";

/**
 * @import { Frames } from "./arm.js"
 * @import { Vector } from "./camera.js"
 */

/** @type {Record<string, string>} */
const KEYS = { 1: "top", 2: "front", 3: "side", 4: "iso", 5: "tool", f: "fit", a: "all", 0: "fit" };

/**
 * What a key looks at, or undefined.
 * @param {string} key
 * @returns {string | undefined}
 */
export const viewOf = (key) => KEYS[key.toLowerCase()];

export class Viewpoint {
  camera = new Camera();
  fitted = "fit"; // what was fitted last: the path, or "all" with the arm
  steered = false; // whether the camera was moved by hand since it showed all

  constructor() {
    this.camera.look(VIEWS.iso);
  }

  /**
   * Looks from a side, or (`fit`, `all`) shows the part or the arm too from where one looks: all `points`, and
   * `edges` left free.
   * @param {string} name
   * @param {Frames} frames of the arm's pose
   * @param {Vector[]} points
   * @param {{ above: number, below: number }} edges
   */
  look(name, frames, points, edges) {
    if (name === "fit" || name === "all") this.fitted = name;
    else if (name === "tool") this.camera.lookFrom(frames.tcp.z.map((v) => -v));
    else this.camera.look(VIEWS[name]);
    if (name === "top" || name === "tool") this.fitted = "fit";
    this.steered = false;
    this.camera.fit(this.fitted === "all" ? [...points, ...armPoints(frames)] : points, edges);
  }
}
