// The groups that the form is folded into, and what each says of itself while it is folded.

import { make } from "../page/dom.js";
import { brief } from "./field-text.js";

/**
 * @import { Job } from "../job/job.js"
 * @import { Row } from "./row.js"
 */

/** @type {Record<string, string>} */
const TITLES = {
  robot: "Robot",
  frames: "Frames",
  path: "Path",
  stock: "Stock",
  motion: "Motion",
  tool: "Tool",
  material: "Material",
  cutting: "Cutting",
  shaper: "Vibration",
  compensation: "Compensation",
  uncertainty: "How sure",
  online: "Sensor",
  program: "Program",
};
const OPEN = ["path", "motion"]; // the groups that most visits change

/**
 * Groups in `parent`, each made when it is first asked for: `put(row)` adds a field to its own, `digest(rows, job)`
 * writes what each holds.
 * @param {HTMLElement} parent
 */
export function makeGroups(parent) {
  /** @type {Map<string, { details: HTMLElement, digest: HTMLElement, body: HTMLElement }>} */
  const groups = new Map();

  /** @param {string} name */
  function add(name) {
    const digest = make("span", { className: "digest" });
    const title = TITLES[name] ?? name;
    const body = make("fieldset", {}, make("legend", { className: "hidden-text" }, title));
    const details = make("details", { className: "group", id: `group-${name}`, open: OPEN.includes(name) });
    details.append(make("summary", {}, make("span", { className: "group-title" }, title), digest), body);
    parent.append(details);
    const group = { details, digest, body };
    groups.set(name, group);
    return group;
  }

  return {
    /** @param {Row} row */
    put({ field, node }) {
      (groups.get(field.group) ?? add(field.group)).body.append(node);
    },
    /**
     * @param {Row[]} rows
     * @param {Job} job
     */
    digest(rows, job) {
      for (const [name, { details, digest }] of groups) {
        const own = rows.filter(({ field, node }) => field.group === name && !node.hidden);
        const wrong = own.filter((row) => row.message).length;
        details.classList.toggle("broken", wrong > 0);
        digest.textContent = wrong ? errorsText(wrong) : contentText(own, job);
      }
    },
  };
}

/** @param {number} count */
const errorsText = (count) => (count === 1 ? "1 error" : `${count} errors`);

/**
 * What a group holds, in a few words.
 * @param {Row[]} rows
 * @param {Job} job
 */
const contentText = (rows, job) =>
  rows
    .filter(({ field }, i) => i === 0 || (i === 1 && !field.choices) || (i === 2 && rows[1].field.kind === "vector"))
    .map(({ field }) => brief(field, job.get(field)))
    .filter(Boolean)
    .join(", ");
