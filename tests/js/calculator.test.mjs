// The states of the result, with a core and a page that only take notes. Time is the test's.

import assert from "node:assert/strict";
import { beforeEach, describe, mock, test } from "node:test";
import { Calculator, STATES } from "../../web/js/calculator.js";
import { one, random } from "./common.mjs";

const TYPING = 150; // the same as in calculator.js [ms]
const SUMMARY = { samples: 1000, duration_s: 10 };

/** A job as far as the calculator knows it: a name, its samples, and what another job is. */
class FakeJob {
  constructor(name, sampleTime = 0.001) {
    [this.name, this.sampleTime] = [name, sampleTime];
  }
  get text() {
    return JSON.stringify({ name: this.name });
  }
  sampledEvery(seconds) {
    return JSON.stringify({ name: this.name, every: seconds });
  }
  of(data) {
    return new FakeJob(data.name);
  }
}

/** A calculator with everything around it; `log` is what the page was asked to show. */
function makeBench() {
  const bench = {
    log: [],
    states: [],
    runs: [],
    cancels: 0,
    job: new FakeJob("a"),
    core: { run: (text) => bench.runs.push(text), cancel: () => (bench.cancels += 1) },
    view: {
      become: (state) => bench.states.push(state),
      say: (text) => (bench.said = text),
      warn: (message, remedy) => ([bench.warning, bench.remedy] = [message, remedy]),
      calm: () => ([bench.warning, bench.remedy] = [undefined, undefined]),
      slow: (on) => (bench.isSlow = on),
      progress: (fraction) => (bench.fraction = fraction),
      show: (shown) => bench.log.push(shown.text),
    },
    form: {
      flawed: false,
      problem: undefined,
      cleared: 0,
      clearErrors: () => (bench.form.cleared += 1),
      showError: (error) => (bench.form.problem = error.field && { message: error.message, go() {} }) !== undefined,
    },
    /** The core answers what it was asked last. */
    answer(text = bench.runs.at(-1), took = 20) {
      bench.calculator.events.onstart();
      bench.calculator.events.onresult({ text, summary: SUMMARY, charts: [] }, took);
    },
    /** The inputs change to another job. */
    edit(name, stepped) {
      bench.job.name = name;
      bench.calculator.edited(stepped);
    },
  };
  bench.calculator = new Calculator(bench.core, bench.view);
  bench.calculator.form = bench.form;
  bench.calculator.open(bench.job);
  return bench;
}

/** The same, with the first result on show. */
function withResult() {
  const bench = makeBench();
  bench.calculator.compute();
  bench.answer();
  return bench;
}

beforeEach((t) => {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
});

const wait = (ms) => mock.timers.tick(ms);

describe("from the first result on", () => {
  test("empty, computing, current", () => {
    const bench = makeBench();
    const { calculator } = bench;
    assert.equal(calculator.state, "empty");
    assert.equal(calculator.shown, null);
    calculator.compute();
    assert.deepEqual(bench.runs, [bench.job.text]);
    calculator.events.onstart();
    assert.equal(calculator.state, "computing");
    assert.equal(calculator.current, false);
    calculator.events.onresult({ text: bench.job.text, summary: SUMMARY, charts: [] }, 1234);
    assert.equal(calculator.state, "current");
    assert.equal(calculator.current, true);
    assert.equal(bench.said, "1000 samples in 1.2 s");
    assert.equal(calculator.shown.job.text, bench.job.text, "the shown result knows its job");
  });

  test("an edit before the first result is computed at once, without waiting for the typing to end", () => {
    const bench = makeBench();
    bench.edit("b");
    assert.deepEqual(bench.runs, [bench.job.text]);
  });

  test("a typed edit is computed once, when the typing rests", () => {
    const bench = withResult();
    for (const name of ["b", "c", "d"]) {
      bench.edit(name);
      assert.equal(bench.calculator.state, "computing");
      wait(TYPING - 1);
    }
    assert.equal(bench.runs.length, 1, "only the first result so far");
    wait(1);
    assert.deepEqual(bench.runs.slice(1), [bench.job.text]);
    bench.answer();
    assert.equal(bench.calculator.state, "current");
  });

  test("an edit while a result is on its way: that result is shown, as one of an earlier edit", () => {
    const bench = withResult();
    bench.edit("b");
    wait(TYPING);
    bench.calculator.events.onstart();
    const earlier = bench.job.text;
    bench.edit("c");
    bench.calculator.events.onresult({ text: earlier, summary: SUMMARY, charts: [] }, 20);
    assert.equal(bench.calculator.shown.text, earlier);
    assert.equal(bench.calculator.state, "computing", "it is not of the inputs as they are");
    assert.equal(bench.calculator.shown.preview, false);
    wait(TYPING);
    bench.answer();
    assert.equal(bench.calculator.state, "current");
    assert.equal(bench.calculator.shown.text, bench.job.text);
  });

  test("undo to the job on show ends as current, with that job", () => {
    const bench = withResult();
    bench.edit("b");
    bench.edit("a");
    assert.equal(bench.calculator.state, "computing");
    wait(TYPING);
    bench.answer();
    assert.equal(bench.calculator.state, "current");
    assert.equal(bench.calculator.shown.job.name, "a");
  });

  test("the job of a shown result stays what it was when the inputs change", () => {
    const bench = withResult();
    bench.edit("b");
    assert.equal(bench.calculator.shown.job.name, "a");
  });
});

