// What the page remembers of how it is looked at: units and theme, kept in this browser only.
// Inputs are none of its business.

const KEY = "armill-settings";
const CHOICES = {
  length: ["mm", "inch"],
  force: ["N", "lbf"],
  theme: ["auto", "light", "dark"],
};
const followers = new Set();
const values = { ...Object.fromEntries(Object.entries(CHOICES).map(([key, [first]]) => [key, first])), ...read() };

/** The value of a setting. */
export const setting = (key) => values[key];

/** The values that a setting can have; the first is what holds until one is chosen. */
export const choices = (key) => CHOICES[key];

/** Chooses a value and remembers it. */
export function choose(key, value) {
  if (!CHOICES[key]?.includes(value) || values[key] === value) return;
  values[key] = value;
  try {
    localStorage.setItem(KEY, JSON.stringify(values));
  } catch {
    // Storage is denied or full: the choice holds for this visit.
  }
  for (const follow of followers) follow(key, value);
}

/** Takes over values for this visit, and remembers nothing. */
export const lend = (lent) => void Object.assign(values, lent);

/** Calls `follow(key, value)` whenever a setting changes; returns a function that ends it. */
export function onSetting(follow) {
  followers.add(follow);
  return () => followers.delete(follow);
}

function read() {
  try {
    const stored = Object.entries(JSON.parse(localStorage.getItem(KEY)) ?? {});
    return Object.fromEntries(stored.filter(([key, value]) => CHOICES[key]?.includes(value)));
  } catch {
    return {}; // denied, or not ours
  }
}
