// Joint compliances from loaded poses.

import { make, sentence } from "../page/dom.js";
import { readText } from "../core/assets.js";
import { notify } from "../page/toast.js";
import { formatNumber } from "../page/number.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { Outcome, remarks } from "./result.js";
import { Source } from "./input.js";

/**
 * @import { JointSummary, StiffnessSummary } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Ask, Present } from "./panel.js"
 */

const EXAMPLE = "identify-fanuc-r2000ic";
const MICRO = 1e6;
const JOINTS = { table: "as the robot’s table does", "coupled-j3": "joint 3 from the horizontal (FANUC)" };

/** @param {{ ask: Ask } & Present} page */
export function makeStiffness({ ask, job, use }) {
  /** @type {JobData | null} */
  let example = null; // the measured robot, as long as it is looked at instead of the job's
  const joints = make(
    "select",
    { id: "identify-joints" },
    ...Object.entries(JOINTS).map(([value, name]) => make("option", { value }, name)),
  );
  const whose = make("p", { className: "whose" });
  const source = new Source({
    id: "identify-loads",
    label: "Measured loads and displacements",
    placeholder:
      "q1_deg, q2_deg, q3_deg, q4_deg, q5_deg, q6_deg, fx_n, fy_n, fz_n, dx_mm, dy_mm, dz_mm\n10, -20, 100, 0, 45, 0, " +
      "150, 0, -300, 0.42, 0.03, -0.61\n…",
    exampleName: "Example: FANUC, 43 postures",
    changed: () => look(),
    example: exampleSoon,
    more: [make("label", { htmlFor: "identify-joints" }, "Pendant counts joints ", joints)],
  });
  const outcome = new Outcome({
    ask,
    kind: "stiffness",
    source,
    chart: { name: "stiffness", title: "Displacement of each row, and its residual" },
    show,
  });
  joints.addEventListener("change", () => look());

  /** @param {JobData} job */
  const robotOf = ({ version = 1, robot, tool_frame }) => ({ version, robot, tool_frame });

  function look() {
    const own = make("button", { type: "button", className: "quiet" }, "Use the job’s robot instead");
    own.addEventListener("click", () => ((example = null), look()));
    whose.replaceChildren(
      ...(example
        ? [`The robot is the example’s, a ${example.robot.name}, with the tip where the load was. `, own]
        : ["The robot and its tool frame are the job’s."]),
    );
    outcome.compute(JSON.stringify(robotOf(example ?? job())), joints.value);
  }

  function exampleSoon() {
    showExample().catch((error) => source.fail(error));
  }

  async function showExample() {
    example = JSON.parse(await readText(`examples/${EXAMPLE}.json`));
    joints.value = "coupled-j3";
    await source.read(`${EXAMPLE}.csv`);
    look();
  }

  /** @param {StiffnessSummary} found */
  function take(found) {
    const { robot, tool_frame, workpiece_frame } = example ?? job();
    const { compliance_covariance: covariance } = found;
    const name = found.robot.replace(/, compliance identified.*$/, "");
    const identified = {
      ...robot,
      name: `${name}, compliance ${found.source}`,
      joint_compliance_rad_per_nm: found.joint_compliance_rad_per_nm.map((c) => Number(c.toPrecision(6))),
    };
    /** @type {JobData} */
    const next = { ...job(), robot: identified, tool_frame, workpiece_frame };
    const { stiffness_percent, stiffness_factor, compliance_covariance, ...rest } = next.uncertainty ?? {};
    next.uncertainty = covariance
      ? { ...rest, compliance_covariance: covariance }
      : { ...rest, stiffness_percent, stiffness_factor };
    use(next);
    notify(
      `The job has the compliances ${found.source}${covariance ? ", and their uncertainty" : ""}` +
        `${example ? ", with the robot, its tool and a workpiece in its reach" : ""}. Undo removes them.`,
    );
  }

  /** @param {StiffnessSummary} found */
  function show(found) {
    const button = make(
      "button",
      { type: "button", className: "primary", id: "use-compliance" },
      example ? "Use this robot and these compliances in the job" : "Use these compliances in the job",
    );
    button.addEventListener("click", () => take(found));
    const unsure = found.joints
      .filter(({ verdict }) => verdict === "idle" || verdict === "entangled")
      .map(({ joint }) => joint);
    const warning = unsure.length
      ? [
          `${unsure.length > 1 ? "Joints" : "Joint"} ${unsure.join(", ")} cannot be identified from these postures: ` +
            `do not rely on the values in the table.`,
        ]
      : [];
    return [
      make("p", { className: "found" }, found.sentence),
      ...remarks([...warning, ...found.remarks.map(sentence)]),
      tableOf(found.joints),
      make(
        "p",
        { className: "note" },
        `Intervals are 95 % if errors are independent and of equal size and only the joints deflect. ` +
          `Inflation: how many times the variance grows because the joints look alike in these postures. Condition number ` +
          `${formatNumber(found.condition ?? Infinity)}${found.condition === null ? " infinite" : ""}, residual ` +
          `${lengthText(found.residual_rms_mm)} ${lengthUnit()} rms per component, ${found.degrees_of_freedom} degrees of freedom.`.replace(
            "– infinite",
            "infinite",
          ),
      ),
      make("div", { className: "identify-tools" }, button),
    ];
  }

  return {
    node: make(
      "section",
      { className: "identify", "aria-labelledby": "identify-stiffness" },
      make("h2", { id: "identify-stiffness" }, "Joint compliances from measured loads"),
      make(
        "p",
        { className: "lead" },
        "Load the tip in at least twenty postures, as different as the cell allows, and measure the deflection. " +
          "One row per load: six joint angles, force on the tip and displacement of the tip in the robot’s base frame. A " +
          "first line may name columns and units; moments (mx_nm, my_nm, mz_nm) may be added, displacements left out.",
      ),
      source.node,
      whose,
      outcome.node,
    ),
    look,
    example: exampleSoon,
  };
}

