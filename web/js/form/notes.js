// What is said below a field of the value that it has: where it comes from, what follows from it.

import { FROM_STOCK } from "../job/job.js";
import { plainNumber } from "../page/number.js";
import { shownUnit, shownValue } from "./shown.js";

/**
 * @import { Presets, RobotPreset, Understood } from "../../pkg/armill.js"
 * @import { Job } from "../job/job.js"
 * @import { Row } from "./row.js"
 */

/**
 * What a program states itself, and the field that this takes the place of.
 * @type {Record<string, (program: Understood) => [number, number] | undefined>}
 */
const STATED = {
  "motion.feed_mm_s": ({ feeds_mm_s }) => feeds_mm_s,
  "cutting.spindle_rpm": ({ spindle_rpm }) => spindle_rpm,
};

/**
 * `noteRow(row, robot, program)` writes the note of a row; `robot` is the library's, if the job has one, and `program`
 * what the core understood of the path, if it is one.
 * @param {Job} job
 * @param {Presets} presets
 */
export function makeNotes(job, { robots, materials }) {
  const ofPresets = Object.fromEntries([...robots, ...materials].map(({ id, note }) => [id, note]));

  /**
   * @param {Row} row
   * @param {RobotPreset | undefined} robot
   * @param {Understood | undefined} program
   */
  return function noteRow(row, robot, program) {
    const { field, note } = row;
    if (field.path === "robot.joint_compliance_rad_per_nm") noteCompliance(row, robot, job.changed(field));
    else if (STATED[field.path]) note.textContent = program ? stated(row, STATED[field.path](program)) : "";
    else if (field.path === "workpiece_frame.xyz_mm") note.textContent = robot?.world_note ?? "";
    else if (field.path === "cutting.engagement") noteEngagement(row, job.hasStock, job.get(field) === FROM_STOCK);
    else note.textContent = field.kind === "choice" ? (ofPresets[job.get(field)] ?? "") : "";
  };
}

/**
 * Beside the numbers: an order of magnitude must not look like a measurement.
 * @param {Row} row
 * @param {RobotPreset | undefined} robot
 * @param {boolean} given whether the numbers are one's own
 */
function noteCompliance({ node, note }, robot, given) {
  note.textContent = robot && !given ? robot.stiffness_note : "";
  node.classList.toggle("assumed", Boolean(robot?.stiffness_assumed && !given));
}

/**
 * A number of the program goes before the job's.
 * @param {Row} row
 * @param {[number, number] | undefined} range
 */
function stated({ field }, range) {
  if (!range) return "The program states none: this one is used.";
  const [least, most] = range.map((value) => plainNumber(shownValue(value, field.unit)));
  const span = least === most ? least : `${least} to ${most}`;
  return `The program states ${span} ${shownUnit(field.unit)}, which is used; this one only where it states none.`;
}

/**
 * Without a stock nothing follows from it; with one, nothing else is asked for.
 * @param {Row} row
 * @param {boolean} stock
 * @param {boolean} follows
 */
function noteEngagement({ editor, note }, stock, follows) {
  for (const option of editor.inputs[0].options) option.disabled = option.value === FROM_STOCK && !stock;
  note.textContent = !stock
    ? "With a stock, it can follow what is left of the material along the path."
    : follows
      ? "Depths and angles come from the stock, place by place."
      : "This engagement holds all along the path: the stock is not used.";
}
