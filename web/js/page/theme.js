// Light or dark as chosen; "auto" leaves it to the system.

import { onSetting, setting } from "./settings.js";

/** Shows the page in the theme chosen. */
export function applyTheme() {
  const theme = setting("theme");
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
}

/** Follows the setting from now on. */
export const followTheme = () => onSetting((key) => key === "theme" && applyTheme());
