// Tests that the two decoders of compact, and their PNG readers, give the same verdicts on the fuzzing corpora and on
// damaged files.

import assert from "node:assert/strict";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { differencesIn, verdictLines, writeMutants } from "./verdicts.testing.ts";

const repository = join(import.meta.dirname, "..");
const corpusOfCompact = join(repository, "fuzz/corpus/compact");
const corpora = [corpusOfCompact, join(repository, "fuzz/corpus/png")];

test("both decoders of compact give the same verdict on every file of the corpora", async () => {
  const output = verdictLines(corpora);
  const { count, differences } = await differencesIn(output);
  assert.deepEqual(differences, []);
  assert.equal(count, corpora.flatMap((folder) => readdirSync(folder)).length);
  const verdicts = output.split("\n").map((line) => line.split("\t")[0] ?? "");
  for (const kind of ["truncated", "malformed", "unsupported", "limit"]) assert.ok(verdicts.includes(kind), kind);
  assert.ok(verdicts.filter((verdict) => /^\d+$/.test(verdict)).length > 20, "most of them decode");
});

test("the verdicts of as many files as `make soak` has are read", () => {
  // The names of the same folders, made long, stand for some ten thousand files.
  const folders = corpora.map((folder) => folder + "/.".repeat(1800));
  const output = verdictLines([...folders, ...folders, ...folders]);
  assert.ok(output.length > 1024 * 1024, "more than Node reads from a process unless told");
  assert.ok(output.endsWith("\n"));
});

/** Number of damaged files and seed of their damage; `make soak` sets more, and another one each time. */
const mutantCount = Number(process.env.IMGEO_MUTANTS ?? 1500);
const seed = Number(process.env.IMGEO_RANDOM_SEED ?? 1);

test("both decoders of compact give the same verdict on damaged copies of these files", async () => {
  // Differences are reported with the paths of files, and so with the seed that makes them again.
  const directory = mkdtempSync(join(tmpdir(), `imgeo-mutants-of-seed-${seed}-`));
  try {
    writeMutants(directory, corpusOfCompact, mutantCount, seed);
    const { count, differences } = await differencesIn(verdictLines([directory]));
    assert.deepEqual([count, differences], [mutantCount, []]);
  } finally {
    rmSync(directory, { recursive: true });
  }
});
