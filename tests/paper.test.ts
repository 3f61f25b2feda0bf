// Every row of docs/paper.md names code that exists, and a test that exists or a decision.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

const root = join(import.meta.dirname, "..");
const page = readFileSync(join(root, "docs/paper.md"), "utf8");

/** Whether a file of tests has the test: in C++ `Suite.Name`, in TypeScript a sentence. */
function hasTest(file: string, name: string): boolean {
  const source = readFileSync(join(root, file), "utf8");
  const [, suite, subject] = /^(\w+)\.(\w+)$/.exec(name) ?? [];
  if (!file.endsWith("_test.cpp")) return source.includes(name);
  return suite !== undefined && new RegExp(`^(SOAK_)?TEST(_F|_P)?\\(${suite}, ${subject}\\)`, "m").test(source);
}

/** The faults of one row; empty if there are none. */
function faultsOf(row: string): string[] {
  const [, section = "", element = "", code = "", held = "", ...rest] = row.split("|").map((cell) => cell.trim());
  if (rest.length !== 1 || !/^[1-8]/.test(section)) return [`not a row: ${row}`];
  const faults: string[] = [];
  const files = Array.from(code.matchAll(/`([^`]+)`/g), ([, path = ""]) => path);
  if (files.length === 0) faults.push("names no code");
  faults.push(...files.filter((path) => !existsSync(join(root, path))).map((path) => `${path} does not exist`));
  const tests = Array.from(held.matchAll(/`([^`]+)` "([^"]+)"/g), ([, path = "", name = ""]) => ({ path, name }));
  const decisions = Array.from(held.matchAll(/\]\(((?:decisions\/)?[\w-]+\.md)\)/g), ([, path = ""]) => path);
  if (tests.length + decisions.length === 0) faults.push("names neither a test nor a decision");
  for (const { path, name } of tests)
    if (!existsSync(join(root, path)) || !hasTest(path, name)) faults.push(`${path} has no test "${name}"`);
  for (const path of decisions) if (!existsSync(join(root, "docs", path))) faults.push(`${path} does not exist`);
  if (/partial|partly/i.test(row)) faults.push("says partial");
  return faults.map((fault) => `${section} ${element}: ${fault}`);
}

test("every element of the paper names its code, and its test or its decision, all of which exist", () => {
  const rows = page.split("\n").filter((line) => line.startsWith("| ") && !line.startsWith("| § "));
  assert.ok(rows.length > 50, "the rows were not found");
  assert.deepEqual(rows.flatMap(faultsOf), []);
});

test("the check of a row finds missing files and tests, and rows without either", () => {
  const row = (code: string, held: string): string => `| 5.1 | x | ${code} | ${held} |`;
  const here = "`tests/paper.test.ts`";
  const lattice = "`src/prepare/lattice_test.cpp`";
  assert.deepEqual(faultsOf(row(here, `${here} "finds missing files and tests"`)), []);
  assert.deepEqual(faultsOf(row(here, `${lattice} "Lattice.SpansTheLongestEdge"`)), []);
  assert.deepEqual(faultsOf(row(here, "[normals](decisions/normals.md)")), []);
  for (const wrong of [
    row("`src/none.cpp`", "[normals](decisions/normals.md)"),
    row("none", "[normals](decisions/normals.md)"),
    row(here, "soon"),
    row(here, `${lattice} "Lattice.IsAbsent"`),
    row(here, `${lattice} "Lattice"`),
    row(here, "[normals](decisions/none.md)"),
    row(here, "partly: [normals](decisions/normals.md)"),
  ])
    assert.equal(faultsOf(wrong).length, 1, wrong);
});
