// The Worker's script.

import * as armill from "../pkg/armill.js";
import { serve } from "./core/server.js";

serve(armill);
