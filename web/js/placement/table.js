// The map as a table.

import { shownUnit } from "../form/shown.js";
import { make } from "../page/dom.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { placeAt } from "./grid.js";
import { MARKS } from "./map.js";
import { coordinate, layerName } from "./words.js";

/**
 * @import { Measure } from "./map.js"
 * @import { Surveyed } from "./panel.js"
 */

const SHORT = ["", " ·", " ⁄", "–", "×"]; // for MARKS

/**
 * Caption, head and a body for each layer of the table of a map.
 * @param {Surveyed} map
 * @param {Measure} measure
 */
export function tableParts(map, measure) {
  const { columns, rows, names, layers } = map;
  const head = make(
    "tr",
    {},
    make("th", { scope: "col" }, `${names[1]} \\ ${names[0]}, ${shownUnit("mm")}`),
    ...columns.map((v) => make("th", { scope: "col" }, coordinate(v))),
  );
  const bodies = layers.map(({ found }, layer) => {
    const body = rows.map((row, k) =>
      make(
        "tr",
        {},
        make("th", { scope: "row" }, coordinate(row)),
        ...columns.map((_, i) => {
          const place = placeAt(found, i, k);
          return make(
            "td",
            { title: place ? MARKS[place.mark] : "" },
            !place ? "" : place.mark > 2 ? SHORT[place.mark] : lengthText(place[measure]) + SHORT[place.mark],
          );
        }),
      ),
    );
    const name = make("th", { scope: "rowgroup", colSpan: columns.length + 1 }, layerName(map, layer));
    return make("tbody", {}, ...(layers.length > 1 ? [make("tr", {}, name)] : []), ...body.reverse());
  });
  const error = measure === "max" ? "before compensation" : "after compensation in 95 of 100";
  return [
    make(
      "caption",
      {},
      `Largest error ${error}, ${lengthUnit()}; · near a singularity, ⁄ a joint leaves its range, – out of reach, ` +
        "× in the base or the floor",
    ),
    make("thead", {}, head),
    ...bodies,
  ];
}
