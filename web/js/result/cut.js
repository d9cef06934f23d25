// The cut of the shown result: a drawing of the engagement, the figures of tool, material and
// spindle, and what the wall keeps of the deflection.

import { byId, make, makeSvg } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { errorText, forceText, forceUnit, lengthText, lengthUnit } from "../page/units.js";

/** @import { CutFigures, Summary, WallFigures } from "../../pkg/armill.js" */

const RADIUS = 34; // of the tool in the drawing
const EDGE = 50; // half the drawing
const DEG = Math.PI / 180;
const EXACT = 1e-6; // angles nearer than this are a wall's [deg]

/**
 * Shows the cut of a result.
 * @param {Summary} summary
 */
export function showCut({ material, material_note, cut, walls, mean_force_n }) {
  const figure = () => make("figure", { className: "engagement" }, drawing(cut), make("figcaption", {}, inWords(cut)));
  byId("cut-stock").hidden = !cut.stock;
  byId("cut-stock").textContent = cut.stock ? stockSentence(cut) : "";
  byId("cut-drawing").replaceChildren(figure());
  byId("group-cutting")?.querySelector("fieldset")?.append(sketchOf(figure));
  byId("cut-material").textContent = [material, material_note].filter(Boolean).join(". ");
  byId("cut-figures").replaceChildren(
    ...figures(cut, mean_force_n).map(([name, unit, value, key]) => {
      const dd = make("dd", {}, value);
      if (key) dd.dataset.value = String(cut[key]);
      return make("div", {}, make("dt", {}, `${name} `, make("span", { className: "unit" }, unit)), dd);
    }),
  );
  showWalls(walls, cut.tooth_passing_hz);
}

/**
 * The place for the drawing below the inputs of the cut, made once.
 * @param {() => HTMLElement} figure
 */
function sketchOf(figure) {
  const place = byId("cut-sketch") ?? make("div", { id: "cut-sketch" });
  place.replaceChildren(figure());
  return place;
}

/** @param {CutFigures} cut */
const isSlot = ({ entry_deg, exit_deg }) => entry_deg < EXACT && exit_deg > 180 - EXACT;

/**
 * Without the last bits, which sines and cosines leave.
 * @param {number} value
 */
const tidy = (value) => Number(value.toPrecision(12));

/**
 * What kind of milling two angles are.
 * @param {CutFigures} cut
 */
function wayOf(cut) {
  if (isSlot(cut)) return "Slot";
  if (cut.exit_deg > 180 - EXACT) return "Climb milling";
  return cut.entry_deg < EXACT ? "Conventional milling" : "Material ahead only";
}

/** @param {CutFigures} cut */
function inWords(cut) {
  /** @param {number} value */
  const angle = (value) => formatNumber(Number(value.toFixed(2)));
  const where = cut.stock ? "Where the force is largest: " : "";
  if (isAir(cut)) return `${where}no tooth cuts with its side.`;
  return (
    `${where}${wayOf(cut)}, seen from the spindle: a tooth cuts from ${angle(cut.entry_deg)} to ${angle(cut.exit_deg)} ` +
    `deg; radial depth ${lengthText(tidy(cut.radial_depth_mm))} ${lengthUnit()}.`
  );
}

/**
 * Whether the side of the tool touches nothing.
 * @param {CutFigures} cut
 */
const isAir = ({ entry_deg, exit_deg, axial_depth_mm, stock }) =>
  stock !== undefined && (exit_deg - entry_deg < EXACT || axial_depth_mm === 0);

/**
 * What stands above the figures of a job with a stock.
 * @param {CutFigures} cut
 */
const stockSentence = ({ stock }) =>
  `Engagement from the stock: ${stock}. Drawing, entry, exit, depths, chip, forces, torque, power and removal rate ` +
  "are those where the force is largest.";

/**
 * Where the drawing has the immersion angle: from the left (y), clockwise over the feed (up).
 * @param {number} degrees
 * @param {number} [radius]
 */
