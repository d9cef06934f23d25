// The view "Thesis": its table, and the way from a figure's number to its chart.

import { byId, make } from "../page/dom.js";

/**
 * The table "Thesis, recomputed".
 * @param {import("../../pkg/armill.js").ThesisRow[]} rows
 */
export function showThesis(rows) {
  const cells = rows.map(({ quantity, source, printed, ours, agrees, reason }) =>
    make(
      "tr",
      { className: agrees ? "" : "differs" },
      make("th", { scope: "row" }, quantity),
      make("td", {}, source),
      make("td", { className: "digits" }, printed),
      make("td", { className: "digits" }, ours),
      make("td", {}, make("strong", {}, agrees ? "✓ Agrees." : "✗ Differs."), ` ${reason}`),
    ),
  );
  byId("thesis").tBodies[0].replaceChildren(...cells);
}

/**
 * Numbers of figures in their order: "4.2" before "4.10".
 * @param {{ number: string }} given
 * @param {{ number: string }} given
 */
const ordered = ({ number: a }, { number: b }) => {
  const [[a1, a2], [b1, b2]] = [a, b].map((text) => text.split(".").map(Number));
  return a1 - b1 || a2 - b2;
};

/**
 * The thesis's figures among charts: { number, name, title, view } each, in the order of their numbers.
 * @param {import("../../pkg/armill.js").ChartEntry[]} charts
 */
export const figuresIn = (charts) =>
  charts
    .flatMap(({ figure, name, title, view }) =>
      figure
        .split(", ")
        .filter(Boolean)
        .map((number) => ({ number, name, title, view })),
    )
    .sort(ordered);

/**
 * Lists the thesis's figures; `open(view, name)` leads to a chart.
 * @param {import("../../pkg/armill.js").ChartEntry[]} charts
 * @param {(view: string, name: string) => void} open
 */
export function showFigureIndex(charts, open) {
  const items = figuresIn(charts).map(({ number, name, title, view }) => {
    const link = make("a", { href: `#view=${view}` }, make("b", {}, `Fig. ${number}`), make("span", {}, title));
    link.addEventListener("click", (event) => {
      event.preventDefault();
      open(view, name);
    });
    return make("li", {}, link);
  });
  byId("figures-index").replaceChildren(...items);
}
