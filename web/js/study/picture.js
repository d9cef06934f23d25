// The picture of an answer by cases, drawn by the core as large as its place.

import { fileOf } from "../chart/export.js";
import { svgOf } from "../chart/drawing.js";
import { debounced, make } from "../page/dom.js";
import { download } from "../page/download.js";
import { units } from "../page/units.js";
import { askSingle } from "./ask.js";

/**
 * @import { AnswerDrawing } from "../../pkg/armill.js"
 * @import { Picture } from "./pictures.js"
 */

const ROW_PX = { study_intervals: 22, study_grid: 34 }; // height of a case
const CLOSE = 12; // rows of a grid from which on they are as close as intervals
const ROUND_PX = 76; // what axes and names need besides
const LEAST_PX = 150;

/** A figure that draws what it was given last. */
export function makePicture() {
  /** @type {Picture | undefined} */
  let picture;
  /** @type {AnswerDrawing | undefined} */
  let drawn;
  let width = 0; // as drawn last
  const title = make("h3");
  const plot = make("div", { className: "drawing still" });
  const caption = make("figcaption");
  const save = make("button", { type: "button", id: "study-svg", className: "quiet" }, "Save SVG");
  const node = make(
    "figure",
    { className: "chart-figure answer-picture", hidden: true },
    make("header", {}, title, save),
    plot,
    caption,
  );
  save.addEventListener("click", async () => {
    const svg = plot.querySelector("svg");
    if (!drawn || !svg) return;
    const chart = /** @type {any} */ ({ ...drawn, series: [] });
    const content = /** @type {any} */ ({ chart, data: [{ values: [] }], times: [], hidden: [] });
    const file = await fileOf("svg", content, svg, make("div"));
    download("armill-answer.svg", file.type, file.content);
  });

  async function draw() {
    const mine = picture;
    const room = Math.floor(plot.clientWidth);
    if (!mine || room < 1) return;
    width = room;
    const height = Math.max(LEAST_PX, ROUND_PX + ROW_PX[mine.rows > CLOSE ? "study_intervals" : mine.kind] * mine.rows);
    plot.style.setProperty("min-height", `${height}px`);
    const made = await askSingle(mine.kind, mine.data, { width: room, height, ...units() });
    if (mine !== picture) return;
    drawn = made;
    title.textContent = made.title;
    caption.textContent = made.description;
    plot.replaceChildren(svgOf(made.svg));
  }
  const redraw = () => draw().catch(() => {}); // the next look draws again
  new ResizeObserver(debounced(() => !node.hidden && plot.clientWidth !== width && redraw(), 120)).observe(node);

  return {
    node,
    /**
     * Draws it; hides the figure without one.
     * @param {Picture | undefined} next
     */
    show(next) {
      picture = next;
      node.hidden = !next;
      if (next) redraw();
    },
  };
}
