// The files that this page has beside it. The one-file page has its own version of this module and
// finds them inside itself.

/** @param {string} path */
const urlOf = (path) => new URL(path, document.baseURI);

/**
 * The text of a file of the site.
 * @param {string} path
 */
export async function readText(path) {
  const answer = await fetch(urlOf(path)).catch(({ message }) => {
    throw new Error(`${path} could not be loaded (${message}).`); // without a network
  });
  if (!answer.ok) throw new Error(`${path} could not be loaded (${answer.status}).`);
  return answer.text();
}

/** Whether embed.html is beside the page. */
export const EMBEDDABLE = true;

/** The script that keeps the site in the browser; a worker serves the folder that it is in. */
export const SERVICE_WORKER = "service-worker.js";

/** The core, fetched and compiled. */
export async function compileCore() {
  const answer = await fetch(urlOf("pkg/armill_bg.wasm"));
  if (!answer.ok) throw new Error(`the server answered ${answer.status}`);
  // Hosts that do not know the file's type get it compiled after loading instead of meanwhile.
  const typed = answer.headers.get("Content-Type") === "application/wasm";
  return typed ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

/** A new Worker of the core. */
export const startWorker = () => new Worker(urlOf("js/worker.js"), { type: "module", name: "armill" });
