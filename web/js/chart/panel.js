// Draws the charts of one panel and one that is always in sight, and keeps them together: one cursor, one range of time, one set of
// units.

import { carried, overIn, setApart } from "./along.js";
import { Figure } from "./figure.js";
import { onCursor } from "../page/cursor.js";
import { debounced, make } from "../page/dom.js";
import { onSetting } from "../page/settings.js";
import { onStretch } from "../page/stretch.js";

/**
 * @import { ChartEntry, Over } from "../../pkg/armill.js"
 * @import { Beside } from "./together.js"
 * @import { Pin } from "../result/pinned.js"
 * @import { Range } from "./view.js"
 */

/** @type {ChartEntry[]} */
let available = []; // of the shown result
/** @type {HTMLElement | null} */
let panel = null;
/** @type {{ place: HTMLElement, name: string } | null} */
let fixed = null; // { place, name }: the chart that is always in sight
let turn = 0; // drawing that is no longer the latest one stops
/** @type {Beside[]} */
let beside = []; // pinned results that are drawn with the shown one
/** @type {Over} */
let over = "time"; // what all charts over the run are drawn over
/** @type {Range | null} */
let range = null; // of that
/** @type {Map<string, Figure>} */
const figures = new Map(); // chart name -> Figure
/** @type {Set<Figure>} */
const pending = new Set(); // those that are not drawn yet, because they are out of sight

const CALM_MS = 150; // after the last result, before what is out of sight is drawn
/** @type {WeakMap<Element, boolean>} */
const sight = new WeakMap();
const watched = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    sight.set(target, isIntersecting);
    const figure = isIntersecting && [...pending].find(({ node }) => node === target);
    if (figure) drawNow(figure);
  }
});

/**
 * Takes over the charts of a new result.
 * @param {ChartEntry[]} list
 */
export function setCharts(list) {
  available = list;
  for (const figure of figures.values()) figure.forget();
  followOver();
  draw();
}

/**
 * Draws the curves of pinned results, { letter, name, chart(name, options) }, with those of the shown
 * one; `apart` if they take longer or shorter.
 * @param {Pin[]} pins
 * @param {boolean} apart
 */
export function setBeside(pins, apart) {
  setApart(apart);
  followOver();
  /** @param {Pick<Pin, "letter" | "name" | "text">} pin */
  const state = (pin) => `${pin.letter} ${pin.name} ${pin.text}`;
  if (pins.map(state).join() === beside.map(state).join()) return;
  beside = pins.map((pin) => ({
    ...pin,
    chart: (name, options) => pin.chart(name, options),
  }));
  for (const figure of figures.values()) figure.beside = beside;
  draw();
}

/**
 * Draws the chart `name` in `place`, as large as that is, whichever panel is shown.
 * @param {HTMLElement} place
 * @param {string} name
 */
export function fixChart(place, name) {
  fixed = { place, name };
  resized.observe(place);
}

/**
 * Charts of the shown result as texts, name -> { svg, csv }, drawn out of sight at the width of a page.
 * @param {string[]} names
 */
export async function chartTexts(names) {
  const place = make("div", { className: "charts unseen", "aria-hidden": "true" });
  document.body.append(place);
  const texts = new Map();
  try {
    for (const entry of available.filter(({ name }) => names.includes(name))) {
      const figure = new Figure(entry, () => {});
      place.replaceChildren(figure.node);
      await figure.draw();
      texts.set(entry.name, await figure.texts());
    }
  } finally {
    place.remove();
  }
  return texts;
}

/**
 * Draws the charts of `shown`, and again whenever its width changes.
 * @param {HTMLElement} shown
 */
export function showPanel(shown) {
  if (panel) resized.unobserve(panel);
  panel = shown;
  resized.observe(panel);
  for (const figure of figures.values()) if (!figure.fills && !panel.contains(figure.node)) figure.forget();
  draw();
}

onCursor((time, from) => {
  for (const figure of figures.values()) if (figure.cursor !== from && figure.overRun) figure.follow(time);
});

