// The view "Placement": where on the table, the wall or the track the part would come out best.

import { extent } from "../core/client.js";
import { byId, debounced, make, makeSvg } from "../page/dom.js";
import { numberCell } from "../form/number-cell.js";
import { shownUnit, shownValue } from "../form/shown.js";
import { formatNumber, plainNumber } from "../page/number.js";
import { onSetting } from "../page/settings.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { legendItems } from "./legend.js";
import { MARKS, draw, scaleGradient } from "./map.js";
import { survey } from "./pool.js";

/**
 * @import { Present } from "../identify/panel.js"
 * @import { Cell, Drawn } from "./map.js"
 */

/**
 * A map, the job and ranges it belongs to, and its plane.
 *
 * @typedef {Drawn & { key: string | null, axes: number[], fixed: number }} Surveyed
 */

const AXES = ["x", "y", "z"];
/** @type {Record<string, [number, number, number]>} */
const PLANES = { xy: [0, 1, 2], xz: [0, 2, 1], yz: [1, 2, 0] };
const STEPS = [11, 21, 31, 41];
const CALM_MS = 400;

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
  /** @type {[number, number][] | null} */
  let ranges = null; // smallest and largest x, y, z worth a look, by the core
  let typed = false;

  const plane = select("placement-plane", { xy: "x and y", xz: "x and z", yz: "y and z" });
  const steps = select("placement-steps", Object.fromEntries(STEPS.map((n) => [n, `${n} × ${n}`])));
  steps.value = "21";
  const cells = ["a-from", "a-to", "b-from", "b-to", "at"].map((id) => numberCell(`placement-${id}`, "mm"));
  const numbers = cells.map(({ input }) => input);
  const labels = numbers.map((input) => make("label", { for: input.id }));
  const understood = numbers.map((input) => make("output", { className: "understood", htmlFor: input.id }));
  const fields = make(
    "div",
    { className: "placement-fields" },
    .../** @type {[string, HTMLElement][]} */ ([
      ["Plane", plane],
      ["Steps", steps],
    ]).map(([text, input]) => make("div", {}, make("label", { for: input.id }, text), input)),
    ...numbers.map((input, i) => make("div", {}, labels[i], input, understood[i])),
  );
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
    "Click a cell to place the part there; undo moves it back. Arrow keys move over the cells, Enter places the part.",
  );
  node.replaceChildren(
    fields,
    make("div", { className: "placement-actions" }, again, cancel, whole, bar),
    status,
    make(
      "div",
      { className: "placement-view" },
      svg,
      make("div", { className: "placement-side" }, verdict, best, scale, legend, read),
    ),
    keys,
    details,
  );

  const axes = () => PLANES[plane.value];
  const place = () => job().workpiece_frame.xyz_mm;

  /** The labels of the plane, and its ranges where none are typed. */
  function fill() {
    const [a, b, fixed] = axes().map((axis) => AXES[axis]);
    [`${a} from`, `${a} to`, `${b} from`, `${b} to`, `At ${fixed}`].forEach((text, i) =>
      labels[i].replaceChildren(text, " ", make("span", { className: "unit" }, shownUnit("mm"))),
    );
    if (typed || !ranges) return;
    const [i, k, rest] = axes();
    [...ranges[i], ...ranges[k], place()[rest]].forEach((value, n) => cells[n].write(value));
  }

  async function look() {
    if (byId("panel-placement").hidden || !job()) return;
    try {
      const all = await extent(JSON.stringify(job()));
      ranges = AXES.map((_, axis) => [Math.floor(all[2 * axis] / 50) * 50, Math.ceil(all[2 * axis + 1] / 50) * 50]);
    } catch (error) {
      return error.code === "cancelled" ? undefined : say(`No map: ${error.message}`);
    }
    fill();
    compute();
  }

  /** What the five fields hold [mm], and what is wrong with each. */
  function readCells() {
    /** @type {number[]} */
    const values = [];
    /** @type {string[]} */
    const mistakes = [];
    cells.forEach((cell, i) => {
      try {
        values[i] = cell.read();
      } catch ({ message }) {
        mistakes[i] = message;
      }
      const read = mistakes[i] ? "" : cell.understood();
      understood[i].textContent = read && `= ${read}`;
    });
    return { values, mistakes: Array.from(mistakes) };
  }

  async function compute(always = false) {
    const { values, mistakes } = readCells();
    const turned = values[0] >= values[1] ? 1 : values[2] >= values[3] ? 3 : -1;
    numbers.forEach((input, i) =>
      mistakes[i] || i === turned ? input.setAttribute("aria-invalid", "true") : input.removeAttribute("aria-invalid"),
    );
    const wrong = mistakes.findIndex(Boolean);
    if (wrong >= 0) return say(`${labels[wrong].textContent}: ${mistakes[wrong]}`);
    if (turned >= 0) return say(`${labels[turned].textContent}: enter more than the start.`);
    const { workpiece_frame: frame, ...others } = job();
    const xyz = frame.xyz_mm;
    // The map does not depend on where the part is now.
    const json = JSON.stringify({ ...others, workpiece_frame: { ...frame, xyz_mm: [0, 0, 0] } });
    const key = JSON.stringify([json, plane.value, steps.value, values]);
    if (map?.key === key && !always) return show();
    cursor = null;
    running?.abort();
    const mine = (running = new AbortController());
    const count = Number(steps.value);
    /**
     * @param {number} from
     * @param {number} to
     */
    const line = (from, to) => Array.from({ length: count }, (_, n) => from + ((to - from) * n) / (count - 1));
    const [i, k, rest] = axes();
    const [columns, rows] = [line(values[0], values[1]), line(values[2], values[3])];
    const bands = rows.map((row) =>
      Float64Array.from(
        columns.flatMap((column) => {
          const at = [0, 0, 0];
          [at[i], at[k], at[rest]] = [column, row, values[4]];
          return at;
        }),
      ),
    );
    /** @type {(Float64Array | null)[]} */
    const found = rows.map(() => null);
    /**
     * @param {number} column
     * @param {number} row
     */
    const at = (column, row) => {
      const numbers = found[row];
      if (!numbers) return null;
      const [max, mean, mark] = numbers.subarray(3 * column, 3 * column + 3);
      return { max, mean, mark };
    };
    const names = [AXES[i], AXES[k]];
    map = {
      key: null,
      axes: [i, k, rest],
      fixed: values[4],
      columns,
      rows,
      at,
      names,
      current: [xyz[i], xyz[k]],
      cursor,
    };
    cancel.disabled = bar.hidden = false;
    bar.value = 0;
    say("Computing the map…");
    const began = performance.now();
    let done = 0;
    try {
      await survey(
        json,
        bands,
        (index, numbers) => {
          if (mine !== running) return;
          found[index] = numbers;
          bar.value = ++done / rows.length;
          soon();
        },
        mine.signal,
      );
      if (mine !== running) return;
      map.key = key;
      say(`${count * count} places in ${formatNumber((performance.now() - began) / 1000, 2)} s.`);
    } catch (error) {
      if (mine !== running) return;
      say(error.code === "cancelled" ? "Cancelled; what was computed is shown." : `No map: ${error.message}`);
    }
    running = null;
    cancel.disabled = bar.hidden = true;
    show();
  }

  /** @param {string} text */
  const say = (text) => (status.textContent = text);
  const soon = debounced(() => show(), 60);

  function show() {
    if (!map) return;
    const { rows, columns, at } = map;
    const places = rows.flatMap((_, k) =>
      columns.flatMap((_, i) => {
        const place = at(i, k);
        return place ? [{ i, k, ...place }] : [];
      }),
    );
    const errors = places
      .filter(({ mark }) => mark < 3)
      .map(({ max }) => max)
      .sort((a, b) => a - b);
    // A few places near singularities would take the whole scale.
    const limit = errors[Math.floor(0.95 * (errors.length - 1))] ?? 0;
    const good = places.filter(({ mark }) => mark === 0).sort((a, b) => a.max - b.max);
    const top = good[0];
    const xyz = place();
    const [i, k, rest] = map.axes;
    map.best = top && [map.columns[top.i], map.rows[top.k]];
    map.current = [xyz[i], xyz[k]];
    map.cursor = cursor;
    if (Math.abs(xyz[rest] - map.fixed) > 1e-9) map.current = [NaN, NaN];
    pick = draw(svg, map, limit);
    ramp.style.setProperty("background", scaleGradient());
    low.textContent = "0";
    high.textContent = `${lengthText(limit)} ${lengthUnit()} and more`;
    verdict.textContent = top
      ? `Best on this map: ${spot(top.i, top.k)}, at most ${lengthText(top.max)} ${lengthUnit()} off the path before compensation.`
      : errors.length
        ? "Every place on this map violates a limit or is near a singularity."
        : running
          ? ""
          : "No place on this map is within reach.";
    best.disabled = !top;
    best.onclick = () => top && put(top.i, top.k);
    tell();
    if (details.open) fillTable();
  }

  /**
   * A coordinate to a tenth of a millimetre or a hundredth of an inch.
   * @param {number} mm
   */
  const coordinate = (mm) => {
    const places = shownUnit("mm") === "mm" ? 10 : 100;
    return plainNumber(Math.round(shownValue(mm, "mm") * places) / places);
  };

  /**
   * @param {number} i
   * @param {number} k
   */
  const spot = (i, k) => {
    if (!map) return "";
    const { axes, columns, rows } = map;
    return `${AXES[axes[0]]} ${coordinate(columns[i])}, ${AXES[axes[1]]} ${coordinate(rows[k])} ${shownUnit("mm")}`;
  };

  function tell() {
    const at = cursor && map?.at(...cursor);
    if (!cursor || !at) return void (read.textContent = "");
    const what =
      at.mark === 3
        ? MARKS[3]
        : `at most ${lengthText(at.max)} ${lengthUnit()}, mean ${lengthText(at.mean)}${at.mark ? `; ${MARKS[at.mark]}` : ""}`;
    read.textContent = `${spot(...cursor)}: ${what}.`;
  }

  /**
   * @param {number} i
   * @param {number} k
   */
  function put(i, k) {
    if (!map) return;
    const next = job();
    const xyz = [...next.workpiece_frame.xyz_mm];
    /** @param {number} v */
    const round = (v) => Math.round(v * 1000) / 1000;
    [xyz[map.axes[0]], xyz[map.axes[1]], xyz[map.axes[2]]] = [round(map.columns[i]), round(map.rows[k]), map.fixed];
    use({ ...next, workpiece_frame: { ...next.workpiece_frame, xyz_mm: xyz } });
    say(`The part is at ${spot(i, k)}; undo moves it back.`);
    show();
  }

  function fillTable() {
    if (!map) return;
    const { at, columns } = map;
    const head = make(
      "tr",
      {},
      make("th", { scope: "col" }, `${map.names?.[1] ?? ""} \\ ${map.names?.[0] ?? ""}, ${shownUnit("mm")}`),
      ...map.columns.map((v) => make("th", { scope: "col" }, coordinate(v))),
    );
    const short = ["", " ·", " ⁄", "–"];
    const body = map.rows.map((row, k) =>
      make(
        "tr",
        {},
        make("th", { scope: "row" }, coordinate(row)),
        ...columns.map((_, i) => {
          const place = at(i, k);
          return make(
            "td",
            { title: place ? MARKS[place.mark] : "" },
            !place ? "" : place.mark === 3 ? short[3] : lengthText(place.max) + short[place.mark],
          );
        }),
      ),
    );
    table.replaceChildren(
      make(
        "caption",
        {},
        `Largest error before compensation, ${lengthUnit()}; · near a singularity, ⁄ a joint leaves its range, – out of reach`,
      ),
      make("thead", {}, head),
      make("tbody", {}, ...body.reverse()),
    );
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
    if (cell && map?.at(...cell)) put(...cell);
  });
  svg.addEventListener("keydown", (event) => {
    if (!map) return;
    /** @type {[number, number] | undefined} */
    const move = /** @type {any} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] })[
      event.key
    ];
    if (event.key === "Enter" && cursor && map.at(...cursor)) return put(...cursor);
    if (!move) return;
    event.preventDefault();
    const from = cursor ?? [Math.floor(map.columns.length / 2), Math.floor(map.rows.length / 2)];
    cursor = [clamp(from[0] + move[0], map.columns.length), clamp(from[1] + move[1], map.rows.length)];
    show();
  });
  plane.addEventListener("change", () => ((typed = false), fill(), compute()));
  steps.addEventListener("change", () => compute());
  const edited = debounced(() => compute(), CALM_MS);
  for (const input of numbers) input.addEventListener("input", () => ((typed = true), edited()));
  again.addEventListener("click", () => compute(true));
  whole.addEventListener("click", () => ((typed = false), fill(), compute()));
  cancel.addEventListener("click", () => running?.abort());
  details.addEventListener("toggle", () => details.open && fillTable());
  onSetting(() => {
    for (const cell of cells) cell.relabel();
    fill();
    if (map) show();
  });
  return { look };
}

/**
 * @param {number} value
 * @param {number} count
 */
const clamp = (value, count) => Math.min(count - 1, Math.max(0, value));

/**
 * @param {string} id
 * @param {Record<string, string>} words
 */
function select(id, words) {
  return make("select", { id }, ...Object.entries(words).map(([value, text]) => make("option", { value }, text)));
}
