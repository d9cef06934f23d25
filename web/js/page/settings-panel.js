// The controls of what settings.js remembers.

import { make } from "./dom.js";
import { choices, choose, setting } from "./settings.js";

/** @import { Setting } from "./settings.js" */

/** @type {{ key: Setting, title: string, labels: Record<string, string> }[]} */
const ROWS = [
  { key: "length", title: "Lengths", labels: { mm: "mm", inch: "inch" } },
  { key: "feed", title: "Feeds", labels: { second: "per second", minute: "per minute" } },
  { key: "force", title: "Forces", labels: { N: "N", lbf: "lbf" } },
  { key: "theme", title: "Colours", labels: { auto: "system", light: "light", dark: "dark" } },
];

/**
 * Fills `box` with one row of choices a setting.
 * @param {HTMLElement} box
 */
export function settingsPanel(box) {
  box.append(
    make("h2", {}, "Settings"),
    ...ROWS.map(row),
    make(
      "p",
      { className: "note" },
      "For inputs, figures, charts and tables. Sentences, jobs and programs stay in mm and N.",
    ),
  );
}

/** @param {(typeof ROWS)[number]} row */
function row({ key, title, labels }) {
  const options = (choices(key) ?? []).map((value) => {
    const input = make("input", {
      type: "radio",
      name: `setting-${key}`,
      id: `setting-${key}-${value}`,
      value,
      checked: setting(key) === value,
    });
    input.addEventListener("change", () => choose(key, value));
    return make("label", { className: "choice" }, input, make("span", {}, labels[value]));
  });
  return make("fieldset", { className: "choices" }, make("legend", {}, title), ...options);
}
