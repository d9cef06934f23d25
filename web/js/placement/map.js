// The map as a drawing: a cell a place, coloured by its error; hatched, dotted or empty where
// something is the matter.

import { convert } from "../form/quantity.js";
import { makeSvg } from "../page/dom.js";
import { inLength, lengthUnit } from "../page/units.js";
import { colour, gradient } from "../scene/ramp.js";
import { ground, outline } from "./around.js";

/** @import { Around } from "./around.js" */

/**
 * Its largest and mean error before compensation and the 95 % quantile of the largest after it [mm], and what is wrong
 * with it, see `MARKS`.
 *
 * @typedef {{ max: number, mean: number, mark: number, p95: number }} Place
 */

/** @typedef {"max" | "p95"} Measure which error of a place counts */

/** @typedef {[column: number, row: number]} Cell */

/**
 * Columns and rows are positions [mm]; `best` and `current` are positions too, `cursor` is a cell.
 *
 * @typedef {{
 *   columns: number[],
 *   rows: number[],
 *   at(column: number, row: number): Place | null,
 *   names: string[],
 *   axes: number[],
 *   around?: Around,
 *   current: [number, number],
 *   best?: [number, number],
 *   cursor: Cell | null,
 * }} Drawn a map as it is drawn
 */

const SIZE = 600; // of the plot's longer side, in units of the drawing
const EDGE = { left: 62, right: 12, top: 10, bottom: 44 };
export const MARKS = ["", "near a singularity", "a joint leaves its range", "out of reach", "in the base or the floor"];

/**
 * What `node` is painted with: the colour of an error, `limit` being the end of the scale.
 * @param {number} error
 * @param {number} limit
 */
const paint = (error, limit) => `rgb(${colour(limit > 0 ? error / limit : 0).join(" ")})`;

export const scaleGradient = () => gradient();

/**
 * Draws a map into `svg`; returns a function that finds the cell under a point of the drawing.
 * @param {SVGElement} svg
 * @param {Drawn} map
 * @param {Measure} measure what is coloured
 * @param {number} limit the end of the scale [mm]
 * @returns {(x: number, y: number) => Cell | undefined}
 */
export function draw(svg, map, measure, limit) {
  const [nx, ny] = [map.columns.length, map.rows.length];
  const [wide, tall] = [span(map.columns), span(map.rows)];
  const scale = SIZE / Math.max(wide, tall);
  const [width, height] = [wide * scale, tall * scale];
  /** @param {number} v */
  const x = (v) => EDGE.left + ((v - map.columns[0]) / step(map.columns) + 0.5) * (width / nx);
  /** @param {number} v */
  const y = (v) => EDGE.top + height - ((v - map.rows[0]) / step(map.rows) + 0.5) * (height / ny);
  const [w, h] = [width / nx, height / ny];
  svg.setAttribute("viewBox", `0 0 ${width + EDGE.left + EDGE.right} ${height + EDGE.top + EDGE.bottom}`);
  const cells = [];
  for (let k = 0; k < ny; k++) {
    for (let i = 0; i < nx; i++) {
      const place = map.at(i, k);
      if (!place) continue;
      const box = { x: x(map.columns[i]) - w / 2, y: y(map.rows[k]) - h / 2, width: w + 0.3, height: h + 0.3 };
      if (place.mark < 3) cells.push(makeSvg("rect", { ...box, fill: paint(place[measure], limit) }));
      if (place.mark)
        cells.push(makeSvg("rect", { ...box, class: "mark", fill: `url(#placement-mark-${place.mark})` }));
    }
  }
  const frame = makeSvg("rect", { class: "frame", x: EDGE.left, y: EDGE.top, width, height });
  const ticks = [
    ...ticksOf(map.columns.map(inLength)).map((v) => label(x(mm(v)), EDGE.top + height + 16, v, "middle")),
    ...ticksOf(map.rows.map(inLength)).map((v) => label(EDGE.left - 6, y(mm(v)) + 4, v, "end")),
  ];
  const names = [
    makeSvg(
      "text",
      { x: EDGE.left + width / 2, y: EDGE.top + height + 36, "text-anchor": "middle" },
      `${map.names[0]}, ${lengthUnit()}`,
    ),
    makeSvg(
      "text",
      { x: 0, y: 0, "text-anchor": "middle", transform: `translate(13 ${EDGE.top + height / 2}) rotate(-90)` },
      `${map.names[1]}, ${lengthUnit()}`,
    ),
  ];
  /** @param {[number, number]} place */
  const inside = ([a, b]) =>
    a >= map.columns[0] - step(map.columns) / 2 &&
    a <= map.columns[nx - 1] + step(map.columns) / 2 &&
    b >= map.rows[0] - step(map.rows) / 2 &&
    b <= map.rows[ny - 1] + step(map.rows) / 2;
  const plot = { x, y, box: { x: EDGE.left, y: EDGE.top, width, height } };
  const around = makeSvg("g", { "clip-path": "url(#placement-clip)" });
  if (map.around) {
    const { around: stands, axes, cursor } = map;
    around.append(...ground(stands, axes, plot));
    if (map.best) around.append(...outline(stands, axes, map.best, plot, "best"));
    if (cursor) around.append(...outline(stands, axes, [map.columns[cursor[0]], map.rows[cursor[1]]], plot, "cursor"));
    if (Number.isFinite(map.current[0])) around.append(...outline(stands, axes, map.current, plot, "now"));
  }
  const signs = [];
  if (map.best) signs.push(diamond(x(map.best[0]), y(map.best[1])));
  if (inside(map.current)) signs.push(...cross(x(map.current[0]), y(map.current[1])));
  if (map.cursor)
    signs.push(
      makeSvg("rect", {
        class: "cursor",
        x: x(map.columns[map.cursor[0]]) - w / 2,
        y: y(map.rows[map.cursor[1]]) - h / 2,
        width: w,
        height: h,
      }),
    );
  svg.replaceChildren(patterns(plot.box), ...cells, frame, ...ticks, ...names, around, ...signs);
  return (px, py) => {
    const [i, k] = [Math.floor((px - EDGE.left) / w), Math.floor((EDGE.top + height - py) / h)];
    return i >= 0 && i < nx && k >= 0 && k < ny ? [i, k] : undefined;
  };
}

