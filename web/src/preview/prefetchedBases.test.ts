import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { PrefetchedBases } from "./prefetchedBases.ts";

const file = readFileSync(join(import.meta.dirname, "../../../vectors/compact-1/base.png"));

/** Bases prefetched from a server that gives this answer to every request, and the URLs requested from it. */
function prefetchedFrom(answer: () => Promise<Response>): { prefetched: PrefetchedBases; requested: string[] } {
  const requested: string[] = [];
  const prefetched = new PrefetchedBases((url) => {
    requested.push(url as string);
    return answer();
  });
  return { prefetched, requested };
}

describe("prefetched bases", () => {
  test("are fetched and decoded once, and can be taken once", async () => {
    const { prefetched, requested } = prefetchedFrom(() => Promise.resolve(new Response(file)));
    const { downloaded, decode } = prefetched.fetch("b.png");
    await downloaded;
    const decoded = decode();
    assert.equal(prefetched.fetch("b.png").decode(), decoded);
    const { byteLength, bases } = await decoded;
    assert.equal(byteLength, file.length);
    assert.ok(bases[0] && bases[0].whole.vertexCount > 0);
    assert.deepEqual(await prefetched.take("b.png"), { byteLength, bases: bases.map((base) => base.segments) });
    assert.equal(prefetched.take("b.png"), undefined);
    assert.deepEqual(requested, ["b.png"]);
  });

  test("reject their promises on failure, without unhandled rejections", async () => {
    const failures = [
      () => Promise.reject(new TypeError("no network")),
      () => Promise.resolve(new Response("", { status: 404 })),
      () => Promise.resolve(new Response(file.subarray(0, 40))),
    ];
    for (const failure of failures) {
      const { prefetched } = prefetchedFrom(failure);
      const { decode } = prefetched.fetch("b.png");
      await assert.rejects(decode());
      await assert.rejects(prefetched.take("b.png") ?? Promise.resolve());
    }
  });
});
