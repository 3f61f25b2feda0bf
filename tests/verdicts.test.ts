// Tests that the two decoders of compact, and their PNG readers, give the same verdicts on the fuzzing corpora and on
// damaged files.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { differencesIn, writeMutants } from "./verdicts.testing.ts";

const repository = join(import.meta.dirname, "..");
const compactVerdicts = join(repository, "build/fuzz/compact_verdicts");
const corpusOfCompact = join(repository, "fuzz/corpus/compact");
const corpora = [corpusOfCompact, join(repository, "fuzz/corpus/png")];

test("both decoders of compact give the same verdict on every file of the corpora", async () => {
  const output = execFileSync(compactVerdicts, corpora, { encoding: "utf8" });
  const { count, differences } = await differencesIn(output);
  assert.deepEqual(differences, []);
  assert.equal(count, corpora.flatMap((folder) => readdirSync(folder)).length);
  const verdicts = output.split("\n").map((line) => line.split("\t")[0] ?? "");
  for (const kind of ["truncated", "malformed", "unsupported", "limit"]) assert.ok(verdicts.includes(kind), kind);
  assert.ok(verdicts.filter((verdict) => /^\d+$/.test(verdict)).length > 20, "most of them decode");
});

/** Number of damaged files; `make soak` sets more. */
const mutantCount = Number(process.env.IMGEO_MUTANTS ?? 1500);

test("both decoders of compact give the same verdict on damaged copies of these files", async () => {
  const directory = mkdtempSync(join(tmpdir(), "imgeo-mutants-"));
  try {
    writeMutants(directory, corpusOfCompact, mutantCount, 1);
    const { count, differences } = await differencesIn(
      execFileSync(compactVerdicts, [directory], { encoding: "utf8" }),
    );
    assert.deepEqual([count, differences], [mutantCount, []]);
  } finally {
    rmSync(directory, { recursive: true });
  }
});
