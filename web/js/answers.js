// The Worker's side of core.js: owns one Run of the WebAssembly core and answers questions about it.

const PROGRESS_MS = 40;
const ROWS = 20_000; // of a file written at a time
const FULL = new Set(["export", "replay", "promise", "thesis", "identify", "extent", "survey"]); // questions that only the full core answers

let armill; // the core in use: the small or the full one, behind the same interface
let isFull = false;
let run = null;
let shown; // the job of the run, as JSON text
let upgrading; // promise of the full core, from when it is first needed
const identified = {}; // what was identified last, `stiffness` and `response`
let surveyed; // { json, survey } of the map of places
const arrival = {}; // takes the core that is waited for

const answers = {
  check: (json) => void armill.check(json),
  arm: (json) => armill.arm(json),
  place: (json) => armill.place_in_front(json),
  run(json) {
    let last = 0;
    const fresh = armill.run(json, (fraction, stage) => {
      const now = performance.now();
      if (now - last < PROGRESS_MS) return;
      last = now;
      postMessage({ progress: { fraction, stage } });
    });
    release();
    [run, shown] = [fresh, json];
    return { summary: run.summary(), charts: run.charts() };
  },
  column: (key) => run.column(key),
  frames: (sample) => run.frames(sample),
  track: (most) => run.track(most),
  chart: (name, options) => run.chart(name, options),
  data: (name, units) => run.chart_data(name, units),
  export: (format) => (format === "columns-csv" ? columnsFile() : run.export(format)),
  replay: (format) => run.replay(format),
  promise: () => run.promise(),
  /** Makes ready for the next job: with the first result shown, there is time to load the full core. */
  async prepare() {
    release();
    await upgrade();
  },
  thesis: () => armill.thesis_recomputed(),
  identify(kind, ...args) {
    const fresh = armill[`identify_${kind}`](...args);
    identified[kind]?.free();
    identified[kind] = fresh;
    return fresh.summary();
  },
  identified_chart: (kind, options) => identified[kind].chart(options),
  identified_data: (kind, units) => identified[kind].chart_data(units),
  extent: (json) => surveyOf(json).extent(),
  survey: (json, places) => surveyOf(json).places(places),
  trap: () => armill.trap(),
};

/** All columns as a file. A long run is a gigabyte of text, more than a string holds: the browser keeps the parts on its disk. */
function columnsFile() {
  const samples = run.column("time_s").length;
  const parts = [];
  for (let from = 0; from < samples; from += ROWS) parts.push(new Blob([run.columns_csv(from, from + ROWS)]));
  return new Blob(parts);
}

function release() {
  run?.free();
  run = null;
}

/** The job of a map, read once for all its bands. */
function surveyOf(json) {
  if (surveyed?.json !== json) {
    surveyed?.survey.free();
    surveyed = undefined;
    surveyed = { json, survey: new armill.Survey(json) };
  }
  return surveyed.survey;
}

async function answer(kind, args) {
  if (FULL.has(kind)) await upgrade();
  try {
    return answers[kind](...args);
  } catch (error) {
    if (error.code !== "needs-full") throw error;
  }
  await upgrade();
  return answers[kind](...args);
}

/** Goes on with the full core, once; the run is computed again in it and has the same bits. */
async function upgrade() {
  if (isFull) return;
  if (!upgrading) {
    upgrading = arriving().finally(() => (upgrading = undefined));
    postMessage({ need: "full" });
  }
  await upgrading;
}

/** The next core that the page sends, started. */
const arriving = () => new Promise((resolve, reject) => Object.assign(arrival, { resolve, reject }));

/** What is handed over instead of copied: a column, or those of a chart. */
const buffers = (value) => [value].flat().flatMap((each) => (each instanceof Float64Array ? each : each?.values)?.buffer ?? []);

/** An error as data: Errors lose their extra properties on the way through postMessage. */
function plain(error) {
  const { code, message, field, line, column } = error;
  return { code, message: message ?? String(error), field, line, column, fatal: error instanceof WebAssembly.RuntimeError };
}

/** Answers the page's questions. `glue` has the JavaScript side of each core that there is, `small` and `full`. */
export function serve(glue) {
  const first = arriving();
  first.catch(() => {}); // told to whoever asks first

  async function start({ core, module, error }) {
    if (error) throw error;
    const next = await glue[core]();
    await next.default({ module_or_path: module });
    const again = run && next.run(shown);
    release();
    [armill, run, isFull] = [next, again, core === "full"];
  }

  addEventListener("message", async ({ data }) => {
    if (data.core) return start(data).then(arrival.resolve, arrival.reject);
    const { id, kind, args } = data;
    try {
      await first;
    } catch (error) {
      return postMessage({ id, error: { ...plain(error), code: "load", fatal: true } });
    }
    try {
      const value = await answer(kind, args);
      postMessage({ id, value }, buffers(value));
    } catch (error) {
      postMessage({ id, error: plain(error) });
    }
  });
}
