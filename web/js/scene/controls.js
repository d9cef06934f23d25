// Moves a camera by mouse, touch and keys.
//
// The page must stay scrollable: a finger that starts upwards or downwards scrolls it (`touch-
// action: pan-y`), one that starts sideways orbits; two fingers pan and pinch. The wheel zooms once
// the picture has the focus, or with Ctrl.

/** @type {Record<string, [x: number, y: number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const TURN = Math.PI / 450; // a pixel of dragging [rad]
const STEP = Math.PI / 36; // an arrow key [rad]
const STILL = 4; // a press that moves less than this points [px]
const SIDEWAYS = 10; // a finger turns the picture once it has gone this far to a side [px]; before, it may still scroll the page

/** @import { Camera } from "./camera.js" */

/** @typedef {{ x: number, y: number, start: number[], moved: number, free: boolean, pans: boolean }} Pointer one on the picture */

/** @typedef {{ move(): void, point(x: number, y: number, pressed: boolean): void, key(key: string): boolean }} Steered */

/**
 * Steers `camera` from `canvas`. `on.move` follows a change, `on.point` a pointer over the picture, `on.key` may
 * take a key first by returning true.
 * @param {HTMLElement} canvas
 * @param {Camera} camera
 * @param {Steered} on
 */
export function steer(canvas, camera, on) {
  /** @type {Map<number, Pointer>} */
  const down = new Map(); // by the pointer's id
  /** @param {PointerEvent} event */
  const place = ({ offsetX, offsetY }) => [offsetX, offsetY];

  canvas.addEventListener("pointerdown", (event) => {
    const [x, y] = place(event);
    down.set(event.pointerId, {
      x,
      y,
      start: [x, y],
      moved: 0,
      free: event.pointerType !== "touch",
      pans: event.button !== 0 || event.shiftKey,
    });
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    const own = down.get(event.pointerId);
    if (!own) return on.point(x, y, false);
    const [dx, dy] = [x - own.x, y - own.y];
    const others = [...down.values()].filter((other) => other !== own);
    own.moved += Math.abs(dx) + Math.abs(dy);
    const [aside, upright] = [Math.abs(x - own.start[0]), Math.abs(y - own.start[1])];
    own.free ||= others.length > 0 || (aside > SIDEWAYS && aside >= upright);
    [own.x, own.y] = [x, y];
    if (own.moved < STILL || !own.free) return;
    if (others.length === 1) pinch({ x: x - dx, y: y - dy }, others[0], dx, dy);
    else if (own.pans) camera.pan(dx, dy);
    else camera.orbit(-dx * TURN, dy * TURN);
    on.move();
  });
  /** @param {PointerEvent} event */
  const up = (event) => {
    const own = down.get(event.pointerId);
    down.delete(event.pointerId);
    if (own && own.moved < STILL && event.type === "pointerup") on.point(own.x, own.y, true);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);

  /**
   * One of two fingers moves by (dx, dy): the middle moves by half of that, the distance says the
   * zoom.
   * @param {{ x: number, y: number }} own
   * @param {{ x: number, y: number }} other
   * @param {number} dx
   * @param {number} dy
   */
  function pinch(own, other, dx, dy) {
    const before = Math.hypot(own.x - other.x, own.y - other.y);
    const after = Math.hypot(own.x + dx - other.x, own.y + dy - other.y);
    camera.pan(dx / 2, dy / 2);
    if (before > 10 && after > 10) camera.zoom(after / before);
  }

  // Two fingers are for the picture, whatever way they start.
  canvas.addEventListener("touchstart", (event) => event.touches.length > 1 && event.preventDefault(), {
    passive: false,
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      camera.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015) * (event.ctrlKey ? 4 : 1)));
      on.move();
    },
    { passive: false },
  );

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (!on.key(event.key) && !step(event)) return;
    event.preventDefault();
  });

  /**
   * What a key does to the camera; false if nothing.
   * @param {KeyboardEvent} event
   */
  function step({ key, shiftKey }) {
    const [x, y] = ARROWS[key] ?? [0, 0];
    if (x || y) shiftKey ? camera.pan(-x * 30, y * 30) : camera.orbit(x * STEP, y * STEP);
    else if (key === "+" || key === "=") camera.zoom(1.2);
    else if (key === "-") camera.zoom(1 / 1.2);
    else return false;
    on.move();
    return true;
  }
}
