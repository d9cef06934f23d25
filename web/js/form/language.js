// The language of a program, which nothing but its text and its name tell.

/** @type {Record<string, string[]>} */
const ENDINGS = {
  apt: ["apt", "aptsource", "cls", "cl", "ncl"],
  csv: ["csv", "txt", "tsv", "xyz"],
  gcode: ["nc", "ngc", "gcode", "g", "tap", "cnc", "mpf", "spf", "eia", "iso"],
};

/**
 * The language of a program by its text; where that does not tell, by the ending of its name.
 * @param {string} name
 * @param {string} text
 */
export function languageOf(name, text) {
  const head = text.slice(0, 20_000);
  if (/^\s*(GOTO|FROM|FEDRAT|PARTNO|UNITS|MULTAX|SPINDL)\b/im.test(head)) return "apt";
  if (/^\s*%|^[^A-FH-LO-Z\n]*[GM]\s*\d/im.test(head.replace(/\([^)]*\)|;.*$/gm, ""))) return "gcode";
  const ending = name.slice(name.lastIndexOf(".") + 1).toLowerCase();
  return Object.keys(ENDINGS).find((language) => ENDINGS[language].includes(ending)) ?? "csv";
}
