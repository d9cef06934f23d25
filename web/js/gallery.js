// The gallery's colours, which follow the setting on the page.

import { applyTheme } from "./page/theme.js";

applyTheme();
