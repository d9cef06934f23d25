// What the page remembers of how it is looked at: units and theme, kept in this browser only.

/** @typedef {"length" | "feed" | "force" | "theme" | "over" | `scale-${string}`} Setting */

const KEY = "armill-settings";
/** @type {Record<string, string[]>} */
const CHOICES = {
  length: ["mm", "inch"],
  feed: ["second", "minute"],
  force: ["N", "lbf"],
  theme: ["auto", "light", "dark"],
  over: ["auto", "time", "length", "line"],
};
const SCALES = ["auto", "linear", "log"]; // of each chart: `scale-` and its name
/** @type {Set<(key: Setting, value: string) => void>} */
const followers = new Set();
/** @type {Record<string, string>} */
const values = read();
let borrowed = false;

/**
 * The value of a setting.
 * @param {Setting} key
 */
export const setting = (key) => values[key] ?? choices(key)?.[0] ?? "";

/**
 * The values that a setting can have; the first is what holds until one is chosen.
 * @param {string} key
 * @returns {string[] | undefined}
 */
export function choices(key) {
  return CHOICES[key] ?? (key.startsWith("scale-") ? SCALES : undefined);
}

/**
 * Chooses a value and remembers it.
 * @param {Setting} key
 * @param {string} value
 */
export function choose(key, value) {
  if (!choices(key)?.includes(value) || setting(key) === value) return;
  values[key] = value;
  try {
    if (!borrowed) localStorage.setItem(KEY, JSON.stringify(values));
  } catch {
    // Storage is denied or full: the choice holds for this visit.
  }
  for (const follow of followers) follow(key, value);
}

/**
 * Takes over values for this visit, which remembers nothing.
 * @param {Record<string, string>} lent
 */
export function lend(lent) {
  borrowed = true;
  Object.assign(values, lent);
}

/**
 * Calls `follow(key, value)` whenever a setting changes; returns a function that ends it.
 * @param {(key: Setting, value: string) => void} follow
 */
export function onSetting(follow) {
  followers.add(follow);
  return () => followers.delete(follow);
}

function read() {
  try {
    const stored = Object.entries(JSON.parse(localStorage.getItem(KEY) ?? "{}") ?? {});
    return Object.fromEntries(stored.filter(([key, value]) => choices(key)?.includes(value)));
  } catch {
    return {}; // denied, or not ours
  }
}
