// The language of a program, which nothing but its text and its name tell.

/** @type {Record<string, string[]>} */
const ENDINGS = {
  apt: ["apt", "aptsource", "cls", "cl", "ncl"],
  csv: ["csv", "txt", "tsv", "xyz"],
  gcode: ["nc", "ngc", "gcode", "g", "tap", "cnc", "mpf", "spf", "eia", "iso"],
};

/** @type {Record<string, string[]>} kinds of files that come with programs and are none that are read */
const FOREIGN = {
  "a drawing or a model": ["step", "stp", "stl", "igs", "iges", "dxf", "dwg", "3mf", "obj", "svg"],
  "a robot program": ["src", "mod", "modx", "pgf", "ls", "jbi", "script", "urp", "pgx"],
  "a document": ["pdf", "doc", "docx", "xls", "xlsx", "htm", "html", "xml"],
};
const READ = "Armill reads G-code, APT and CL files, points as CSV, and its own jobs as JSON.";

/**
 * Why a file of this name is not read; undefined if it may be.
 * @param {string} name
 */
export function notRead(name) {
  const ending = name.slice(name.lastIndexOf(".") + 1).toLowerCase();
  const kind = Object.keys(FOREIGN).find((each) => name.includes(".") && FOREIGN[each].includes(ending));
  return kind && `it is ${kind}. ${READ}`;
}

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
