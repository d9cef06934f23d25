// The table of factors that a measured pass teaches.

import { make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";

/** @import { LearnSummary } from "../../pkg/armill.js" */

/** @type {Record<string, string>} */
const NAMES = {
  cutting: "Cutting force",
  "radial-ratio": "Its radial ratio",
  "axial-ratio": "Its axial ratio",
};

/** @param {string} input */
const nameOf = (input) => NAMES[input] ?? `Stiffness of joint ${input.replace("stiffness-", "")}`;

/** @param {LearnSummary["factors"]["factors"]} factors */
export function factorTable(factors) {
  /** @param {[number, number]} ends */
  const range = ([low, high]) => `${formatNumber(low, 3)} to ${formatNumber(high, 3)}`;
  /** @param {LearnSummary["factors"]["factors"][number]} factor */
  const row = ({ input, value, interval, before }) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, nameOf(input)),
      make("td", { "data-label": "Factor" }, formatNumber(value, 3)),
      make("td", { "data-label": "95 % interval" }, range(interval)),
      make("td", { "data-label": "Before" }, range(before)),
    );
  const heads = ["What", "Factor", "95 % interval", "Before"].map((text) => make("th", { scope: "col" }, text));
  return make(
    "table",
    { id: "learned", className: "identified" },
    make("caption", {}, "Factors on what the job says"),
    make("thead", {}, make("tr", {}, ...heads)),
    make("tbody", {}, ...factors.map(row)),
  );
}
