// Node cannot fetch files: here the core is read from beside this module, and `await init()` has nothing left to do.

import { readFileSync } from "node:fs";
import { initSync } from "./armill.js";

initSync({ module: readFileSync(new URL("./armill_bg.wasm", import.meta.url)) });

export * from "./armill.js";
export { default } from "./armill.js";
