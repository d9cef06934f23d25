// The place of the picture on the page: how large it is, whether it is near the screen, and whether there are graphics.

/**
 * What happens to it; `room` is its width and height [px].
 *
 * @typedef {{
 *   resized(room: [number, number]): void,
 *   near(near: boolean): void,
 *   lost(): void,
 *   restored(): void,
 * }} Events
 */

/**
 * Watches the `canvas` in its `stage`. It counts as near from one screen away.
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLElement} stage
 * @param {Events} on
 */
export function watch(canvas, stage, on) {
  new ResizeObserver(() => on.resized([stage.clientWidth, stage.clientHeight])).observe(stage);
  new IntersectionObserver((entries) => on.near(entries[entries.length - 1].isIntersecting), {
    rootMargin: "100%",
  }).observe(stage);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault(); // without this it is never restored
    on.lost();
  });
  canvas.addEventListener("webglcontextrestored", () => on.restored());
}

/**
 * Makes a canvas as sharp as the screen, at most twice. Says whether that has changed it, and so cleared it.
 * @param {HTMLCanvasElement} canvas
 * @param {[number, number]} room
 */
export function sharpen(canvas, room) {
  const sharp = Math.min(2, devicePixelRatio || 1);
  const [width, height] = room.map((length) => Math.round(length * sharp));
  if (canvas.width === width && canvas.height === height) return false;
  [canvas.width, canvas.height] = [width, height];
  return true;
}
