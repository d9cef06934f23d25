// A question as a value, and as the text that stands for it in an address.

/** @import { Field } from "../../pkg/armill.js" */

/** @typedef {"p95" | "nominal" | "uncompensated"} Measure the error that is asked about */

/**
 * A number of the job over a range, in the field's own unit, or a choice over all its words.
 *
 * @typedef {{ path: string, from: number, to: number, count: number, log: boolean }} NumberRange
 * @typedef {NumberRange | { path: string, words: "all" }} Range
 */

/**
 * @typedef {{ kind: "largest", path: string, from: number, to: number, measure: Measure }} Largest
 * @typedef {{ kind: "sweep", ranges: Range[] }} Sweep
 * @typedef {{ kind: "robots", place: Place }} Robots
 * @typedef {{ kind: "choices" } | { kind: "tornado" } | { kind: "measures" } | { kind: "loops" }} Plain
 * @typedef {Largest | Sweep | Robots | Plain} Question
 */

/** @typedef {"kept" | "front" | "sought"} Place where the part is for each robot */

/** @type {Record<Place, string>} */
export const PLACES = {
  kept: "where the job has it",
  front: "in front of each robot",
  sought: "at the best place and turn for each",
};

/** @type {Record<Measure, string>} */
export const MEASURES = {
  p95: "after compensation, 95 of 100",
  uncompensated: "without compensation",
  nominal: "after compensation, if every number is exact",
};

/** What a largest value is usually asked of. */
export const LIMITED = [
  "cutting.axial_depth_mm",
  "cutting.radial_depth_mm",
  "motion.feed_mm_s",
  "cutting.feed_per_tooth_mm",
  "motion.acceleration_mm_s2",
  "tool.stickout_mm",
  "motion.force_n",
];

const PLAIN = ["choices", "tornado", "measures", "loops"];
const RANGE = /^([\w.]+)=([^:]+):([^:]+)(?::(\d+)(:log)?)?$/;

/**
 * A range as the core and the script read it.
 * @param {Range} range
 */
export function rangeText(range) {
  if ("words" in range) return `${range.path}=${range.words}`;
  const { path, from, to, count, log } = range;
  return `${path}=${from}:${to}:${count}${log ? ":log" : ""}`;
}

/**
 * Which question of a largest value, as the core and the script read it.
 * @param {Largest} question
 */
export const largestText = ({ path, from, to }) => `${path}=${from}:${to}`;

/**
 * The text of a question.
 * @param {Question} question
 */
export function written(question) {
  if (question.kind === "largest") return `largest~${largestText(question)}~${question.measure}`;
  if (question.kind === "sweep") return ["sweep", ...question.ranges.map(rangeText)].join("~");
  if (question.kind === "robots") return `robots~${question.place}`;
  return question.kind;
}

/**
 * The question of a text; undefined if it is none.
 * @param {string} text
 * @returns {Question | undefined}
 */
export function read(text) {
  const [kind, ...rest] = text.split("~");
  if (PLAIN.includes(kind) && !rest.length) return /** @type {Plain} */ ({ kind });
  if (kind === "robots" && Object.hasOwn(PLACES, rest[0] ?? "")) return { kind, place: /** @type {Place} */ (rest[0]) };
  const ranges = rest.filter((each) => each.includes("=")).map(readRange);
  if (!ranges.length || ranges.some((range) => !range)) return undefined;
  const [first] = /** @type {Range[]} */ (ranges);
  if (kind === "sweep" && ranges.length <= 2 && ranges.every((range) => range && ("words" in range || range.count > 1)))
    return { kind, ranges: /** @type {Range[]} */ (ranges) };
  const measure = /** @type {Measure} */ (rest[1]);
  if (kind !== "largest" || "words" in first || !Object.hasOwn(MEASURES, measure ?? "")) return undefined;
  return { kind, path: first.path, from: first.from, to: first.to, measure };
}

/**
 * @param {string} text
 * @returns {Range | undefined}
 */
function readRange(text) {
  const [, choice] = /^([\w.]+)=all$/.exec(text) ?? [];
  if (choice) return { path: choice, words: "all" };
  const [, path, low, high, count, log] = RANGE.exec(text) ?? [];
  const [from, to] = [Number(low), Number(high)];
  return path && Number.isFinite(from) && Number.isFinite(to)
    ? { path, from, to, count: Number(count ?? 0), log: Boolean(log) }
    : undefined;
}

/**
 * The question that a fragment names, as `&ask=...`, or undefined.
 * @param {string} fragment
 */
export function askedIn(fragment) {
  const [, text] = /(?:^#?|&)ask=([^&]*)/.exec(fragment) ?? [];
  return text === undefined ? undefined : read(decodeURIComponent(text));
}

/**
 * The range in which a field is asked about to begin with: what is usual, with the present value inside.
 * @param {Pick<Field, "min" | "max" | "usual">} field
 * @param {number} now
 * @returns {[number, number]}
 */
export function rangeOf({ min = -Infinity, max = Infinity, usual }, now) {
  const size = Math.abs(now) || 1;
  const [from, to] = usual ?? (now > 0 ? [now / 4, now * 4] : [now - size, now + size]);
  /** @param {number} value */
  const within = (value) => Math.min(max, Math.max(min, value));
  return [within(Math.min(from, now)), within(Math.max(to, now))];
}
