import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { isLineSlow, measuredBitsPerSecond } from "./lineRate.ts";

/** The timing of a transfer of so many bytes and milliseconds. */
const transfer = (bytes: number, ms: number, { begin = 1000, isCached = false } = {}) =>
  ({
    transferSize: isCached ? 0 : bytes + 300,
    encodedBodySize: bytes,
    responseStart: begin,
    responseEnd: begin + ms,
  }) as PerformanceResourceTiming;

describe("the rate of the line", () => {
  test("is that of the fastest transfer", () => {
    const later = { begin: 2000 };
    assert.equal(measuredBitsPerSecond([transfer(50_000, 100), transfer(100_000, 100, later)]), 8e6);
  });
  test("is that of all transfers that share the line", () => {
    const transfers = [
      transfer(60_000, 60, { begin: 1030 }),
      transfer(50_000, 50),
      transfer(90_000, 70, { begin: 1040 }),
      transfer(10_000, 100, { begin: 1110 }),
    ];
    assert.equal(measuredBitsPerSecond(transfers), (8000 * 200_000) / 110);
  });
  test("counts what arrives within a millisecond as if it took one, and nothing that ends before it begins", () => {
    assert.equal(measuredBitsPerSecond([transfer(50_000, 0)]), 4e8);
    assert.equal(measuredBitsPerSecond([transfer(50_000, -400)]), undefined);
  });
  test("is unknown where all comes from the cache, or is small", () => {
    assert.equal(measuredBitsPerSecond([]), undefined);
    assert.equal(measuredBitsPerSecond([transfer(100_000, 1, { isCached: true }), transfer(2000, 1)]), undefined);
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
