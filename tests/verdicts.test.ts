// The two decoders of compact, and their readers of PNG, say the same of every file
// that the C++ ones are fuzzed with.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { differencesIn } from "./verdicts.testing.ts";

const repository = join(import.meta.dirname, "..");
const corpora = ["fuzz/corpus/compact", "fuzz/corpus/png"].map((folder) => join(repository, folder));

test("both decoders of compact say the same of every file of the corpora", async () => {
  const output = execFileSync(join(repository, "build/fuzz/compact_verdicts"), corpora, { encoding: "utf8" });
  const { count, differences } = await differencesIn(output);
  assert.deepEqual(differences, []);
  assert.equal(count, corpora.flatMap((folder) => readdirSync(folder)).length);
  const verdicts = output.split("\n").map((line) => line.split("\t")[0] ?? "");
  for (const kind of ["truncated", "malformed", "unsupported", "limit"]) assert.ok(verdicts.includes(kind), kind);
  assert.ok(verdicts.filter((verdict) => /^\d+$/.test(verdict)).length > 20, "most of them decode");
});
