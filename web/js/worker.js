// The Worker's script: it starts with the small core and goes on with the full one where that is needed. The one-file page has its own.

import * as small from "../pkg/small/armill.js";
import { serve } from "./answers.js";

serve({ small: () => small, full: () => import("../pkg/full/armill.js") });
