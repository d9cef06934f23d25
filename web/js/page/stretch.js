// A stretch of the shown run that was selected, in seconds: one for all charts.

/** @type {Set<(place: unknown, complete: boolean) => void>} */
const followers = new Set();
/** @type {[number, number] | null} */
let now = null; // [from, to], or null
/** @type {unknown} */
let home = null; // where it was selected

/** The selected stretch [s], or null. */
export const stretch = () => now;

/**
 * Whether it was selected there.
 * @param {unknown} place
 */
export const isHome = (place) => home === place;

/**
 * Selects a stretch [s], or none; `complete` once both of its ends are chosen.
 * @param {[number, number] | null} range
 * @param {unknown} place
 * @param {boolean} complete
 */
export function setStretch(range, place, complete) {
  now = range;
  home = range && place;
  for (const follow of followers) follow(place, complete);
}

/**
 * Calls `follow(place, complete)` whenever the stretch changes.
 * @param {(place: unknown, complete: boolean) => void} follow
 */
export const onStretch = (follow) => void followers.add(follow);
