// The view "Placement": where on the table, the wall or the track the part would come out best.

import * as core from "../core/client.js";
import { byId, debounced, make, makeSvg } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { onSetting } from "../page/settings.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { aroundOf, isInFloor, sideOf } from "./around.js";
import { makeChoices } from "./choices.js";
import { AXES, gridOf, markFloor, placeAt, placeIn, ranked } from "./grid.js";
import { legendItems } from "./legend.js";
import { draw, scaleGradient } from "./map.js";
import { survey } from "./pool.js";
import { makeRanges } from "./ranges.js";
import { tableParts } from "./table.js";
import { makeTurn } from "./turn.js";
import { layerName, prospect, reaches, sized, spot } from "./words.js";

/**
 * @import { Present } from "../identify/panel.js"
 * @import { Around } from "./around.js"
 * @import { Layer, Ranked } from "./grid.js"
 * @import { Cell, Drawn, Place } from "./map.js"
 */

/**
 * A map, the job and ranges it belongs to, its layers, and what was found where the part is now.
 *
 * @typedef {Drawn & { key: string | null, layers: Layer[], now?: Place }} Surveyed
 */

const SAME = 1 + 1e-6; // a place rounded to the job's digits differs from itself by that

/**
 * Builds the view into `node`; `job()` is the present one, `use(job)` shows another (and can be
 * undone).
 * @param {HTMLElement} node
 * @param {Present} present
 */
