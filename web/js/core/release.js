// What the site holds. The build writes these two into the service worker, see `xtask/src/site/offline.rs`.

/** Names this version of the site: a hash of all of its files. */
export const VERSION = "";

/**
 * The SHA-256 of each file, as fetch() checks it, by the file's path in the site.
 * @type {Record<string, string>}
 */
export const FILES = {};