describe("a number that is pushed", () => {
  test("a long run follows with fewer samples, and with all of them when it rests", () => {
    const bench = withResult();
    bench.job.sampleTime = 0.0001;
    bench.edit("b", true);
    const preview = bench.runs.at(-1);
    const { every } = JSON.parse(preview);
    assert.ok(every <= 0.01 && every <= SUMMARY.duration_s / 2000 + 1e-12, "as coarse as it may be");
    assert.ok(every / 0.0001 >= 2, "and coarser than the job asks for");
    assert.ok(Math.abs(every / 0.0001 - Math.round(every / 0.0001)) < 1e-9, "every so many of the job's samples");
    bench.answer();
    assert.equal(bench.calculator.state, "preview");
    assert.equal(bench.calculator.shown.preview, true);
    assert.equal(bench.calculator.current, false);
    wait(TYPING);
    assert.equal(bench.runs.at(-1), bench.job.text);
    bench.calculator.events.onstart();
    assert.equal(bench.calculator.state, "preview", "until all samples are there");
    bench.calculator.events.onresult({ text: bench.job.text, summary: SUMMARY, charts: [] }, 20);
    assert.equal(bench.calculator.state, "current");
    assert.equal(bench.calculator.shown.preview, false);
  });

  test("a short run needs no preview", () => {
    const bench = withResult();
    bench.job.sampleTime = SUMMARY.duration_s / 2000;
    bench.edit("b", true);
    assert.equal(bench.runs.at(-1), bench.job.text);
  });

  test("without a result there is nothing to preview", () => {
    const bench = makeBench();
    bench.edit("b", true);
    assert.deepEqual(bench.runs, [bench.job.text]);
  });

  test("the result of an earlier edit is no preview, even if a preview was on show", () => {
    const bench = withResult();
    bench.job.sampleTime = 0.0001;
    bench.edit("b", true);
    bench.answer();
    wait(TYPING);
    bench.calculator.events.onstart();
    const earlier = bench.job.text;
    bench.edit("c");
    bench.calculator.events.onresult({ text: earlier, summary: SUMMARY, charts: [] }, 20);
    assert.equal(bench.calculator.shown.preview, false);
    assert.equal(bench.calculator.state, "computing");
  });
});

