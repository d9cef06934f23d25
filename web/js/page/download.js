// Hands text to the person as a file.

import { make } from "./dom.js";

let owner = "armill"; // what names of files begin with

/**
 * Begins the names of files with that of the job; with "armill" if it is empty.
 * @param {any} stem
 */
export const nameFilesAfter = (stem) => void (owner = stem || "armill");

/**
 * A file's name, "armill-columns.csv", with the job's in place of "armill".
 * @param {string} name
 */
const ownName = (name) => name.replace(/^armill(?=-)/, () => owner);

/**
 * Saves `text`, a string or a Blob, under `name`; nothing leaves the browser.
 * @param {string} name
 * @param {string} type its media type
 * @param {BlobPart} text
 */
export function download(name, type, text) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: address, download: ownName(name) }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
