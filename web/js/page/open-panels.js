// Which view and which groups of inputs are open: remembered in this browser.

/** @typedef {{ tab?: string, groups?: string[] }} OpenPanels */

const KEY = "armill-panels";

/**
 * What was open last: `tab`, an id, and `groups`, a list of ids; each undefined where nothing is
 * remembered.
 * @returns {OpenPanels}
 */
export function openPanels() {
  try {
    const { tab, groups } = JSON.parse(localStorage.getItem(KEY) ?? "{}") ?? {};
    return { tab: typeof tab === "string" ? tab : undefined, groups: Array.isArray(groups) ? groups : undefined };
  } catch {
    return {}; // denied, or not ours
  }
}

/**
 * Remembers one of the two.
 * @param {OpenPanels} open
 */
export function rememberPanels(open) {
  try {
    localStorage.setItem(KEY, JSON.stringify({ ...openPanels(), ...open }));
  } catch {
    // Denied or full: it stays as it is for this visit.
  }
}

/** Opens the groups that were open, and remembers what is opened and folded from now on. */
export function restoreGroups() {
  const all = /** @type {HTMLDetailsElement[]} */ ([...document.querySelectorAll(".group")]);
  const { groups } = openPanels();
  if (groups) for (const group of all) group.open = groups.includes(group.id);
  const follow = () => rememberPanels({ groups: all.filter((group) => group.open).map((group) => group.id) });
  for (const group of all) group.addEventListener("toggle", follow);
}