const at = (degrees, radius = RADIUS) => [-Math.cos(degrees * DEG) * radius, -Math.sin(degrees * DEG) * radius];
/** @param {number[]} xy */
const point = (xy) => xy.map((value) => value.toFixed(2)).join(" ");

/** @param {CutFigures} cut */
function toolAlone(cut) {
  const viewBox = `${-EDGE} ${-EDGE} ${2 * EDGE} ${2 * EDGE}`;
  const svg = makeSvg("svg", { viewBox, role: "img", "aria-label": inWords(cut) });
  svg.append(makeSvg("circle", { class: "tool", r: RADIUS }));
  return svg;
}

/** @param {CutFigures} cut */
function drawing(cut) {
  if (isAir(cut)) return toolAlone(cut);
  const { entry_deg: entry, exit_deg: exit } = cut;
  const [from, to] = [at(entry), at(exit)];
  const arc = `A ${RADIUS} ${RADIUS} 0 0 1 ${point(to)}`;
  const svg = makeSvg("svg", {
    viewBox: `${-EDGE} ${-EDGE} ${2 * EDGE} ${2 * EDGE}`,
    role: "img",
    "aria-label": inWords(cut),
  });
  /** @param {number} x */
  const side = (x) => makeSvg("rect", { class: "stays", x, y: -EDGE, width: EDGE - RADIUS, height: 2 * EDGE });
  if (entry < EXACT) svg.append(side(-EDGE));
  if (exit > 180 - EXACT) svg.append(side(RADIUS));
  svg.append(
    makeSvg("path", {
      class: "chip",
      d: `M ${point([from[0], -EDGE])} L ${point(from)} ${arc} L ${point([to[0], -EDGE])} Z`,
    }),
    makeSvg("circle", { class: "tool", r: RADIUS }),
    makeSvg("path", { class: "limit", d: `M 0 0 L ${point(from)} M 0 0 L ${point(to)}` }),
    makeSvg("path", { class: "engaged", d: `M ${point(from)} ${arc}` }),
    // The feed, up, and the turn of the spindle, clockwise.
    makeSvg("path", { class: "arrow", d: "M 0 0 V -20 m -3 5 l 3 -5 l 3 5" }),
    makeSvg("path", {
      class: "arrow",
      d: `M ${point(at(250, 16))} A 16 16 0 0 1 ${point(at(320, 16))} m 4.7 1.7 l -4.7 -1.7 l 0.85 4.9`,
    }),
    makeSvg("text", { x: 3, y: -8 }, "feed"),
  );
  for (const angle of [entry, exit]) {
    const [x, y] = at(angle, RADIUS + 8);
    svg.append(makeSvg("text", { class: "angle", x: x.toFixed(1), y: (y + 2.5).toFixed(1) }, `${Math.round(angle)}°`));
  }
  return svg;
}

/**
 * Name, unit, text and key of every figure.
 * @param {CutFigures} cut
 * @param {number[]} mean
 * @returns {[name: string, unit: string, text: string, key?: keyof CutFigures][]}
 */
