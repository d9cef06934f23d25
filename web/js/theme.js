// Light or dark as chosen, before anything is drawn. "auto" leaves it to the system.

import { onSetting, setting } from "./settings.js";

const apply = () => {
  const theme = setting("theme");
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
};

apply();
onSetting((key) => key === "theme" && apply());
