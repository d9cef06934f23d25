// Runs that a Worker keeps beside the shown one, each under an id: the pinned results. They share one
// Worker, and with it one memory, which never shrinks: what does not fit is computed again when it is
// asked for.

const MOST = 150_000; // samples in memory at a time, unless a single run has more

/**
 * Answers about held runs; `core()` is the core.
 * @param {any} core
 */
export function heldRuns(core) {
  const held = new Map(); // id -> { json, run, samples }, what was used last at the end

  /** @param {string} id */
  function runOf(id) {
    const one = held.get(id);
    held.delete(id);
    held.set(id, one);
    if (one.run) return one.run;
    if (one.samples) makeRoom(one.samples);
    one.run = core().run(one.json);
    one.samples = one.run.summary().samples;
    makeRoom(0);
    return one.run;
  }

  /**
   * Lets go of runs, those not used for longest first, until `more` samples fit beside the rest.
   * @param {any} more
   */
  function makeRoom(more) {
    const kept = [...held.values()].filter(({ run }) => run);
    let samples = kept.reduce((sum, one) => sum + one.samples, more);
    for (const one of more ? kept : kept.slice(0, -1)) {
      if (samples <= MOST) return;
      samples -= one.samples;
      one.run.free();
      one.run = null;
    }
  }

  /** @param {string} id */
  function drop(id) {
    held.get(id)?.run?.free();
    held.delete(id);
  }

  return {
    /**
     * @param {string} id
     * @param {string} json
     */
    hold(id, json) {
      drop(id);
      held.set(id, { json, run: null, samples: 0 });
      return runOf(id).summary();
    },
    drop,
    held_chart: (
      /** @type {string} */ id,
      /** @type {string} */ name,
      /** @type {import("../../pkg/armill.js").ChartOptions} */ options,
    ) => runOf(id).chart(name, options),
  };
}
