// What is written over the picture: names of axes and of the worst place. None covers another.

import { plus } from "./camera.js";

/** @import { Frame } from "./arm.js" */

/** @typedef {{ name: string, frame: Frame, long: number }} Named a frame with a name, and how long its axes are [mm] */

/** @typedef {{ words: string, point: number[], className: string }} Label */

/** @typedef {{ x: number, y: number, width: number, height: number }} Rectangle a place in the picture [px] */

const HEIGHT = 16; // of a label [px]
const BESIDE = 6; // from its point [px]

/**
 * The names of frames' axes at their tips, and of the frames; frames that coincide share one.
 * @param {Named[]} axes
 * @returns {Label[]}
 */
export function axisLabels(axes) {
  const [base, workpiece] = axes;
  const same = Math.hypot(...base.frame.origin.map((v, i) => v - workpiece.frame.origin[i])) < 1e-6;
  return (same ? [base] : [workpiece, base]).flatMap(({ name, frame, long }) => [
    { words: same ? "base and workpiece" : name, point: frame.origin, className: "name" },
    .../** @type {const} */ (["x", "y", "z"]).map((axis) => ({
      words: axis,
      point: plus(frame.origin, frame[axis], long * 1.1),
      className: "",
    })),
  ]);
}

export class Labels {
  #box;
  /** @type {Map<string, number>} */
  #widths = new Map(); // of words that were measured

  /** @param {HTMLElement} box */
  constructor(box) {
    this.#box = box;
  }

  /**
   * Writes labels { words, point, className } where `place(point)` says, and moves `first`, an element with a `point`, or
   * none, out of their way. `taken` are boxes { x, y, width, height } to be left free; a label without room is left out.
   * @param {Label[]} wanted
   * @param {{ node: HTMLElement, point: number[] } | null | undefined} first
   * @param {(point: number[]) => number[]} place
   * @param {number[]} room
   * @param {Rectangle[]} taken
   */
  write(wanted, first, place, room, taken) {
    const occupied = [...taken];
    if (first)
      this.#put(
        first.node,
        place(first.point),
        [first.node.offsetWidth, first.node.offsetHeight],
        room,
        occupied,
        true,
      );
    while (this.#box.children.length < wanted.length) this.#box.append(document.createElement("span"));
    /** @type {HTMLElement[]} */ ([...this.#box.children]).forEach((span, i) => {
      span.hidden = i >= wanted.length;
      if (span.hidden) return;
      const { words, point, className } = wanted[i];
      if (span.textContent !== words) span.textContent = words;
      span.className = className;
      if (!this.#widths.has(words)) this.#widths.set(words, span.offsetWidth);
      this.#put(span, place(point), [this.#widths.get(words) ?? 0, HEIGHT], room, occupied, false);
    });
  }

  /**
   * Puts a label beside its point, where there is room for it; one that has to be seen is put there anyway.
   * @param {HTMLElement} node
   * @param {number[]} point
   * @param {number[]} size
   * @param {number[]} room
   * @param {Rectangle[]} occupied
   * @param {boolean} always
   */
  #put(node, [x, y, depth], [width, height], room, occupied, always) {
    const sides = [
      [BESIDE, -height - BESIDE],
      [-width - BESIDE, -height - BESIDE],
      [BESIDE, BESIDE],
      [-width - BESIDE, BESIDE],
      [-width / 2, -height - 2 * BESIDE],
      [-width / 2, 2 * BESIDE],
    ].map(([dx, dy]) => ({ x: x + dx, y: y + dy, width, height }));
    /** @param {Rectangle} box */
    const fits = (box) =>
      box.x >= 0 &&
      box.y >= 0 &&
      box.x + width <= room[0] &&
      box.y + height <= room[1] &&
      !occupied.some((other) => meet(box, other));
    const ahead = depth > 0;
    const clamped = { ...sides[0], x: bounded(sides[0].x, room[0] - width), y: bounded(sides[0].y, room[1] - height) };
    const box = ahead ? (sides.find(fits) ?? (always ? clamped : undefined)) : undefined;
    node.hidden = !box;
    if (!box) return;
    occupied.push(box);
    node.style.setProperty("transform", `translate(${box.x.toFixed(1)}px, ${box.y.toFixed(1)}px)`);
  }
}

/**
 * @param {number} value
 * @param {number} most
 */
const bounded = (value, most) => Math.max(0, Math.min(most, value));

/**
 * @param {Rectangle} a
 * @param {Rectangle} b
 */
const meet = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
