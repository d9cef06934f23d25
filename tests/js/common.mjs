// What the tests of the page's modules share: the core in Node, and random numbers that can be had again.

import { readFileSync } from "node:fs";
import * as armill from "../../target/site/pkg/armill.js";

armill.initSync({ module: readFileSync(new URL("../../target/site/pkg/armill_bg.wasm", import.meta.url)) });

/** The core, as the site has it. */
export { armill };

/** What a form is built from, as the core gives it. */
export const hello = () => ({
  job: { ...JSON.parse(armill.default_job()), model: armill.model() },
  fields: armill.fields(),
  presets: armill.presets(),
  model: armill.model(),
});

/** Numbers from 0 to 1, the same for the same seed: mulberry32, by Tommy Ettinger. */
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** One item of a list. */
export const one = (next, list) => list[Math.floor(next() * list.length)];
