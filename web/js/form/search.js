// Finds entries of a list by what is typed: "kr210", "measured", "60 kg".

/**
 * A text in lower case without accents, its words and numbers separated by single spaces.
 * @param {string} text
 */
const plain = (text) =>
  text
    .normalize("NFD")
    .replace(/\p{M}/gu, "")
    .toLowerCase()
    .replace(/(\p{L})(?=\d)|(\d)(?=\p{L})/gu, "$1$2 ")
    .split(/[^\p{L}\d.%±]+/u)
    .filter(Boolean)
    .join(" ");

/**
 * The items whose text has the whole query from the start of a word on; if none has, those that have all of its
 * words. `textOf(item)` is what an item is found by.
 * @template T
 * @param {T[]} items
 * @param {string} query
 * @param {(item: T) => string} textOf
 */
export function found(items, query, textOf) {
  const phrase = plain(query);
  if (!phrase) return items;
  /**
   * @param {T} item
   * @param {string} words
   */
  const has = (item, words) => ` ${plain(textOf(item))}`.includes(` ${words}`);
  const whole = items.filter((item) => has(item, phrase));
  return whole.length ? whole : items.filter((item) => phrase.split(" ").every((word) => has(item, word)));
}
