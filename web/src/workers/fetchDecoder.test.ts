import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { fetchDecoder, measuredBitsPerSecond } from "./fetchDecoder.ts";

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
});

describe("the module", () => {
  const workerUrl = new URL("https://a.test/worker.js");
  const moduleUrl = new URL("https://a.test/decoder.wasm");
  const bytes = Uint8Array.of(0, 97, 115, 109);

  for (const { why, transfers = [], policy, status = 200, isFetched } of [
    { why: "is fetched where workers may compile it", isFetched: true },
    { why: "is fetched on a fast line", transfers: [transfer(100_000, 50)], isFetched: true },
    { why: "is not fetched on a slow line", transfers: [transfer(100_000, 160)], isFetched: false },
    { why: "is not fetched where a policy forbids it", policy: "default-src 'self'", isFetched: false },
    { why: "is missing where the server lacks it", status: 404, isFetched: false },
  ] as { why: string; transfers?: PerformanceResourceTiming[]; policy?: string; status?: number; isFetched: boolean }[])
    test(why, async (context) => {
      const requests: string[] = [];
      context.mock.method(performance, "getEntriesByType", () => transfers);
      context.mock.method(globalThis, "fetch", (url: URL, init: RequestInit) => {
        requests.push(`${init.method ?? "GET"} ${url.pathname}`);
        if (init.method === "HEAD")
          return Promise.resolve(new Response(null, { headers: policy ? { "content-security-policy": policy } : {} }));
        return Promise.resolve(new Response(bytes, { status }));
      });
      const fetched = await fetchDecoder(workerUrl, moduleUrl);
      assert.deepEqual(fetched && new Uint8Array(fetched), isFetched ? bytes : undefined);
      assert.equal(requests.includes("GET /decoder.wasm"), isFetched || status !== 200);
      assert.ok(requests.length <= 2);
    });

  test("is missing where the network fails", async (context) => {
    context.mock.method(globalThis, "fetch", () => Promise.reject(new TypeError("no network")));
    assert.equal(await fetchDecoder(workerUrl, moduleUrl), undefined);
  });
});
