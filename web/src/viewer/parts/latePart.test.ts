import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { PartModule } from "./latePart.ts";
import { LatePart } from "./latePart.ts";

/** A part whose module comes after so many failures, and how often it was requested and added. */
function partAfter(failures: number): { part: LatePart; counts: { requested: number; added: number } } {
  const counts = { requested: 0, added: 0 };
  const module: PartModule = {
    add: () => {
      ++counts.added;
    },
  };
  const load = (): Promise<PartModule> =>
    counts.requested++ < failures ? Promise.reject(new TypeError("503")) : Promise.resolve(module);
  return { part: new LatePart(load, [1, 1]), counts };
}

describe("a part of the runtime", () => {
  test("is requested and added once, also for calls at the same time", async () => {
    const { part, counts } = partAfter(0);
    const [first, second] = await Promise.all([part.load(), part.load()]);
    assert.equal(first, second);
    assert.equal(part.module, first);
    assert.deepEqual(counts, { requested: 1, added: 1 });
  });

  test("is requested again where a server is busy for a moment", async () => {
    const { part, counts } = partAfter(2);
    await part.load();
    assert.deepEqual(counts, { requested: 3, added: 1 });
  });

  test("rejects after three failures; a later call tries again", async () => {
    const { part, counts } = partAfter(3);
    await assert.rejects(part.load(), { message: "503" });
    assert.deepEqual([part.module, counts], [undefined, { requested: 3, added: 0 }]);
    assert.equal(await part.load(), part.module);
    assert.deepEqual(counts, { requested: 4, added: 1 });
  });
});
