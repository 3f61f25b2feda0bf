import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { TransferWindow } from "./transferWindow.ts";

/** A window after two seconds on a line with this rate and latency. */
function windowOn(bytesPerMs: number, latencyMs: number): TransferWindow {
  const window = new TransferWindow();
  window.onHeaders(latencyMs);
  for (let now = 0; now <= 2000; now += 10) window.onBytes(10 * bytesPerMs, now);
  return window;
}

describe("the transfer window", () => {
  test("covers a round trip at the line's rate, with a margin, and never less than a slow line needs", () => {
    const smallest = new TransferWindow().byteLength;
    assert.equal(windowOn(625, 40).byteLength, smallest, "5 Mbit/s, 40 ms: 25 kB are on their way");
    const far = windowOn(12_500, 200).byteLength;
    assert.ok(far >= 2_500_000 && far < 5_000_000, `100 Mbit/s, 200 ms: ${far}`);
    const near = windowOn(12_500, 1).byteLength;
    assert.ok(near < far / 2 && near >= 1_000_000, `100 Mbit/s, 1 ms: tasks of the page delay requests, too: ${near}`);
  });

  test("is at first what the line is assumed to carry, and then what it carries", () => {
    const window = new TransferWindow();
    window.assume(500_000);
    assert.equal(window.byteLength, 500_000);
    window.onHeaders(40);
    for (let now = 0; now <= 1000; now += 10) window.onBytes(6250, now);
    assert.equal(window.byteLength, new TransferWindow().byteLength);
  });

  test("does not count pauses as slowness", () => {
    const window = windowOn(12_500, 40);
    const before = window.byteLength;
    window.onBytes(125_000, 12_000);
    assert.equal(window.byteLength, before);
  });

  test("follows a line that becomes slower", () => {
    const window = windowOn(12_500, 40);
    for (let now = 2010; now < 6000; now += 10) window.onBytes(6250, now);
    assert.ok(window.byteLength < windowOn(12_500, 40).byteLength);
  });
});
