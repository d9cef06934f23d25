// Light or dark as chosen. The page loads this before anything is drawn; "auto" leaves it to the system.

import { onSetting, setting } from "./settings.js";

function apply() {
  const theme = setting("theme");
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
}

apply();

/** Follows the setting from now on. */
export const followTheme = () => onSetting((key) => key === "theme" && apply());
