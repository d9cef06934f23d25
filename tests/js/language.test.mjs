// The language of a program, tried on every program that the site and the tests have.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { test } from "node:test";
import { languageOf, notRead } from "../../web/js/form/language.js";

const here = (path) => new URL(path, import.meta.url);

test("the examples are what their list says, by their text alone", () => {
  for (const { file, kind } of JSON.parse(readFileSync(here("../../web/examples/index.json"), "utf8"))) {
    const text = readFileSync(here(`../../web/examples/${file}`), "utf8");
    assert.equal(languageOf(file, text), kind, file);
    assert.equal(languageOf("noname", text), kind, `${file}, by its text`);
  }
});

test("programs of other makers are G-code", () => {
  const folder = here("../data/gcode/");
  const files = readdirSync(folder).filter((file) => /\.(nc|ngc|gcode|tap)$/i.test(file));
  assert.ok(files.length > 0);
  for (const file of files)
    assert.equal(languageOf("noname", readFileSync(new URL(file, folder), "utf8")), "gcode", file);
});

test("where the text does not tell, the ending does; without either, rows of points", () => {
  assert.equal(languageOf("part.CLS", "$$ nothing yet"), "apt");
  assert.equal(languageOf("part.mpf", ""), "gcode");
  assert.equal(languageOf("part.xyz", ""), "csv");
  assert.equal(languageOf("part", "1, 2, 3\n4, 5, 6"), "csv");
  assert.equal(languageOf("", ""), "csv");
});

test("the text tells more than the ending", () => {
  assert.equal(languageOf("points.csv", "%\nO1000\nG21 G90\nG1 X1 F100"), "gcode");
  assert.equal(languageOf("program.nc", "PARTNO BRACKET\nGOTO/1,2,3"), "apt");
});

test("a word in a comment is no word of a program", () => {
  assert.equal(languageOf("", "; G1 is not used here\n1, 2, 3"), "csv");
});

test("a file of a kind that is not read is refused by its ending, and what is read is said", () => {
  for (const [name, kind] of [
    ["part.STEP", "a drawing or a model"],
    ["bracket.v2.stl", "a drawing or a model"],
    ["pocket.src", "a robot program"],
    ["drawing.pdf", "a document"],
  ]) {
    const why = notRead(name) ?? "";
    assert.ok(why.startsWith(`it is ${kind}.`) && /G-code, APT .* CSV, .* JSON/.test(why), `${name}: ${why}`);
  }
  for (const name of ["step", "src", "program", "part.nc", "part.cls", "points.txt", "bracket.step.nc", ""])
    assert.equal(notRead(name), undefined, name);
});
