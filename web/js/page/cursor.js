// The page's one cursor: an instant of the shown run, in seconds. Charts, scene, play and program
// all read and move it.

/** @type {Set<(time: number | null, from: unknown) => void>} */
const followers = new Set();
/** @type {number | null} */
let now = null; // seconds from the start, or null while nothing is pointed at

/** The instant pointed at [s], or null. */
export const cursor = () => now;

/**
 * Points at an instant [s], or at none; `from` lets listeners ignore their own updates.
 * @param {number | null} time
 * @param {unknown} [from]
 */
export function setCursor(time, from) {
  if (time === now) return;
  now = time;
  for (const follow of followers) follow(now, from);
}

/**
 * Calls `follow(time, from)` whenever the cursor moves; returns a function that ends it.
 * @param {(time: number | null, from: unknown) => void} follow
 */
export function onCursor(follow) {
  followers.add(follow);
  return () => followers.delete(follow);
}