describe("inputs that are refused", () => {
  test("a flawed form keeps the last result, ends the run and leads to the field", () => {
    const bench = withResult();
    let went = 0;
    bench.form.flawed = true;
    bench.form.problem = { message: "Feed: not a number.", go: () => (went += 1) };
    bench.calculator.edited();
    assert.equal(bench.calculator.state, "stale");
    assert.equal(bench.cancels, 1);
    assert.equal(bench.calculator.shown.job.name, "a");
    assert.match(bench.said, /last valid result/);
    assert.equal(bench.warning, "Feed: not a number.");
    bench.remedy.go();
    assert.equal(went, 1);
    wait(10 * TYPING);
    assert.equal(bench.runs.length, 1, "nothing more is computed");
  });

  test("mended, it is computed again", () => {
    const bench = withResult();
    bench.form.flawed = true;
    bench.calculator.edited();
    bench.form.flawed = false;
    bench.edit("b");
    assert.equal(bench.warning, undefined);
    wait(TYPING);
    bench.answer();
    assert.equal(bench.calculator.state, "current");
  });

  test("a flawed form without a result still gets one, of the last valid values", () => {
    const bench = makeBench();
    bench.form.flawed = true;
    bench.calculator.edited();
    assert.deepEqual(bench.runs, [bench.job.text]);
    bench.answer();
    assert.equal(bench.calculator.state, "stale", "it is not what the form says");
    assert.equal(bench.calculator.shown.text, bench.job.text);
  });

  test("typing that ends in a flaw is not computed when it rests", () => {
    const bench = withResult();
    bench.edit("b");
    bench.form.flawed = true;
    bench.calculator.edited();
    wait(TYPING);
    assert.equal(bench.runs.length, 1);
  });

  test("an error of the core beside its field", () => {
    const bench = withResult();
    bench.edit("b");
    wait(TYPING);
    bench.calculator.events.onstart();
    bench.calculator.events.onerror({ code: "invalid", field: "motion.feed_mm_s", message: "too fast" });
    assert.equal(bench.calculator.state, "stale");
    assert.equal(bench.warning, "too fast");
    assert.equal(bench.remedy.label, "Show the field");
  });

  test("an error without a field names its line, or has its remedy", () => {
    const bench = withResult();
    bench.calculator.events.onerror({ code: "json", message: "unexpected end", line: 3, column: 7 });
    assert.equal(bench.warning, "unexpected end (line 3, column 7)");
    assert.equal(bench.remedy, undefined);
    const remedy = { label: "Place the path in front of this robot", go() {} };
    bench.view.remedyFor = ({ code }) => (code === "unreachable" ? remedy : undefined);
    bench.calculator.events.onerror({ code: "unreachable", message: "out of reach" });
    assert.equal(bench.remedy, remedy);
    assert.equal(bench.calculator.state, "stale");
  });

  test("an error before the first result says that there is none", () => {
    const bench = makeBench();
    bench.calculator.compute();
    bench.calculator.events.onerror({ code: "json", message: "unexpected end" });
    assert.equal(bench.said, "No result yet.");
  });
});

describe("runs that end otherwise", () => {
  test("cancelled: stopped, and computed again when asked", () => {
    const bench = withResult();
    bench.edit("b");
    wait(TYPING);
    bench.calculator.events.onstart();
    bench.calculator.events.oncancel({ code: "cancelled", message: "Cancelled." });
    assert.equal(bench.calculator.state, "stopped");
    assert.match(bench.said, /^Cancelled\. Showing the last valid result\.$/);
    bench.calculator.compute();
    bench.answer();
    assert.equal(bench.calculator.state, "current");
  });

  test("cancelled because the form is flawed: stale", () => {
    const bench = withResult();
    bench.form.flawed = true;
    bench.calculator.edited();
    bench.calculator.events.oncancel({ code: "cancelled", message: "Cancelled." });
    assert.equal(bench.calculator.state, "stale");
  });

  test("a trap: the inputs stay, and the remedy computes them", () => {
    const bench = withResult();
    bench.calculator.events.ontrap({ code: "trap", message: "unreachable executed", fatal: true });
    assert.equal(bench.calculator.state, "stopped");
    assert.match(bench.warning, /inputs are kept.*unreachable executed/);
    bench.remedy.go();
    assert.equal(bench.runs.at(-1), bench.job.text);
    assert.equal(bench.warning, undefined);
    bench.answer();
    assert.equal(bench.calculator.state, "current");
  });

  test("a core that cannot be loaded is tried again where that can help", () => {
    const bench = makeBench();
    bench.calculator.events.ontrap({ code: "load", message: "the server answers 404", fatal: true });
    assert.equal(bench.calculator.state, "stopped");
    assert.match(bench.warning, /could not be loaded: the server answers 404/);
    assert.equal(bench.remedy.label, "Try again");
    bench.remedy.go();
    assert.deepEqual(bench.runs, [bench.job.text]);

    let again = 0;
    bench.calculator.cannotStart({ code: "load", message: "offline" }, () => (again += 1));
    bench.remedy.go();
    assert.equal(again, 1);

    bench.calculator.cannotStart(new Error("WebAssembly is not defined"));
    assert.equal(bench.remedy, undefined, "no network mends that");
  });
});

