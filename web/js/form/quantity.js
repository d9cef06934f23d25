// Numbers as people type them: with units and sums ("1/2 in", "6000 mm/min", "2*(10+5)"), with a
// decimal comma or with thousands separated.
//
//   sum     = product { ("+" | "-") product }
//   product = power { ["*" | "/"] power }      "2 mm" is a product, and so is "mm/min"
//   power   = sign power | (number | unit | "(" sum ")") ["²" | "³"]

/** @typedef {{ value: number, kind: string }} Measure a value in base units, and the kind of quantity that it is of */

/** @typedef {{ text?: string, number?: number, unit?: string, sign?: string }} Token */

/**
 * What each unit is in others; null for the base units that all are made of.
 * @type {Record<string, string | null>}
 */
const UNITS = {
  mm: null,
  µm: "0.001 mm",
  cm: "10 mm",
  m: "1000 mm",
  in: "25.4 mm",
  ft: "304.8 mm",
  s: null,
  ms: "0.001 s",
  min: "60 s",
  h: "3600 s",
  ipm: "in/min",
  deg: null,
  rad: `${180 / Math.PI} deg`,
  arcmin: "deg/60",
  Hz: "360 deg/s", // a cycle is a turn, so that Hz, rad/s and rpm are the same kind
  rpm: "360 deg/min",
  N: null,
  kN: "1000 N",
  lbf: "4.4482216152605 N",
  Nm: "1000 N mm",
  MPa: "N/mm²",
  GPa: "1000 N/mm²",
  W: "N m/s",
  kW: "1000 W",
  hp: "745.6998715822702 W", // 550 ft lbf/s
  kg: null,
  g: "0.001 kg",
  lb: "0.45359237 kg",
  "%": null,
};

/** @type {Record<string, string>} */
const ALIASES = { um: "µm", μm: "µm", inch: "in", '"': "in", "″": "in", "°": "deg", sec: "s", "1/min": "rpm" };

/**
 * The kinds of quantity that fields have: a name, and the units to suggest.
 * @type {[name: string, units: string[]][]}
 */
const KINDS = [
  ["a length", ["mm", "cm", "m", "in", "ft"]],
  ["a speed", ["mm/s", "mm/min", "m/min", "in/s", "in/min"]],
  ["an acceleration", ["mm/s²", "m/s²", "in/s²"]],
  ["an angle", ["deg", "rad", "arcmin"]],
  ["a time", ["s", "ms", "min"]],
  ["a frequency or speed of rotation", ["Hz", "rad/s", "rpm"]],
  ["a force", ["N", "kN", "lbf"]],
  ["a torque", ["N m"]],
  ["a mass", ["kg", "g", "lb"]],
  ["a power", ["W", "kW", "hp"]],
  ["a pressure", ["N/mm²", "MPa", "GPa"]],
  ["a percentage", ["%"]],
];

const SPACE = " \u00a0\u2009\u202f\t";
const TOKEN = new RegExp(
  `[${SPACE}]*(?:` +
    `(?<number>(?:\\d{1,3}(?:[ '’\u00a0\u2009\u202f]\\d{3})+(?![\\d'’])(?:[.,]\\d*)?|[\\d.,]*\\d[\\d.,]*)(?:e[+-]?\\d+)?)|` +
    `(?<unit>[a-zµμ°%"″]+)(?<power>[²³]|\\^?[23](?![\\d.,]))?|(?<sign>[-+*/()²³]))`,
  "iuy",
);

/** What is wrong with a typed number; `readings` are the texts it may have meant. */
export class NotAQuantity extends Error {
  /**
   * @param {string} message
   * @param {string[]} [readings]
   */
  constructor(message, readings = []) {
    super(message);
    this.readings = readings;
  }
}

/**
 * The value of `text` in `unit` ("" for a plain number). A number without a unit is one in `plainUnit`.
 * Throws NotAQuantity.
 * @param {string} text
 */
export function readQuantity(text, unit = "", plainUnit = unit) {
  const typed = text.trim();
  if (typed === "") throw new NotAQuantity("A number is needed here.");
  const { value, kind, hasNumber, exact } = evaluated(
    unit === "1/min" ? typed.replace(/(?<![\d.,])1\/min\b|\/min\b/i, " rpm") : typed,
  );
  if (!hasNumber) throw notANumber(typed);
  const [wanted, given] = [unitOf(unit), kind === PLAIN ? unitOf(plainUnit) : { value: 1, kind }];
  if (given.kind !== wanted.kind) throw new NotAQuantity(misfit(typed, kind, unit, wanted.kind));
  if (!Number.isFinite(value)) throw new NotAQuantity(`“${typed}” is too large or divides by zero.`);
  if (exact && given.value === wanted.value) return value;
  return rounded((value * given.value) / wanted.value, 15); // 1.1 in are 27.94 mm, not 27.939999999999998
}

