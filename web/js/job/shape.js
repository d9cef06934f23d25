// The shapes that a part of a job may take: a robot or material by preset or by numbers, a path of some kind, a shaper
// by frequency in one of two units.

import { draftKey, keyOf, parentOf, twin } from "./field-path.js";

/** @import { Field } from "../../pkg/armill.js" */

export const OWN = "table"; // what a preset choice says when the numbers are one's own
export const KIENZLE = "kienzle"; // the same for a material by k_c1.1 and m_c
export const EXTENTS = ["stock.allowance_mm", "stock.top_mm"]; // what the extents of a program give by themselves
const OWN_FORMS = [OWN, "opw", KIENZLE]; // a robot's may be ortho-parallel parameters instead

/**
 * The shape that the part at `path` has now, by which fields say when they are shown; `preset` are the numbers behind
 * the preset that it names, if any.
 * @param {string} path
 * @param {any} part
 * @param {Record<string, any>} preset
 */
export function shapeNow(path, part, preset) {
  if (path === "uncertainty") return stiffnessKnown(part);
  if (part?.frequency_hz !== undefined) return "hz";
  if (part?.opw !== undefined) return "opw";
  if (part?.kc11_n_mm2 !== undefined || part?.mc !== undefined) return KIENZLE;
  if (part?.preset === undefined) return OWN;
  return preset.kc11_n_mm2 !== undefined ? `${KIENZLE}-preset` : preset.orthogonal ? "orthogonal-preset" : "preset";
}

/**
 * In which of three ways a job says how well stiffness is known.
 * @param {any} part
 */
function stiffnessKnown(part) {
  if (part?.compliance_covariance !== undefined) return "covariance";
  return part?.stiffness_factor !== undefined ? "factor" : "percent";
}

/**
 * An object with every field of the part at `path` that is needed when its field `decider` is `choice`. Values are those
 * that are `known` by key, those kept in `drafts`, or the defaults.
 * @param {Field[]} fields
 * @param {string} path
 * @param {{ known?: Map<string, any>, drafts: Map<string, any>, decider?: Field, choice?: string }} given
 */
export function shaped(fields, path, { known = new Map(), drafts, decider, choice }) {
  const own = OWN_FORMS.includes(choice ?? "");
  const byPreset = decider?.path.endsWith(".preset") && !own;
  /** @type {Record<string, any>} */
  const shape = {};
  for (const field of fields) {
    const key = keyOf(field.path);
    if (parentOf(field.path) !== path) continue;
    if (field.path === decider?.path) {
      if (!own) shape[key] = choice;
      continue;
    }
    const { when } = field;
    const asked = when && (when.path === decider?.path || (own && when.path === path));
    const unneeded = asked && !when.is.includes(String(choice));
    if (byPreset || unneeded || isInOtherUnit(fields, field, known)) continue;
    if (choice === "extents" && EXTENTS.includes(field.path)) continue;
    const standard = field.defaults?.[choice ?? ""] ?? field.default;
    shape[key] = structuredClone(known.get(key) ?? drafts.get(draftKey(field, choice)) ?? standard);
  }
  return shape;
}

/**
 * Whether a part with the `known` keys gives the quantity by this field's twin; rad/s unless Hz
 * is known.
 * @param {Field[]} fields
 * @param {Field} field
 * @param {Map<string, any>} known
 */
function isInOtherUnit(fields, { path }, known) {
  const other = twin(path);
  if (!other || !fields.some((field) => field.path === other)) return false;
  return path.endsWith("_hz") !== known.has("frequency_hz");
}
