// A chart as a file: a drawing or picture that needs no style sheet, or its values.

import { make, makeSvg } from "../page/dom.js";
import { sample } from "./legend.js";

/** @import { Chart, ChartColumn } from "../../pkg/armill.js" */

const LOOK = [
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-opacity",
  "stroke-width",
  "stroke-dasharray",
  "stroke-linejoin",
  "paint-order",
];
const MARGIN = 12;
const TITLE = 28; // height of the title's line
const LINE = 20; // and of one of the legend

/** @import { Content } from "./readout.js" */

/**
 * A chart as a file "svg", "png" or "csv", { type, content }: of what is shown, { chart, data, times,
 * hidden }, the drawing `svg` and the legend on the page.
 * @param {string} format
 * @param {Content & { times: ArrayLike<number> }} content
 * @param {SVGElement} svg
 * @param {HTMLElement} legend
 */
export async function fileOf(format, { chart, data, times, hidden }, svg, legend) {
  if (format === "csv") {
    const timed = times === data[0].values;
    return { type: "text/csv", content: csvText(timed ? data : [{ key: "time_s", values: times }, ...data]) };
  }
  /** @type {{ label: string, sample: SVGElement }[]} */
  const entries = chart.series
    .filter(({ key }) => !hidden.includes(key))
    .map((series) => ({
      label: series.label,
      sample:
        /** @type {SVGElement | null} */ (legend.querySelector(`[data-key="${CSS.escape(series.key)}"] .sample`)) ??
        sample(series),
    }));
  for (const entry of legend.querySelectorAll(".pinned"))
    entries.push({
      label: String(entry.textContent),
      sample: /** @type {SVGElement} */ (entry.querySelector(".sample")),
    });
  const text = svgText(chart, svg, entries);
  return format === "svg"
    ? { type: "image/svg+xml", content: text }
    : { type: "image/png", content: await pngOf(text) };
}

/**
 * The chart as SVG text with title and legend, looking as it does now. `legend` is [{ label, sample
 * }].
 * @param {Chart} chart
 * @param {SVGElement} plot
 * @param {{ label: string, sample: SVGElement }[]} legend
 */
function svgText(chart, plot, legend) {
  const style = getComputedStyle(plot);
  const family = style.fontFamily.replaceAll('"', "'");
  const { color: ink, backgroundColor } = getComputedStyle(plot.closest("figure") ?? plot);
  const pen = /** @type {CanvasRenderingContext2D} */ (make("canvas").getContext("2d"));
  pen.font = `12px ${style.fontFamily}`;
  let [x, row] = [MARGIN, 0];
  const entries = legend.map(({ label, sample }) => {
    const width = 36 + pen.measureText(label).width + 18;
    if (x > MARGIN && x + width > chart.width + MARGIN) [x, row] = [MARGIN, row + 1];
    const line = dressed(sample);
    line.setAttribute("transform", `translate(0 -8)`);
    const entry = makeSvg(
      "g",
      { transform: `translate(${x} ${TITLE + MARGIN + row * LINE + 4})` },
      line,
      makeSvg("text", { x: 36, fill: ink }, label),
    );
    x += width;
    return entry;
  });
  const top = TITLE + MARGIN + (legend.length ? (row + 1) * LINE : 0);
  const [width, height] = [chart.width + 2 * MARGIN, chart.height + top + MARGIN];
  const root = makeSvg(
    "svg",
    {
      xmlns: "http://www.w3.org/2000/svg",
      viewBox: `0 0 ${width} ${height}`,
      width,
      height,
      role: "img",
      "font-family": family,
      "font-size": 12,
    },
    makeSvg("title", {}, chart.title),
    makeSvg("desc", {}, chart.description),
    makeSvg("rect", { width, height, fill: backgroundColor }),
    makeSvg("text", { x: MARGIN, y: TITLE - 4, "font-size": 15, "font-weight": 600, fill: ink }, chart.title),
    ...entries,
  );
  const drawing = dressed(plot);
  root.append(makeSvg("g", { transform: `translate(${MARGIN} ${top})` }, ...drawing.childNodes));
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(root)}\n`;
}

/**
 * A copy that has its colours, weights and dashes with it.
 * @param {SVGElement} element
 * @returns {SVGElement}
 */
function dressed(element) {
  const copy = /** @type {SVGElement} */ (element.cloneNode(true));
  /**
   * @param {Element} a
   * @param {Element} b
   */
  const pairs = (a, b) => {
    if (a.namespaceURI === makeSvg("g").namespaceURI && a.tagName !== "svg" && !a.closest("defs")) {
      const style = getComputedStyle(a);
      const shape = a.tagName !== "g";
      if (shape) for (const name of LOOK) b.setAttribute(name, style.getPropertyValue(name));
      else for (const name of LOOK) b.removeAttribute(name);
    }
    b.removeAttribute("class");
    [...a.children].forEach((child, i) => pairs(child, b.children[i]));
  };
  pairs(element, copy);
  return copy.tagName === "svg" && element.classList.contains("sample") ? makeSvg("g", {}, ...copy.childNodes) : copy;
}

/**
 * The drawing as a PNG of twice its size.
 * @param {string} svg
 * @returns {Promise<Blob>}
 */
async function pngOf(svg) {
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = make("canvas", { width: 2 * image.width, height: 2 * image.height });
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, fail) =>
      canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("the picture is too large"))), "image/png"),
    );
  } finally {
    URL.revokeObjectURL(address);
  }
}

/**
 * Every sample of the chart's columns; the units stand in the header.
 * @param {{ key: string, values: ArrayLike<number> }[]} data
 */
function csvText(data) {
  const rows = [data.map(({ key }) => key).join(",")];
  for (let k = 0; k < data[0].values.length; k++) rows.push(data.map(({ values }) => values[k]).join(","));
  return `${rows.join("\n")}\n`;
}
