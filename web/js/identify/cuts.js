// Cutting coefficients from a dynamometer's mean forces.

import { readText } from "../core/assets.js";
import { make, sentence } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { notify } from "../page/toast.js";
import { Source } from "./input.js";
import { remarks } from "./result.js";

/**
 * @import { FittedCut } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Ask, Present } from "./panel.js"
 */

const EXAMPLE = "learn-cuts";

/** @param {{ ask: Ask } & Present} page */
export function makeCuts({ ask, job, use }) {
  /** @type {JobData | null} */
  let example = null; // the tool and cut of the example, as long as they are looked at instead of the job's
  let asked = "";
  const whose = make("p", { className: "whose" });
  const result = make("div", { className: "result", hidden: true, "aria-live": "polite" });
  const source = new Source({
    id: "learn-cuts",
    label: "Mean forces of several cuts",
    placeholder: "feed_per_tooth_mm, fx_n, fy_n, fz_n\n0.025, -55.6, 126.6, -61.6\n0.05, -65.1, 162.4, -68.6\n…",
    exampleName: "Example: five slots",
    changed: () => look(),
    example: exampleSoon,
  });

  async function look() {
    const own = make("button", { type: "button", className: "quiet" }, "Use the job’s instead");
    own.addEventListener("click", () => ((example = null), look()));
    whose.replaceChildren(
      ...(example ? ["Tool and engagement are the example’s. ", own] : ["Tool and engagement are the job’s."]),
    );
    const { tool, cutting } = example ?? job();
    const json = JSON.stringify({ version: 1, tool, cutting: { ...cutting, engagement: stated(cutting) } });
    const { text } = source;
    if (asked === json + text) return;
    asked = json + text;
    if (!text.trim()) {
      result.hidden = true;
      return source.fail(null);
    }
    const mine = asked;
    try {
      const fit = await ask("fit_cuts", json, text);
      if (mine !== asked) return;
      source.fail(null);
      result.replaceChildren(...show(fit));
      result.hidden = false;
      result.classList.remove("stale");
    } catch (error) {
      if (mine !== asked) return;
      source.fail(error);
      result.classList.add("stale");
    }
  }

  function exampleSoon() {
    showExample().catch((error) => source.fail(error));
  }

  async function showExample() {
    example = JSON.parse(await readText(`examples/${EXAMPLE}.json`));
    await source.read(`${EXAMPLE}.csv`);
    look();
  }

  /** @param {FittedCut} fit */
  function take({ coefficients }) {
    const numbers = coefficients.map(({ key, value }) => [key, Number(value.toPrecision(4))]);
    use({ ...job(), material: Object.fromEntries(numbers) });
    notify("The job’s material now has these coefficients. Undo removes them.");
  }

  /** @param {FittedCut} fit */
  function show(fit) {
    const button = make(
      "button",
      { type: "button", className: "primary", id: "use-coefficients" },
      "Use these coefficients in the job",
    );
    button.addEventListener("click", () => take(fit));
    const check = fit.peak_check
      ? ` Computed peaks are ${formatNumber(fit.peak_check.ratio, 3)} times the measured ones on average, off by up to ` +
        `${formatNumber(fit.peak_check.worst_percent, 2)} %.`
      : "";
    const shares = fit.r_squared.map((share) => formatNumber(100 * share, 3)).join(", ");
    return [
      tableOf(fit),
      ...remarks(fit.remarks.map(sentence)),
      make(
        "p",
        { className: "note" },
        `From ${fit.cuts} cuts. Straight lines over the feed per tooth explain ${shares} % of how the force varies along the ` +
          `feed, across it and along the tool.${check}`,
      ),
      make("div", { className: "identify-tools" }, button),
    ];
  }

  return {
    node: make(
      "section",
      { className: "identify", "aria-labelledby": "learn-cuts-title" },
      make("h2", { id: "learn-cuts-title" }, "Cutting coefficients from a dynamometer"),
      make(
        "p",
        { className: "lead" },
        "Cut at several feeds per tooth with the job’s tool and engagement. One row per cut: feed per tooth and the mean force " +
          "on the tool, x along the feed, y to its left, z from tip to spindle. axial_depth_mm and the largest resultant, " +
          "peak_n, may be added.",
      ),
      source.node,
      whose,
      result,
    ),
    look,
    example: exampleSoon,
  };
}

/**
 * The engagement of a cut; that of a stock is not one.
 * @param {JobData["cutting"]} cutting
 */
const stated = (cutting) => (cutting?.engagement === "from-stock" ? undefined : cutting?.engagement);

/** @param {FittedCut} fit */
function tableOf({ coefficients }) {
  const unit = (/** @type {string} */ key) => (key.endsWith("mm2") ? "N/mm²" : "N/mm");
  const row = (/** @type {FittedCut["coefficients"][number]} */ { key, value, interval }) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, `${key.split("_")[0]} `, make("span", { className: "unit" }, unit(key))),
      make("td", { "data-label": "Value" }, formatNumber(value, 4)),
      make(
        "td",
        { "data-label": "95 % interval" },
        interval ? `${formatNumber(interval[0], 4)} to ${formatNumber(interval[1], 4)}` : "not known",
      ),
    );
  const heads = ["Coefficient", "Value", "95 % interval"].map((text) => make("th", { scope: "col" }, text));
  return make(
    "table",
    { id: "fitted-cuts", className: "identified" },
    make("caption", {}, "Cutting coefficients"),
    make("thead", {}, make("tr", {}, ...heads)),
    make("tbody", {}, ...coefficients.map(row)),
  );
}
