// The dialog that shares the shown result: as a link, as Markdown, as a frame to embed. Nothing
// is sent anywhere.

import { byId, make } from "../page/dom.js";
import { download } from "../page/download.js";
import { EMBEDDABLE } from "../core/assets.js";
import { fragmentOf, LONGEST_LINK } from "../job/link.js";
import { markdown } from "./markdown.js";
import { formatNumber } from "../page/number.js";

/**
 * @import { Summary } from "../../pkg/armill.js"
 * @import { JobData } from "../job/data.js"
 * @import { Job } from "../job/job.js"
 */

/** @typedef {{ text: string, job: Job, standard: JobData, summary: Summary }} Shared */

/** @type {Record<string, { title: string, note: string }>} */
const FORMS = {
  link: {
    title: "Link",
    note: "The whole job is in the link itself. Anyone who opens it gets the same result; nothing is stored on a server.",
  },
  markdown: {
    title: "Markdown",
    note: "For a report or a message: verdict, figures, inputs that differ from the default, and the link.",
  },
  ...(EMBEDDABLE && { embed: { title: "Embed", note: "For a page of your own: a frame that shows this job." } }),
};

/**
 * Makes the dialog; the function it returns opens it for a result.
 * @returns {(shown: Shared) => Promise<void>}
 */
export function shareDialog() {
  const text = make("textarea", {
    id: "share-text",
    readOnly: true,
    rows: 7,
    spellcheck: false,
    "aria-label": "Text to copy",
  });
  const note = make("p", { className: "note", id: "share-note" });
  const said = make("p", { className: "said", role: "status" });
  const copy = make("button", { type: "button", className: "primary", id: "share-copy" }, "Copy");
  const file = make(
    "button",
    { type: "button", className: "primary", id: "share-file" },
    "Save job ",
    make("span", { className: "unit" }, "JSON"),
  );
  const close = make("button", { type: "button", id: "share-close" }, "Close");
  const forms = Object.entries(FORMS).map(([value, { title }]) => {
    const input = make("input", {
      type: "radio",
      name: "share-form",
      id: `share-${value}`,
      value,
      checked: value === "link",
    });
    input.addEventListener("change", () => show(value));
    return make("label", { className: "choice" }, input, make("span", {}, title));
  });
  const choice = make(
    "fieldset",
    { className: "choices" },
    make("legend", { className: "hidden-text" }, "Share as"),
    ...forms,
  );
  const dialog = make(
    "dialog",
    { id: "share-dialog", "aria-labelledby": "share-title" },
    make("h2", { id: "share-title" }, "Share this result"),
    choice,
    text,
    note,
    make("footer", {}, said, copy, file, close),
  );
  document.body.append(dialog);

  /** @type {Shared} */
  let given; // what is shared
  /** @type {string | null} */
  let link; // its address, or null if that is too long
  /** @type {number} */
  let length; // of the address

  /** @param {string} form */
  function show(form) {
    const lost = link === null && form !== "markdown";
    text.hidden = copy.hidden = lost;
    file.hidden = link !== null;
    said.textContent = "";
    note.textContent = link === null ? `${lost ? "" : "Without a link: "}${tooLong(length)}` : FORMS[form].note;
    text.value = textAs(form);
    text.select();
  }

  /** @param {string} form */
  function textAs(form) {
    if (form === "markdown") return markdown({ ...given, link });
    if (link === null) return "";
    return form === "embed" ? frame(link) : link;
  }

  copy.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text.value);
      said.textContent = "Copied.";
    } catch {
      text.focus();
      text.select();
      said.textContent =
        "This browser does not allow the page to copy. The text is selected: copy it with Ctrl+C or ⌘C.";
    }
  });
  file.addEventListener("click", () => download("armill-job.json", "application/json", `${given.text}\n`));
  close.addEventListener("click", () => dialog.close());

  return async (shown) => {
    given = shown;
    const address = new URL(
      `#${await fragmentOf(JSON.stringify(JSON.parse(shown.text)))}`,
      location.href.replace(/#.*/, ""),
    ).href;
    length = address.length;
    link = length > LONGEST_LINK ? null : address;
    byId("share-link").checked = true;
    dialog.showModal();
    show("link");
  };
}

/** @param {number} length */
const tooLong = (length) =>
  `The link would have ${formatNumber(length)} characters. Mail and chat programs cut links above ` +
  `${formatNumber(LONGEST_LINK)}, so send the job as a file instead; “Open job…” reads it.`;

/**
 * The frame that shows the job of a link.
 * @param {string} link
 */
function frame(link) {
  const { hash } = new URL(link);
  return `<iframe src="${new URL(`embed.html${hash}`, link).href}" title="Armill" width="100%" height="640" loading="lazy"></iframe>`;
}
