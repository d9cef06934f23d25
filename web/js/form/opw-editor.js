// Ortho-parallel parameters of an arm: seven lengths, then sign and zero offset of each joint.

import { make } from "../page/dom.js";
import { allUnderstood, numberCell } from "./number-cell.js";
import { tableEditor } from "./table-editor.js";

/** @import { Editor } from "./editors.js" */

/** @typedef {{ joint_sign: number[], joint_offset_deg: number[] } & Record<string, any>} Opw as in a job */

/**
 * The editor of these parameters; `standard` are the default's.
 * @param {string} id
 * @param {Opw} standard
 * @returns {Editor}
 */
export function opwEditor(id, standard) {
  const scalars = Object.keys(standard).filter((key) => key.endsWith("_mm"));
  const cells = scalars.map((key) => numberCell(`${id}-${key}`, "mm"));
  const inputs = cells.map(({ input }) => input);
  const parts = scalars.map((key, i) =>
    make("label", { className: "part", for: inputs[i].id }, make("span", {}, key.replace("_mm", "")), inputs[i]),
  );
  const joints = tableEditor(id, jointsOf(standard), { joints: true });
  return {
    node: make(
      "div",
      { id: `${id}-lengths`, role: "group" },
      make("div", { className: "vector lengths" }, ...parts),
      joints.node,
    ),
    inputs: [...inputs, ...joints.inputs],
    read() {
      /** @type {{ joint_sign: number, offset_deg: number }[]} */
      const rows = joints.read();
      const values = scalars.map((key, i) => [key, cells[i].read()]);
      return {
        ...Object.fromEntries(values),
        joint_sign: rows.map((row) => row.joint_sign),
        joint_offset_deg: rows.map((row) => row.offset_deg),
      };
    },
    write(value) {
      scalars.forEach((key, i) => cells[i].write(value[key]));
      joints.write(jointsOf(value));
    },
    at(rest) {
      const scalar = inputs[scalars.findIndex((key) => rest.startsWith(`.${key}`))];
      return (
        scalar ??
        joints.at(
          rest.replace(
            /^\.joint_(sign|offset_deg)(\[\d+\])$/,
            (_, key, row) => `${row}.${key === "sign" ? "joint_sign" : key}`,
          ),
        )
      );
    },
    understood: () => [allUnderstood(cells), joints.understood?.()].filter(Boolean).join(", "),
    relabel: joints.relabel,
  };
}

/**
 * Sign and offset as rows of a table.
 * @param {Opw} opw
 */
const jointsOf = ({ joint_sign, joint_offset_deg }) =>
  joint_sign.map((sign, i) => ({ joint_sign: sign, offset_deg: joint_offset_deg[i] }));
