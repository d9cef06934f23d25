// What a measured pass teaches: the next pass's commands, and factors on stiffness and cutting force.

import { readText } from "../core/assets.js";
import { numberCell } from "../form/number-cell.js";
import { make, sentence } from "../page/dom.js";
import { download } from "../page/download.js";
import { formatNumber } from "../page/number.js";
import { notify } from "../page/toast.js";
import { lengthText, lengthUnit } from "../page/units.js";
import { Source } from "./input.js";
import { factorTable } from "./factors.js";
import { Outcome, remarks } from "./result.js";

/**
 * @import { LearnSummary } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Ask, Present } from "./panel.js"
 */

const EXAMPLE = "learn-pass";
const COMMANDED = { corrected: "the program as corrected", desired: "the path as drawn" };
const FRAMES = { "": "as it fits", workpiece: "workpiece", base: "robot’s base", world: "controller’s world" };

/** What adds a correction to the running desired program. */
const INTERFACES = { "kuka-rsi": "KUKA RSI", "abb-egm": "ABB EGM" };

/** @param {{ ask: Ask } & Present} page */
export function makePass({ ask, job, use }) {
  /** @type {JobData | null} */
  let example = null; // the job of the example, as long as it is looked at instead of one's own
  /** @type {{ name: string, text: string } | null} */
  let earlier = null; // what earlier passes taught
  const commanded = choice("learn-commanded", COMMANDED);
  const frame = choice("learn-frame", FRAMES);
  const cells = {
    shift: optional("learn-shift", "s", "found"),
    corner: optional("learn-corner", "Hz", "by the noise"),
    gain: optional("learn-gain", "", "0.7"),
  };
  const file = make("input", { type: "file", id: "learn-earlier", hidden: true, "aria-label": "Learned before: file" });
  const open = make("button", { type: "button" }, "Learned before…");
  open.addEventListener("click", () => file.click());
  file.addEventListener("change", async () => {
    const [chosen] = file.files ?? [];
    file.value = "";
    if (chosen) earlier = { name: chosen.name, text: await chosen.text() };
    look();
  });
  const whose = make("p", { className: "whose" });
  const source = new Source({
    id: "learn-log",
    label: "Log of a measured pass",
    placeholder: "time_s, x_mm, y_mm, z_mm\n0.00, 599.93, -149.98, 99.96\n0.02, 599.94, -149.98, 99.95\n…",
    exampleName: "Example: a simulated log",
    changed: () => look(),
    example: exampleSoon,
    more: [open, file],
  });
  const outcome = new Outcome({
    ask,
    kind: "pass",
    source,
    chart: { name: "learned", title: "Measured error over the expected one" },
    show,
  });
  for (const input of [commanded, frame, ...Object.values(cells).map(({ input }) => input)])
    input.addEventListener("change", () => look());

  function look() {
    whose.replaceChildren(...context());
    /** @type {(number | undefined)[]} */
    let [shift, corner, gain] = [];
    try {
      [shift, corner, gain] = Object.values(cells).map((cell) => cell.read());
    } catch ({ message }) {
      return source.fail({ message });
    }
    const text = JSON.stringify(example ?? job());
    const frameName = frame.value || undefined;
    outcome.compute(text, commanded.value, earlier?.text, frameName, shift, corner, gain);
  }

  /** What the log is laid over, and what was learned before. */
  function context() {
    const own = quiet("Use the page’s job instead", () => ((example = null), look()));
    const forget = quiet("Forget them", () => {
      const { learned, ...rest } = job();
      use(rest);
      notify("The job no longer has the factors of a measured pass. Undo brings them back.");
      look();
    });
    const without = quiet("Leave it out", () => ((earlier = null), look()));
    return [
      ...(example ? ["The log is laid over the example’s job. ", own] : ["The log is laid over the page’s job. "]),
      ...(!example && job().learned ? [" It has factors from an earlier pass. ", forget] : []),
      ...(earlier ? [` The pass ran with what ${earlier.name} had taught. `, without] : []),
    ];
  }

  function exampleSoon() {
    showExample().catch((error) => source.fail(error));
  }

  async function showExample() {
    example = JSON.parse(await readText(`examples/${EXAMPLE}.json`));
    await source.read(`${EXAMPLE}.csv`);
    look();
  }

  /** @param {LearnSummary} found */
  function take(found) {
    const before = example ?? job();
    use({ ...before, learned: { ...found.factors.learned } });
    notify("The job has these factors, and the band that is left of them. Undo removes them.");
  }

  /**
   * @param {"correction" | "command_csv" | "package_zip" | "interface_zip"} kind
   * @param {string} name
   * @param {string} type
   * @param {string[]} which
   */
  async function save(kind, name, type, ...which) {
    try {
      download(name, type, await ask("learned_file", kind, ...which));
    } catch (error) {
      source.fail(error);
    }
  }

  /** @param {LearnSummary} found */
  function show(found) {
    const { next, factors, log } = found;
    const factorsButton = make(
      "button",
      { type: "button", className: "primary", id: "use-factors" },
      example ? "Use this job with these factors" : "Use these factors in the job",
    );
    factorsButton.addEventListener("click", () => take(found));
    /**
     * @param {string} id
     * @param {string} text
     * @param {() => void} act
     */
    const button = (id, text, act) => {
      const node = make("button", { type: "button", id }, text);
      node.addEventListener("click", act);
      return node;
    };
    const nextPass = next && [
      make("h3", {}, "The next pass"),
      make(
        "p",
        { className: "found" },
        `Measured: up to ${lengthText(next.measured_mm.max)} ${lengthUnit()}, ${lengthText(next.measured_mm.mean)} on average. ` +
          `If that comes back, the next pass leaves up to ${lengthText(next.expected_mm.max)}, ` +
          `${lengthText(next.expected_mm.mean)} on average.`,
      ),
      make(
        "div",
        { className: "identify-tools" },
        button("learn-package", "Program of the next pass (zip)", () =>
          save("package_zip", "armill-next-pass.zip", "application/zip"),
        ),
        button("learn-command", "Its commands (CSV)", () => save("command_csv", "armill-next-pass.csv", "text/csv")),
        button("learn-save", "What was learned (JSON)", () =>
          save("correction", "armill-learned.json", "application/json"),
        ),
        ...Object.entries(INTERFACES).map(([id, name]) =>
          button(`learn-${id}`, `For ${name} (zip, untested)`, () =>
            save("interface_zip", `armill-next-pass-${id}.zip`, "application/zip", id),
          ),
        ),
      ),
      make(
        "p",
        { className: "note" },
        `Gain ${formatNumber(next.gain)}: of what a correction can reach, ${formatNumber(100 * Math.abs(1 - next.gain), 2)} % ` +
          `is left after each pass. It converges where a correction moves the tip by less than ` +
          `${formatNumber(next.converges_below, 2)} times as much as is commanded. The commands change by up to ` +
          `${lengthText(next.largest_change_mm)} ${lengthUnit()}.`,
      ),
    ];
    return [
      make("p", { className: "note" }, [readAs(log), ...log.recognised.map((text) => `${sentence(text)}.`)].join(" ")),
      ...remarks(log.remarks.map(sentence)),
      ...(nextPass || []),
      make("h3", {}, "Arm and cut"),
      factorTable(factors.factors),
      ...remarks(found.unexplained),
      make("div", { className: "identify-tools" }, factorsButton),
      make("p", { className: "note" }, `By ${factors.estimator}.`),
    ];
  }

  return {
    node: make(
      "section",
      { className: "identify", "aria-labelledby": "learn-pass" },
      make("h2", { id: "learn-pass" }, "What a measured pass teaches"),
      make(
        "p",
        { className: "lead" },
        "Run the job once and log where the tip was, the force, the joint angles at motor and gear, or probe the part. " +
          "One row per instant or point; the first line names the columns: time_s or s_mm, x_mm y_mm z_mm (with nx ny nz " +
          "of a probed part), dx_mm dy_mm dz_mm, fx_n fy_n fz_n, q1_deg to q6_deg with load1_deg to load6_deg.",
      ),
      source.node,
      make(
        "div",
        { className: "identify-tools" },
        make("label", { htmlFor: "learn-commanded" }, "What ran ", commanded),
        make("label", { htmlFor: "learn-frame" }, "Measured in the frame of the ", frame),
        ...[
          { name: "Run begins after", cell: cells.shift },
          { name: "Low pass", cell: cells.corner },
          { name: "Gain", cell: cells.gain },
        ].map(({ name, cell: { input, unit } }) =>
          make("label", { htmlFor: input.id }, `${name} `, make("span", { className: "unit" }, unit), " ", input),
        ),
      ),
      whose,
      outcome.node,
    ),
    look,
    example: exampleSoon,
  };
}

