// <armill-calculator>: Armill in a page of yours. The element only builds an iframe of embed.html, hands its attributes on
// in the fragment (which no server sees) and follows the height that the frame reports.
//
//   job     the job to compute: its JSON text, a link made by Armill, or the address of a .json file
//   preset  changes to the default job by name: a robot, a material, an example program ("al-7075-t6 pocket")
//   inputs  which inputs show: groups and fields ("motion path.radius_mm"), "all" (default) or "none"
//   charts  which charts show: by name or view ("before-after joints", "why"), or "none"; default "before-after"
//   show    what else shows: "scene" (paths and arm in space), "budget" (which joint and source errs how much); default "none"
//   units   of lengths, forces and feeds: "mm" or "inch", "N" or "lbf", "per-second" or "per-minute"; default "mm N per-second"
//   theme   "light", "dark" or "auto" (default)
//   height  in pixels; without it the frame is as high as what it holds
//   title   what assistive tools call the frame
//   src     where embed.html is, if it is not where this script came from

const HANDED_ON = ["preset", "inputs", "charts", "show", "units", "theme"];
const FIRST_HEIGHT = 480; // until the frame reports it
const TALLEST = 20_000; // a frame that asks for more is not ours

export class ArmillCalculator extends HTMLElement {
  static observedAttributes = ["job", ...HANDED_ON, "height", "title", "src"];

  #frame = document.createElement("iframe");
  /** @type {URL | undefined} */
  #url; // what the frame shows
  #shadow = this.attachShadow({ mode: "open" });
  #update = 0; // only the latest one counts

  constructor() {
    super();
    this.#frame.loading = "lazy";
    for (const [name, value] of Object.entries({ display: "block", width: "100%", border: "0" }))
      this.#frame.style.setProperty(name, value);
    this.#tall(FIRST_HEIGHT);
  }

  connectedCallback() {
    if (!this.style.display) this.style.setProperty("display", "block");
    addEventListener("message", this.#follow);
    this.#show();
  }

  disconnectedCallback() {
    removeEventListener("message", this.#follow);
  }

  attributeChangedCallback() {
    if (this.isConnected) this.#show();
  }

  /** Takes the height from our own frame's messages, and nothing from anybody else's. */
  #follow = (/** @type {MessageEvent} */ { source, origin, data }) => {
    if (source !== this.#frame.contentWindow || origin !== this.#url?.origin) return;
    const height = data?.type === "armill-height" ? data.height : undefined;
    if (Number.isFinite(height) && height > 0 && height <= TALLEST && !this.#fixed) this.#tall(Math.ceil(height));
  };

  get #fixed() {
    const height = Number(this.getAttribute("height"));
    return height > 0 ? Math.min(height, TALLEST) : undefined;
  }

  /** @param {number} height [px] */
  #tall(height) {
    this.#frame.style.setProperty("height", `${height}px`);
  }

  async #show() {
    const mine = ++this.#update;
    if (this.#fixed) this.#tall(this.#fixed);
    this.#frame.title = this.getAttribute("title") ?? "Armill calculator";
    const options = new URLSearchParams();
    for (const name of HANDED_ON) if (this.hasAttribute(name)) options.set(name, this.getAttribute(name) ?? "");
    try {
      const job = await jobOf(this.getAttribute("job")?.trim());
      if (mine !== this.#update) return;
      if (job) options.set("job", job);
    } catch ({ message }) {
      if (mine === this.#update) this.#say(`The job of this calculator could not be loaded: ${message}`);
      return;
    }
    this.#url = new URL(this.getAttribute("src") ?? new URL("../embed.html", import.meta.url), document.baseURI);
    this.#url.hash = String(options);
    // Replaced, so that a change of attributes is no step in the reader's history.
    if (this.#frame.isConnected) this.#frame.contentWindow?.location.replace(this.#url);
    else {
      this.#frame.src = this.#url.href;
      this.#shadow.replaceChildren(this.#frame);
    }
  }

  /** @param {string} message */
  #say(message) {
    const text = document.createElement("p");
    text.setAttribute("role", "alert");
    text.textContent = message;
    this.#shadow.replaceChildren(text);
  }
}

/**
 * What the frame takes as a job: JSON text, or what a link's fragment holds.
 * @param {string | undefined} attribute
 */
async function jobOf(attribute) {
  if (!attribute || attribute.startsWith("{")) return attribute;
  const url = new URL(attribute, document.baseURI);
  if (url.hash) {
    const [, job] = /^#job=(.+)$/.exec(url.hash) ?? [];
    if (!job) throw new Error("the link holds none.");
    return job;
  }
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url.href} answers ${answer.status}.`);
  return answer.text();
}

customElements.get("armill-calculator") ?? customElements.define("armill-calculator", ArmillCalculator);
