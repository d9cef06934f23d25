// The names of the axes, written over the picture.

import { plus } from "./camera.js";

/** Writes the axes' names at their tips; frames that coincide share one. */
export function placeLabels(box, axes, place) {
  const [base, workpiece] = axes;
  const same = Math.hypot(...base.frame.origin.map((v, i) => v - workpiece.frame.origin[i])) < 1e-6;
  const wanted = [];
  for (const { name, frame, long } of same ? [base] : axes) {
    ["x", "y", "z"].forEach((axis) => wanted.push([axis, plus(frame.origin, frame[axis], long * 1.1)]));
    wanted.push([same ? "base and workpiece" : name, frame.origin, "name"]);
  }
  while (box.children.length < wanted.length) box.append(document.createElement("span"));
  [...box.children].forEach((span, i) => {
    span.hidden = i >= wanted.length;
    if (span.hidden) return;
    const [words, point, className = ""] = wanted[i];
    const [x, y] = place(point);
    if (span.textContent !== words) span.textContent = words;
    span.className = className;
    span.style.setProperty("transform", `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`);
  });
}