/**
 * A value of one unit in another of the same kind, to some digits.
 * @param {number} value
 * @param {string} from
 * @param {string} to
 */
export const convert = (value, from, to, digits = 15) =>
  from === to ? value : rounded((value * unitOf(from).value) / unitOf(to).value, digits);

/**
 * Whether a text is a number and nothing else, written the way the page writes numbers.
 * @param {string} text
 */
export const isPlain = (text) => /^\s*[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?\s*$/i.test(text);

/**
 * @param {number} value
 * @param {number} digits
 */
const rounded = (value, digits) => Number(value.toPrecision(digits));

// A kind of quantity is the product of base units as a text, such as "mm1 s-1"; "" is a plain number.
const PLAIN = "";

/**
 * @param {Measure} a
 * @param {Measure} b
 */
function times(a, b, sign = 1) {
  const powers = Object.fromEntries(a.kind.split(" ").filter(Boolean).map(parsedPower));
  for (const [base, power] of b.kind.split(" ").filter(Boolean).map(parsedPower))
    powers[base] = (powers[base] ?? 0) + sign * power;
  const kind = Object.keys(powers)
    .filter((base) => powers[base])
    .sort()
    .map((base) => base + powers[base])
    .join(" ");
  return { value: sign > 0 ? a.value * b.value : a.value / b.value, kind };
}

/**
 * @param {string} text
 * @returns {[base: string, power: number]}
 */
const parsedPower = (text) => {
  const [, base, power] = /^(.*?)(-?\d+)$/.exec(text) ?? [];
  return [base, Number(power)];
};

/** @type {Map<string, Measure>} */
const known = new Map();

/**
 * A unit, as a field states it or as it is typed.
 * @param {string} name
 */
function unitOf(name) {
  if (!known.has(name)) known.set(name, name === "" ? { value: 1, kind: PLAIN } : evaluated(ALIASES[name] ?? name));
  return /** @type {Measure} */ (known.get(name));
}

/**
 * A unit by the name that was typed; undefined if there is none. Only where it is no other's does case not matter.
 * @param {string} name
 */
function namedUnit(name) {
  const lower = name.toLowerCase();
  const own = Object.hasOwn(ALIASES, lower) ? ALIASES[lower] : name;
  const found = Object.hasOwn(UNITS, own)
    ? own
    : Object.keys(UNITS).find((each) => each.toLowerCase() === own.toLowerCase());
  if (found === undefined) return undefined;
  const inOthers = UNITS[found];
  return inOthers === null ? { value: 1, kind: `${found}1` } : unitOf(inOthers);
}

/**
 * What a text stands for: its value in base units, and whether it is a single number.
 * @param {string} text
 */
function evaluated(text) {
  const tokens = tokensOf(text);
  const hasNumber = tokens.some(({ number }) => number !== undefined);
  let at = 0;
  /**
   * A sign that comes next, if it is one of these.
   * @param {...string} signs
   */
  const next = (...signs) => (signs.includes(tokens[at]?.sign ?? "") ? tokens[at++].sign : undefined);
  const fail = () => notANumber(text);

  /** @returns {Measure} */
  function sum() {
    let left = product();
    for (let sign; (sign = next("+", "-"));) {
      const right = product();
      if (right.kind !== left.kind)
        throw new NotAQuantity(`“${text}”: what is added needs units of the same kind, each its own.`);
      left = { value: sign === "+" ? left.value + right.value : left.value - right.value, kind: left.kind };
    }
    return left;
  }

  /** @returns {Measure} */
  function product() {
    let left = power();
    for (;;) {
      const sign = next("*", "/");
      const token = tokens[at];
      if (!sign && (!token || (token.sign && token.sign !== "("))) return left;
      if (!sign && token.number !== undefined) left = mixed(left);
      else left = times(left, power(), sign === "/" ? -1 : 1);
    }
  }

  /**
   * A whole number and a fraction: 1 1/2. Two numbers side by side are nothing else.
   * @param {Measure} whole
   */
  function mixed(whole) {
    const [above, slash, below] = tokens.slice(at, at + 3);
    const digits = [tokens[at - 1], above, below].every((token) => /^\d+$/.test(token?.text ?? ""));
    if (!digits || slash?.sign !== "/") throw fail();
    at += 3;
    return { value: whole.value + Number(above.number) / Number(below.number), kind: PLAIN };
  }

  /** @returns {Measure} */
  function power() {
    if (next("-")) {
      const { value, ...rest } = power();
      return { ...rest, value: -value };
    }
    if (next("+")) return power();
    let base = primary();
    const mark = next("²", "³");
    const count = mark === "²" ? 2 : mark === "³" ? 3 : 1;
    for (let i = 1, one = base; i < count; i++) base = times(base, one);
    return base;
  }

  /** @returns {Measure} */
  function primary() {
    if (next("(")) {
      const inside = sum();
      if (!next(")")) throw fail();
      return inside;
    }
    const token = tokens[at++];
    if (token?.number !== undefined) return { value: token.number, kind: PLAIN };
    if (token?.unit === undefined) throw fail();
    const unit = namedUnit(token.unit);
    if (!unit && !hasNumber) throw fail();
    if (!unit) throw new NotAQuantity(`“${text}”: “${token.unit}” is not a unit that is known here.`);
    return unit;
  }

  const result = sum();
  if (at < tokens.length) throw fail();
  const exact = tokens.filter(({ sign }) => sign !== "-" && sign !== "+").length === 1;
  return { ...result, hasNumber, exact };
}

/**
 * Numbers, units and signs in order; a power that follows a unit is a sign of its own.
 * @param {string} text
 */
function tokensOf(text) {
  /** @type {Token[]} */
  const tokens = [];
  const plain = text
    .trimEnd()
    .replace(/[\u2212\u2013]/g, "-")
    .replace(/[×·]/g, "*")
    .replace(/÷/g, "/");
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < plain.length) {
    const { number, unit, power, sign } = TOKEN.exec(plain)?.groups ?? {};
    const end = TOKEN.lastIndex;
    if (number !== undefined) {
      /** @param {string} other */
      const inText = (other) => plain.slice(0, end - number.length) + other + plain.slice(end);
      tokens.push({ text: number, number: literal(number, inText) });
    } else if (unit !== undefined) {
      tokens.push({ unit });
      if (power) tokens.push({ sign: { 2: "²", 3: "³" }[power.replace("^", "")] ?? power });
    } else if (sign !== undefined) {
      tokens.push({ sign });
    } else throw notANumber(text);
  }
  return tokens;
}

