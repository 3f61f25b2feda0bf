import assert from "node:assert/strict";
import type { TestContext } from "node:test";
import { test } from "node:test";
import { maxMessages, MessageLog } from "./messageLog.ts";

function recorded(context: TestContext): string[] {
  const lines: string[] = [];
  for (const level of ["warn", "error"] as const)
    context.mock.method(console, level, (line: string) => void lines.push(`${level} ${line}`));
  return lines;
}

test("each message is written once, however many others are between", (context) => {
  const lines = recorded(context);
  const log = new MessageLog();
  for (let repetition = 0; repetition < 2; ++repetition) {
    for (let n = 0; n < 50; ++n) log.warn(`fault ${n}`);
    log.error("failure");
  }
  assert.equal(lines.length, 51);
  assert.deepEqual(lines.slice(-2), ["warn imgeo: fault 49", "error imgeo: failure"]);
});

test("after a thousand different messages one says that further ones are not written", (context) => {
  const lines = recorded(context);
  const log = new MessageLog();
  for (let n = 0; n < maxMessages + 100; ++n) log.error(`failure ${n}`);
  assert.equal(lines.length, maxMessages + 1);
  assert.deepEqual(lines.slice(-2), ["error imgeo: failure 999", "warn imgeo: further messages are not written"]);
});