/** @param {number[]} values */
const step = (values) => (values.length > 1 ? values[1] - values[0] : 1);
/** @param {number[]} values */
const span = (values) => step(values) * values.length;

/** @param {number} length */
const mm = (length) => convert(length, lengthUnit(), "mm");

/** @param {number[]} values */
function ticksOf(values) {
  const [low, high] = [values[0], values[values.length - 1]];
  const rough = (high - low) / 5 || 1;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const every = ([1, 2, 5].find((n) => n * decade >= rough) ?? 10) * decade;
  const first = Math.ceil(low / every) * every;
  return Array.from(
    { length: Math.max(0, Math.floor((high - first) / every + 1e-9) + 1) },
    (_, n) => first + n * every,
  );
}

/**
 * @param {number} x
 * @param {number} y
 * @param {number} value
 * @param {string} anchor
 */
const label = (x, y, value, anchor) =>
  makeSvg("text", { x, y, "text-anchor": anchor }, String(Math.round(value)).replace("-", "−"));

/**
 * @param {number} x
 * @param {number} y
 */
const diamond = (x, y) => makeSvg("path", { class: "best", d: `M${x} ${y - 9}l9 9-9 9-9-9z` });

/**
 * @param {number} x
 * @param {number} y
 */
const cross = (x, y) =>
  ["under", "over"].map((layer) =>
    makeSvg("path", { class: `current ${layer}`, d: `M${x - 13} ${y}h26M${x} ${y - 13}v26` }),
  );

/** @param {Record<string, number>} box of the plot */
function patterns(box) {
  /**
   * @param {number} id
   * @param {number} size
   * @param {SVGElement[]} inside
   */
  const pattern = (id, size, ...inside) =>
    makeSvg(
      "pattern",
      { id: `placement-mark-${id}`, width: size, height: size, patternUnits: "userSpaceOnUse" },
      ...inside,
    );
  return makeSvg(
    "defs",
    {},
    pattern(1, 8, makeSvg("circle", { cx: 4, cy: 4, r: 1.4, class: "dot" })),
    pattern(
      2,
      8,
      makeSvg("path", { d: "M-2 2l4-4M0 8l8-8M6 10l4-4", class: "hatch under" }),
      makeSvg("path", { d: "M-2 2l4-4M0 8l8-8M6 10l4-4", class: "hatch" }),
    ),
    pattern(
      3,
      10,
      makeSvg("rect", { width: 10, height: 10, class: "ground" }),
      makeSvg("path", { d: "M3 5h4", class: "empty" }),
    ),
    pattern(
      4,
      10,
      makeSvg("rect", { width: 10, height: 10, class: "ground" }),
      makeSvg("path", { d: "M2.5 2.5l5 5M7.5 2.5l-5 5", class: "empty" }),
    ),
    makeSvg("clipPath", { id: "placement-clip" }, makeSvg("rect", box)),
  );
}