/**
 * Where the log lies, in a sentence.
 * @param {LearnSummary["log"]} log
 */
function readAs({ shift_s, shift_mm, distance_mm, correlation, corner_hz, noise_mm, covered_percent }) {
  const shift =
    shift_s !== undefined
      ? `The run begins ${formatNumber(shift_s, 3)} s after the first row`
      : shift_mm !== undefined
        ? `The path begins ${lengthText(shift_mm)} ${lengthUnit()} after the first row`
        : "Points are filed where the path is closest";
  const fit =
    distance_mm !== undefined
      ? `; positions lie ${lengthText(distance_mm)} ${lengthUnit()} from where they are expected, root mean square`
      : correlation !== undefined
        ? `; correlation with what is expected ${formatNumber(correlation, 2)}`
        : "";
  return (
    `${shift}${fit}. ${formatNumber(covered_percent, 3)} % of the run was measured, noise ` +
    `${lengthText(noise_mm)} ${lengthUnit()}, low pass ${formatNumber(corner_hz)} Hz.`
  );
}

/**
 * @param {string} id
 * @param {Record<string, string>} words
 */
const choice = (id, words) =>
  make("select", { id }, ...Object.entries(words).map(([value, name]) => make("option", { value }, name)));

/**
 * A number that may be left out.
 * @param {string} id
 * @param {string} unit
 * @param {string} otherwise
 */
function optional(id, unit, otherwise) {
  const cell = numberCell(id, unit);
  cell.input.placeholder = otherwise;
  return {
    input: cell.input,
    unit,
    read() {
      cell.input.removeAttribute("aria-invalid");
      if (!cell.input.value.trim()) return undefined;
      try {
        return cell.read();
      } catch (error) {
        cell.input.setAttribute("aria-invalid", "true");
        throw error;
      }
    },
  };
}

/**
 * @param {string} text
 * @param {() => void} act
 */
function quiet(text, act) {
  const button = make("button", { type: "button", className: "quiet" }, text);
  button.addEventListener("click", act);
  return button;
}
