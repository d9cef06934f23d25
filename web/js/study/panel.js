// The part of the view "What if" where questions about the job are asked and answered.

import { merged } from "../job/data.js";
import { fragmentOf, LONGEST_LINK } from "../job/link.js";
import { announce } from "../page/announce.js";
import { debounced, make } from "../page/dom.js";
import { download } from "../page/download.js";
import { onSetting } from "../page/settings.js";
import { answer } from "./ask.js";
import { listed, tableCsv, tableMarkdown } from "./columns.js";
import { makeCurve } from "./curve.js";
import { makePicture } from "./picture.js";
import { pictureOf } from "./pictures.js";
import { makeFields } from "./fields.js";
import { askedIn, written } from "./question.js";
import { answerTable, cannot } from "./table.js";
import { isAlike, ranked, rounded, sentenceOf, titleOf } from "./words.js";

/**
 * @import { Field } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Job } from "../job/job.js"
 * @import { Answer } from "./ask.js"
 * @import { Question } from "./question.js"
 */

/** @typedef {{ question: Question, answer: Answer, text: string, fields: Field[] }} Answered `text` is the job's */

const CALM_MS = 500;

/**
 * Fills `node`; `job()` is the page's job, `use(job)` takes over another one, `fields()` lists every input of a job.
 * @param {HTMLElement} node
 * @param {{ job(): Job, use(job: JobData): void, fields(): Field[] }} page
 */
