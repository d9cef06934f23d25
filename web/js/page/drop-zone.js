// Files dragged over the page: a frame over all of it says what letting go would do. Nothing moves for it,
// and it is not read out: who drags sees it.

import { byId } from "./dom.js";

/** @param {DragEvent} event */
const hasFiles = ({ dataTransfer }) => Boolean(dataTransfer?.types.includes("Files"));

/**
 * `take(file)` is called with the file that is dropped anywhere on the page, except where an element takes it
 * itself. An element with `data-drop` says in that attribute what it takes.
 * @param {(file: File) => void} take
 */
export function makeDropZone(take) {
  const frame = byId("drop-zone");
  const usual = frame.textContent ?? "";
  const leave = () => (frame.hidden = true);
  addEventListener("dragover", (event) => {
    if (!hasFiles(event)) return; // a text that is moved from one field to another
    event.preventDefault();
    const own = /** @type {Element} */ (event.target).closest?.("[data-drop]")?.getAttribute("data-drop");
    const text = own ?? usual;
    if (frame.textContent !== text) frame.textContent = text;
    frame.hidden = false;
  });
  addEventListener("dragleave", (event) => event.relatedTarget === null && leave()); // for outside the window
  addEventListener("keydown", ({ key }) => key === "Escape" && leave());
  addEventListener("drop", leave, { capture: true });
  addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    if (file) take(file);
  });
}
