// A frame as a controller or its pendant writes it, pasted into any box of the frame.

import { CONVENTIONS, strayLength } from "./orientation.js";

const NUMBER = "([-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:e[-+]?\\d+)?)";
const NAMED = new RegExp(`\\b(RX|RY|RZ|[XYZABCWPR])\\s*[:=]?\\s*${NUMBER}`, "gi");
/** @param {number} count */
const list = (count) => `\\[\\s*${Array(count).fill(NUMBER).join("\\s*,\\s*")}\\s*\\]`;
const POSE = new RegExp(`${list(3)}\\s*,\\s*${list(4)}`, "i"); // ABB: [[x, y, z], [q1, q2, q3, q4]]
const TRSF = new RegExp(`\\{\\s*${Array(6).fill(NUMBER).join("\\s*,\\s*")}\\s*\\}`, "i"); // VAL 3: {x, y, z, rx, ry, rz}

/**
 * Position [mm] and orientation [deg] of the frame in `text`, `{ xyz_mm, rpy_deg }`; undefined if it has no whole one. Rx, Ry, Rz
 * are read as `brand` counts them, Stäubli if that is another.
 * @param {string} text
 * @param {string} brand
 */
export function frameIn(text, brand) {
  const pose = POSE.exec(text)?.slice(1).map(Number);
  if (pose) return strayLength(pose.slice(3)) === undefined ? frame(pose, "ABB") : undefined;
  const turned = brand === "Yaskawa" ? brand : "Stäubli";
  const trsf = TRSF.exec(text)?.slice(1).map(Number);
  if (trsf) return frame(trsf, turned);
  const named = new Map([...text.matchAll(NAMED)].map(([, name, value]) => [name.toUpperCase(), Number(value)]));
  for (const [angles, convention] of /** @type {[string[], string][]} */ ([
    [["A", "B", "C"], "KUKA"],
    [["W", "P", "R"], "FANUC"],
    [["RX", "RY", "RZ"], turned],
  ])) {
    const keys = ["X", "Y", "Z", ...angles];
    if (keys.every((key) => named.has(key)))
      return frame(
        keys.map((key) => Number(named.get(key))),
        convention,
      );
  }
  return undefined;
}

/**
 * @param {number[]} values
 * @param {string} brand
 */
const frame = (values, brand) => ({ xyz_mm: values.slice(0, 3), rpy_deg: CONVENTIONS[brand].rpy(values.slice(3)) });
