// What the marks of the map mean.

import { make, makeSvg } from "../page/dom.js";
import { MARKS } from "./map.js";

/** The marks of the map, each with its meaning. */
export function legendItems() {
  /** @param {SVGElement[]} inside */
  const sample = (...inside) => makeSvg("svg", { viewBox: "0 0 20 20", "aria-hidden": "true" }, ...inside);
  /** @param {number} n */
  const mark = (n) =>
    sample(
      makeSvg("rect", { class: `swatch mark-${n}`, width: 20, height: 20 }),
      makeSvg("rect", { class: "mark", width: 20, height: 20, fill: `url(#placement-mark-${n})` }),
    );
  /**
   * @param {string} name
   * @param {string} d
   */
  const path = (name, d) =>
    sample(...["under", "over"].map((layer) => makeSvg("path", { class: `${name} ${layer}`, d })));
  return [
    [path("current", "M2 10h16M10 2v16"), "the part now"],
    [path("best", "M10 2l8 8-8 8-8-8z"), "best place"],
    [mark(1), MARKS[1]],
    [mark(2), MARKS[2]],
    [mark(3), MARKS[3]],
    [mark(4), MARKS[4]],
  ].map(([picture, text]) => make("li", {}, picture, text));
}
