// The scale of colours for signed deviations: blue for too little material, orange for too much. The two differ for
// the colour-blind as well, and both ends stand out from the middle, which is about the paper's.

import { rgb } from "./ramp.js";

const LIGHT = ["00497a", "2f86bd", "a3cbe4", "e6e8ea", "f4c49d", "de7a33", "953c00"].map(rgb);
const DARK = ["9ad7ff", "4a9fd8", "49687f", "565d64", "8f684e", "e8853f", "ffc795"].map(rgb);

/**
 * The colour [0..255] of a share from -1 (too little) to 1 (too much) of the scale.
 * @param {number} share
 * @param {boolean} dark
 */
export function colour(share, dark) {
  const stops = dark ? DARK : LIGHT;
  const at = ((Math.min(1, Math.max(-1, share)) + 1) / 2) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return stops[i].map((v, c) => Math.round(v + (stops[i + 1][c] - v) * (at - i)));
}

/**
 * The scale as a row of RGBA pixels.
 * @param {boolean} dark
 * @param {number} [count]
 */
export function texels(dark, count = 256) {
  const row = new Uint8Array(count * 4);
  for (let i = 0; i < count; i++) row.set([...colour((2 * i) / (count - 1) - 1, dark), 255], i * 4);
  return row;
}

/**
 * The scale as a CSS gradient that grows to the right.
 * @param {boolean} dark
 */
export function gradient(dark) {
  const stops = Array.from({ length: 13 }, (_, i) => `rgb(${colour(i / 6 - 1, dark).join(" ")})`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
