// What must hold for any link, however damaged: it gives a job's text or an error in words, never anything else. Run by `cargo xtask fuzz link`.
//
// Links come from tests/fuzz/corpus/link/, changed by a seeded generator: characters, the bytes that they stand for, and the text that
// those unfold to. A link that breaks a law is printed, for the corpus.   node tests/fuzz/link.mjs <seconds> <seed>

import { readFileSync, readdirSync } from "node:fs";
import { constants, deflateSync } from "node:zlib";
import { fragmentOf, holdsJob, jobIn } from "../../web/js/job/link.js";

const [seconds, seed] = process.argv.slice(2).map(Number);
const here = (path) => new URL(path, import.meta.url);

const LARGEST = 4_000_000; // bytes, as link.js says
const CHARACTERS = "ABCXYZabcxyz0129-_=+/.#% \n\u00e4\u{1f600}\0";
const TEXTS = ["", "{}", '{"version":1}', "\u00e4\u{1f600}\u2028", "[[[[[[", "a".repeat(70_000), "\ufeff{}"];

let state = seed >>> 0;
/** A whole number below `limit`: mulberry32, by Tommy Ettinger. */
function random(limit) {
  state = (state + 0x6d2b79f5) >>> 0;
  let t = Math.imul(state ^ (state >>> 15), state | 1);
  t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
  return ((t ^ (t >>> 14)) >>> 0) % limit;
}
const one = (list) => list[random(list.length)];

const corpus = readdirSync(here("corpus/link/"))
  .sort()
  .map((name) => readFileSync(here(`corpus/link/${name}`), "utf8"));

const bytesOf = (link) => Buffer.from(link.replace(/^[^.]*\./, ""), "base64url");
const linkOf = (bytes) => `job=${1 + random(2)}.${Buffer.from(bytes).toString("base64url")}`;

function changed(bytes) {
  const copy = Buffer.from(bytes);
  const at = random(copy.length + 1);
  switch (random(5)) {
    case 0:
      if (at < copy.length) copy[at] ^= 1 << random(8);
      return copy;
    case 1:
      return copy.subarray(0, at);
    case 2:
      return Buffer.concat([copy.subarray(0, at), Buffer.from([random(256)]), copy.subarray(at)]);
    case 3:
      return Buffer.concat([copy, copy.subarray(at)]);
    default:
      return Buffer.concat([copy.subarray(0, at), copy.subarray(Math.min(copy.length, at + 1 + random(8)))]);
  }
}

/** A link made from another one, and the text that it must give, if that is known. */
function next() {
  const link = one(corpus);
  switch (random(4)) {
    case 0: {
      const at = random(link.length + 1);
      return { link: link.slice(0, at) + one([...CHARACTERS]) + link.slice(at + random(3)) };
    }
    case 1:
      return { link: linkOf(changed(bytesOf(link))) };
    case 2: {
      // Whole, at every level of compression.
      const text =
        one(TEXTS) + String.fromCodePoint(32 + random(0xd000)).repeat(random(60) ? random(50) : random(1 << 21));
      const bytes = Buffer.from(text);
      return { link: linkOf(deflateSync(bytes, { level: random(10) })), text: bytes.length > LARGEST ? null : text };
    }
    default: {
      // Whole or cut, of bytes that are no text.
      const bytes = Buffer.from(Array.from({ length: random(200) }, () => random(256)));
      return { link: linkOf(deflateSync(bytes, random(2) ? {} : { finishFlush: constants.Z_SYNC_FLUSH })) };
    }
  }
}

async function check({ link, text }) {
  const fragment = random(2) ? `#${link}` : link;
  let given;
  try {
    given = await jobIn(fragment);
  } catch (error) {
    const { code, message } = error;
    if (code !== "link" || !/^The link could not be opened: .{10,200}\.$/s.test(message)) throw error;
    if (typeof text === "string") throw new Error(`a sound link was refused: ${message}`);
    return "refused";
  }
  if (typeof given !== "string" || !holdsJob(fragment)) throw new Error("it gave something that is no job");
  if (text === null || Buffer.byteLength(given) > LARGEST) throw new Error("it gave more than is allowed");
  // A byte order mark is no part of a text.
  if (text !== undefined && given !== text.replace(/^\ufeff/, "")) throw new Error("it gave another text");
  const again = await jobIn(await fragmentOf(given));
  if (again !== given.replace(/^\ufeff/, "")) throw new Error("the text does not survive a link of its own");
  return "opened";
}

let tried; // what an error outside of any promise is about
const fail = (error) => {
  console.error(
    `${JSON.stringify(tried.link.slice(0, 4000))} (${tried.link.length} characters) breaks a law: ${error?.message ?? error}`,
  );
  process.exit(1);
};
process.on("unhandledRejection", fail);
process.on("uncaughtException", fail);

const counts = { opened: 0, refused: 0 };
const end = performance.now() + seconds * 1000;
for (let k = 0; k < corpus.length || performance.now() < end; k++) {
  tried = k < corpus.length ? { link: corpus[k] } : next();
  try {
    counts[await check(tried)] += 1;
  } catch (error) {
    fail(error);
  }
}
await new Promise((resolve) => setTimeout(resolve, 50)); // for rejections that come late
if (!counts.opened || !counts.refused) fail(new Error("links of both kinds must have been tried"));
console.log(`${counts.opened + counts.refused} links: ${counts.opened} opened, ${counts.refused} refused in words`);
