// Tabs after the ARIA pattern: one stop for Tab, arrows move and select, Home and End jump. A panel may
// have tabs of its own, its pages. The address names the view that is shown, so that a link opens it and
// Back returns to the one before.

import { byId } from "./dom.js";

const VIEW = /(?:^#?|&)view=([\w-]+)/;

/**
 * The view that a fragment names, or undefined.
 * @param {string} fragment
 */
export const viewIn = (fragment) => VIEW.exec(fragment)?.[1];

/**
 * A fragment, without "#", that names another view and is the same otherwise.
 * @param {string} fragment
 * @param {string} view
 */
export function withView(fragment, view) {
  const rest = fragment.replace(/^#/, "").replace(/&?view=[\w-]*/, "");
  const own = /^\w+=/.test(rest) ? rest : ""; // not the name of a section
  return [own, `view=${view}`].filter(Boolean).join("&");
}

/**
 * Makes every tab list of the page work; `onshow(panel)` is called whenever another panel without pages
 * of its own is shown, its view's name in `panel.id` after "panel-".
 * @param {(panel: HTMLElement) => void} onshow
 */
export function makeTabs(onshow) {
  const lists = /** @type {HTMLElement[]} */ ([...document.querySelectorAll("[role=tablist]")]);
  /** @param {Element} list */
  const tabsOf = (list) => /** @type {HTMLElement[]} */ ([...list.querySelectorAll("[role=tab]")]);
  /** @param {HTMLElement} tab */
  const panelOf = (tab) => byId(String(tab.getAttribute("aria-controls")));
  /** @param {Element} list */
  const chosenOf = (list) =>
    /** @type {HTMLElement} */ (tabsOf(list).find((tab) => tab.getAttribute("aria-selected") === "true"));
  /** @param {HTMLElement} panel */
  const pagesOf = (panel) => panel.querySelector("[role=tablist]");

  /**
   * @param {Element} list
   * @param {HTMLElement} chosen
   */
  function mark(list, chosen) {
    for (const tab of tabsOf(list)) {
      const on = tab === chosen;
      tab.setAttribute("aria-selected", String(on));
      tab.tabIndex = on ? 0 : -1;
      panelOf(tab).hidden = !on;
    }
    chosen.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /**
   * The panel that is seen when `tab` is chosen: its own, or its chosen page.
   * @param {HTMLElement} tab
   */
  const seen = (tab) => {
    const pages = pagesOf(panelOf(tab));
    return pages ? panelOf(chosenOf(pages)) : panelOf(tab);
  };

  /** @param {HTMLElement} tab */
  function select(tab) {
    const list = /** @type {HTMLElement} */ (tab.closest("[role=tablist]"));
    mark(list, tab);
    const parent = list.closest("[role=tabpanel]");
    if (parent) mark(lists[0], byId(String(parent.getAttribute("aria-labelledby"))));
    onshow(seen(tab));
  }

  /**
   * As a person does it: the address follows.
   * @param {HTMLElement} tab
   */
  function choose(tab) {
    select(tab);
    const view = seen(tab).id.replace("panel-", "");
    if (viewIn(location.hash) !== view) history.pushState(null, "", `#${withView(location.hash, view)}`);
  }

  for (const list of lists) {
    list.addEventListener("click", ({ target }) => {
      /** @type {HTMLElement | null} */
      const tab = /** @type {Element} */ (target).closest("[role=tab]");
      if (tab) choose(tab);
    });
    list.addEventListener("keydown", (event) => {
      const tabs = tabsOf(list);
      const at = tabs.indexOf(/** @type {HTMLElement} */ (document.activeElement));
      /** @type {Record<string, number>} */
      const places = { ArrowRight: at + 1, ArrowLeft: at - 1 + tabs.length, Home: 0, End: tabs.length - 1 };
      const to = places[event.key];
      if (at < 0 || to === undefined) return;
      event.preventDefault();
      const tab = tabs[to % tabs.length];
      tab.focus();
      choose(tab);
    });
  }

  /**
   * @param {string} view
   * @returns {HTMLElement | null}
   */
  const tabOf = (view) => document.querySelector(`[role=tab][aria-controls="panel-${CSS.escape(view)}"]`);
  const own = {
    /**
     * Shows a view by its name; false if there is none.
     * @param {string} view
     */
    show(view) {
      const tab = tabOf(view);
      if (tab) select(tab);
      return Boolean(tab);
    },
    /**
     * The same as a person would: Back returns.
     * @param {string} view
     */
    choose(view) {
      const tab = tabOf(view);
      if (tab) choose(tab);
    },
    /** The panel that is seen. */
    current: () => seen(chosenOf(lists[0])),
  };
  addEventListener("popstate", () => {
    const view = viewIn(location.hash) ?? "overview";
    if (own.current().id !== `panel-${view}`) own.show(view);
  });
  return own;
}