/** @param {JointSummary[]} joints */
function tableOf(joints) {
  /** @param {number | null} value */
  const micro = (value) => (value === null ? "∞" : formatNumber(value * MICRO));
  /** @param {JointSummary} joint */
  const row = ({
    joint,
    compliance_rad_per_nm,
    interval_rad_per_nm: [low, high],
    stiffness_nm_per_rad,
    variance_inflation,
    verdict,
    sentence: words,
  }) =>
    make(
      "tr",
      { className: verdict },
      make("th", { scope: "row" }, `Joint ${joint}`),
      make("td", { "data-label": "Compliance" }, micro(compliance_rad_per_nm)),
      make("td", { "data-label": "95 % interval" }, `${micro(low)} to ${micro(high)}`),
      make(
        "td",
        { "data-label": "Stiffness, kN m/rad" },
        stiffness_nm_per_rad === null ? "rigid" : formatNumber(Math.round(stiffness_nm_per_rad / 1000)),
      ),
      make(
        "td",
        { "data-label": "Inflation" },
        variance_inflation === null ? "∞" : formatNumber(variance_inflation, 2),
      ),
      make("td", {}, sentence(words)),
    );
  /**
   * @param {string} text
   * @param {string} [unit]
   */
  const head = (text, unit) =>
    make("th", { scope: "col" }, text, unit ? make("span", { className: "unit" }, ` ${unit}`) : "");
  return make(
    "table",
    { id: "identified", className: "identified" },
    make("caption", {}, "Joint compliances ", make("span", { className: "unit" }, "10⁻⁶ rad/(N m)")),
    make(
      "thead",
      {},
      make(
        "tr",
        {},
        head("Joint"),
        head("Compliance"),
        head("95 % interval"),
        head("Stiffness", "kN m/rad"),
        head("Inflation"),
        head("How well it is known"),
      ),
    ),
    make("tbody", {}, ...joints.map(row)),
  );
}
