// Keeps the site in the browser, so that it works without a network once it was visited.
//
// Every file is of one version: it is stored only if it has the hash that the build wrote here, and is
// served from the store of this version alone. A new version waits until no tab shows the old one.

import { FILES, VERSION } from "./core/release.js";

/**
 * @typedef {{ waitUntil(done: Promise<unknown>): void }} Lifetime
 * @typedef {Lifetime & { request: Request, respondWith(answer: Promise<Response>): void }} Fetch
 * @typedef {Lifetime & { data: unknown, source: { postMessage(answer: string): void } }} Message
 * @typedef {object} Worker what a service worker has that a page has not
 * @property {{ scope: string }} registration
 * @property {{ matchAll(which: { includeUncontrolled: boolean }): Promise<{ url: string }[]> }} clients
 * @property {() => Promise<void>} skipWaiting
 * @property {(kind: string, act: (event: any) => void) => void} addEventListener
 */
const worker = /** @type {Worker} */ (/** @type {unknown} */ (self));

const SCOPE = worker.registration.scope;
const OURS = `armill ${SCOPE} `; // another Armill may be on the same origin
const STORE = OURS + VERSION;

/**
 * The file of the site that an address means, whatever its query; undefined for any other address.
 * @param {string} address
 */
function fileAt(address) {
  const { origin, pathname } = new URL(address);
  const scope = new URL(SCOPE);
  if (origin !== scope.origin || !pathname.startsWith(scope.pathname)) return undefined;
  const path = pathname.slice(scope.pathname.length) || "index.html";
  return Object.hasOwn(FILES, path) ? path : undefined;
}

/**
 * A file of this version from the network; rejects if what the server has is another one.
 * @param {string} path
 */
async function fetched(path) {
  const answer = await fetch(SCOPE + path, { cache: "no-cache", integrity: FILES[path] });
  if (!answer.ok) throw new Error(`${path}: the server answered ${answer.status}`);
  // Some hosts redirect index.html to the folder; a page must not be opened with a redirected answer.
  const { headers, status } = answer;
  return answer.redirected ? new Response(await answer.blob(), { headers, status }) : answer;
}

async function store() {
  const cache = await caches.open(STORE);
  await Promise.all(Object.keys(FILES).map(async (path) => cache.put(path, await fetched(path))));
}

async function removeOlder() {
  const names = await caches.keys();
  await Promise.all(names.filter((name) => name.startsWith(OURS) && name !== STORE).map((name) => caches.delete(name)));
}

/** @param {string} path */
async function served(path) {
  const cache = await caches.open(STORE);
  return (await cache.match(path)) ?? fetched(path);
}

/**
 * Takes over at once if only the page that asks is open: any other would get files of two versions.
 * @param {Message} event
 */
async function takeOver({ source }) {
  const open = await worker.clients.matchAll({ includeUncontrolled: true });
  if (open.filter(({ url }) => fileAt(url)).length > 1) source.postMessage("others-open");
  else await worker.skipWaiting();
}

worker.addEventListener("install", (/** @type {Lifetime} */ event) => event.waitUntil(store()));
worker.addEventListener("activate", (/** @type {Lifetime} */ event) => event.waitUntil(removeOlder()));
worker.addEventListener("message", (/** @type {Message} */ event) => {
  if (event.data === "take-over") event.waitUntil(takeOver(event));
});
worker.addEventListener("fetch", (/** @type {Fetch} */ event) => {
  const path = event.request.method === "GET" ? fileAt(event.request.url) : undefined;
  if (path) event.respondWith(served(path));
});
