import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { endlessBody } from "./endlessBody.testing.ts";
import { fetchDecoder, maxModuleBytes } from "./fetchDecoder.ts";

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
      context.mock.method(globalThis, "fetch", (url: URL | string, init: RequestInit) => {
        requests.push(`${init.method ?? "GET"} ${new URL(url).pathname}`);
        if (init.method === "HEAD")
          return Promise.resolve(new Response(null, { headers: policy ? { "content-security-policy": policy } : {} }));
        return Promise.resolve(new Response(body, { status }));
      });
      const module = await fetchDecoder(workerUrl, moduleUrl);
      assert.equal(module instanceof WebAssembly.Module, isCompiled);
      if (policy !== undefined) assert.equal(compile.mock.callCount(), 0);
      assert.deepEqual(requests.sort(), ["GET /decoder.wasm", "HEAD /worker.js"]);
    });

  test("is missing where it has more bytes than a module may have, and its transfer ends", async (context) => {
    const chunk = new Uint8Array(2 ** 20);
    chunk.set(bytes);
    const endless = endlessBody(chunk);
    context.mock.method(globalThis, "fetch", (_: URL | string, { method, priority, cache }: RequestInit) => {
      assert.deepEqual([priority, cache], ["low", "force-cache"]);
      return Promise.resolve(new Response(method === "HEAD" ? null : endless.body));
    });
    assert.equal(await fetchDecoder(workerUrl, moduleUrl), undefined);
    assert.ok(endless.isCancelled);
    assert.ok(endless.sentBytes <= maxModuleBytes + 4 * chunk.length, `${endless.sentBytes} bytes`);
  });

  test("is missing where the network fails", async (context) => {
    context.mock.method(globalThis, "fetch", () => Promise.reject(new TypeError("no network")));
    assert.equal(await fetchDecoder(workerUrl, moduleUrl), undefined);
  });
});
