// The Worker's side of core.js: owns one Run of the WebAssembly core and answers questions about it.

import init, * as armill from "../pkg/armill.js";

const PROGRESS_MS = 40;
let start; // takes the promise of a running core
const ready = new Promise((resolve) => (start = resolve));
ready.catch(() => {}); // told to whoever asks first
let run = null;

const answers = {
  hello: () => ({
    version: armill.version(),
    job: JSON.parse(armill.default_job()),
    fields: armill.fields(),
    presets: armill.presets(),
    formats: armill.formats(),
  }),
  check: (json) => void armill.check(json),
  run(json) {
    let last = 0;
    const fresh = armill.run(json, (fraction, stage) => {
      const now = performance.now();
      if (now - last < PROGRESS_MS) return;
      last = now;
      postMessage({ progress: { fraction, stage } });
    });
    release();
    run = fresh;
    return { summary: run.summary(), charts: run.charts() };
  },
  column: (key) => run.column(key),
  frames: (sample) => run.frames(sample),
  track: (most) => run.track(most),
  chart: (name, options) => run.chart(name, options),
  data: (name, units) => run.chart_data(name, units),
  export: (format) => run.export(format),
  replay: (format) => run.replay(format),
  release,
  thesis: () => armill.thesis_recomputed(),
  trap: () => armill.trap(),
};

function release() {
  run?.free();
  run = null;
}

/** What is handed over instead of copied: a column, or those of a chart. */
const buffers = (value) => [value].flat().flatMap((each) => (each instanceof Float64Array ? each : each?.values)?.buffer ?? []);

/** An error as data: Errors lose their extra properties on the way through postMessage. */
function plain(error) {
  const { code, message, field, line, column } = error;
  return { code, message: message ?? String(error), field, line, column, fatal: error instanceof WebAssembly.RuntimeError };
}

addEventListener("message", async ({ data: { module, id, kind, args } }) => {
  if (module) return start(init({ module_or_path: module }));
  try {
    await ready;
  } catch (error) {
    return postMessage({ id, error: { ...plain(error), code: "load", fatal: true } });
  }
  try {
    const value = answers[kind](...args);
    postMessage({ id, value }, buffers(value));
  } catch (error) {
    postMessage({ id, error: plain(error) });
  }
});
