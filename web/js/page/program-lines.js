// Which line of the program runs when.

/** @type {Float64Array | null} */
let lines = null; // program line of each sample of the shown result
let sampleTime = 1;

/**
 * Takes over the lines of a new result; `null` for a path that was drawn.
 * @param {Float64Array | null} column
 * @param {number} time between two samples [s]
 */
export function setLines(column, time) {
  [lines, sampleTime] = [column, time];
}

/**
 * The line that runs at a time [s], or undefined.
 * @param {number} time
 */
export const lineAt = (time) =>
  lines?.[Math.min(lines.length - 1, Math.max(0, Math.round(time / sampleTime)))] || undefined;

/**
 * The time [s] at which a line starts to run, or undefined.
 * @param {number} line
 */
export function timeOf(line) {
  const sample = lines?.indexOf(line) ?? -1;
  return sample < 0 ? undefined : sample * sampleTime;
}
