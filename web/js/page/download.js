// Hands text to the person as a file.

import { make } from "./dom.js";

/** Saves `text`, a string or a Blob, under `name`; nothing leaves the browser. */
export function download(name, type, text) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
