// The best turn of the tool about its axis where the part is: all turns are tried, ten degrees apart, and the best is taken.

import { shareOut } from "../core/pool.js";
import { make } from "../page/dom.js";
import { plainNumber } from "../page/number.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { least, placeIn } from "./grid.js";
import { MARKS } from "./map.js";
import { errorWords } from "./words.js";

/**
 * @import { Present } from "../identify/panel.js"
 * @import { Measure } from "./map.js"
 */

const STEP_DEG = 10;

/**
 * A button and what it brought; `measure()` is the error that counts.
 * @param {Present} present
 * @param {() => Measure} measure
 */
export function makeTurn({ job, use }, measure) {
  const button = make("button", { type: "button", id: "placement-turn" }, "Best turn of the tool here");
  const said = make("p", { id: "placement-turned", role: "status" });

  async function turn() {
    const before = job();
    const { spin, workpiece_frame: frame } = before;
    const now = spin?.angle_deg ?? 0;
    const turns = Array.from({ length: 360 / STEP_DEG }, (_, n) => STEP_DEG * n - 180);
    button.disabled = true;
    said.textContent = "Trying 36 turns…";
    try {
      const [xyz, all] = [frame.xyz_mm, [now, ...turns]].map((numbers) => Float64Array.from(numbers));
      let numbers = new Float64Array();
      const ask = (/** @type {import("../core/asked.js").Asked} */ worker) =>
        worker.ask("turns", JSON.stringify(before), xyz, all);
      await shareOut(1, ask, (part) => (numbers = part), new AbortController().signal);
      if (JSON.stringify(job()) !== JSON.stringify(before)) return void (said.textContent = "The job has changed.");
      const [present, ...tried] = [now, ...turns].map((deg, n) => ({ deg, ...placeIn(numbers, n) }));
      const by = measure();
      const best = least(tried, by);
      const was = present.mark ? MARKS[present.mark] : `${lengthText(present[by])} ${lengthUnit()}`;
      if (!best) said.textContent = "No turn keeps all limits here.";
      else if (present.mark === 0 && present[by] <= best[by]) {
        said.textContent = `None of 36 turns is better than ${degrees(now)}: ${errorWords(present, by)}.`;
      } else {
        use({ ...before, spin: { ...spin, angle_deg: best.deg } });
        said.textContent =
          `The tool is turned from ${degrees(now)} to ${degrees(best.deg)}: ` +
          `${errorWords(best, by)}; until now: ${was}. Undo turns it back.`;
      }
    } catch (error) {
      said.textContent = `No turn was tried: ${error.message}`;
    } finally {
      button.disabled = false;
    }
  }

  button.addEventListener("click", turn);
  return {
    nodes: [button, said],
    /** Offers the turn only where the job has a fixed one. */
    look() {
      const free = (job()?.spin?.mode ?? "fixed") !== "fixed";
      button.hidden = free;
      if (free) said.textContent = "";
    },
  };
}

/** @param {number} deg */
const degrees = (deg) => `${plainNumber(deg)}°`;
