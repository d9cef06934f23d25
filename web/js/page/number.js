// Numbers as people read them; form/quantity.js has how they are typed.

const GROUP = "\u202f"; // narrow no-break space between thousands

/**
 * `value` to `digits` significant digits, never fewer than its whole digits.
 * @param {number} value
 * @param {number} [digits]
 */
export function formatNumber(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return minus(group(String(value)));
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${minus(mantissa)}·10${superscript(Number(exponent))}`;
  }
  const text = size >= 10 ** digits ? value.toFixed(0) : value.toPrecision(digits);
  return minus(group(text));
}

/**
 * A length to a fixed place, in mm a tenth of a micrometre, so that a column of them lines up.
 * @param {number} length
 * @param {number} [decimals]
 */
export function formatError(length, decimals = 4) {
  if (length > 0 && length < finest(decimals)) return least(decimals);
  return length >= 1000 ? formatNumber(length) : minus(length.toFixed(decimals));
}

/**
 * A length to three digits, but no finer than a place that no machine knows: in mm a tenth of a
 * micrometre.
 * @param {number} length
 * @param {number} [decimals]
 */
export function formatLength(length, decimals = 4) {
  const size = Math.abs(length);
  if (size > 0 && size < finest(decimals)) return least(decimals);
  return size > 0 && size < 10 ** (2 - decimals)
    ? minus(String(Number(length.toFixed(decimals))))
    : formatNumber(length);
}

/**
 * `value` as an input field shows it: all its digits, nothing added.
 * @param {unknown} value
 */
export function plainNumber(value) {
  if (typeof value !== "number" || !Number.isFinite(value)) return "";
  return value !== 0 && Math.abs(value) < 1e-4 ? value.toExponential() : String(value);
}

/**
 * The next value for an arrow key: one step in the second digit, or 1 for whole numbers.
 * @param {number} value
 * @param {1 | -1} direction
 * @param {boolean} [whole]
 */
export function stepped(value, direction, whole) {
  if (whole || value === 0) return value + direction;
  const step = 10 ** (Math.floor(Math.log10(Math.abs(value)) + 1e-9) - 1);
  return Number((value + direction * step).toPrecision(12));
}

/** @param {number} decimals */
const finest = (decimals) => 0.5 * 10 ** -decimals;

/** @param {number} decimals */
const least = (decimals) => `<${(10 ** -decimals).toFixed(decimals)}`;

/** @param {string} text */
const minus = (text) => text.replace("-", "\u2212");

/** @param {string} text */
const group = (text) => {
  const [whole, rest] = text.split(".");
  if (whole.replace("-", "").length < 5) return text;
  return whole.replace(/\B(?=(\d{3})+$)/g, GROUP) + (rest ? `.${rest}` : "");
};

/** @param {number} exponent */
const superscript = (exponent) => String(exponent).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]));