function figures(cut, mean) {
  /** @param {keyof CutFigures} key */
  const value = (key) => tidy(Number(cut[key]));
  /**
   * @param {keyof CutFigures} key
   * @param {number} [digits]
   */
  const n = (key, digits) => formatNumber(value(key), digits);
  /** @param {keyof CutFigures} key */
  const length = (key) => lengthText(value(key));
  const tool =
    cut.corner_radius_mm === 0
      ? "flat end mill"
      : 2 * cut.corner_radius_mm >= cut.diameter_mm
        ? "ball nose"
        : `bull nose, corner ${length("corner_radius_mm")}`;
  /** @type {ReturnType<typeof figures>} */
  const rows = [
    ["Tool", lengthUnit(), `${tool}, diameter ${length("diameter_mm")}`],
    ["Cutting k_tc, k_rc, k_ac", "N/mm²", [n("ktc_n_mm2", 4), n("krc_n_mm2"), n("kac_n_mm2")].join(", ")],
    ["Edge k_te, k_re, k_ae", "N/mm", [n("kte_n_mm"), n("kre_n_mm"), n("kae_n_mm")].join(", ")],
    ["Entry, exit", "deg", `${n("entry_deg")}, ${n("exit_deg")}`],
    ["Radial × axial depth", lengthUnit(), `${length("radial_depth_mm")} × ${length("axial_depth_mm")}`],
    [
      "Feed per tooth; mean, largest chip",
      lengthUnit(),
      `${length("feed_per_tooth_mm")}; ${length("mean_chip_mm")}, ${length("largest_chip_mm")}`,
    ],
    [
      "Mean force; largest in a revolution",
      forceUnit(),
      `${forceText(Math.hypot(...mean))}; ${forceText(cut.peak_force_n)}`,
    ],
    [
      "Torque" + (cut.spindle_torque_nm ? ", of rated" : ""),
      "N m",
      n("torque_nm") + (cut.spindle_torque_nm ? ` of ${n("spindle_torque_nm")}` : ""),
      "torque_nm",
    ],
    [
      "Spindle power" + (cut.spindle_power_kw ? ", of rated" : ""),
      "kW",
      n("power_kw") + (cut.spindle_power_kw ? ` of ${n("spindle_power_kw")}` : ""),
      "power_kw",
    ],
    ["Removal rate", "cm³/min", n("removal_cm3_min"), "removal_cm3_min"],
  ];
  if (cut.stock)
    rows.push(
      ["Largest engaged angle", "deg", n("largest_engaged_deg"), "largest_engaged_deg"],
      ["Removed volume", "cm³", n("removed_cm3"), "removed_cm3"],
      ["Share in the air", "%", formatNumber(100 * (cut.air_share ?? 0), 2), "air_share"],
    );
  if (cut.removal_cm3_min > 0)
    rows.push(["Power for removal rate", "N/mm²", formatNumber((cut.power_kw * 6e4) / cut.removal_cm3_min)]);
  if (cut.kc11_n_mm2) rows.splice(1, 0, ["k_c1.1; m_c", "N/mm²; 1", `${n("kc11_n_mm2", 4)}; ${n("mc")}`]);
  if (cut.made_at_chip_mm)
    rows.splice(cut.kc11_n_mm2 ? 2 : 1, 0, [
      "At chip thickness",
      lengthUnit(),
      length("made_at_chip_mm"),
      "made_at_chip_mm",
    ]);
  if (cut.tool_bending_um_n)
    rows.splice(1, 0, ["Tip deflection of the tool", "µm/N", n("tool_bending_um_n"), "tool_bending_um_n"]);
  if (cut.spread_percent) rows.push(["Coefficients known to ±", "%", n("spread_percent"), "spread_percent"]);
  return rows;
}

/**
 * @param {WallFigures[]} walls
 * @param {number} passing tooth passing frequency [Hz]
 */
function showWalls(walls, passing) {
  const section = byId("walls");
  section.hidden = walls.length === 0;
  byId("wall-passing").textContent = formatNumber(passing);
  /**
   * @param {number} value
   * @param {(value: number) => string} text
   */
  const cell = (value, text) => {
    const td = make("td", {}, text(value));
    td.dataset.value = String(value);
    return td;
  };
  /**
   * @param {string} name
   * @param {number | null} force
   * @param {number} mean
   * @param {number | null} max
   */
  const row = (name, force, mean, max) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, name),
      force === null ? make("td", {}, "") : cell(force, forceText),
      cell(mean, errorText),
      max === null ? make("td", {}, "") : cell(max, errorText),
    );
  const rows = walls.flatMap((wall) => {
    const which = walls.length === 1 ? "" : wall.side > 0 ? " (left wall)" : " (right wall)";
    return [
      row(`By the mean force${which}`, wall.mean_force_n, wall.by_mean_force_mm, wall.by_mean_force_max_mm),
      row(
        `At the instant that forms the wall${which}`,
        wall.instant_force_n,
        wall.at_instant_mm,
        wall.at_instant_max_mm,
      ),
      row(`Left if the mean is compensated${which}`, null, wall.at_instant_mm - wall.by_mean_force_mm, null),
    ];
  });
  byId("wall-table").tBodies[0].replaceChildren(...rows);
}
