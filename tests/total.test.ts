// Tests what ends the log of `make test`: the messages of failed tests and the total.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

function totalOf(reports: Record<string, string>): { status: number | null; stdout: string } {
  const directory = mkdtempSync(join(tmpdir(), "imgeo-total-"));
  try {
    mkdirSync(join(directory, "build"));
    for (const [name, text] of Object.entries(reports)) writeFileSync(join(directory, name), text);
    const { status, stdout } = spawnSync(process.execPath, ["scripts/total.ts", directory], { encoding: "utf8" });
    return { status, stdout };
  } finally {
    rmSync(directory, { recursive: true });
  }
}

const nodeReport = `<testsuites>
  <testcase name="holds" time="1" classname="test"/>
  <testcase name="a &lt; b" time="2" classname="test" failure="3 was 4">
    <failure type="testCodeFailure" message="3 was 4">[Error: 3 was 4]</failure>
  </testcase>
  <!-- pass 1 --><!-- fail 1 --><!-- cancelled 0 --><!-- skipped 0 -->
</testsuites>`;

const ctestReport = `<testsuite>
  <testcase name="image" status="fail"><system-out></system-out></testcase>
  <testcase name="fuzz_png" status="fail"><system-out></system-out></testcase>
</testsuite>`;

const googleTestReport = `<testsuites tests="2" failures="1" disabled="0" errors="0">
  <testsuite name="Png"><testcase name="Reads" status="run" result="completed" time="0" classname="Png" />
  <testcase name="Refuses" status="run" result="completed" time="0" classname="Png">
    <failure message="png_test.cpp:7&#x0A;Expected: true" type=""><![CDATA[png_test.cpp:7]]></failure>
  </testcase></testsuite>
</testsuites>`;

test("the total is preceded by the name and the message of each failed test of every kind", () => {
  const { status, stdout } = totalOf({
    "browser.node": nodeReport,
    "build/ctest.junit": ctestReport,
    "build/image_test.xml": googleTestReport,
  });
  assert.equal(status, 1);
  assert.deepEqual(stdout.trimEnd().split("\n").sort(), [
    "    3 was 4",
    "    Expected: true",
    "    png_test.cpp:7",
    "imgeo: 2 passed, 3 failed",
    "imgeo: failed: Refuses",
    "imgeo: failed: a < b",
    "imgeo: failed: fuzz_png (ctest)",
  ]);
});

test("the total fails where no test has run", () => {
  assert.deepEqual(totalOf({}), { status: 1, stdout: "imgeo: 0 passed, 0 failed\n" });
});
