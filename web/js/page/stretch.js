// A stretch of the shown run that was selected, in seconds: one for all charts.

const followers = new Set();
let now = null; // [from, to], or null
let home = null; // where it was selected

/** The selected stretch [s], or null. */
export const stretch = () => now;

/** Whether it was selected there. */
export const isHome = (place) => home === place;

/** Selects a stretch [s], or none; `complete` once both of its ends are chosen. */
export function setStretch(range, place, complete) {
  now = range;
  home = range && place;
  for (const follow of followers) follow(place, complete);
}

/** Calls `follow(place, complete)` whenever the stretch changes. */
export const onStretch = (follow) => void followers.add(follow);
