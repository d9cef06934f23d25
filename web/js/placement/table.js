// The map as a table.

import { shownUnit } from "../form/shown.js";
import { make } from "../page/dom.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { MARKS } from "./map.js";
import { coordinate } from "./words.js";

/** @import { Drawn } from "./map.js" */

const SHORT = ["", " ·", " ⁄", "–"]; // for MARKS

/**
 * Caption, head and body of the table of a map.
 * @param {Drawn} map
 */
export function tableParts({ columns, rows, names, at }) {
  const head = make(
    "tr",
    {},
    make("th", { scope: "col" }, `${names[1]} \\ ${names[0]}, ${shownUnit("mm")}`),
    ...columns.map((v) => make("th", { scope: "col" }, coordinate(v))),
  );
  const body = rows.map((row, k) =>
    make(
      "tr",
      {},
      make("th", { scope: "row" }, coordinate(row)),
      ...columns.map((_, i) => {
        const place = at(i, k);
        return make(
          "td",
          { title: place ? MARKS[place.mark] : "" },
          !place ? "" : place.mark === 3 ? SHORT[3] : lengthText(place.max) + SHORT[place.mark],
        );
      }),
    ),
  );
  return [
    make(
      "caption",
      {},
      `Largest error before compensation, ${lengthUnit()}; · near a singularity, ⁄ a joint leaves its range, – out of reach`,
    ),
    make("thead", {}, head),
    make("tbody", {}, ...body.reverse()),
  ];
}
