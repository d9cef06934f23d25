// Tabs after the ARIA pattern: one stop for Tab, arrows move and select, Home and End jump.

/** Makes `list` a working tab list; calls `onshow(panel)` whenever another panel is shown. */
export function makeTabs(list, onshow) {
  const tabs = [...list.querySelectorAll("[role=tab]")];
  const panelOf = (tab) => document.getElementById(tab.getAttribute("aria-controls"));

  const select = (chosen) => {
    for (const tab of tabs) {
      const on = tab === chosen;
      tab.setAttribute("aria-selected", String(on));
      tab.tabIndex = on ? 0 : -1;
      panelOf(tab).hidden = !on;
    }
    chosen.scrollIntoView({ block: "nearest", inline: "nearest" });
    onshow(panelOf(chosen));
  };

  list.addEventListener("click", (event) => {
    const tab = event.target.closest("[role=tab]");
    if (tab) select(tab);
  });
  list.addEventListener("keydown", (event) => {
    const at = tabs.indexOf(document.activeElement);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1 + tabs.length, Home: 0, End: tabs.length - 1 }[event.key];
    if (at < 0 || to === undefined) return;
    event.preventDefault();
    const tab = tabs[to % tabs.length];
    tab.focus();
    select(tab);
  });
  return {
    show: (id) => tabs.some((tab) => tab.id === id) && select(document.getElementById(id)),
    current: () => panelOf(tabs.find((tab) => tab.getAttribute("aria-selected") === "true")),
  };
}
