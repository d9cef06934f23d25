// The furniture around the picture: views, a menu of what is shown, magnification, scale of colours, labels.

import { make } from "../page/dom.js";
import { makeLegend } from "./legend.js";
import { makeMenu } from "./menu.js";
import { gradient } from "./ramp.js";

/**
 * @typedef {{
 *   view(name: string): void, shown(name: string, on: boolean): void, factor(value: number | null): void,
 *   worst(): void,
 * }} Controls
 */

const VIEWS = [
  ["fit", "Path", "Fit the path (F)"],
  ["all", "Arm", "Fit the whole arm (A)"],
  ["top", "Top", "The part from above (1)"],
  ["tool", "Tool", "The part along the tool’s axis (5)"],
];
const GAP = 6; // between the picture and what is written below it [px]
const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];

/**
 * Builds everything into `node`; `on` = { view(name), shown(name, on), factor(value or null), worst() }.
 * @param {HTMLElement} node
 * @param {Controls} on
 */
export function furnish(node, on) {
  const canvas = make("canvas", {
    tabIndex: 0,
    role: "application",
    "aria-label": "Paths and arm in space",
    "aria-describedby": "scene-text scene-keys",
    "aria-roledescription": "picture in space",
  });
  const labels = make("div", { className: "labels", "aria-hidden": "true" });
  const worst = make("button", {
    type: "button",
    className: "worst",
    hidden: true,
    title: "Move the cursor to the worst place",
  });
  worst.addEventListener("click", () => on.worst());
  const message = make("p", { className: "message", hidden: true });
  const floor = make("p", { className: "floor" });
  const legend = makeLegend();
  const factor = make("select", {
    "aria-label": "Magnification of the deviation",
    title: "Magnification of the deviation",
  });
  factor.addEventListener("change", () => on.factor(factor.value === "auto" ? null : Number(factor.value)));
  const stated = make("p", { className: "stated" }, factor);
  const beyond = make("p", { className: "beyond", hidden: true });
  const corners = make("div", { className: "part-corner" });
  const stage = make(
    "div",
    { className: "stage" },
    canvas,
    labels,
    worst,
    stated,
    beyond,
    corners,
    floor,
    legend.node,
    message,
  );

  const views = VIEWS.map(([name, label, title]) => {
    const button = make("button", { type: "button", title, "data-view": name }, label);
    button.addEventListener("click", () => on.view(name));
    return button;
  });
  const menu = makeMenu(on);
  const head = make(
    "header",
    {},
    make("h2", { id: "scene-title" }, "Paths and arm in space"),
    make("div", { className: "sides", role: "group", "aria-label": "View" }, ...views),
    menu.button,
    menu.node,
  );
  const view = make("div", { className: "scene-view" }, head, stage);
  node.style.setProperty("--ramp", gradient());
  node.replaceChildren(view);

  return {
    canvas,
    labels,
    worst,
    stage,
    floor,
    legend,
    menu,
    /** Puts a legend into the corner of the picture, and the rest below it. */
    corner: (/** @type {any} */ child) => corners.append(child),
    below: (/** @type {any[]} */ ...children) => view.append(...children),
    after: (/** @type {any[]} */ ...children) => node.append(...children),
    /** The places in the picture that are written on. */
    taken: () =>
      [stated, beyond, corners, floor, legend.node].map(
        ({ offsetLeft: x, offsetTop: y, offsetWidth: width, offsetHeight: height }) => ({
          x,
          y,
          width,
          height,
        }),
      ),
    /**
     * Names the joints of a pose that are out of range.
     * @param {{ beyond: any, excess: ArrayLike<number> }} given
     */
    beyond({ beyond: joints, excess }) {
      const words = joints
        .map((/** @type {number} */ joint) => `Joint ${joint} is ${excess[joint - 1].toFixed(1)}° out of range`)
        .join("\n");
      if (beyond.textContent !== words) beyond.textContent = words;
      beyond.hidden = !words;
    },
    /** What is written along the picture's edges leaves this free [px]. */
    edges: () => ({ above: stated.offsetHeight, below: legend.node.offsetHeight + GAP }),
    /**
     * Says something instead of the picture, or (empty) shows it again.
     * @param {string} words
     */
    say(words) {
      message.textContent = words;
      message.hidden = !words;
      stage.classList.toggle("silent", Boolean(words));
    },
    /**
     * Offers magnifications around the automatic one.
     * @param {number} automatic
     * @param {number | null} chosen
     */
    factors(automatic, chosen) {
      const values = MAGNIFICATIONS.filter((v) => v <= Math.max(100, automatic * 20));
      factor.replaceChildren(
        make("option", { value: "auto", selected: chosen === null }, `Error × ${automatic}`),
        ...values.map((v) => make("option", { value: String(v), selected: v === chosen }, `× ${v}`)),
      );
    },
  };
}
