// Names of jobs, and what follows from them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { fileStem, legal, named, nameOfFile, programName } from "../../web/js/job/name.js";

test("names of files and programs", () => {
  assert.equal(nameOfFile("bracket.nc"), "bracket");
  assert.equal(nameOfFile("part 3.rev2.ngc"), "part 3.rev2");
  assert.equal(nameOfFile(".nc"), ".nc");
  assert.equal(legal("  \t\n "), undefined);
  assert.equal(legal("a\nb"), "a b");
  assert.equal(legal("x".repeat(300)).length, 100);
  assert.equal(fileStem("part 3: a/b"), "part-3-a-b");
  assert.equal(programName("Träger 7"), "TRAGER_7");
  assert.equal(programName("3-achs"), "P3_ACHS");
  assert.equal(programName("支架"), undefined);
  // What every controller takes, whatever the name.
  for (const name of ["a-very-long-name-of-a-part", "__x__", "12345678901234", "é", "9"])
    assert.match(programName(name), /^[A-Z][A-Z0-9_]{0,10}$/, name);
});

test("a program follows its job's name until it has one of its own", () => {
  const job = { version: 1, program: { name: "ARMILL", tool_number: 3 } };
  const bracket = named(job, "bracket");
  assert.deepEqual(bracket, { version: 1, name: "bracket", program: { name: "BRACKET", tool_number: 3 } });
  assert.deepEqual(named(bracket, "plate").program.name, "PLATE");
  assert.deepEqual(named(bracket, undefined), job);
  const own = { ...bracket, program: { name: "MINE" } };
  assert.equal(named(own, "plate").program.name, "MINE");
  assert.deepEqual(named({ version: 1 }, undefined), { version: 1 });
  assert.deepEqual(job, { version: 1, program: { name: "ARMILL", tool_number: 3 } }, "the argument is as it was");
});
