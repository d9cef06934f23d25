// A result as a few lines of Markdown, for a report or a message.

import { formatError, formatNumber } from "../page/number.js";
import { inWords } from "../form/field-text.js";
import { SEVERITY } from "./warnings.js";

/**
 * @import { CutFigures, Statistics, Summary, SurfaceFigures } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Job } from "../job/job.js"
 */

/**
 * `job` is the Job of the result, `standard` the default job's plain object, `link` its address or
 * null.
 * @param {{ summary: Summary, job: Job, standard: JobData, link: string | null }} shared
 */
export function markdown({ summary, job, standard, link }) {
  const { before_mm: before, after_mm: after, passes } = summary;
  /** @type {[name: string, error: Statistics][]} */
  const rows = [
    ["deflection alone", before.deflection],
    ["shaping alone", before.shaping],
    ["both, before compensation", before.both],
    [`after compensation, ${passes} ${passes === 1 ? "pass" : "passes"}, if every number is exact`, after],
  ];
  /**
   * @param {import("../../pkg/armill.js").Field} field
   * @param {any} value
   */
  const words = (field, value) => escaped(inWords(field, value, { asSaved: true }));
  const changed = job.differences(standard).filter(({ own }) => own !== undefined);
  return [
    ...(job.data.name ? [`## ${escaped(job.data.name)}`, ""] : []),
    `**${escaped(summary.verdict)}**`,
    "",
    escaped(summary.how_sure.sentence),
    ...(summary.how_sure.measure_first ? ["", escaped(summary.how_sure.measure_first.sentence)] : []),
    "",
    "| Contour error, mm | mean | max |",
    "|---|---:|---:|",
    ...rows.map(([name, { mean, max }]) => `| ${name} | ${formatError(mean)} | ${formatError(max)} |`),
    "",
    `Mean force ${formatNumber(Math.hypot(...summary.mean_force_n))} N, path length ` +
      `${formatNumber(summary.path_length_mm, 4)} mm, duration ${formatNumber(summary.duration_s)} s, stops: ` +
      `${summary.stops.count}.`,
    ...(summary.warnings.length ? ["", "Warnings:", "", ...summary.warnings.map(warningLine)] : ["", "No warnings."]),
    ...(summary.cut.stock ? ["", escaped(inStock(summary.cut))] : []),
    ...(summary.feed_rule ? ["", escaped(summary.feed_rule.sentence)] : []),
    ...(summary.surface?.worst.length ? ["", escaped(surfaceLeft(summary.surface))] : []),
    "",
    changed.length ? "Inputs that differ from the default job:" : "Inputs: the default job.",
    ...changed.map(
      ({ field, own, other }) => `- ${field.label}: ${words(field, own)} (default ${words(field, other)})`,
    ),
    "",
    `${link ? `[Open in Armill](${link}), ` : ""}fingerprint \`${summary.fingerprint}\`, model ${summary.model}`,
    "",
  ].join("\n");
}

/** @param {{ severity: import("../../pkg/armill.js").Warning["severity"], message: string }} given */
const warningLine = ({ severity, message }) => `- **${SEVERITY[severity]}:** ${escaped(message)}`;

/**
 * The cut in a stock.
 * @param {CutFigures} cut
 */
const inStock = ({ stock, removed_cm3 = 0, air_share = 0, largest_engaged_deg = 0 }) =>
  `Engagement from the stock: ${stock}. It loses ${formatNumber(removed_cm3)} cm³; the tool is engaged by up to ` +
  `${formatNumber(largest_engaged_deg)} deg and in the air on ${formatNumber(100 * air_share, 2)} % of its path at feed.`;

/**
 * The surface that is left.
 * @param {SurfaceFigures} surface
 */
const surfaceLeft = ({ worst_before_mm = 0, worst_after_mm = 0, after_p95_mm = 0, worst }) =>
  `Surface left on the part: up to ${formatError(worst_before_mm)} mm off before compensation, in 95 of 100 at most ` +
  `${formatError(after_p95_mm)} mm after it (${formatError(worst_after_mm)} mm if every number is exact). ` +
  worst.map(({ sentence }) => `${sentence}.`).join(" ");

/** @param {string} text */
const escaped = (text) => text.replace(/[\\`*_[\]|<>]/g, "\\$&");
