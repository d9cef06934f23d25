// The files of the one-file page: they stand in it as text.

const textOf = (id) => document.getElementById(id).textContent;

/** The text of a file of the site. */
export async function readText(path) {
  const text = JSON.parse(textOf("files"))[path];
  if (text === undefined) throw new Error(`${path} is not in this one-file page.`);
  return text;
}

/** Whether embed.html is beside the page. */
export const EMBEDDABLE = false;

/** One file needs no keeping. */
export const SERVICE_WORKER = undefined;

/** The compiled core. */
export function compileCore() {
  const packed = Uint8Array.from(atob(textOf("core")), (character) => character.charCodeAt(0));
  const wasm = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compileStreaming(new Response(wasm, { headers: { "Content-Type": "application/wasm" } }));
}

/** A new Worker of the core. */
export function startWorker() {
  const url = URL.createObjectURL(new Blob([textOf("worker")], { type: "text/javascript" }));
  return new Worker(url, { name: "armill" });
}
