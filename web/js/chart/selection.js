// What is said below a chart about a selected stretch of the run: its statistics, series by series.

import { make } from "../page/dom.js";
import { formatNumber } from "../page/number.js";
import { lineAt } from "../page/program-lines.js";
import { inLength, lengthUnit } from "../page/units.js";
import { columnsOf, read } from "./readout.js";
import { statisticsOf } from "./statistics.js";

/** @type {Record<"mean" | "max" | "rms" | "p95", string>} */
const HEADS = { mean: "Mean", max: "Max", rms: "RMS", p95: "95 %" };

const NAMES = /** @type {(keyof typeof HEADS)[]} */ (Object.keys(HEADS));

export class Selection {
  node = make("section", { className: "stretch", hidden: true, "aria-label": "Selected stretch" });
  #title = make("p", { role: "status" });
  #table = make("table");
  #said = make("span", { role: "status" });
  #text = "";

  /**
   * `remove()` is called when the stretch is no longer wanted.
   * @param {() => void} remove
   */
  constructor(remove) {
    const copy = make("button", { type: "button", className: "quiet" }, "Copy");
    copy.addEventListener("click", () => this.#copy());
    const gone = make("button", { type: "button", className: "quiet" }, "Clear");
    gone.addEventListener("click", remove);
    this.node.append(make("header", {}, this.#title, this.#said, copy, gone), this.#table);
  }

  /**
   * Shows the samples from one index to another, with their times and path lengths [mm].
   * @param {{ chart: import("../../pkg/armill.js").Chart, data: import("../../pkg/armill.js").ChartColumn[], hidden: string[] }} given
   * @param {ArrayLike<number>} times
   * @param {ArrayLike<number>} lengths
   * @param {[number, number]} pair
   */
  show({ chart, data, hidden }, times, lengths, [from, to]) {
    const where = whereIs(times, lengths, from, to);
    const rows = columnsOf(chart, data).flatMap((columns, i) => {
      const { key, label } = chart.series[i];
      const found = hidden.includes(key) ? undefined : statisticsOf(columns[0].values, from, to);
      return found ? [{ key, label, unit: columns[0].unit, found }] : [];
    });
    if (this.#title.textContent !== where) this.#title.textContent = where; // read out once
    this.#said.textContent = "";
    const unit = rows[0]?.unit ?? "";
    const head = Object.values(HEADS).map((name) => make("th", { scope: "col" }, name));
    const note = make("span", { className: "unit" }, unit);
    this.#table.replaceChildren(
      make("thead", {}, make("tr", {}, make("th", { scope: "col" }, "Series ", note), ...head)),
      make("tbody", {}, ...rows.map(rowOf)),
    );
    this.#text = [
      chart.title,
      where,
      ["Series", ...Object.values(HEADS), "Unit"].join("\t"),
      ...rows.map(({ label, found, unit }) => [label, ...NAMES.map((name) => found[name]), unit].join("\t")),
    ].join("\n");
    this.node.hidden = false;
  }

  hide() {
    this.node.hidden = true;
    this.#title.textContent = "";
  }

  async #copy() {
    try {
      await navigator.clipboard.writeText(`${this.#text}\n`);
      this.#said.textContent = "Copied.";
    } catch {
      getSelection()?.selectAllChildren(this.node);
      this.#said.textContent =
        "This browser does not let the page copy. The text is selected: copy it with Ctrl+C or ⌘C.";
    }
  }
}

/**
 * Where a stretch is and how long.
 * @param {ArrayLike<number>} times
 * @param {ArrayLike<number>} lengths
 * @param {number} from
 * @param {number} to
 */
function whereIs(times, lengths, from, to) {
  /** @param {number} value */
  const number = (value) => formatNumber(value, 4);
  const length = inLength(lengths[to] - lengths[from]);
  const lines = [lineAt(times[from]), lineAt(times[to])].filter(Boolean);
  const span = lines.length < 2 ? "" : lines[0] === lines[1] ? `, line ${lines[0]}` : `, lines ${lines.join(" to ")}`;
  return (
    `${number(times[from])} to ${number(times[to])} s: ${number(times[to] - times[from])} s, ` +
    `${number(length)} ${lengthUnit()} of the path${span}`
  );
}

/** @param {{ key: string, label: string, unit: string, found: Record<string, number> }} given */
function rowOf({ key, label, unit, found }) {
  const cells = NAMES.map((name) => {
    const cell = make("td", {}, read(found[name], unit));
    cell.dataset.value = String(found[name]);
    return cell;
  });
  const row = make("tr", {}, make("th", { scope: "row" }, label), ...cells);
  row.dataset.key = key;
  return row;
}
