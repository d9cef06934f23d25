// Jobs as links. `cargo xtask fuzz link` tries many more that are damaged.

import assert from "node:assert/strict";
import { test } from "node:test";
import { inflateSync } from "node:zlib";
import { fragmentOf, holdsJob, jobIn } from "../../web/js/job/link.js";
import { armill } from "./common.mjs";

const refused = (why) => (error) => error.code === "link" && why.test(error.message);

test("a job survives its link, which zlib reads too", async () => {
  for (const text of ["{}", armill.default_job(), "ä\u{1f600}\u2028", "x".repeat(1_000_000)]) {
    const fragment = await fragmentOf(text);
    assert.match(fragment, /^job=2\.[\w-]+$/, "nothing that a mail program would break");
    assert.equal(await jobIn(fragment), text);
    assert.equal(await jobIn(`#${fragment}`), text, "with or without the sign of a fragment");
    assert.equal(inflateSync(Buffer.from(fragment.slice(6), "base64url")).toString(), text);
  }
});

test("what means to be a job, and what does not", () => {
  for (const fragment of ["#job=2.abc", "job=", "#job=nonsense"]) assert.equal(holdsJob(fragment), true, fragment);
  for (const fragment of ["", "#", "#jobs=2.a", "#tab=cut", "#ajob=2.a"])
    assert.equal(holdsJob(fragment), false, fragment);
});

test("format 1 is read, a later one is not guessed at", async () => {
  const body = (await fragmentOf("{}")).slice("job=2.".length);
  assert.equal(await jobIn(`#job=1.${body}`), "{}");
  await assert.rejects(jobIn(`#job=3.${body}`), refused(/newer Armill \(format 3/));
  await assert.rejects(jobIn(`#job=0.${body}`), refused(/no format 0/));
});

test("each cut of a link, and each changed character, is refused in words", async () => {
  const fragment = await fragmentOf(JSON.stringify({ motion: { feed_mm_s: 100 } }));
  const head = "job=2.".length;
  for (let end = head; end < fragment.length; end++) await assert.rejects(jobIn(fragment.slice(0, end)), refused(/./));
  for (let at = head; at < fragment.length; at++) {
    const other = fragment[at] === "A" ? "B" : "A";
    const changed = fragment.slice(0, at) + other + fragment.slice(at + 1);
    // The last character may carry bits that belong to no byte.
    if (
      at === fragment.length - 1 &&
      Buffer.from(changed.slice(head), "base64url").equals(Buffer.from(fragment.slice(head), "base64url"))
    )
      continue;
    await assert.rejects(jobIn(changed), refused(/./), changed);
  }
});

test("what would unfold to gigabytes is refused while it does", async () => {
  await assert.rejects(jobIn(await fragmentOf(" ".repeat(4_000_001))), refused(/more than 4 MB/));
  assert.equal((await jobIn(await fragmentOf(" ".repeat(4_000_000)))).length, 4_000_000);
});
