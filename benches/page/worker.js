// Times the core in a Worker, as the page runs it.

const WARM_MS = 500; // V8 recompiles hot code
const ENOUGH_MS = 1000;
const FEWEST = 5;
const CLOCK_MS = 10; // the browser's clock is coarse: one reading covers at least this much

/** Times of one call in ms, as a list. */
function timed(call) {
  const since = (start) => performance.now() - start;
  let calls = 0;
  const warm = performance.now();
  do {
    call();
    calls++;
  } while (since(warm) < WARM_MS);
  const batch = Math.max(1, Math.ceil((CLOCK_MS * calls) / since(warm)));
  const times = [];
  const all = performance.now();
  while (times.length < FEWEST || since(all) < ENOUGH_MS) {
    const start = performance.now();
    for (let i = 0; i < batch; i++) call();
    times.push(since(start) / batch);
  }
  return times;
}

/** The core of the site or of the benchmark, started. */
async function started(folder) {
  const core = await import(`${folder}/armill.js`);
  const { memory } = await core.default();
  return { core, memory };
}

const answers = {
  /** Every stage of a job. */
  async stages(samples) {
    const { core } = await started("./pkg");
    const bench = new core.StageBench(samples);
    return Object.fromEntries(core.StageBench.names().map((name, index) => [name, timed(() => bench.work(index))]));
  },
  async kinematics() {
    const { core } = await started("./pkg");
    const bench = new core.PoseBench();
    return Object.fromEntries(core.PoseBench.names().map((name, index) => [name, timed(() => bench.work(index))]));
  },
  /** A whole job as the page asks for it, in the core of the site: first time, later times [ms], size of the memory after the first. */
  async whole(job) {
    const { core, memory } = await started("../pkg");
    let samples;
    const run = () => {
      const run = core.run(job, () => {});
      samples = run.summary().samples;
      run.free();
    };
    const start = performance.now();
    run();
    const first = performance.now() - start;
    const bytes = memory.buffer.byteLength;
    return { samples, first, bytes, times: timed(run) };
  },
};

addEventListener("message", async ({ data: [kind, ...args] }) => {
  try {
    postMessage({ value: await answers[kind](...args) });
  } catch (error) {
    postMessage({ error: String(error) });
  }
});
