import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { fetchDecoder } from "./fetchDecoder.ts";

describe("the module", () => {
  const workerUrl = new URL("https://a.test/worker.js");
  const moduleUrl = new URL("https://a.test/decoder.wasm");
  const bytes = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0); // an empty module

  for (const { why, policy, status = 200, body = bytes, isCompiled } of [
    { why: "is compiled where workers may do so", isCompiled: true },
    { why: "is not compiled where a policy forbids it", policy: "default-src 'self'", isCompiled: false },
    { why: "is missing where the server lacks it", status: 404, isCompiled: false },
    { why: "is missing where its bytes are no module", body: Uint8Array.of(1, 2, 3), isCompiled: false },
  ] as { why: string; policy?: string; status?: number; body?: Uint8Array<ArrayBuffer>; isCompiled: boolean }[])
    test(why, async (context) => {
      const compile = context.mock.method(WebAssembly, "compile");
      const requests: string[] = [];
      context.mock.method(globalThis, "fetch", (url: URL, init: RequestInit) => {
        requests.push(`${init.method ?? "GET"} ${url.pathname}`);
        if (init.method === "HEAD")
          return Promise.resolve(new Response(null, { headers: policy ? { "content-security-policy": policy } : {} }));
        return Promise.resolve(new Response(body, { status }));
      });
      const module = await fetchDecoder(workerUrl, moduleUrl);
      assert.equal(module instanceof WebAssembly.Module, isCompiled);
      if (policy !== undefined) assert.equal(compile.mock.callCount(), 0);
      assert.deepEqual(requests.sort(), ["GET /decoder.wasm", "HEAD /worker.js"]);
    });

  test("is missing where the network fails", async (context) => {
    context.mock.method(globalThis, "fetch", () => Promise.reject(new TypeError("no network")));
    assert.equal(await fetchDecoder(workerUrl, moduleUrl), undefined);
  });
});
