// The pinned result's own Worker: it computes the job again when a chart first asks for its curves,
// or after a reload.

import { helper } from "../core/client.js";

export class Pinned {
  #json;
  #worker;
  #run;

  constructor(json) {
    this.#json = json;
  }

  /** Its figures, as the core gives them with a result. */
  summary() {
    this.#worker ??= helper();
    this.#run ??= this.#worker.ask("run", this.#json);
    return this.#run.then(({ summary }) => summary);
  }

  async chart(name, options) {
    await this.summary();
    return this.#worker.ask("chart", name, options);
  }

  async chartData(name, units) {
    await this.summary();
    return this.#worker.ask("data", name, units);
  }

  stop() {
    this.#worker?.stop({ code: "cancelled", message: "Cancelled." });
  }
}
