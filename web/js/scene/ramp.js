// The scale of colours for errors, from blue over red to amber: hues that the colour-blind tell apart, and every one of
// them at least three times as light or dark as the page's light and dark paper (WCAG 2.2, 1.4.11), so that one scale
// serves both.

const STOPS = ["3f7fd6", "7a6fd8", "b55cb8", "d6527f", "df5b3d", "cf7a00"].map(rgb);

/**
 * Red, green and blue [0..255] of six hexadecimal digits.
 * @param {string} hex
 */
export function rgb(hex) {
  return [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16));
}

/**
 * The colour [0..255] of a share from 0 to 1 of the scale.
 * @param {number} share
 */
export function colour(share) {
  const at = Math.min(1, Math.max(0, share)) * (STOPS.length - 1);
  const i = Math.min(STOPS.length - 2, Math.floor(at));
  return STOPS[i].map((v, c) => Math.round(v + (STOPS[i + 1][c] - v) * (at - i)));
}

/**
 * The scale as a row of RGBA pixels.
 * @param {number} [count]
 */
export function texels(count = 256) {
  const row = new Uint8Array(count * 4);
  for (let i = 0; i < count; i++) row.set([...colour(i / (count - 1)), 255], i * 4);
  return row;
}

/**
 * The scale as a CSS gradient that grows to the right.
 */
export function gradient() {
  const stops = Array.from({ length: 11 }, (_, i) => `rgb(${colour(i / 10).join(" ")})`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
