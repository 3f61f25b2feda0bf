import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { policyAllowsWasm, workersAllowWasm } from "./wasmPolicy.ts";

describe("a policy allows WebAssembly", () => {
  for (const [header, allows] of [
    [null, true],
    ["", true],
    ["img-src 'self'", true],
    ["default-src 'self'", false],
    ["default-src 'self' 'wasm-unsafe-eval'", true],
    ["default-src 'self'; script-src 'self' 'wasm-unsafe-eval'", true],
    ["default-src 'unsafe-eval'; script-src 'self'", false],
    ["Default-Src 'none';SCRIPT-SRC  'Unsafe-Eval'", true],
    ["script-src 'self'; script-src 'wasm-unsafe-eval'", false],
    ["script-src 'wasm-unsafe-eval', default-src 'self'", false],
    ["script-src 'wasm-unsafe-eval', img-src 'self'", true],
    ["default-src", false],
  ] as const)
    test(`${String(header)}: ${allows ? "yes" : "no"}`, () => {
      assert.equal(policyAllowsWasm(header), allows);
    });
});

describe("workers", () => {
  const answer = (headers: Record<string, string>, status = 200): typeof fetch => {
    return (_input, init) => {
      assert.equal(init?.method, "HEAD");
      return Promise.resolve(new Response(null, { status, headers }));
    };
  };

  for (const [why, url, headers, status, allow] of [
    ["without a policy may", "https://a.test/worker.js", {}, 200, true],
    [
      "with a policy may not",
      "https://a.test/worker.js",
      { "content-security-policy": "default-src 'self'" },
      200,
      false,
    ],
    [
      "whose attempts would be reported do not",
      "https://a.test/worker.js",
      { "content-security-policy-report-only": "default-src 'self'" },
      200,
      false,
    ],
    ["whose file is not there do not", "https://a.test/worker.js", {}, 404, false],
    ["of a blob do not", "blob:https://a.test/1", {}, 200, false],
  ] as const)
    test(`${why} compile WebAssembly`, async (context) => {
      context.mock.method(globalThis, "fetch", answer(headers, status));
      assert.equal(await workersAllowWasm(new URL(url)), allow);
    });
});