export function makePlacement(node, { job, use }) {
  /** @type {Surveyed | null} */
  let map = null;
  /** @type {((x: number, y: number) => Cell | undefined) | null} */
  let pick = null; // from a point of the drawing to a cell
  /** @type {Cell | null} */
  let cursor = null;
  /** @type {AbortController | null} */
  let running = null; // AbortController of the map being computed
  /** @type {Around | undefined} */
  let around; // of the present job

  const place = () => job().workpiece_frame.xyz_mm;
  const ranges = makeRanges(place, () => compute());
  const choices = makeChoices(() => show());
  const turn = makeTurn({ job, use }, choices.measure);
  ranges.node.append(...choices.fields);
  const again = make("button", { type: "button", id: "placement-compute" }, "Compute the map");
  const cancel = make("button", { type: "button", id: "placement-cancel", disabled: true }, "Cancel");
  const whole = make("button", { type: "button", className: "quiet", id: "placement-reset" }, "Whole reach");
  const bar = make("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the map" });
  const status = make("p", { id: "placement-status", role: "status" });
  const svg = makeSvg("svg", {
    id: "placement-map",
    role: "application",
    tabindex: "0",
    "aria-roledescription": "map",
    "aria-label": "Predicted error over places of the part",
    "aria-describedby": "placement-keys placement-read",
  });
  const read = make("p", { id: "placement-read", role: "status" });
  const ramp = make("div", { className: "bar" });
  const [low, high] = ["low", "high"].map((className) => make("span", { className }));
  const scale = make("div", { className: "placement-scale" }, ramp, low, high);
  const legend = make("ul", { className: "placement-legend" }, ...legendItems());
  const verdict = make("p", { id: "placement-verdict" });
  const best = make(
    "button",
    { type: "button", id: "placement-best", className: "primary", disabled: true },
    "Place the part at the best",
  );
  const table = make("table", { id: "placement-table" });
  const details = make(
    "details",
    { className: "placement-values" },
    make("summary", {}, "As a table"),
    make("div", { className: "scroll" }, table),
  );
  const keys = make(
    "p",
    { id: "placement-keys", className: "hint" },
    "The axes count the zero of the workpiece frame; the outlines are the part. Click a cell to place the part there; " +
      "undo moves it back. Arrow keys move over the cells, Enter places the part.",
  );
  node.replaceChildren(
    ranges.node,
    make("div", { className: "placement-actions" }, again, cancel, whole, bar),
    status,
    make(
      "div",
      { className: "placement-view" },
      svg,
      make(
        "div",
        { className: "placement-side" },
        verdict,
        best,
        choices.layerField,
        scale,
        legend,
        read,
        ...turn.nodes,
      ),
    ),
    keys,
    details,
  );

  async function look() {
    if (byId("panel-placement").hidden || !job()) return;
    turn.look();
    try {
      const json = JSON.stringify(job());
      const all = await core.extent(json);
      around = aroundOf(await core.around(json));
      choices.offerSide(sideOf(around, job(), place()));
      ranges.offer(
        AXES.map((_, axis) => [Math.floor(all[2 * axis] / 50) * 50, Math.ceil(all[2 * axis + 1] / 50) * 50]),
      );
    } catch (error) {
      return error.code === "cancelled" ? undefined : say(`No map: ${error.message}`);
    }
    compute();
  }

  async function compute(always = false) {
    const asked = ranges.read();
    if (typeof asked === "string") return say(asked);
    const { plane, axes, values, count, across } = asked;
    const { workpiece_frame: frame, ...others } = job();
    const xyz = frame.xyz_mm;
    // The map does not depend on where the part is now.
    const json = JSON.stringify({ ...others, workpiece_frame: { ...frame, xyz_mm: [0, 0, 0] } });
    const key = JSON.stringify([json, plane, count, values, across]);
    if (map?.key === key && !always) return restate(json, xyz);
    cursor = null;
    running?.abort();
    const mine = (running = new AbortController());
    const grids = across.map((fixed) => gridOf(axes, [...values.slice(0, 4), fixed], count));
    const bands = grids.flatMap((grid) => grid.bands);
    const { columns, rows } = grids[0];
    /** @type {Layer[]} */
    const layers = across.map((fixed) => ({ fixed, found: rows.map(() => null) }));
    const [i, k] = axes;
    map = {
      key: null,
      axes,
      layers,
      columns,
      rows,
      at: (column, row) => placeAt(layers[choices.layer()].found, column, row),
      names: [AXES[i], AXES[k]],
      current: [xyz[i], xyz[k]],
      cursor,
    };
    offerLayers(map, Math.floor(layers.length / 2));
    cancel.disabled = bar.hidden = false;
    bar.value = 0;
    say("Computing the map…");
    const began = performance.now();
    let done = 0;
    try {
      await survey(
        json,
        [...bands, Float64Array.from(xyz)],
        (index, numbers) => {
          if (mine !== running) return;
          // A part that is lower than the floor now has room there: the robot stands on something.
          const floor = around;
          if (floor && !isInFloor(floor, xyz[2]) && index < bands.length)
            markFloor(numbers, (n) => isInFloor(floor, bands[index][3 * n + 2]));
          if (map && index === bands.length) map.now = placeIn(numbers, 0);
          else layers[Math.floor(index / rows.length)].found[index % rows.length] = numbers;
          bar.value = ++done / (bands.length + 1);
          soon();
        },
        mine.signal,
      );
      if (mine !== running) return;
      map.key = key;
      const { best } = bestOf(map);
      if (best) choices.showLayer(best.layer);
      say(`${count * count * layers.length} places in ${formatNumber((performance.now() - began) / 1000, 2)} s.`);
    } catch (error) {
      if (mine !== running) return;
      say(error.code === "cancelled" ? "Cancelled; what was computed is shown." : `No map: ${error.message}`);
    }
    running = null;
    cancel.disabled = bar.hidden = true;
    show();
  }

  /**
   * @param {Surveyed} map
   * @param {number} shown
   */
  const offerLayers = (map, shown) =>
    choices.offerLayers(
      map.layers.map((_, n) => layerName(map, n)),
      shown,
    );

  /**
   * Finds out about another place of the part on the same map.
   * @param {string} json
   * @param {number[]} xyz
   */
  async function restate(json, xyz) {
    const mine = map;
    if (mine) mine.now = undefined;
    show();
    const keep = (/** @type {number} */ _, /** @type {Float64Array} */ numbers) => {
      if (mine && mine === map) mine.now = placeIn(numbers, 0);
    };
    await survey(json, [Float64Array.from(xyz)], keep, new AbortController().signal).catch(() => {});
    show();
  }

  /** @param {string} text */
  const say = (text) => (status.textContent = text);
  const soon = debounced(() => show(), 60);

  /**
   * The position of one of a map's places [mm].
   * @param {Surveyed} map
   * @param {{ i: number, k: number, layer: number }} which
   */
  function positionOf(map, { i, k, layer }) {
    const xyz = [0, 0, 0];
    [map.columns[i], map.rows[k], map.layers[layer].fixed].forEach((value, n) => (xyz[map.axes[n]] = value));
    return xyz;
  }

  /**
   * The best place on the side to stay on, and the end of the scale.
   * @param {Surveyed} map
   */
  function bestOf(map) {
    const side = choices.side();
    return ranked(
      map,
      choices.measure(),
      (each) => side === "any" || !around || sideOf(around, job(), positionOf(map, each)) === side,
    );
  }

  function show() {
    if (!map) return;
    const measure = choices.measure();
    const layer = choices.layer();
    const { best: top, limit } = bestOf(map);
    const end = limit ?? 0;
    const xyz = place();
    const [i, k, rest] = map.axes;
    map.around = around;
    map.best = top?.layer === layer ? [map.columns[top.i], map.rows[top.k]] : undefined;
    map.current = [xyz[i], xyz[k]];
    map.cursor = cursor;
    if (Math.abs(xyz[rest] - map.layers[layer].fixed) > 1e-9) map.current = [NaN, NaN];
    pick = draw(svg, map, measure, end);
    ramp.style.setProperty("background", scaleGradient());
    low.textContent = "0";
    high.textContent = `${lengthText(end)} ${lengthUnit()} and more`;
    const { now } = map;
    const better = top && !(now?.mark === 0 && now[measure] <= top[measure] * SAME);
    verdict.textContent = top
      ? better
        ? `Best on this map${choices.sideWords()}: ${sized(spot(map, top.i, top.k, top.layer), top, measure)}.`
        : `${sized(`No place on this map is better${choices.sideWords()} than where the part is`, /** @type {Place} */ (now), measure)}.`
      : limit !== undefined
        ? `Every place on this map${choices.sideWords()} violates a limit or is near a singularity.`
        : running
          ? ""
          : "No place on this map is within reach.";
    best.disabled = !better || running !== null; // until all are there, a better one may come
    best.onclick = () => top && put(top);
    tell();
    if (details.open) fillTable();
  }

  function tell() {
    const at = cursor && map?.at(...cursor);
    if (!map || !cursor || !at) return void (read.textContent = "");
    const [i, k] = cursor;
    const part = around ? `; the part ${reaches(around, map.axes, [map.columns[i], map.rows[k]])}` : "";
    read.textContent = `${spot(map, i, k, choices.layer())}${part}: ${prospect(at)}.`;
  }

  /** @param {{ i: number, k: number, layer: number }} which */
  function put(which) {
    if (!map) return;
    const next = job();
    const xyz = positionOf(map, which).map((v) => Math.round(v * 1000) / 1000);
    use({ ...next, workpiece_frame: { ...next.workpiece_frame, xyz_mm: xyz } });
    say(`The part is at ${spot(map, which.i, which.k, which.layer)}; undo moves it back.`);
    show();
  }

  /** @param {Cell} cell of the layer that is shown */
  const putAt = ([i, k]) => put({ i, k, layer: choices.layer() });

  function fillTable() {
    if (map) table.replaceChildren(...tableParts(map, choices.measure()));
  }

  /** @param {MouseEvent} event */
  const cellAt = (event) => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM()?.inverse());
    return pick?.(point.x, point.y);
  };
  svg.addEventListener("pointermove", (event) => {
    const cell = cellAt(event);
    if (String(cell) === String(cursor)) return;
    cursor = cell ?? null;
    if (map) show();
  });
  svg.addEventListener("click", (event) => {
    const cell = cellAt(event);
    if (cell && map?.at(...cell)) putAt(cell);
  });
  svg.addEventListener("keydown", (event) => {
    if (!map) return;
    /** @type {[number, number] | undefined} */
    const move = /** @type {any} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] })[
      event.key
    ];
    if (event.key === "Enter" && cursor && map.at(...cursor)) return putAt(cursor);
    if (!move) return;
    event.preventDefault();
    const from = cursor ?? [Math.floor(map.columns.length / 2), Math.floor(map.rows.length / 2)];
    cursor = [clamp(from[0] + move[0], map.columns.length), clamp(from[1] + move[1], map.rows.length)];
    show();
  });
  again.addEventListener("click", () => compute(true));
  whole.addEventListener("click", () => ranges.whole());
  cancel.addEventListener("click", () => running?.abort());
  details.addEventListener("toggle", () => details.open && fillTable());
  onSetting(() => {
    ranges.relabel();
    if (!map) return;
    offerLayers(map, choices.layer());
    show();
  });
  return { look };
}

/**
 * @param {number} value
 * @param {number} count
 */
const clamp = (value, count) => Math.min(count - 1, Math.max(0, value));
