// The name of a job, and the names that follow from it: of files, of the robot's program.

const LONGEST = 100; // characters, as the core takes them
const LONGEST_PROGRAM = 11; // Stäubli's 15 less the numbers of a split program; other controllers take more
const UNNAMED = "ARMILL"; // what programs are called unless the job says

/**
 * The name of a job whose program is opened from a file: "bracket.nc" is "bracket". Undefined if nothing is left of it.
 * @param {string} file
 */
export function nameOfFile(file) {
  const stem = file.replace(/\.[^.]*$/, "") || file;
  return legal(stem);
}

/**
 * What is typed as the name of a job, as the core takes it; undefined for none.
 * @param {string} text
 */
export const legal = (text) =>
  text
    .replace(/\p{Cc}/gu, " ")
    .trim()
    .slice(0, LONGEST) || undefined;

/**
 * The first part of file names: without what file systems refuse, and without blanks.
 * @param {string} name
 */
export const fileStem = (name) =>
  name
    .replace(/[\s\\/:*?"<>|]+/g, "-")
    .replace(/^[-.]+|[-.]+$/g, "")
    .slice(0, 60);

/**
 * A name that every controller takes: letters, digits and underscores, a letter first. Undefined if none is left.
 * @param {string} name
 */
export function programName(name) {
  const letters = name
    .normalize("NFD")
    .replace(/\p{M}/gu, "")
    .toUpperCase()
    .replace(/[^A-Z0-9]+/g, "_")
    .replace(/^_+/, "");
  const begun = /^\d/.test(letters) ? `P${letters}` : letters;
  return begun.slice(0, LONGEST_PROGRAM).replace(/_+$/, "") || undefined;
}

/**
 * A job, a plain object, with another name or none. Its program takes the name too, unless it has one of its own.
 * @param {import("./data.js").JobData} data
 * @param {string} [name]
 */
export function named(data, name) {
  const { name: before, ...rest } = data;
  const own = data.program?.name ?? UNNAMED;
  const follows = own === UNNAMED || (before !== undefined && own === programName(before));
  const program = (name && programName(name)) ?? UNNAMED;
  return {
    ...rest,
    ...(name !== undefined && { name }),
    ...(follows && own !== program && { program: { ...data.program, name: program } }),
  };
}
