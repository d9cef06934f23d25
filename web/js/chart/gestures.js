// What mouse, fingers, wheel and keys do to a chart.
//
// `chart` has: `place(event)` -> fractions [across, up] of the plot, `enter()`, `point(place)`,
// `leave()`, `pin(place)`, `scale([fx, fy], place)`, `shift(dx, dy)` (fractions), `zoomBox(a, b)`,
// `box(corners)`, `reset()`, `step(samples, share)`, `ends(last)`, `clear()`, `go()`, `grab()` ->
// token and `drag(token, dx, dy, scale, place)`: the view as it was when grabbed, moved; `zoomed`;
// `select(a, b, complete)` and `markEnd()` for a stretch, by dragging if `selecting`.

/** @import { Figure } from "./figure.js" */

/** @typedef {[x: number, y: number]} Point in pixels, or as fractions of the plot: across and up */

/** @typedef {{ clientX: number, clientY: number }} Pointed an event, as far as it says where */

const CLICK_PX = 4; // a press that moves less is a click
const THIN_PX = 12; // a box thinner than this zooms one axis only
const WHEEL = 0.0015; // exponent of the zoom for each pixel of the wheel
const PINCH = 0.01; // a pinch on a touchpad comes as a wheel with small steps

/**
 * @param {HTMLElement} plot
 * @param {Figure} chart
 */
