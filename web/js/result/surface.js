// The surface that is left, in words: the figures, and the worst places, each leading there.

import { setCursor } from "../page/cursor.js";
import { byId, make } from "../page/dom.js";
import { lengthText, lengthUnit } from "../page/units.js";

/** @import { Summary } from "../../pkg/armill.js" */

/**
 * Writes the surface of a summary, if it has one; its places move the cursor.
 * @param {Summary} summary
 */
export function showSurface({ surface, samples, duration_s }) {
  const box = byId("surface");
  const { worst_before_mm = NaN, worst_after_mm, after_p95_mm = NaN, worst = [] } = surface ?? {};
  box.hidden = worst_after_mm === undefined;
  if (worst_after_mm === undefined) return;
  /**
   * @param {string} id
   * @param {number} value
   */
  const put = (id, value) => {
    byId(id).textContent = lengthText(value);
    byId(id).dataset.value = String(value);
  };
  put("surface-before", worst_before_mm);
  put("surface-after", worst_after_mm);
  put("surface-p95", after_p95_mm);
  for (const unit of box.querySelectorAll(".length")) unit.textContent = lengthUnit();
  byId("surface-list").replaceChildren(
    ...worst.map(({ sentence, sample }) => {
      const button = make("button", { type: "button", className: "place", title: "Move the cursor there" }, sentence);
      button.addEventListener("click", () => setCursor((sample / (samples - 1)) * duration_s, "surface"));
      return make("li", {}, button);
    }),
  );
}
