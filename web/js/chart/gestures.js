// What mouse, fingers, wheel and keys do to a chart: they zoom it, move its cursor and select a stretch of the run.

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
  const { zoom, cursor, picker, marks } = chart;
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
  /**
   * Where an event is, as fractions of the plot, across and up; beside it they are beyond 0 to 1.
   * @param {Pointed} event
   * @returns {Point}
   */
  const fractions = (event) => {
    const { left, top, width, height } = zoom.area;
    const [x, y] = local(event);
    return [(x - left) / width, 1 - (y - top) / height];
  };
  /** @param {Pointed} event */
  const isInside = (event) => fractions(event).every((part) => part === inside(part));
  /**
   * The same for the place of the plot that is nearest.
   * @param {Pointed} event
   * @returns {Point}
   */
  const placeOf = (event) => {
    const [across, up] = fractions(event);
    return [inside(across), inside(up)];
  };

  plot.addEventListener("pointerenter", () => cursor.enter());
  plot.addEventListener("pointerdown", (event) => {
    if (event.button > 1 || (event.button === 1 && event.pointerType !== "mouse")) return;
    if (!isInside(event)) return;
    pressed.set(event.pointerId, event);
    plot.setPointerCapture(event.pointerId);
    if (pressed.size === 2) held = pinch();
    else if (event.pointerType === "touch" && !chart.selecting) held = { kind: "scrub" };
    else {
      const selects = chart.kind === "time" && (event.shiftKey || chart.selecting);
      const kind = event.button === 1 ? "pan" : selects ? "select" : event.shiftKey ? "pan" : "box";
      held = { kind, start: event, from: local(event), grip: zoom.grab(), moved: false };
      if (event.button === 1) event.preventDefault();
    }
    if (held.kind === "scrub") cursor.point(placeOf(event));
  });

  plot.addEventListener("pointermove", (event) => {
    if (!pressed.has(event.pointerId)) return isInside(event) ? cursor.point(placeOf(event)) : cursor.leave();
    pressed.set(event.pointerId, event);
    if (held?.kind === "pinch") return pinched();
    if (held?.kind === "scrub") return void cursor.point(placeOf(event));
    if (!held) return;
    const [dx, dy] = [event.clientX - held.start.clientX, event.clientY - held.start.clientY];
    held.moved ||= Math.hypot(dx, dy) > CLICK_PX;
    if (!held.moved) return;
    if (held.kind === "pan") return zoom.drag(held.grip, dx, dy);
    if (held.kind === "select") return void picker.drag(placeOf(held.start)[0], placeOf(event)[0], false);
    held.corners = boxed(held.from, local(event));
    marks.box(held.corners);
  });

  plot.addEventListener("pointerup", (event) => {
    const before = held;
    release(event);
    if (before?.kind === "scrub" || (before?.kind === "box" && !before.moved)) cursor.pin(placeOf(event));
    else if (before?.corners) zoom.box(before.corners[0], before.corners[1]);
    else if (before?.kind === "select" && before.moved) picker.drag(placeOf(before.start)[0], placeOf(event)[0], true);
    else if (before?.kind === "select") cursor.pin(placeOf(event));
  });
  plot.addEventListener("pointercancel", (event) => release(event));
  plot.addEventListener("pointerleave", (event) => event.pointerType !== "touch" && !pressed.size && cursor.leave());
  plot.addEventListener("dblclick", () => zoom.reset());
  // Two fingers are ours; one that goes up or down scrolls the page (touch-action).
  plot.addEventListener(
    "touchmove",
    (event) => event.touches.length > 1 && event.cancelable && event.preventDefault(),
    { passive: false },
  );

  /** @param {{ pointerId?: number }} event */
  function release({ pointerId = NaN }) {
    pressed.delete(pointerId);
    marks.box(null);
    held = null;
  }

  function pinch() {
    const [a, b] = [...pressed.values()];
    return { kind: "pinch", grip: zoom.grab(), apart: distance(a, b), middle: middle(a, b) };
  }

  function pinched() {
    const [a, b] = [...pressed.values()];
    const now = middle(a, b);
    const factor = held.apart / Math.max(20, distance(a, b));
    zoom.drag(
      held.grip,
      now.clientX - held.middle.clientX,
      now.clientY - held.middle.clientY,
      factor,
      placeOf(held.middle),
    );
  }

  /**
   * A box that is thin in one direction covers the whole plot in it.
   * @param {Point} a
   * @param {Point} b
   * @returns {[Point, Point]}
   */
  function boxed(a, b) {
    const { left, top, width, height } = zoom.area;
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
      if (!asked && !zoom.zoomed && (sideways || dy > 0)) return; // nothing to do here: the page may scroll
      event.preventDefault();
      if (sideways) return zoom.shift((Math.abs(dx) > Math.abs(dy) ? dx : dy) / size().width, 0);
      const factor = Math.exp(dy * (event.ctrlKey && Math.abs(dy) < 30 ? PINCH : WHEEL));
      const onAxis = event.clientX - size().left < zoom.area.left;
      zoom.scale(onAxis ? [1, factor] : [factor, chart.plane ? factor : 1], placeOf(event));
    },
    { passive: false },
  );

  /** @type {Record<string, (shift: boolean) => void>} */
  const keys = {
    ArrowLeft: (shift) => (shift ? zoom.shift(-0.1, 0) : cursor.step(-1, 0)),
    ArrowRight: (shift) => (shift ? zoom.shift(0.1, 0) : cursor.step(1, 0)),
    PageUp: () => cursor.step(0, 0.1),
    PageDown: () => cursor.step(0, -0.1),
    Home: () => cursor.ends(false),
    End: () => cursor.ends(true),
    "+": () => zoom.in(),
    "=": () => zoom.in(),
    "-": () => zoom.out(),
    0: () => zoom.reset(),
    Escape: () => (release({}), pressed.clear(), cursor.clear(), picker.clear()),
    Enter: () => cursor.go(),
    s: () => void (chart.kind === "time" && picker.markEnd(cursor.index)),
  };
  plot.addEventListener("keydown", (event) => {
    const vertical = event.shiftKey && (event.key === "ArrowUp" ? 0.1 : event.key === "ArrowDown" ? -0.1 : 0);
    const act = vertical ? () => zoom.shift(0, vertical) : keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(event.shiftKey);
  });
}

/** @param {number} part */
const inside = (part) => Math.min(1, Math.max(0, part));
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