onStretch((_, complete) => {
  for (const figure of figures.values()) if (figure.kind === "time") figure.followStretch(complete);
});

onSetting((key) => {
  if (key === "over") followOver();
  if (key !== "length" && key !== "force") return;
  if (over === "length") range = null;
  for (const figure of figures.values()) {
    figure.forget();
    const inLengths = figure.plane || (figure.kind === "time" && over === "length");
    figure.zoom.show(inLengths ? null : undefined, null, true); // ranges of lengths and forces no longer hold
  }
  draw();
});

/** Draws over another axis if that has changed: the charts show the same samples of the run as before. */
async function followOver() {
  const [before, now] = [over, overIn(available.find(({ kind }) => kind === "time")?.over ?? [])];
  if (now === before) return;
  over = now;
  const same = await carried(range, before, now);
  if (over !== now) return;
  range = same;
  for (const figure of figures.values()) {
    if (figure.kind !== "time") continue;
    figure.forget();
    figure.zoom.show(range, undefined, true);
  }
  draw();
}

/**
 * Zooming one chart over time takes the others along.
 * @param {Figure} from
 * @param {Range | null} x
 */
function link(from, x) {
  range = x;
  for (const figure of figures.values())
    if (figure !== from && figure.kind === "time") figure.zoom.show(x, undefined, true);
}

/** @param {ChartEntry} entry */
function figureOf(entry) {
  let figure = figures.get(entry.name);
  if (!figure) {
    figure = new Figure(entry, link);
    figure.beside = beside;
    figure.fills = entry.name === fixed?.name;
    if (figure.kind === "time") figure.zoom.show(range, null, true);
    figures.set(entry.name, figure);
    watched.observe(figure.node);
  }
  figure.axes = entry.over ?? [];
  return figure;
}

const redraw = debounced(() => draw(), 120);
const resized = new ResizeObserver(() => {
  if ([...figures.values()].filter((figure) => !figure.fits).length) redraw(); // each measures its room
});

async function draw() {
  if (!panel) return;
  const mine = ++turn;
  const view = panel.id.replace("panel-", "");
  const always = available.filter(({ name }) => name === fixed?.name).map(figureOf);
  const shown = available.filter((chart) => chart.view === view && chart.name !== fixed?.name).map(figureOf);
  if (fixed && always.length) put(fixed.place, always);
  /** @type {HTMLElement | null} */
  const place = panel.querySelector(".charts");
  if (place) put(place, shown);
  // While results stream in, only what is in sight follows each of them.
  const later = shown.filter((figure) => figure.isDrawn && !sight.get(figure.node));
  pending.clear();
  for (const figure of later) pending.add(figure);
  for (const figure of [...always, ...shown.filter((figure) => !pending.has(figure))])
    if (!(await drawNow(figure)) || mine !== turn) return;
  if (later.length) await new Promise((resolve) => setTimeout(resolve, CALM_MS));
  for (const figure of later) if (mine !== turn || (pending.has(figure) && !(await drawNow(figure)))) return;
}

/**
 * Draws it; false if that failed: a newer result, or a recovery, draws again.
 * @param {Figure} figure
 */
async function drawNow(figure) {
  pending.delete(figure);
  try {
    await figure.draw();
    return true;
  } catch {
    return false;
  }
}

/**
 * Has a place hold these figures, in this order.
 * @param {HTMLElement} place
 * @param {Figure[]} list
 */
function put(place, list) {
  const as = list.every((figure, i) => place.children[i] === figure.node) && place.children.length === list.length;
  if (!as) place.replaceChildren(...list.map((figure) => figure.node));
}

document
  .querySelector("main")
  ?.append(
    make(
      "p",
      { id: "chart-keys", className: "hidden-text" },
      "Left and right arrows move the cursor, Page Up and Page Down by a tenth, Home and End to the ends of what is " +
        "shown. Plus and minus zoom, zero shows all, Shift and arrows pan. S selects a stretch: press it at both ends. " +
        "Enter leads to the line of the program, " +
        "Escape takes the cursor away. The button Table shows the values as a table.",
    ),
  );
