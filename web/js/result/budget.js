// The error budget: which joint and which source gives how much of the contour error, as bars,
// table and sentence.

import { byId, make } from "../page/dom.js";
import { inLength, lengthUnit } from "../page/units.js";

/** @import { Budget, Parts } from "../../pkg/armill.js" */

const NAMES = ["Joint 1", "Joint 2", "Joint 3", "Joint 4", "Joint 5", "Joint 6", "Tool", "Shaping"];
const KEYS = ["s1", "s2", "s3", "s4", "s5", "s6", "tool", "shaping"];
const NAMED = 0.24; // share of a bar from which a part carries its name, and its short one
const SHORT = 0.1;

document.querySelector(".budget")?.append(...emptyBudget());

/** What stands below the heading of the section: sentence, two bars, and a table that can be opened. */
function emptyBudget() {
  /** @param {string} id */
  const bar = (id) => make("div", { className: "budget-bar", id, "aria-hidden": "true" });
  const unit = () => make("span", { className: "unit", "data-unit": "length" }, lengthUnit());
  /** @param {(Node | string)[]} content */
  const head = (...content) => make("th", { scope: "col" }, ...content);
  const heads = [head("Part"), head("max ", unit()), head("%"), head("mean ", unit()), head("%")];
  const table = make("table", { id: "budget-table" }, make("thead", {}, make("tr", {}, ...heads)), make("tbody"));
  const note =
    "Each part is its vector, projected on the contour error; they add up to it. " +
    "A negative part pulls the tip back to the path.";
  return [
    make("p", { id: "budget-sentence" }, "–"),
    make(
      "p",
      { className: "budget-of" },
      "Where it is largest ",
      make("span", { className: "unit", id: "budget-time" }),
    ),
    bar("budget-worst"),
    make("p", { className: "budget-of" }, "On average"),
    bar("budget-mean"),
    make("details", {}, make("summary", {}, "In numbers"), table, make("p", { className: "unit" }, note)),
  ];
}

/**
 * Shows the budget of a result.
 * @param {Budget} budget
 */
export function showBudget({ worst_mm, mean_mm, time_s, sentence }) {
  byId("budget-sentence").textContent = sentence;
  byId("budget-worst").replaceChildren(...barOf(worst_mm));
  byId("budget-mean").replaceChildren(...barOf(mean_mm));
  byId("budget-time").textContent = `at ${time_s.toFixed(2)} s`;
  const rows = [
    ...NAMES.slice(0, 6).map((name, i) =>
      row(name, `s${i + 1}`, worst_mm.joints[i], mean_mm.joints[i], worst_mm, mean_mm),
    ),
    ...(worst_mm.tool || mean_mm.tool ? [row("Tool", "tool", worst_mm.tool, mean_mm.tool, worst_mm, mean_mm)] : []),
    row("Deflection", "sum", sumOf(worst_mm), sumOf(mean_mm), worst_mm, mean_mm),
    row("Shaping", "shaping", worst_mm.shaping, mean_mm.shaping, worst_mm, mean_mm),
    row("Contour error", "total", worst_mm.total, mean_mm.total, worst_mm, mean_mm),
  ];
  byId("budget-table").tBodies[0].replaceChildren(...rows);
}

/** @param {Parts} parts */
const sumOf = ({ joints, tool }) => joints.reduce((sum, joint) => sum + joint, tool);
/**
 * @param {number} part
 * @param {number} total
 */
const percent = (part, total) => (total > 0 ? signed((100 * part) / total, 0) : "–");
/**
 * @param {number} value
 * @param {number} digits
 */
const signed = (value, digits) =>
  value
    .toFixed(digits)
    .replace(/^-(0(\.0+)?)$/, "$1")
    .replace("-", "\u2212");

/**
 * @param {string} name
 * @param {string} key
 * @param {number} worst
 * @param {number} mean
 * @param {Parts} worsts
 * @param {Parts} means
 */
function row(name, key, worst, mean, worsts, means) {
  const swatch = ["sum", "total"].includes(key)
    ? []
    : [make("span", { className: `part ${key}`, "aria-hidden": "true" })];
  /** @param {number} value */
  const number = (value) => {
    const td = make("td", {}, signed(inLength(value), lengthUnit() === "mm" ? 4 : 6));
    td.dataset.value = String(value);
    return td;
  };
  return make(
    "tr",
    { className: key },
    make("th", { scope: "row" }, ...swatch, name),
    number(worst),
    make("td", {}, percent(worst, worsts.total)),
    number(mean),
    make("td", {}, percent(mean, means.total)),
  );
}

/**
 * Parts that pull the tip back stand left of the line, the others right of it; all on one scale.
 * @param {Parts} parts
 */
function barOf(parts) {
  const all = [...parts.joints, parts.tool, parts.shaping].map((value, i) => ({ value, name: NAMES[i], key: KEYS[i] }));
  const whole = all.reduce((sum, { value }) => sum + Math.abs(value), 0);
  if (!whole) return [];
  const back = all.filter(({ value }) => value < 0);
  const out = all.filter(({ value }) => value > 0);
  /** @param {(typeof all)[number]} part */
  const segment = ({ value, name, key }) => {
    const share = Math.abs(value) / whole;
    const part = make("span", { className: `part ${key}`, title: `${name}: ${percent(value, parts.total)} %` });
    if (share > SHORT) part.append(make("span", {}, share > NAMED ? name : name.replace("Joint ", "J")));
    part.style.setProperty("width", `${100 * share}%`);
    return part;
  };
  return [...back.map(segment), make("span", { className: "zero" }), ...out.map(segment)];
}
