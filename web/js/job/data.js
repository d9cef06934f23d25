// A job as plain data, in the shape of the job file.

/** @typedef {Record<string, any>} JobData a job as the core reads it: sections with their keys */

/** @typedef {{ job: JobData, drafts?: Record<string, any> }} JobState a job, and what is kept for the way back */

const MOST_POINTS = 5000; // in a field of their own: browsers take seconds to lay out more

/**
 * A job's plain object as the text that is computed and saved.
 * @param {JobData} data
 */
export const textOf = (data) => JSON.stringify(data, null, 2);

/**
 * Plain data changed by a JSON merge patch (RFC 7386): null removes a key.
 * @param {any} data
 * @param {any} patch
 * @returns {any}
 */
export function merged(data, patch) {
  if (typeof patch !== "object" || patch === null || Array.isArray(patch)) return patch;
  const own = typeof data === "object" && data !== null && !Array.isArray(data) ? data : {};
  const all = { ...own };
  for (const [key, change] of Object.entries(patch)) {
    if (change === null) delete all[key];
    else all[key] = merged(own[key], change);
  }
  return all;
}

/**
 * A job whose polyline is too long for a text field has its points as rows of a program, the same
 * path.
 * @param {JobData} job
 */
export function listed(job) {
  const { kind, points_mm } = job.path ?? {};
  if (kind !== "polyline" || !(points_mm?.length > MOST_POINTS)) return job;
  return {
    ...job,
    path: { kind: "csv", text: points_mm.map((/** @type {number[]} */ point) => point.join(",")).join("\n") },
  };
}

/**
 * A copy of plain data that shares its texts: a program of megabytes is never doubled.
 * @param {any} value
 * @returns {any}
 */
export function copy(value) {
  if (Array.isArray(value)) return value.map(copy);
  if (typeof value !== "object" || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([key, part]) => [key, copy(part)]));
}

/**
 * Plain data that cannot be changed at any depth.
 * @template T
 * @param {T} value
 * @returns {T}
 */
export function frozen(value) {
  if (typeof value === "object" && value !== null) Object.values(value).forEach(frozen);
  return Object.freeze(value);
}
