// What distinguishes the entries of the libraries, in a few words each.

/** @import { Presets, RobotPreset } from "../../pkg/armill.js" */

/** @typedef {{ text: string, kind?: string }} Badge */

/** @type {Record<RobotPreset["stiffness"], string>} */
const STIFFNESS = {
  measured: "stiffness measured",
  published: "stiffness published",
  guessed: "stiffness guessed",
};

/**
 * Badges `{ text, kind }` of each robot and material by its key.
 * @param {Presets} presets
 * @returns {Map<string, Badge[]>}
 */
export function badgesOf({ robots, materials }) {
  return new Map(
    /** @type {[string, Badge[]][]} */ ([
      ...robots.map(({ id, stiffness, payload_kg, reach_mm }) => [
        id,
        [
          { text: STIFFNESS[stiffness], kind: stiffness },
          { text: `${payload_kg} kg` },
          { text: `reach ${(reach_mm / 1000).toFixed(2)} m` },
        ],
      ]),
      ...materials.map(({ id, spread_percent, confidence }) => [
        id,
        [{ text: `±${spread_percent} %` }, { text: `${confidence} confidence`, kind: confidence }],
      ]),
    ]),
  );
}
