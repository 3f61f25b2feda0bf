// The commands of scripts/common.sh that need the network.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { test } from "node:test";

// Runs shell text after common.sh, where `flaky N` fails at its first N calls.
function shell(text: string): { status: number | null; stdout: string; stderr: string } {
  const flaky = `calls=0; flaky() { calls=$((calls + 1)); echo "call $calls"; (( calls > $1 )); }`;
  return spawnSync("bash", ["-c", `. scripts/common.sh; ${flaky}; ${text}`], {
    encoding: "utf8",
    env: { ...process.env, IMGEO_NETWORK_ATTEMPTS: "3", IMGEO_NETWORK_PAUSE: "0" },
  });
}

test("a command that needs the network is repeated until it succeeds", () => {
  const run = shell("withRetries flaky 2; echo done");
  assert.equal(run.stdout, "call 1\ncall 2\ncall 3\ndone\n");
  assert.equal(run.stderr.match(/'flaky 2' failed; attempt \d of 3/g)?.length, 2);
  assert.equal(run.status, 0);
});

test("a command that needs the network and never succeeds ends the script", () => {
  const run = shell("withRetries flaky 9; echo done");
  assert.equal(run.stdout, "call 1\ncall 2\ncall 3\n");
  assert.equal(run.status, 1);
});