export function makeStudy(node, { job, use, fields: all }) {
  /** @type {AbortController | null} */
  let running = null;
  /** @type {Answered | null} */
  let shown = null;
  const edited = debounced(() => ask(), CALM_MS);
  const fields = makeFields({ ask: () => ask(), changed: edited });
  const button = (/** @type {string} */ id, /** @type {string} */ text, /** @type {() => void} */ go) => {
    const made = make("button", { type: "button", id, className: "quiet" }, text);
    made.addEventListener("click", go);
    return made;
  };
  const again = button("study-again", "Ask again", () => ask());
  const cancel = button("study-cancel", "Cancel", () => running?.abort());
  const bar = make("progress", { id: "study-progress", max: 1, value: 0 });
  const status = make("p", { id: "study-status", role: "status" });
  const said = make("p", { id: "study-answer", className: "found" });
  const act = make("div", { className: "study-act" });
  const curve = makeCurve();
  const picture = makePicture();
  const table = make("div");
  const tools = make(
    "div",
    { className: "study-tools", hidden: true },
    button("study-link", "Copy link", () => copy(linkOf)),
    button("study-markdown", "Copy Markdown", () => copy(markdownOf)),
    button("study-csv", "Save CSV", saveCsv),
  );
  node.replaceChildren(
    fields.node,
    make("div", { className: "study-actions" }, again, cancel, bar),
    status,
    said,
    act,
    curve.node,
    picture.node,
    table,
    tools,
  );
  become(false);
  again.hidden = true;

  /** @param {boolean} busy */
  function become(busy) {
    cancel.hidden = bar.hidden = !busy;
    again.hidden = busy || !shown;
    if (busy) bar.value = 0;
  }

  /**
   * Asks what the inputs say, or what is `given`; what is being answered is superseded.
   * @param {Question} [given]
   */
  async function ask(given) {
    running?.abort();
    running = null;
    become(false);
    /** @type {Question | undefined} */
    let question;
    try {
      question = given ?? fields.read();
    } catch ({ message }) {
      return void (status.textContent = message);
    }
    if (!question) return;
    const mine = (running = new AbortController());
    const text = job().text;
    become(true);
    status.textContent = "Computing…";
    const began = performance.now();
    try {
      const found = await answer(question, text, (fraction) => (bar.value = fraction), mine.signal);
      if (mine !== running) return;
      shown = { question, answer: found, text, fields: fieldsOf(question) };
      status.textContent = `Answered in ${((performance.now() - began) / 1000).toFixed(1)} s.`;
      show();
      announce("study", said.textContent ?? "");
    } catch (error) {
      if (mine !== running) return;
      status.textContent = error.code === "cancelled" ? "Cancelled." : `No answer: ${error.message}`;
    }
    running = null;
    become(false);
  }

  /** @param {Question} question */
  function fieldsOf(question) {
    const paths =
      question.kind === "largest"
        ? [question.path]
        : question.kind === "sweep"
          ? question.ranges.map(({ path }) => path)
          : [];
    return paths.map((path) => /** @type {Field} */ (all().find((field) => field.path === path)));
  }

  function show() {
    if (!shown) return;
    const { question, answer: found, text, fields: about } = shown;
    const asked = job().of(JSON.parse(text));
    said.textContent = sentenceOf(question, found, about);
    said.dataset.value = String(found.largest?.largest ?? "");
    const one = about.length === 1 && about[0].kind !== "choice" ? about[0] : undefined;
    const tolerance = asked.data.compensation.tolerance_mm;
    curve.show(one ? (found.rows ?? []) : [], one, one && { now: asked.get(one), tolerance });
    picture.show(pictureOf(question, found, about, { tolerance, valueAt: (field) => asked.get(field) }));
    act.replaceChildren(...actions());
    const given = listed(question, found, about);
    const best = ranked(/** @type {any[]} */ (found.robots ?? found.choices ?? []))[0];
    table.replaceChildren(
      answerTable(titleOf(question, about), given, {
        sort: best && { key: "p95", falling: false },
        marks: (row) => markOf(row, best),
        act: found.robots || found.choices ? (row) => useButton(row) : undefined,
      }),
    );
    tools.hidden = false;
  }

  /** What can be done with the answer as a whole. */
  function actions() {
    if (!shown?.answer.largest?.largest) return [];
    const { path } = shown.answer.largest;
    const [field] = shown.fields;
    const value = floored(shown.answer.largest.largest);
    return [
      button("study-use", "Use this value", () => {
        const next = job().of(structuredClone(job().data));
        next.set(field, value);
        use(next.data);
        status.textContent = `${field.label} is set; undo brings the former value back.`;
      }),
    ].map((made) => Object.assign(made, { title: path }));
  }

  /** @param {any} row */
  function useButton(row) {
    if (row.error || row.choice === "as-is") return undefined;
    const made = make("button", { type: "button", className: "quiet" }, "Use it");
    made.setAttribute("aria-label", `Use it: ${row.name ?? row.label}`);
    made.addEventListener("click", () => {
      const patch = row.patch ?? {
        robot: { preset: row.id },
        workpiece_frame: { xyz_mm: row.workpiece_mm },
        spin: { angle_deg: row.spin_deg },
      };
      use(patched(job().data, patch, Boolean(row.id)));
      status.textContent = "The job has it now; undo brings the former one back.";
    });
    return made;
  }

  const linkOf = async () => {
    const { question, text } = /** @type {Answered} */ (shown);
    const fragment = await fragmentOf(JSON.stringify(JSON.parse(text)));
    const link = new URL(`#${fragment}&view=compare&ask=${encodeURIComponent(written(question))}`, location.href).href;
    return link.length > LONGEST_LINK ? "" : link;
  };
  const markdownOf = async () => {
    const { question, answer: found, fields: about } = /** @type {Answered} */ (shown);
    const link = await linkOf();
    return [
      `**${titleOf(question, about)}**`,
      said.textContent,
      tableMarkdown(listed(question, found, about)),
      ...(link ? [`[Open in Armill](${link})`] : []),
    ].join("\n\n");
  };

  /** @param {() => Promise<string>} make */
  async function copy(make) {
    const text = await make();
    if (!text) return void (status.textContent = "The job is too long for a link. Save it as a file instead.");
    try {
      await navigator.clipboard.writeText(text);
      status.textContent = "Copied.";
    } catch {
      status.textContent = "This browser does not allow the page to copy.";
    }
  }

  function saveCsv() {
    if (!shown) return;
    const { question, answer: found, fields: about } = shown;
    download(`armill-${question.kind}.csv`, "text/csv", tableCsv(listed(question, found, about)));
  }

  onSetting((key) => {
    if (key === "theme") return;
    fields.relabel();
    show();
  });

  return {
    /** Offers the numbers of the job, and says when an answer is of other inputs. */
    look() {
      fields.offer(job(), all());
      if (shown && !running && shown.text !== job().text)
        status.textContent = "The inputs have changed since this was answered.";
    },
    /**
     * Asks for the largest value of a number.
     * @param {string} path
     */
    limit(path) {
      fields.offer(job(), all());
      fields.limit(path);
      node.scrollIntoView({ block: "start" });
      ask();
    },
    /** Asks what the address asks. */
    open() {
      const question = askedIn(location.hash);
      if (!question) return;
      fields.offer(job(), all());
      fields.take(question);
      ask(question);
    },
  };
}

/**
 * The class of a row beside the best one.
 * @param {any} row
 * @param {any} best
 */
function markOf(row, best) {
  if (row === best) return "best";
  if (cannot(row)) return "cannot";
  return best && isAlike(row, best) ? "alike" : "";
}

/**
 * Four digits, on the side that still meets the tolerance.
 * @param {number} value
 */
function floored(value) {
  const near = rounded(value);
  return near <= value ? near : rounded(value - 0.5 * 10 ** (Math.floor(Math.log10(Math.abs(value))) - 3));
}

/**
 * A job with a change: of another robot none of the former's numbers stay.
 * @param {JobData} data
 * @param {any} patch
 * @param {boolean} isRobot
 */
function patched(data, patch, isRobot) {
  const next = merged(data, patch);
  if (isRobot) next.robot = patch.robot;
  return next;
}