export function listen(plot, chart) {
  /** @type {Map<number, Pointed>} */
  const pressed = new Map(); // pointers that are down, by id
  /** @type {any} */
  let held = null; // what they do

  const size = () => plot.getBoundingClientRect();
  /**
   * @param {Pointed} event
   * @returns {Point}
   */
  const local = ({ clientX, clientY }) => [clientX - size().left, clientY - size().top];

  plot.addEventListener("pointerenter", () => chart.enter());
  plot.addEventListener("pointerdown", (event) => {
    if (event.button > 1 || (event.button === 1 && event.pointerType !== "mouse")) return;
    if (!chart.place(event)) return;
    pressed.set(event.pointerId, event);
    plot.setPointerCapture(event.pointerId);
    if (pressed.size === 2) held = pinch();
    else if (event.pointerType === "touch" && !chart.selecting) held = { kind: "scrub" };
    else {
      const selects = chart.kind === "time" && (event.shiftKey || chart.selecting);
      const kind = event.button === 1 ? "pan" : selects ? "select" : event.shiftKey ? "pan" : "box";
      held = { kind, start: event, from: local(event), grip: chart.grab(), moved: false };
      if (event.button === 1) event.preventDefault();
    }
    if (held.kind === "scrub") chart.point(chart.place(event));
  });

  plot.addEventListener("pointermove", (event) => {
    if (!pressed.has(event.pointerId)) {
      const place = chart.place(event);
      return place ? chart.point(place) : chart.leave();
    }
    pressed.set(event.pointerId, event);
    if (held?.kind === "pinch") return pinched();
    if (held?.kind === "scrub") return void chart.point(chart.place(event, true));
    if (!held) return;
    const [dx, dy] = [event.clientX - held.start.clientX, event.clientY - held.start.clientY];
    held.moved ||= Math.hypot(dx, dy) > CLICK_PX;
    if (!held.moved) return;
    if (held.kind === "pan") return chart.drag(held.grip, dx, dy);
    if (held.kind === "select")
      return void chart.select(chart.place(held.start, true), chart.place(event, true), false);
    held.corners = boxed(held.from, local(event));
    chart.box(held.corners);
  });

  plot.addEventListener("pointerup", (event) => {
    const before = held;
    release(event);
    if (before?.kind === "scrub" || (before?.kind === "box" && !before.moved)) chart.pin(chart.place(event, true));
    else if (before?.corners) chart.zoomBox(before.corners[0], before.corners[1]);
    else if (before?.kind === "select" && before.moved)
      chart.select(chart.place(before.start, true), chart.place(event, true), true);
    else if (before?.kind === "select") chart.pin(chart.place(event, true));
  });
  plot.addEventListener("pointercancel", (event) => release(event));
  plot.addEventListener("pointerleave", (event) => event.pointerType !== "touch" && !pressed.size && chart.leave());
  plot.addEventListener("dblclick", () => chart.reset());
  // Two fingers are ours; one that goes up or down scrolls the page (touch-action).
  plot.addEventListener(
    "touchmove",
    (event) => event.touches.length > 1 && event.cancelable && event.preventDefault(),
    { passive: false },
  );

  /** @param {{ pointerId?: number }} event */
  function release({ pointerId = NaN }) {
    pressed.delete(pointerId);
    chart.box(null);
    held = null;
  }

  function pinch() {
    const [a, b] = [...pressed.values()];
    return { kind: "pinch", grip: chart.grab(), apart: distance(a, b), middle: middle(a, b) };
  }

  function pinched() {
    const [a, b] = [...pressed.values()];
    const now = middle(a, b);
    const factor = held.apart / Math.max(20, distance(a, b));
    chart.drag(
      held.grip,
      now.clientX - held.middle.clientX,
      now.clientY - held.middle.clientY,
      factor,
      chart.place(held.middle, true) ?? undefined,
    );
  }

  /**
   * A box that is thin in one direction covers the whole plot in it.
   * @param {Point} a
   * @param {Point} b
   * @returns {[Point, Point]}
   */
  function boxed(a, b) {
    const { left, top, width, height } = chart.area;
    /**
     * @param {Point} point
     * @returns {Point}
     */
    const clamp = ([x, y]) => [Math.min(left + width, Math.max(left, x)), Math.min(top + height, Math.max(top, y))];
    const [[x1, y1], [x2, y2]] = [clamp(a), clamp(b)];
    if (Math.abs(y2 - y1) < THIN_PX)
      return [
        [x1, top],
        [x2, top + height],
      ];
    if (Math.abs(x2 - x1) < THIN_PX)
      return [
        [left, y1],
        [left + width, y2],
      ];
    return [
      [x1, y1],
      [x2, y2],
    ];
  }

  plot.addEventListener(
    "wheel",
    (event) => {
      const asked = event.ctrlKey || event.metaKey;
      if (!asked && document.activeElement !== plot) return; // the page's own scrolling
      const unit = [1, 16, size().height][event.deltaMode];
      const [dx, dy] = [event.deltaX * unit, event.deltaY * unit];
      const sideways = Math.abs(dx) > Math.abs(dy) || event.shiftKey;
      if (!asked && !chart.zoomed && (sideways || dy > 0)) return; // nothing to do here: the page may scroll
      event.preventDefault();
      if (sideways) return chart.shift((Math.abs(dx) > Math.abs(dy) ? dx : dy) / size().width, 0);
      const factor = Math.exp(dy * (event.ctrlKey && Math.abs(dy) < 30 ? PINCH : WHEEL));
      const onAxis = event.clientX - size().left < chart.area.left;
      chart.scale(onAxis ? [1, factor] : [factor, chart.plane ? factor : 1], chart.place(event, true) ?? undefined);
    },
    { passive: false },
  );

  /** @type {Record<string, (shift: boolean) => void>} */
  const keys = {
    ArrowLeft: (shift) => (shift ? chart.shift(-0.1, 0) : chart.step(-1, 0)),
    ArrowRight: (shift) => (shift ? chart.shift(0.1, 0) : chart.step(1, 0)),
    PageUp: () => chart.step(0, 0.1),
    PageDown: () => chart.step(0, -0.1),
    Home: () => chart.ends(false),
    End: () => chart.ends(true),
    "+": () => chart.scale([0.5, chart.plane ? 0.5 : 1]),
    "=": () => chart.scale([0.5, chart.plane ? 0.5 : 1]),
    "-": () => chart.scale([2, chart.plane ? 2 : 1]),
    0: () => chart.reset(),
    Escape: () => (release({}), pressed.clear(), chart.clear()),
    Enter: () => chart.go(),
    s: () => chart.markEnd(),
  };
  plot.addEventListener("keydown", (event) => {
    const vertical = event.shiftKey && (event.key === "ArrowUp" ? 0.1 : event.key === "ArrowDown" ? -0.1 : 0);
    const act = vertical ? () => chart.shift(0, vertical) : keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(event.shiftKey);
  });
}

/**
 * @param {Pointed} a
 * @param {Pointed} b
 */
const distance = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
/**
 * @param {Pointed} a
 * @param {Pointed} b
 */
const middle = (a, b) => ({ clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 });
