// The scale of colours for errors: viridis (van der Walt and Smith, 2015), perceptually even and
// safe for the colour-blind, without the end that would drown in the paper.

const VIRIDIS = [
  "440154",
  "482475",
  "414487",
  "355f8d",
  "2a788e",
  "21918c",
  "22a884",
  "44bf70",
  "7ad151",
  "bddf26",
  "fde725",
].map(rgb);

/** Red, green and blue [0..255] of six hexadecimal digits. */
export function rgb(hex) {
  return [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16));
}

/** The colour [0..255] of a share from 0 to 1 of the scale. */
export function colour(share, dark) {
  const [low, high] = dark ? [0.28, 1] : [0, 0.86];
  const at = (low + (high - low) * Math.min(1, Math.max(0, share))) * (VIRIDIS.length - 1);
  const i = Math.min(VIRIDIS.length - 2, Math.floor(at));
  return VIRIDIS[i].map((v, c) => Math.round(v + (VIRIDIS[i + 1][c] - v) * (at - i)));
}

/** The scale as a row of RGBA pixels. */
export function texels(dark, count = 256) {
  const row = new Uint8Array(count * 4);
  for (let i = 0; i < count; i++) row.set([...colour(i / (count - 1), dark), 255], i * 4);
  return row;
}

/** The scale as a CSS gradient that grows to the right. */
export function gradient(dark) {
  const stops = Array.from({ length: 9 }, (_, i) => `rgb(${colour(i / 8, dark).join(" ")})`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
