// The orientation of a frame, in the values that the robot's brand has for it.

import { make } from "../page/dom.js";
import { Mistake, allUnderstood, numberCell } from "./number-cell.js";
import { CONVENTIONS, strayLength } from "./orientation.js";

/**
 * @import { Editor } from "./editors.js"
 * @import { Convention } from "./orientation.js"
 */

// How a spindle sits on a flange: its z axis, out of the tool, along the flange's or across it.

/** @type {Record<string, { label: string, rpy_deg: number[] }>} */
const SPINDLES = {
  along: { label: "Spindle along the flange axis", rpy_deg: [0, 0, 0] },
  x: { label: "Spindle at 90°, towards the flange’s +X", rpy_deg: [0, 90, 0] },
  "minus-x": { label: "Spindle at 90°, towards the flange’s −X", rpy_deg: [0, -90, 0] },
};

/**
 * An editor for roll, pitch and yaw; `brand()` says who counts them, `spindle` offers how a spindle may sit.
 * @param {string} id
 * @param {() => string} brand
 */
export function orientationEditor(id, brand, { spindle = false } = {}) {
  const angles = [0, 1, 2].map((i) => numberCell(`${id}-${i}`, "deg"));
  const quaternion = CONVENTIONS.ABB.ids.map((name) => numberCell(`${id}-${name}`));
  const sets = [angles, quaternion].map((cells) => {
    const names = cells.map(() => make("span"));
    const labels = cells.map(({ input }, i) => make("label", { className: "part" }, names[i], input));
    return { cells, names, labels, node: make("div", { className: `vector of-${cells.length}` }, ...labels) };
  });
  const menu = spindle ? spindleMenu(id, choose) : undefined;
  const node = make("div", { id, className: "orientation", role: "group" }, ...sets.map((set) => set.node));
  if (menu) node.prepend(menu);
  /** @type {Convention} */
  let convention;
  /** @type {{ rpy: number[], values: number[] }} */
  let held = { rpy: [0, 0, 0], values: [] };

  const cells = () => (convention.names.length === 4 ? quaternion : angles);

  /** Names the boxes as the brand does. */
  function follow() {
    const next = CONVENTIONS[brand()] ?? CONVENTIONS.other;
    if (next === convention) return;
    convention = next;
    for (const set of sets) {
      set.node.hidden = set.cells !== cells();
      if (set.node.hidden) continue;
      set.cells.forEach(({ input }, i) => {
        input.id = set.labels[i].htmlFor = `${id}-${convention.ids[i]}`;
        set.names[i].textContent = convention.names[i];
      });
    }
  }

  /** @param {number[]} rpy */
  function write(rpy) {
    follow();
    held = { rpy, values: convention.of(rpy) };
    cells().forEach((cell, i) => cell.write(held.values[i]));
    if (menu) menu.value = Object.keys(SPINDLES).find((key) => String(SPINDLES[key].rpy_deg) === String(rpy)) ?? "";
  }

  function read() {
    const values = cells().map((cell) => cell.read());
    if (values.every((value, i) => value === held.values[i])) return [...held.rpy];
    const stray = convention === CONVENTIONS.ABB ? strayLength(values) : undefined;
    if (stray !== undefined) throw new Mistake(`q1 to q4 have the length ${stray.toPrecision(4)}; a rotation needs 1.`);
    return convention.rpy(values);
  }

  /** @param {number[]} rpy */
  function choose(rpy) {
    write(rpy);
    node.dispatchEvent(new CustomEvent("input", { bubbles: true }));
  }

  return {
    node,
    inputs: [...angles, ...quaternion].map(({ input }) => input),
    read,
    write,
    at: (/** @type {string} */ rest) => cells()[Number(/^\[(\d)\]/.exec(rest)?.[1] ?? 0)].input,
    understood: () => allUnderstood(cells()),
    unit: () => (convention?.names.length === 4 ? "" : "deg"),
    meaning: () => convention?.meaning ?? "",
  };
}

/**
 * The usual ways to mount a spindle; `choose(rpy)` is called with the chosen one.
 * @param {string} id
 * @param {(rpy: number[]) => void} choose
 */
function spindleMenu(id, choose) {
  const menu = make(
    "select",
    { id: `${id}-spindle`, "aria-label": "How the spindle sits on the flange" },
    ...Object.entries(SPINDLES).map(([value, { label }]) => make("option", { value }, label)),
    make("option", { value: "", disabled: true }, "An orientation of its own"),
  );
  for (const kind of ["input", "change"]) menu.addEventListener(kind, (event) => event.stopPropagation());
  menu.addEventListener("change", () => choose(SPINDLES[menu.value].rpy_deg));
  return menu;
}
