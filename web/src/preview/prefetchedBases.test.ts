import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { PrefetchedBases } from "./prefetchedBases.ts";

const file = readFileSync(join(import.meta.dirname, "../../../vectors/compact-1/base.png"));

function basesFrom(answer: () => Promise<Response>): { early: PrefetchedBases; asked: string[] } {
  const asked: string[] = [];
  const early = new PrefetchedBases((url) => {
    asked.push(url as string);
    return answer();
  });
  return { early, asked };
}

describe("bases that are asked for early", () => {
  test("are fetched once, decoded, and given away once", async () => {
    const { early, asked } = basesFrom(() => Promise.resolve(new Response(file)));
    const { downloaded: arrival, decoded: content } = early.fetch("b.png");
    assert.equal(early.fetch("b.png").decoded, content);
    await arrival;
    const { byteLength, bases } = await content;
    assert.equal(byteLength, file.length);
    assert.ok(bases[0] && bases[0].whole.vertexCount > 0);
    assert.deepEqual(await early.take("b.png"), { byteLength, bases: bases.map((base) => base.segments) });
    assert.equal(early.take("b.png"), undefined);
    assert.deepEqual(asked, ["b.png"]);
  });

  test("that are no use are told to whoever looks, and to nobody else", async () => {
    const faults = [
      () => Promise.reject(new TypeError("no network")),
      () => Promise.resolve(new Response("", { status: 404 })),
      () => Promise.resolve(new Response(file.subarray(0, 40))),
    ];
    for (const fault of faults) {
      const { early } = basesFrom(fault);
      const { decoded: content } = early.fetch("b.png");
      await assert.rejects(content);
      await assert.rejects(early.take("b.png") ?? Promise.resolve());
    }
  });
});
