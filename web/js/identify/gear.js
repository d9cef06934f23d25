// The spring of a joint from its angles at the motor and behind the gear.

import { make, sentence } from "../page/dom.js";
import { notify } from "../page/toast.js";
import { formatNumber } from "../page/number.js";
import { Outcome, remarks } from "./result.js";
import { Source } from "./input.js";

/**
 * @import { GearSummaries, GearSummary } from "../../pkg/armill.js"
 * @import { Ask, Present } from "./panel.js"
 */

const EXAMPLE = "gear-kuka-kr300";
const MEGA = 1e6;

/** @param {{ ask: Ask } & Present} page */
export function makeGear({ ask, job, use }) {
  const columns = "time_s, motor_side_q3_deg, load_side_q3_deg, model_load_3_nm\n0.000, -0.103, 0.042, 0.0\n…";
  const source = new Source({
    id: "identify-gear",
    label: "Angles at motor and load",
    placeholder: columns,
    exampleName: "Example: KUKA KR300, joint 3",
    changed: () => look(),
    example,
  });
  const other = new Source({
    id: "identify-gear-other",
    label: "Another run of the same joints, to be predicted (may be empty)",
    placeholder: columns,
    exampleName: "Example: the other run",
    changed: () => look(),
    example: () => other.read(`${EXAMPLE}-b.csv`).then(look, refuse),
  });
  const drawn = make("select", { id: "identify-gear-joint" });
  const which = make("label", { htmlFor: "identify-gear-joint", hidden: true }, "Chart of ", drawn);
  drawn.addEventListener("change", () => look());
  const outcome = new Outcome({
    ask,
    kind: "gear",
    source,
    chart: { name: "gear", title: "Difference of motor and load angle" },
    show,
    faulty: ({ field }) => (field === "other" ? other : source),
  });

  /** @param {Parameters<Source["fail"]>[0]} error */
  const refuse = (error) => source.fail(error);

  function example() {
    Promise.all([source.read(`${EXAMPLE}-a.csv`), other.read(`${EXAMPLE}-b.csv`)]).then(look, refuse);
  }

  let seen = ""; // the text whose joints the list shows

  function look() {
    if (seen !== source.text) drawn.replaceChildren(); // another text may have other joints
    other.fail(null);
    const { version = 1, robot, uncertainty } = job();
    outcome.compute(
      JSON.stringify({ version, robot, uncertainty }),
      other.text.trim() ? other.text : undefined,
      drawn.value ? Number(drawn.value) : undefined,
    );
  }

  /**
   * @param {number} joint
   * @param {string} robot
   * @param {NonNullable<GearSummaries["in_job"][number]>} arm
   */
  function take(joint, robot, { joint_compliance_rad_per_nm: compliance, compliance_covariance: covariance }) {
    const name = `${robot.replace(/, joint \d+ from its encoders/, "")}, joint ${joint} from its encoders`;
    const { stiffness_percent, stiffness_factor, ...rest } = job().uncertainty ?? {};
    // Rows of springs and factors that a pass has taught would stand above the compliance.
    const { learned, ...own } = job();
    const { joint_springs_nm_arcmin: springs = [], ...its } = own.robot;
    const others = springs.filter((/** @type {number[]} */ [row]) => row !== joint);
    const kept = others.length ? { joint_springs_nm_arcmin: others } : {};
    use({
      ...own,
      robot: { ...its, ...kept, name, joint_compliance_rad_per_nm: compliance },
      uncertainty: { ...rest, compliance_covariance: covariance },
    });
    const gone = [
      learned && "factors from a measured pass",
      others.length < springs.length && "a table of the joint’s spring",
    ];
    const words = gone.filter(Boolean).join(" and ");
    notify(
      `Joint ${joint} of the job’s robot now has this stiffness and its interval; the others vary as before.` +
        `${words ? ` It takes the place of ${words}.` : ""} Undo removes it.`,
    );
  }

  /** @param {GearSummaries} found */
  function show(found) {
    const { joints, robot, in_job: arms } = found;
    seen = source.text;
    if (!drawn.options.length) {
      const option = (/** @type {GearSummary} */ { joint }) =>
        make("option", { value: String(joint) }, `joint ${joint}`);
      drawn.replaceChildren(...joints.map(option));
    }
    which.hidden = joints.length < 2;
    const buttons = joints.flatMap(({ joint }, at) => {
      const arm = arms[at];
      if (!arm) return [];
      const name = `Use it for joint ${joint} of the job’s robot`;
      const button = make("button", { type: "button", className: "primary", id: `use-gear-${joint}` }, name);
      button.addEventListener("click", () => take(joint, robot, arm));
      return [button];
    });
    return [
      ...joints.flatMap((gear) => [
        make("p", { className: "found" }, gear.sentence),
        ...remarks(gear.remarks.map(sentence)),
      ]),
      tableOf(joints),
      make(
        "p",
        { className: "note" },
        "Intervals come from leaving out one block of half a second after the other, because neighboring samples err alike.",
      ),
      make("div", { className: "identify-tools" }, ...buttons, which),
    ];
  }

  return {
    node: make(
      "section",
      { className: "identify", "aria-labelledby": "identify-gear-title" },
      make("h2", { id: "identify-gear-title" }, "A joint’s spring from encoders behind the gear"),
      make(
        "p",
        { className: "lead" },
        "Move the arm for ten seconds or more and record, for one joint or several, the angle at the motor and behind the gear, and the " +
          "torque that a model of the arm puts on the joint. No load has to be hung on.",
      ),
      source.node,
      make("p", { className: "whose" }, "Another run, to see how well the first predicts it. It may stay empty:"),
      other.node,
      outcome.node,
    ),
    look,
    example,
  };
}

/** @param {GearSummary[]} joints */
function tableOf(joints) {
  /**
   * @param {string} label
   * @param {string} unit
   * @param {string} value
   * @param {[number, number]} [interval]
   */
  const cell = (label, unit, value, interval) =>
    make(
      "td",
      { "data-label": label },
      value,
      make("span", { className: "unit" }, ` ${unit}`),
      interval ? ` (${formatNumber(interval[0], 3)} to ${formatNumber(interval[1], 3)})` : "",
    );
  /** @param {GearSummary} gear */
  const row = (gear) => {
    const stiffness = gear.stiffness_nm_per_rad;
    const within = gear.stiffness_interval_nm_per_rad;
    const spring = stiffness
      ? cell(
          "Stiffness",
          "10⁶ N m/rad",
          formatNumber(stiffness / MEGA, 3),
          within && [within[0] / MEGA, within[1] / MEGA],
        )
      : cell("Stiffness", "", "not seen");
    return make(
      "tr",
      {},
      make("th", { scope: "row" }, `Joint ${gear.joint}`),
      spring,
      cell("Delay", "ms", formatNumber(gear.delay_ms, 3), gear.delay_interval_ms),
      cell("Hysteresis, to each side", "µrad", formatNumber(gear.hysteresis_urad, 2), gear.hysteresis_interval_urad),
      cell("Not explained", "µrad rms", formatNumber(gear.rest_urad, 2)),
    );
  };
  const heads = ["Joint", "Stiffness", "Delay", "Hysteresis, to each side", "Not explained"];
  return make(
    "table",
    { id: "identified-gear", className: "identified" },
    make("caption", {}, "What the encoders show, with 95 % intervals"),
    make("thead", {}, make("tr", {}, ...heads.map((text) => make("th", { scope: "col" }, text)))),
    make("tbody", {}, ...joints.map(row)),
  );
}
