// A number's label is a slider: dragged sideways it changes the number.

const STEP_PX = 4;

/**
 * Calls `step(count)`, negative to the left, while `label` is dragged by a mouse or pen. A click
 * still does what it does, and a finger scrolls.
 * @param {HTMLElement} label
 * @param {(count: number) => void} step
 */
export function scrub(label, step) {
  /** @type {number | null} */
  let from = null; // where the drag began [px]
  let done = 0; // steps so far
  label.classList.add("scrub");
  label.addEventListener("pointerdown", ({ button, clientX, pointerId, pointerType, target }) => {
    if (button !== 0 || pointerType === "touch" || /** @type {Element} */ (target).closest("button")) return;
    [from, done] = [clientX, 0];
    label.setPointerCapture(pointerId);
  });
  label.addEventListener("pointermove", ({ clientX }) => {
    if (from === null) return;
    const steps = Math.trunc((clientX - from) / STEP_PX);
    if (steps !== done) step(steps - done);
    done = steps;
  });
  for (const end of ["pointerup", "pointercancel"]) label.addEventListener(end, () => (from = null));
  label.addEventListener("click", (event) => {
    if (done) event.preventDefault();
    done = 0;
  });
}
