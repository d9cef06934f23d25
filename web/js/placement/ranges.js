// The fields that say which places a map has: its plane, the steps along its sides and its ranges.

import { numberCell } from "../form/number-cell.js";
import { shownUnit } from "../form/shown.js";
import { debounced, make, select } from "../page/dom.js";
import { AXES } from "./grid.js";
import { coordinate } from "./words.js";

/** @type {Record<string, [number, number, number]>} */
const PLANES = { xy: [0, 1, 2], xz: [0, 2, 1], yz: [1, 2, 0] };
const STEPS = [11, 21, 31, 41];
const CALM_MS = 400;
const APART_MM = 100; // of several layers

/**
 * What is asked for: `axes` of columns and rows and the one across the plane, `values` [mm] of the five fields,
 * `count` of the places along a side, and the positions `across` [mm] of the layers.
 *
 * @typedef {{ plane: string, axes: [number, number, number], values: number[], count: number, across: number[] }} MapRequest
 */

/**
 * The fields; `place()` is where the part is [mm], `changed()` is called after an edit.
 * @param {() => number[]} place
 * @param {() => void} changed
 */
export function makeRanges(place, changed) {
  /** @type {[number, number][] | null} */
  let reach = null; // smallest and largest x, y, z worth a look
  let typed = false;

  const plane = select("placement-plane", { xy: "x and y", xz: "x and z", yz: "y and z" });
  const steps = select("placement-steps", Object.fromEntries(STEPS.map((n) => [n, `${n} × ${n}`])));
  steps.value = "21";
  const layers = select("placement-layers", { 1: "1", 3: "" });
  const layersLabel = make("label", { for: layers.id });
  const cells = ["a-from", "a-to", "b-from", "b-to", "at"].map((id) => numberCell(`placement-${id}`, "mm"));
  const numbers = cells.map(({ input }) => input);
  const labels = numbers.map((input) => make("label", { for: input.id }));
  const understood = numbers.map((input) => make("output", { className: "understood", htmlFor: input.id }));
  const node = make(
    "div",
    { className: "placement-fields" },
    .../** @type {[string, HTMLElement][]} */ ([
      ["Plane", plane],
      ["Steps", steps],
    ]).map(([text, input]) => make("div", {}, make("label", { for: input.id }, text), input)),
    ...numbers.map((input, i) => make("div", {}, labels[i], input, understood[i])),
    make("div", {}, layersLabel, layers),
  );

  /** The labels of the plane, and its ranges where none are typed. */
  function fill() {
    const [i, k, rest] = PLANES[plane.value];
    const [a, b, fixed] = [AXES[i], AXES[k], AXES[rest]];
    [`${a} from`, `${a} to`, `${b} from`, `${b} to`, `At ${fixed}`].forEach((text, n) =>
      labels[n].replaceChildren(text, " ", make("span", { className: "unit" }, shownUnit("mm"))),
    );
    layersLabel.textContent = rest === 2 ? "Heights" : "Layers";
    layers.options[1].textContent = `3, ±${coordinate(APART_MM)} ${shownUnit("mm")}`;
    if (typed || !reach) return;
    [...reach[i], ...reach[k], place()[rest]].forEach((value, n) => cells[n].write(value));
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

  /**
   * What is asked for, or a sentence about what is wrong with it.
   * @returns {MapRequest | string}
   */
  function read() {
    const { values, mistakes } = readCells();
    const turned = values[0] >= values[1] ? 1 : values[2] >= values[3] ? 3 : -1;
    numbers.forEach((input, i) =>
      mistakes[i] || i === turned ? input.setAttribute("aria-invalid", "true") : input.removeAttribute("aria-invalid"),
    );
    const wrong = mistakes.findIndex(Boolean);
    if (wrong >= 0) return `${labels[wrong].textContent}: ${mistakes[wrong]}`;
    if (turned >= 0) return `${labels[turned].textContent}: enter more than the start.`;
    const across = (layers.value === "1" ? [0] : [-APART_MM, 0, APART_MM]).map((shift) => values[4] + shift);
    return { plane: plane.value, axes: PLANES[plane.value], values, count: Number(steps.value), across };
  }

  /** Fills in all that is within reach, whatever was typed. */
  function whole() {
    typed = false;
    fill();
    changed();
  }

  const edited = debounced(changed, CALM_MS);
  plane.addEventListener("change", whole);
  for (const input of [steps, layers]) input.addEventListener("change", changed);
  for (const input of numbers) input.addEventListener("input", () => ((typed = true), edited()));

  return {
    node,
    read,
    whole,
    /**
     * Offers the smallest and largest x, y, z worth a look [mm].
     * @param {[number, number][]} ranges
     */
    offer(ranges) {
      reach = ranges;
      fill();
    },
    /** Writes the units of the settings. */
    relabel() {
      for (const cell of cells) cell.relabel();
      fill();
    },
  };
}
