// Lengths and forces of results as the settings want them read. Everything is computed and saved in
// millimetres and newtons.

import { formatError, formatLength, formatNumber } from "./number.js";
import { setting } from "./settings.js";

const LENGTHS = { mm: { name: "mm", size: 1, decimals: 4 }, inch: { name: "in", size: 25.4, decimals: 6 } };
const FORCES = { N: { name: "N", size: 1 }, lbf: { name: "lbf", size: 4.4482216152605 } }; // 0.45359237 kg at 9.80665 m/s2

/** @returns {{ name: string, size: number, decimals: number }} */
const length = () => LENGTHS[/** @type {"mm" | "inch"} */ (setting("length"))];
/** @returns {{ name: string, size: number }} */
const force = () => FORCES[/** @type {"N" | "lbf"} */ (setting("force"))];

/**
 * The units that the core draws in.
 * @returns {import("../../pkg/armill.js").ChartUnits}
 */
export const units = () => /** @type {any} */ ({ length: setting("length"), force: setting("force") });

export const lengthUnit = () => length().name;
export const forceUnit = () => force().name;

/**
 * Millimetres in the chosen unit, as a number.
 * @param {number} mm
 */
export const inLength = (mm) => mm / length().size;

/**
 * Millimetres to three digits (or `digits`), but no finer than any machine knows.
 * @param {number} mm
 * @param {number} [digits]
 */
export const lengthText = (mm, digits) =>
  digits ? formatNumber(inLength(mm), digits) : formatLength(inLength(mm), length().decimals);

const LEAST_MM = 0.01; // what no one can promise of a part milled by a robot is not set large

/**
 * Millimetres as a large figure.
 * @param {number} mm
 */
export const largeText = (mm) => (mm > 0 && mm < LEAST_MM ? `<${lengthText(LEAST_MM, 1)}` : lengthText(mm));

/**
 * Millimetres to a fixed place, so that a column of them lines up.
 * @param {number} mm
 */
export const errorText = (mm) => formatError(inLength(mm), length().decimals);

/**
 * Newtons in the chosen unit, to three digits.
 * @param {number} newton
 */
export const forceText = (newton) => formatNumber(newton / force().size);
