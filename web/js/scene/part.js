// The part as it is cut in the picture: its mesh, which the core makes when it is first looked at, before or after
// compensation, and the scale of its colours.

import * as core from "../core/client.js";
import { make } from "../page/dom.js";
import { inLength, lengthText, lengthUnit } from "../page/units.js";
import { plus } from "./camera.js";
import { gradient, texels } from "./diverging.js";
import { PartPainter } from "./part-gl.js";

/**
 * @import { PartMesh, Summary } from "../../pkg/armill.js"
 * @import { Frame } from "./arm.js"
 * @import { Uniforms } from "./gl.js"
 */

const SIDES = [
  ["before", "Before", "The part without compensation"],
  ["after", "After", "The part after compensation"],
];

export class Part {
  side = "before";
  largest = 0; // deviation at the ends of the scale [mm]
  #changed;
  /** @type {PartPainter | null} */
  #painter = null;
  /** @type {PartMesh | null} */
  #mesh = null;
  /** @type {number[][]} */
  #box = []; // corners of the part in its frame
  #buttons;
  #bar = make("div", { className: "bar" });
  #ends = [make("span"), make("span", { className: "middle" }, "0"), make("span")];
  #unit = make("span");

  /**
   * `changed(first)` is called when another picture is due; `first` if there was no part before.
   * @param {(first?: boolean) => void} changed
   */
  constructor(changed) {
    this.#changed = changed;
    this.#buttons = SIDES.map(([side, label, title]) => {
      const button = make("button", { type: "button", title, "data-side": side }, label);
      button.addEventListener("click", () => this.#choose(side));
      return button;
    });
    this.node = make(
      "div",
      { className: "as-cut", hidden: true },
      make("div", { className: "sides", role: "group", "aria-label": "Part to show" }, ...this.#buttons),
      make(
        "div",
        { className: "deviations" },
        make("p", {}, make("span", {}, "too little"), this.#unit, make("span", {}, "too much")),
        this.#bar,
        make("p", {}, ...this.#ends),
      ),
    );
    this.#press();
  }

  /**
   * Offers the part of a result, if it has one, and frees that of the result before.
   * @param {Summary} summary
   */
  offer({ surface }) {
    this.#mesh = null;
    this.#painter?.clear();
    this.node.hidden = !surface;
    // Until the mesh is there, about what its scale will be.
    this.#scale(Math.max(surface?.worst_before_mm ?? 0, surface?.worst_after_mm ?? 0));
  }

  get offered() {
    return !this.node.hidden;
  }

  get drawn() {
    return Boolean(this.#mesh);
  }

  /** The number of its triangles. */
  get triangles() {
    return (this.#mesh?.triangles.length ?? 0) / 3;
  }

  /**
   * Fetches the mesh of the shown result; `isCurrent()` tells whether that is still the one to show.
   * @param {() => boolean} isCurrent
   */
  async load(isCurrent) {
    if (this.#mesh || !this.offered) return;
    const mesh = await core.partMesh();
    if (!isCurrent() || !this.offered) return;
    this.#mesh = mesh;
    this.#scale(mesh.largest_mm);
    this.#painter?.take(mesh);
    this.#box = boxOf(mesh.places_mm);
    this.#changed(true);
  }

  /**
   * The corners of the part; `frame` is the workpiece's.
   * @param {Frame} frame
   */
  corners({ origin, x, y, z }) {
    /** @param {number[]} place */
    const place = ([a, b, c]) => plus(plus(plus(origin, x, a), y, b), z, c);
    return this.#mesh ? this.#box.map(place) : [];
  }

  /**
   * Draws with another WebGL, or with none.
   * @param {WebGL2RenderingContext | null | undefined} gl
   */
  drawWith(gl) {
    this.#painter = gl ? new PartPainter(gl) : null;
    if (this.#mesh) this.#painter?.take(this.#mesh);
  }

  /** @param {boolean} dark */
  recolour(dark) {
    /** @type {HTMLElement | null} */ (this.node.closest(".scene"))?.style.setProperty("--deviations", gradient(dark));
    this.#painter?.colours(texels(dark));
    this.#scale(this.largest);
  }

  /** @param {Uniforms} style */
  draw(style) {
    this.#painter?.draw(this.side, { ...style, largest: this.largest || 1 });
  }

  /** @param {string} side */
  #choose(side) {
    this.side = side;
    this.#press();
    this.#changed();
  }

  #press() {
    for (const button of this.#buttons) button.setAttribute("aria-pressed", String(button.dataset.side === this.side));
  }

  /** @param {number} largest [mm] */
  #scale(largest) {
    this.largest = largest;
    const [low, , high] = this.#ends;
    low.textContent = `\u2212${lengthText(largest)}`;
    high.textContent = lengthText(largest);
    this.#unit.textContent = `Surface, ${lengthUnit()}`;
    this.#bar.dataset.largest = String(inLength(largest));
  }
}

/**
 * The eight corners of the box around places.
 * @param {Float32Array} places
 */
function boxOf(places) {
  const ends = [0, 1, 2].map((axis) => [Infinity, -Infinity]);
  for (let i = 0; i < places.length; i++) {
    const end = ends[i % 3];
    end[0] = Math.min(end[0], places[i]);
    end[1] = Math.max(end[1], places[i]);
  }
  return Array.from({ length: 8 }, (_, corner) => ends.map((end, axis) => end[(corner >> axis) & 1]));
}

/**
 * A frame of the core as a matrix, column by column.
 * @param {Frame} frame
 */
export const matrixOf = ({ origin, x, y, z }) => new Float32Array([...x, 0, ...y, 0, ...z, 0, ...origin, 1]);
