import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { isLineSlow, measuredBitsPerSecond } from "./lineRate.ts";

/** The timing of a transfer of so many bytes and milliseconds. */
const transfer = (bytes: number, ms: number, isCached = false) =>
  ({
    transferSize: isCached ? 0 : bytes + 300,
    encodedBodySize: bytes,
    responseStart: 1000,
    responseEnd: 1000 + ms,
  }) as PerformanceResourceTiming;

describe("the rate of the line", () => {
  test("is that of the fastest transfer", () => {
    assert.equal(measuredBitsPerSecond([transfer(50_000, 100), transfer(100_000, 100)]), 8e6);
  });
  test("is unknown where all comes from the cache, or is small", () => {
    assert.equal(measuredBitsPerSecond([]), undefined);
    assert.equal(measuredBitsPerSecond([transfer(100_000, 1, true), transfer(2000, 1)]), undefined);
  });

  for (const [ms, isSlow] of [
    [50, false],
    [160, true],
  ] as const)
    test(`is ${isSlow ? "slow" : "fast"} where 100 kB take ${ms} ms`, (context) => {
      context.mock.method(performance, "getEntriesByType", () => [transfer(100_000, ms)]);
      assert.equal(isLineSlow(), isSlow);
    });

  test("is not slow as long as it is unknown", (context) => {
    context.mock.method(performance, "getEntriesByType", () => []);
    assert.equal(isLineSlow(), false);
  });
});
