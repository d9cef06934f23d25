// The menu of the picture: further views, what is shown, and how to move it.

import { make } from "../page/dom.js";

const VIEWS = [
  ["iso", "Iso", "From above at an angle (4)"],
  ["front", "Front", "From the front, along y (2)"],
  ["side", "Side", "From the side, along x (3)"],
];
const SWITCHES = [
  ["desired", "Desired"],
  ["actual", "Actual"],
  ["after", "Actual after compensation"],
  ["compensated", "To command"],
  ["tube", "Tolerance"],
  ["arm", "Arm"],
  ["solid", "Part"],
];
const OFF = ["after", "tube"]; // until somebody wants to see them
const HELP =
  "Drag to turn, Shift-drag or right-drag to move; the wheel zooms once the picture is clicked. On a touch screen " +
  "drag sideways to turn; two fingers move and zoom. Point at a path to read it.";
const KEYS =
  "Arrow keys turn, with Shift they move; plus and minus zoom; F fits the path, A the arm; 1 to 5 are views; Space plays.";
const EDGE = 8; // from the window's edge [px]

/**
 * The button and the menu it opens; `on` = { view(name), shown(name, on) }.
 * @param {{ view(name: string): void, shown(name: string, on: boolean): void }} on
 */
export function makeMenu(on) {
  const views = VIEWS.map(([name, label, title]) => {
    const button = make("button", { type: "button", title, "data-view": name }, label);
    button.addEventListener("click", () => on.view(name));
    return button;
  });
  /** @type {Record<string, HTMLInputElement>} */
  const boxes = {};
  const switches = SWITCHES.map(([name, label]) => {
    const box = make("input", { type: "checkbox", checked: !OFF.includes(name), "data-path": name });
    box.addEventListener("change", () => on.shown(name, box.checked));
    boxes[name] = box;
    const sample = make("span", { className: "dash", "aria-hidden": "true" });
    return make("label", { className: `switch ${name}` }, box, sample, label);
  });
  const node = make(
    "div",
    {
      className: "scene-menu",
      popover: "auto",
      id: "scene-menu",
      role: "dialog",
      "aria-label": "What the picture shows",
    },
    make("div", { className: "sides", role: "group", "aria-label": "More views" }, ...views),
    make("div", { className: "switches", role: "group", "aria-label": "What is shown" }, ...switches),
    make("p", {}, HELP),
    make("p", { id: "scene-keys" }, KEYS),
  );
  const button = make("button", { type: "button", className: "more", popoverTargetElement: node }, "Show");
  node.addEventListener("beforetoggle", ({ newState }) => newState === "open" && place(node, button));
  const partSwitch = /** @type {HTMLElement} */ (boxes.solid.closest("label"));
  partSwitch.hidden = true;
  return {
    button,
    node,
    /** Sets a switch. */
    set: (/** @type {string} */ name, /** @type {boolean} */ checked) => (boxes[name].checked = checked),
    /** Whether there is a part to show. */
    offerPart: (/** @type {boolean} */ offered) => (partSwitch.hidden = !offered),
  };
}

/**
 * Below its button, within the window.
 * @param {HTMLElement} node
 * @param {HTMLElement} button
 */
function place(node, button) {
  const { bottom, right } = button.getBoundingClientRect();
  node.style.setProperty("inset-inline-end", `${Math.max(EDGE, document.documentElement.clientWidth - right)}px`);
  node.style.setProperty("inset-block-start", `${bottom + 4}px`);
  node.style.setProperty("max-height", `${Math.max(160, innerHeight - bottom - 4 - EDGE)}px`);
}
