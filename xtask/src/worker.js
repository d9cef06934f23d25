// The Worker's script of the one-file page: it has the full core alone.

import * as full from "../pkg/full/armill.js";
import { serve } from "./answers.js";

serve({ full: () => full });
