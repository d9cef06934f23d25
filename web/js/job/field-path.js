// Paths of fields, such as "path.points_mm[2]".

/**
 * Its keys, one after the other.
 * @param {string} path
 */
export const keysOf = (path) => path.match(/[^.[\]]+/g) ?? [];
/**
 * The path of the part that has it; empty on the first level.
 * @param {string} path
 */
export const parentOf = (path) => path.slice(0, Math.max(0, path.lastIndexOf(".")));
/**
 * Its last key.
 * @param {string} path
 */
export const keyOf = (path) => path.slice(path.lastIndexOf(".") + 1);
/**
 * The index that the rest of a path begins with, such as "[2].a_mm"; 0 without one.
 * @param {string} rest
 */
export const indexIn = (rest) => Number(/^\[(\d+)\]/.exec(rest)?.[1] ?? 0);
/**
 * Whether a field decides the shape of its part.
 * @param {{ path: string }} field
 */
export const decides = (field) => /\.(kind|preset)$/.test(field.path);

/**
 * The path of the same quantity in another unit: a frequency is in rad/s or in Hz.
 * @param {string} path
 */
export function twin(path) {
  if (path.endsWith("frequency_rad_s")) return path.replace(/rad_s$/, "hz");
  if (path.endsWith("frequency_hz")) return path.replace(/hz$/, "rad_s");
  return undefined;
}

/**
 * What a field's value is kept under: a program in one language is none in another.
 * @param {{ path: string, defaults?: unknown }} field
 * @param {string} [choice]
 */
export const draftKey = (field, choice) => (field.defaults ? `${field.path}@${choice}` : field.path);