/**
 * The number that a literal stands for. A comma separates decimals or thousands; where it may do either,
 * both readings are offered, each by `inText` in place of the literal.
 * @param {string} text
 * @param {(other: string) => string} inText
 */
function literal(text, inText) {
  const [typed, exponent = ""] = text.split(/(?=e)/i);
  if (/^[1-9]\d{0,2},\d{3}$/.test(typed)) {
    const readings = [typed.replace(",", ""), typed.replace(",", ".")];
    throw new NotAQuantity(
      `“${typed}” can be read in two ways. Did you mean ${readings.join(" or ")}?`,
      readings.map((reading) => inText(reading + exponent)),
    );
  }
  const digits = typed.replace(/[\s'’]/g, "");
  const thousands = /^\d{1,3}(,\d{3})+\.\d*$|^\d{1,3}(,\d{3}){2,}$/.test(digits)
    ? ","
    : /^\d{1,3}(\.\d{3})+,\d+$/.test(digits)
      ? "."
      : "";
  const whole = thousands ? digits.replaceAll(thousands, "") : digits;
  const dotted = whole.includes(".") ? whole : whole.replace(",", ".");
  if (!/^(\d+\.?\d*|\.\d+)$/.test(dotted)) throw notANumber(inText(text));
  return Number(dotted + exponent);
}

/** @param {string} text */
const notANumber = (text) => new NotAQuantity(`“${text.trim()}” is not a number.`);

/**
 * Why a quantity does not fit a field, and what would.
 * @param {string} typed
 * @param {string} kind
 * @param {string} unit
 * @param {string} wanted
 */
function misfit(typed, kind, unit, wanted) {
  /** @param {string} each */
  const kindOf = (each) => KINDS.find(([, units]) => unitOf(units[0]).kind === each);
  const own = kindOf(kind);
  const what = own ? `“${typed}” is ${own[0]}` : `“${typed}” does not fit here`;
  if (wanted === PLAIN) return `${what}. A number without a unit is needed here.`;
  const [name, units] = kindOf(wanted) ?? ["a number", [unit]];
  return `${what}. ${name[0].toUpperCase()}${name.slice(1)} is needed here, in ${listed(units)}.`;
}

/** @param {string[]} words */
const listed = (words) => (words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} or ${words.at(-1)}`);
