// A chart's few buttons.

import { make, makeSvg, rove } from "../page/dom.js";

const ICONS = {
  in: "M4 10H16M10 4V16",
  out: "M4 10H16",
  reset: "M4 8V4H8M12 4H16V8M16 12V16H12M8 16H4V12",
  table: "M3 4H17V16H3ZM3 8H17M3 12H17M9 8V16",
  save: "M10 3V12M6 9L10 13L14 9M4 16H16",
};

const icon = (name) =>
  makeSvg("svg", { viewBox: "0 0 20 20", class: "icon", "aria-hidden": "true" }, makeSvg("path", { d: ICONS[name] }));

/**
 * The toolbar; `act` has what its buttons do: `zoomIn`, `zoomOut`, `reset`, `table(on)`,
 * `save(format)`.
 */
export function toolbar(title, act) {
  const button = (name, label, action) => {
    const made = make("button", { type: "button", title: label, "aria-label": label }, icon(name));
    made.addEventListener("click", () => action(made));
    return made;
  };
  const save = button("save", "Save the chart", () => open(menu.hidden));
  const menu = make("div", { className: "menu", hidden: true });
  for (const [format, note] of [
    ["SVG", "drawing"],
    ["PNG", "picture"],
    ["CSV", "all samples"],
  ]) {
    const item = make("button", { type: "button" }, format, make("span", { className: "unit" }, ` ${note}`));
    item.addEventListener("click", () => (open(false), save.focus(), act.save(format.toLowerCase())));
    menu.append(item);
  }
  const open = (on) => {
    menu.hidden = !on;
    save.setAttribute("aria-expanded", String(on));
    if (on) menu.firstChild.focus();
  };
  const table = button("table", "Table", () => {
    const on = table.getAttribute("aria-pressed") !== "true";
    table.setAttribute("aria-pressed", String(on));
    act.table(on);
  });
  table.setAttribute("aria-pressed", "false");
  save.setAttribute("aria-expanded", "false");
  const bar = make(
    "div",
    { role: "toolbar", className: "chart-tools", "aria-label": `Chart tools: ${title}` },
    button("in", "Zoom in", act.zoomIn),
    button("out", "Zoom out", act.zoomOut),
    button("reset", "Show all", act.reset),
    table,
    make("span", { className: "save" }, save, menu),
  );
  bar.addEventListener(
    "focusout",
    ({ relatedTarget }) => menu.contains(relatedTarget) || relatedTarget === save || open(false),
  );
  bar.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || menu.hidden) return;
    event.stopPropagation();
    open(false);
    save.focus();
  });
  rove(bar);
  return bar;
}
