// How a map is read: which error is coloured, the side of the base that counts, and the layer that is shown.

import { make, select } from "../page/dom.js";

/** @import { Measure } from "./map.js" */

const ERRORS = { p95: "after compensation, 95 of 100", max: "before compensation" };
const SIDE_WORDS = {
  any: "any",
  front: "in front of the base",
  left: "left of it",
  behind: "behind it",
  right: "right of it",
};
/** @type {Record<string, string>} */
const SIDE_PHRASES = {
  front: " in front of the base",
  left: " left of the base",
  behind: " behind the base",
  right: " right of the base",
};

/**
 * The choices; `changed()` is called when another is taken.
 * @param {() => void} changed
 */
export function makeChoices(changed) {
  const error = select("placement-error", ERRORS);
  const side = select("placement-side", SIDE_WORDS);
  const layer = select("placement-layer", {});
  let chosen = false; // whether a side was chosen by hand
  const field = (/** @type {string} */ text, /** @type {HTMLSelectElement} */ input) =>
    make("div", { className: "wide" }, make("label", { for: input.id }, text), input);
  const shown = field("Shown at", layer);
  shown.hidden = true;
  for (const input of [error, side, layer]) input.addEventListener("change", changed);
  side.addEventListener("change", () => (chosen = true));
  return {
    fields: [field("Error", error), field("Side to stay on", side)],
    layerField: shown,
    measure: () => /** @type {Measure} */ (error.value),
    side: () => side.value,
    /** The side as the end of a phrase. */
    sideWords: () => SIDE_PHRASES[side.value] ?? "",
    layer: () => Number(layer.value),
    /** @param {number} which */
    showLayer: (which) => void (layer.value = String(which)),
    /**
     * Stays on this side unless another was chosen.
     * @param {string} now where the part is
     */
    offerSide(now) {
      if (!chosen) side.value = now;
    },
    /**
     * Offers layers by their names, and shows one.
     * @param {string[]} names
     * @param {number} which
     */
    offerLayers(names, which) {
      layer.replaceChildren(...names.map((text, n) => make("option", { value: String(n) }, text)));
      layer.value = String(which);
      shown.hidden = names.length < 2;
    },
  };
}
