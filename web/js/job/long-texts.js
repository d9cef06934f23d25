// Long texts, kept in this browser's database: its storage holds some five million characters, a
// program may have fifty.
//
// A text is put down once; what is kept of the inputs then only names it.

const MOST = 8; // texts, of all tabs: older ones are thrown away
const LONG = 200_000; // characters
/** @type {Map<string, number | null>} */
const keys = new Map(); // text -> its key; null if the database does not take it

/** @param {unknown} value */
const isLong = (value) => typeof value === "string" && value.length > LONG;

/**
 * Stores the long texts in plain data that are not stored yet; resolves when they are, or cannot be.
 * @param {object} data
 */
export async function putDown(data) {
  for (const text of textsIn(data)) {
    if (keys.has(text)) continue;
    keys.set(text, await add(text).catch(() => null));
    if (keys.size > MOST) keys.delete([...keys.keys()][0]);
  }
}

/**
 * Whether every long text in plain data lies in the database, or is known not to be taken.
 * @param {object} data
 */
export const isDown = (data) => textsIn(data).every((text) => keys.has(text));

/**
 * Plain data as JSON text, with the keys of its long texts in their place where they lie in the
 * database.
 * @param {object} data
 */
export const named = (data) =>
  JSON.stringify(data, (_, value) => (isLong(value) && keys.get(value) ? { shelf: keys.get(value) } : value));

/**
 * Plain data with its long texts again; one that is gone is empty.
 * @param {any} data
 * @returns {Promise<any>}
 */
export async function pickUp(data) {
  if (typeof data !== "object" || data === null) return data;
  if (typeof data.shelf === "number") {
    const text = (await ask("readonly", (texts) => texts.get(data.shelf)).catch(() => undefined)) ?? "";
    if (isLong(text)) keys.set(text, data.shelf);
    return text;
  }
  if (Array.isArray(data)) return data; // numbers
  return Object.fromEntries(
    await Promise.all(Object.entries(data).map(async ([key, value]) => [key, await pickUp(value)])),
  );
}

/**
 * @param {any} data
 * @returns {string[]}
 */
function textsIn(data) {
  if (isLong(data)) return [data];
  return typeof data === "object" && data !== null && !Array.isArray(data) ? Object.values(data).flatMap(textsIn) : [];
}

/**
 * @param {string} text
 * @returns {Promise<number>}
 */
async function add(text) {
  const key = await ask("readwrite", (texts) => texts.add(text));
  await ask("readwrite", (texts) => texts.delete(IDBKeyRange.upperBound(key - MOST)));
  return key;
}

/**
 * The answer to one request on the texts; rejects where the database is denied or full.
 * @param {IDBTransactionMode} mode
 * @param {(texts: IDBObjectStore) => IDBRequest} request
 */
async function ask(mode, request) {
  const database = await done(
    Object.assign(indexedDB.open("armill"), {
      onupgradeneeded: (/** @type {any} */ { target }) =>
        target.result.createObjectStore("texts", { autoIncrement: true }),
    }),
  );
  try {
    return await done(request(database.transaction("texts", mode).objectStore("texts")));
  } finally {
    database.close();
  }
}

/**
 * @template T
 * @param {IDBRequest<T>} request
 * @returns {Promise<T>}
 */
const done = (request) =>
  new Promise((resolve, reject) =>
    Object.assign(request, { onsuccess: () => resolve(request.result), onerror: () => reject(request.error) }),
  );
