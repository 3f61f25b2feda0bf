// Adds up the reports that scripts/test collected and prints "N passed, N failed", after the messages of failed tests:
// where only the end of a log is kept, they are in it. A C++ program without a GoogleTest report (a fuzz replay, or a
// crash) counts as one test with ctest's result.

import { existsSync, readFileSync, readdirSync } from "node:fs";
import { basename, dirname, join } from "node:path";

const directory = process.argv[2];
if (directory === undefined) throw new Error("usage: total.ts DIRECTORY");

let passed = 0;
let failed = 0;
let skipped = 0;
let leftToSoak = 0;
const failures: string[] = [];

const number = (text: string, pattern: RegExp): number => Number(pattern.exec(text)?.[1] ?? 0);
const count = (text: string, pattern: RegExp): number => [...text.matchAll(pattern)].length;

const entities: Record<string, string> = { lt: "<", gt: ">", quot: '"', apos: "'", amp: "&", "#x0A": "\n" };
const plain = (xml: string): string => xml.replace(/&([^;]+);/g, (whole, name: string) => entities[name] ?? whole);

/** Adds the names of failed cases, each with the first lines of its message. */
function addFailures(text: string): void {
  for (const [, name, content] of text.matchAll(/<testcase name="([^"]*)"[^>]*[^/]>(.*?)<\/testcase>/gs)) {
    const message = /<failure[^>]*message="([^"]*)"/.exec(content!)?.[1];
    if (message === undefined) continue;
    const lines = plain(message).split("\n").slice(0, 12);
    failures.push([plain(name!), ...lines].join("\n    ").slice(0, 1200));
  }
}

/** Adds the totals that node --test writes as comments. */
function addNodeReport(text: string): void {
  addFailures(text);
  passed += number(text, /<!-- pass (\d+) -->/);
  failed += number(text, /<!-- fail (\d+) -->/) + number(text, /<!-- cancelled (\d+) -->/);
  skipped += number(text, /<!-- skipped (\d+) -->/);
}

/** Adds the cases of one program; true if it reported a failure. */
function addGoogleTestReport(text: string): boolean {
  addFailures(text);
  const cases = count(text, /<testcase /g);
  const failuresOfProgram =
    number(text, /<testsuites [^>]*failures="(\d+)"/) + number(text, /<testsuites [^>]*errors="(\d+)"/);
  const skips = count(text, /result="skipped"/g);
  const disabled = count(text, /status="notrun"/g);
  passed += cases - failuresOfProgram - skips - disabled;
  failed += failuresOfProgram;
  skipped += skips;
  leftToSoak += disabled;
  return failuresOfProgram > 0;
}

function addCtestReport(file: string): void {
  const text = readFileSync(file, "utf8");
  for (const [, name, status] of text.matchAll(/<testcase name="([^"]*)"[^>]*status="([^"]*)"/g)) {
    const report = join(dirname(file), `${name}_test.xml`);
    const isRun = existsSync(report);
    const isFailureCounted = isRun && addGoogleTestReport(readFileSync(report, "utf8"));
    if (status === "run") passed += isRun ? 0 : 1;
    else if (!isFailureCounted) {
      failed += 1;
      failures.push(`${name!} (ctest)`);
    }
  }
}

for (const name of readdirSync(directory, { recursive: true, encoding: "utf8" })) {
  const file = join(directory, name);
  if (basename(name) === "ctest.junit") addCtestReport(file);
  if (name.endsWith(".node")) addNodeReport(readFileSync(file, "utf8"));
}

for (const failure of failures) console.log(`imgeo: failed: ${failure}`);
const others = [skipped > 0 ? `, ${skipped} skipped` : "", leftToSoak > 0 ? `, ${leftToSoak} of C++ left to soak` : ""];
console.log(`imgeo: ${passed} passed, ${failed} failed${others.join("")}`);
if (passed === 0 || failed > 0) process.exitCode = 1;
