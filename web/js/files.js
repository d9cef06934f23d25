// The files that this page has beside it. The one-file page has its own version of this module and finds them inside itself.

const urlOf = (path) => new URL(`../${path}`, import.meta.url);

/** The text of a file of the site. */
export async function readText(path) {
  const answer = await fetch(urlOf(path)).catch(({ message }) => {
    throw new Error(`${path} could not be loaded (${message}).`); // without a network
  });
  if (!answer.ok) throw new Error(`${path} could not be loaded (${answer.status}).`);
  return answer.text();
}

/** The core that a Worker starts with: it has all that the first result needs. */
export const FIRST_CORE = "small";

/** Whether embed.html is beside the page. */
export const EMBEDDABLE = true;

/** A compiled core, `small` or `full`. */
export async function compileCore(name) {
  const load = () => fetch(urlOf(`pkg/${name}/armill_bg.wasm`));
  // Hosts that do not know the file's type get it compiled after loading instead of meanwhile.
  return WebAssembly.compileStreaming(load()).catch(async () => WebAssembly.compile(await (await load()).arrayBuffer()));
}

/** A new Worker of the core. */
export const startWorker = () => new Worker(urlOf("js/worker.js"), { type: "module", name: "armill" });
