// The furniture around the picture: views, switches, magnification, scale of colours, labels.

import { make } from "../page/dom.js";
import { gradient } from "./ramp.js";

const VIEW_BUTTONS = [
  ["fit", "Path", "Fit the path (F)"],
  ["all", "Arm", "Fit the whole arm (A)"],
  ["iso", "Iso", "From above at an angle (4)"],
  ["top", "Top", "From above (1)"],
  ["front", "Front", "From the front, along y (2)"],
  ["side", "Side", "From the side, along x (3)"],
  ["tool", "Tool", "Along the tool's axis (5)"],
];
const SWITCHES = [
  ["desired", "Desired"],
  ["actual", "Actual"],
  ["after", "Actual after compensation"],
  ["compensated", "To command"],
  ["arm", "Arm"],
  ["solid", "Part"],
];
const HELP =
  "Drag to turn, Shift-drag or right-drag to move; the wheel zooms once the picture is clicked. On a touch screen " +
  "drag sideways to turn, two fingers move and zoom. Point at a path to read it.";
const KEYS =
  "Arrow keys turn, with Shift they move; plus and minus zoom; F fits the path, A the arm; 1 to 5 are views; Space plays.";
const TICKS = 4;

/** Builds everything into `node`; `on` = { view(name), shown(name, on), factor(value or null) }. */
export function furnish(node, on) {
  const canvas = make("canvas", {
    tabIndex: 0,
    role: "application",
    "aria-label": "Paths and arm in space",
    "aria-describedby": "scene-text scene-keys",
    "aria-roledescription": "picture in space",
  });
  const labels = make("div", { className: "labels", "aria-hidden": "true" });
  const message = make("p", { className: "message", hidden: true });
  const floor = make("p", { className: "floor" });
  const bar = make("div", { className: "bar" });
  const ticks = make("div", { className: "ticks" });
  const scale = make(
    "div",
    { className: "scale" },
    make("p", {}, "Contour error, ", make("span", { className: "unit" }), make("span", { className: "limit" })),
    bar,
    ticks,
  );
  const factor = make("select", { "aria-label": "Magnification of the deviation" });
  factor.addEventListener("change", () => on.factor(factor.value === "auto" ? null : Number(factor.value)));
  const stage = make(
    "div",
    { className: "stage" },
    canvas,
    labels,
    make("p", { className: "stated" }, "Deviation ", factor),
    floor,
    scale,
    message,
  );

  const views = VIEW_BUTTONS.map(([name, label, title]) => {
    const button = make("button", { type: "button", title, "data-view": name }, label);
    button.addEventListener("click", () => on.view(name));
    return button;
  });
  const switches = SWITCHES.map(([name, label]) => {
    const box = make("input", { type: "checkbox", checked: name !== "after", "data-path": name });
    box.addEventListener("change", () => on.shown(name, box.checked));
    return make(
      "label",
      { className: `switch ${name}` },
      box,
      make("span", { className: "dash", "aria-hidden": "true" }),
      label,
    );
  });
  const head = make(
    "header",
    {},
    make("h2", { id: "scene-title" }, "Paths and arm in space"),
    make("div", { className: "sides", role: "group", "aria-label": "View" }, ...views),
  );
  const shows = make("div", { className: "switches", role: "group", "aria-label": "What is shown" }, ...switches);

  const text = make("p", { id: "scene-text", className: "hidden-text" });
  const readout = make("p", { className: "read" });
  const help = make(
    "details",
    { className: "help" },
    make("summary", {}, "How to move it"),
    make("p", {}, HELP),
    make("p", { id: "scene-keys" }, KEYS),
  );
  const partSwitch = shows.querySelector(".switch.solid");
  partSwitch.hidden = true;
  node.replaceChildren(head, shows, stage);

  return {
    canvas,
    labels,
    stage,
    floor,
    readout,
    text,
    help,
    /** Puts the rest above and below the picture. */
    above: (...children) => stage.before(...children),
    below: (...children) => node.append(...children, readout, text, help),
    /** Whether there is a part to show. */
    offerPart: (on) => (partSwitch.hidden = !on),
    /** Says something instead of the picture, or (empty) shows it again. */
    say(words) {
      message.textContent = words;
      message.hidden = !words;
      stage.classList.toggle("silent", Boolean(words));
    },
    /** Offers magnifications around the automatic one. */
    factors(automatic, chosen) {
      const values = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000].filter(
        (v) => v <= Math.max(100, automatic * 20),
      );
      factor.replaceChildren(
        make("option", { value: "auto", selected: chosen === null }, `× ${automatic} (auto)`),
        ...values.map((v) => make("option", { value: String(v), selected: v === chosen }, `× ${v}`)),
      );
    },
    /** The scale from 0 to `largest`, with a mark at the tolerance. */
    scale(largest, tolerance, unit, dark) {
      node.style.setProperty("--ramp", gradient(dark));
      scale.querySelector(".unit").textContent = unit;
      const step = niceStep(largest / TICKS);
      const decimals = Math.max(0, -Math.floor(Math.log10(step)));
      const at = (value, words, name) => {
        const tick = make("span", { className: name }, words);
        tick.style.setProperty("left", `${(100 * value) / largest}%`);
        return tick;
      };
      const marks = [];
      for (let k = 0; k * step < largest * 0.75; k++) marks.push(at(k * step, (k * step).toFixed(decimals), "tick"));
      marks.push(at(largest, largest.toPrecision(3), "tick last"));
      if (tolerance <= largest) marks.push(at(tolerance, "", "tolerance"));
      ticks.replaceChildren(...marks);
      scale.hidden = !(largest > 0);
      scale.querySelector(".limit").textContent = `tolerance ${Number(tolerance.toPrecision(3))}`;
    },
  };
}

function niceStep(wanted) {
  const decade = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].find((step) => step * decade >= wanted * 0.999) * decade;
}
