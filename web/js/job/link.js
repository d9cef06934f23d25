// A job as a link: the whole of it in the fragment, which a browser keeps to itself, as
// `#job=2.<compressed JSON>`. In format 1, which is read too, jobs named no model.
//
// The compression is zlib's ("deflate"), because its checksum tells a damaged link from a whole
// one; base64url has no character that a mail program would break a link at.

/** @import { JobData } from "./data.js" */

const FORMAT = 2;
const LARGEST = 4_000_000; // bytes of JSON: what unfolds to more is refused, for a few kB can be made to unfold to gigabytes

/**
 * Characters of the longest link that the page offers. Browsers take far more; mail and chat programs
 * cut or refuse it.
 */
export const LONGEST_LINK = 8000;

/**
 * Whether a fragment means to be a job.
 * @param {string} fragment
 */
export const holdsJob = (fragment) => /^#?job=/.test(fragment);

/**
 * The job that a fragment names: `#example=thesis` or `#example=bracket`, of the jobs that the core
 * brings, { job, opening }; undefined for another fragment.
 * @param {string} fragment
 * @param {{ job: JobData, opening: JobData }} core
 * @returns {JobData | undefined}
 */
export function exampleIn(fragment, { job: thesis, opening: bracket }) {
  const [, name] = /^#?example=(\w+)/.exec(fragment) ?? [];
  return name === "thesis" ? thesis : name === "bracket" ? bracket : undefined;
}

/**
 * The fragment, without "#", that stands for the JSON text of a job.
 * @param {string} json
 */
export async function fragmentOf(json) {
  const bytes = await read(through(new CompressionStream("deflate"), new TextEncoder().encode(json)));
  return `job=${FORMAT}.${toBase64(bytes)}`;
}

/**
 * The JSON text of the job in a fragment. Rejects with `{ code: "link", message }` if there is none
 * to be had.
 * @param {string} fragment
 */
export async function jobIn(fragment) {
  const [, format, body] = /^#?job=(\d+)\.([\w-]*)(?:&view=[\w-]*)?(?:&ask=[^&]*)?$/.exec(fragment) ?? [];
  if (format === undefined) throw broken("it is not of the form #job=2.… with letters, digits, - and _ only");
  if (Number(format) > FORMAT)
    throw broken(`it was made by a newer Armill (format ${format}; this one reads formats up to ${FORMAT})`);
  if (Number(format) < 1) throw broken(`there is no format ${format}`);
  let bytes;
  try {
    bytes = await read(through(new DecompressionStream("deflate"), fromBase64(body)), LARGEST);
  } catch (error) {
    throw error?.code === "link" ? error : broken("it is cut off or damaged");
  }
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    throw broken("what it holds is not text");
  }
}

/** @param {string} why */
const broken = (why) => ({ code: "link", message: `The link could not be opened: ${why}.` });

/**
 * @param {CompressionStream | DecompressionStream} transform
 * @param {Uint8Array<ArrayBuffer>} bytes
 */
const through = (transform, bytes) => new Blob([bytes]).stream().pipeThrough(transform);

/**
 * All bytes of a stream; refuses more than `most` as soon as they come.
 * @param {ReadableStream<Uint8Array<ArrayBuffer>>} stream
 * @param {number} [most]
 */
async function read(stream, most = Infinity) {
  const reader = stream.getReader();
  const parts = [];
  let size = 0;
  for (let { value } = await reader.read(); value; { value } = await reader.read()) {
    size += value.length;
    if (size > most) {
      reader.cancel().catch(() => {});
      throw broken(`it expands to more than ${most / 1e6} MB`);
    }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** @param {Uint8Array} bytes */
const toBase64 = (bytes) =>
  btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replace(/=+$/, "");

/** @param {string} text */
const fromBase64 = (text) =>
  Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (character) => character.charCodeAt(0));