describe("a run that takes its time", () => {
  test("shows its progress only then, and not after its end", () => {
    const bench = withResult();
    const { events } = bench.calculator;
    events.onstart();
    assert.equal(bench.fraction, 0);
    events.onprogress({ fraction: 0.2, stage: "deflection" });
    assert.equal(bench.fraction, 0.2);
    assert.equal(bench.isSlow, false, "most runs are over before anybody could read that");
    wait(TYPING);
    assert.equal(bench.isSlow, true);
    assert.equal(bench.said, "Computing…");
    events.onprogress({ fraction: 0.5, stage: "compensation" });
    assert.equal(bench.said, "Computing: compensation");
    bench.answer();
    assert.equal(bench.isSlow, false);
    wait(10 * TYPING);
    assert.equal(bench.isSlow, false);
  });

  for (const [name, end] of [
    ["a result", (bench) => bench.answer()],
    ["an error", ({ calculator }) => calculator.events.onerror({ code: "json", message: "no" })],
    ["a cancellation", ({ calculator }) => calculator.events.oncancel({ code: "cancelled", message: "Cancelled." })],
    ["a trap", ({ calculator }) => calculator.events.ontrap({ code: "trap", message: "trap", fatal: true })],
  ])
    test(`says that nothing is heard of it, unless ${name} comes`, () => {
      const bench = withResult();
      const start = () => {
        bench.calculator.events.onstart();
        bench.calculator.events.onprogress({ fraction: 0.1, stage: "stock" });
      };
      start();
      wait(29_999);
      assert.doesNotMatch(bench.said, /No progress/);
      wait(1);
      assert.match(bench.said, /No progress for 30 s/);
      start();
      end(bench);
      wait(60_000);
      assert.doesNotMatch(bench.said, /No progress/);
    });

  test("each sign of life counts", () => {
    const bench = withResult();
    bench.calculator.events.onstart();
    for (let k = 0; k < 5; k++) {
      bench.calculator.events.onprogress({ fraction: k / 5, stage: "stock" });
      wait(20_000);
      assert.doesNotMatch(bench.said, /No progress/);
    }
  });
});

/** A core as core/client.js is one: a run at a time, and the latest job next. */
class FakeCore {
  running = null;
  next = null;
  run(text) {
    if (this.running === null) this.#start(text);
    else this.next = text;
  }
  cancel() {
    this.next = null;
    if (this.running === null) return;
    this.running = null;
    this.events.oncancel({ code: "cancelled", message: "Cancelled." });
  }
  /** The run in progress ends in some way. */
  end(how) {
    const text = this.running;
    if (text === null) return;
    this.running = null;
    if (how === "result") this.events.onresult({ text, summary: SUMMARY, charts: [] }, 20);
    else if (how === "trap") this.events.ontrap({ code: "trap", message: "trap", fatal: true });
    else if (this.next === null) this.events.onerror({ code: "invalid", message: "refused" });
    const { next } = this;
    this.next = null;
    if (next !== null && this.running === null) this.#start(next);
  }
  #start(text) {
    this.running = text;
    this.events.onstart();
  }
}

test("whatever happens in whatever order, the state says what is shown", () => {
  for (let seed = 0; seed < 2000; seed++) {
    mock.timers.reset();
    mock.timers.enable({ apis: ["setTimeout"] });
    const next = random(seed);
    const bench = makeBench();
    const core = new FakeCore();
    const calculator = new Calculator(core, bench.view);
    core.events = calculator.events;
    calculator.form = bench.form;
    calculator.open(bench.job);
    bench.job.sampleTime = one(next, [0.0001, 0.01]);
    const done = [];
    const acts = {
      type: () => ((bench.job.name = one(next, ["a", "b", "c"])), calculator.edited()),
      push: () => ((bench.job.name = one(next, ["a", "b", "c"])), calculator.edited(true)),
      flaw: () => ((bench.form.flawed = true), calculator.edited()),
      mend: () => ((bench.form.flawed = false), calculator.edited()),
      compute: () => calculator.compute(),
      cancel: () => core.cancel(),
      result: () => core.end("result"),
      refusal: () => core.end("refusal"),
      trap: () => core.end("trap"),
      wait: () => wait(one(next, [1, 100, 200])),
    };
    const check = () => {
      const { state, shown } = calculator;
      const story = `seed ${seed}: ${done.join(", ")}: ${state}`;
      assert.ok(STATES.includes(state), story);
      assert.equal(bench.states.at(-1) ?? "empty", state, story);
      if (state === "current") {
        assert.equal(shown.text, bench.job.text, story);
        assert.equal(bench.form.flawed, false, story);
      }
      if (state === "preview") assert.equal(shown.preview, true, story);
      if (state === "empty") assert.equal(shown, null, story);
      if (bench.form.flawed) assert.notEqual(state, "current", story);
      assert.equal(bench.log.at(-1), shown?.text, `${story}: what is shown was handed to the page`);
    };
    for (let k = 0; k < 40; k++) {
      const act = one(next, Object.keys(acts));
      done.push(act);
      acts[act]();
      check();
    }
    // Left alone, with an edit that is sound, all ends well.
    acts.mend();
    for (let k = 0; k < 4; k++) {
      wait(1000);
      core.end("result");
    }
    done.push("rest");
    check();
    assert.equal(calculator.state, "current", `seed ${seed}: ${done.join(", ")}`);
  }
});
