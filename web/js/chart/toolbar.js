// A chart's few buttons.

import { make, makeSvg, rove } from "../page/dom.js";

/** @import { Over } from "../../pkg/armill.js" */

/**
 * What the buttons do.
 *
 * @typedef {{
 *   zoomIn(): void,
 *   zoomOut(): void,
 *   reset(): void,
 *   table(on: boolean): void,
 *   save(format: string): void,
 *   log(on: boolean): void,
 *   over(axis: Over): void,
 *   select(on: boolean): void,
 * }} Tools
 */

/** @type {Record<string, string>} */
const ICONS = {
  in: "M4 10H16M10 4V16",
  out: "M4 10H16",
  reset: "M4 8V4H8M12 4H16V8M16 12V16H12M8 16H4V12",
  table: "M3 4H17V16H3ZM3 8H17M3 12H17M9 8V16",
  select: "M6 3V17M14 3V17M6 10H14M8.5 7.5L6 10L8.5 12.5M11.5 7.5L14 10L11.5 12.5",
  save: "M10 3V12M6 9L10 13L14 9M4 16H16",
};
/** @type {Record<Over, [name: string, note: string]>} */
const OVER = { time: ["Time", "since the start"], length: ["Length", "of the path"], line: ["Line", "of the program"] };

/** @param {string} name */
const icon = (name) =>
  makeSvg("svg", { viewBox: "0 0 20 20", class: "icon", "aria-hidden": "true" }, makeSvg("path", { d: ICONS[name] }));

/**
 * The toolbar as `{ node, show }`; `act` has what its buttons do: `zoomIn`, `zoomOut`, `reset`,
 * `table(on)`, `save(format)`, `log(on)`, `over(axis)`, `select(on)`.
 * @param {string} title
 * @param {Tools} act
 */
export function toolbar(title, act) {
  /**
   * @param {string} label
   * @param {string | Node} face
   * @param {(made: HTMLButtonElement) => void} action
   */
  const button = (label, face, action) => {
    const made = make("button", { type: "button", title: label, "aria-label": label }, face);
    made.addEventListener("click", () => action(made));
    return made;
  };
  /**
   * @param {HTMLButtonElement} made
   * @param {boolean} on
   */
  const press = (made, on) => made.setAttribute("aria-pressed", String(on));
  /**
   * @param {string} label
   * @param {string | Node} face
   * @param {(on: boolean) => void} action
   */
  const toggle = (label, face, action) => {
    const made = button(label, face, () => {
      press(made, made.getAttribute("aria-pressed") !== "true");
      action(made.getAttribute("aria-pressed") === "true");
    });
    press(made, false);
    return made;
  };
  const select = toggle("Select a stretch by dragging", icon("select"), act.select);
  const log = toggle("log scale", "log", act.log);
  const along = menuButton(
    button("Drawn over", "Time", () => {}),
    act.over,
  );
  const save = menuButton(
    button("Save the chart", icon("save"), () => {}),
    act.save,
  );
  save.offer({ svg: ["SVG", "drawing"], png: ["PNG", "picture"], csv: ["CSV", "all samples"] });
  const bar = make(
    "div",
    { role: "toolbar", className: "chart-tools", "aria-label": `Chart tools: ${title}` },
    button("Zoom in", icon("in"), act.zoomIn),
    button("Zoom out", icon("out"), act.zoomOut),
    button("Show all", icon("reset"), act.reset),
    toggle("Table", icon("table"), act.table),
    select,
    log,
    save.node,
    along.node,
  );

  /**
   * Shows a drawing's scale, where there are two to choose from, and what it is drawn over of `list`.
   * @param {{ y: { log: boolean, floor?: number } }} given
   * @param {import("../../pkg/armill.js").Over} over
   * @param {import("../../pkg/armill.js").Over[]} list
   */
  function show({ y }, over, list) {
    log.hidden = !y.log && y.floor === undefined;
    press(log, y.log);
    along.node.hidden = list.length < 2;
    select.hidden = !list.length;
    if (along.node.hidden) return;
    along.offer(Object.fromEntries(list.map((axis) => [axis, OVER[axis]])), over);
    along.button.textContent = OVER[over][0];
    along.button.setAttribute("aria-label", `Drawn over: ${OVER[over][0].toLowerCase()}`);
  }

  rove(bar);
  show({ y: { log: false } }, "time", []);
  return { node: bar, show };
}

/**
 * A button that opens a menu of choices; `choose(key)` is called with the one that is taken.
 * @param {HTMLButtonElement} button
 * @param {(key: any) => void} choose
 */
function menuButton(button, choose) {
  const menu = make("div", { className: "menu", hidden: true });
  const node = make("span", { className: "has-menu" }, button, menu);
  /** @param {boolean} on */
  const open = (on) => {
    menu.hidden = !on;
    button.setAttribute("aria-expanded", String(on));
    /** @type {HTMLElement | null} */
    const item = menu.querySelector("[aria-current]") ?? menu.querySelector("button");
    if (on) item?.focus();
  };
  button.setAttribute("aria-expanded", "false");
  button.addEventListener("click", () => open(Boolean(menu.hidden)));
  node.addEventListener(
    "focusout",
    ({ relatedTarget }) => node.contains(/** @type {Node | null} */ (relatedTarget)) || open(false),
  );
  node.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || menu.hidden) return;
    event.stopPropagation();
    open(false);
    button.focus();
  });

  /**
   * Offers `choices`, key: [name, note]; `current` is marked.
   * @param {Record<string, string[]>} choices
   * @param {string} [current]
   */
  function offer(choices, current) {
    const items = Object.entries(choices).map(([key, [name, note]]) => {
      const item = make(
        "button",
        { type: "button", tabIndex: -1 },
        name,
        make("span", { className: "unit" }, ` ${note}`),
      );
      if (key === current) item.setAttribute("aria-current", "true");
      item.addEventListener("click", () => (open(false), button.focus(), choose(key)));
      return item;
    });
    menu.replaceChildren(...items);
  }

  return { node, button, offer };
}
