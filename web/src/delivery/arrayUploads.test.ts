import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { ArrayUse, StoredBytes } from "../stage/stage.ts";
import { ArrayUploads } from "./arrayUploads.ts";

function memory() {
  const open = new Set<StoredBytes>();
  let stored = 0;
  let gate: Promise<unknown> = Promise.resolve();
  const store = async ({ byteLength }: ElementArray, _: ArrayUse, signal: AbortSignal): Promise<StoredBytes> => {
    stored += 1;
    await gate;
    signal.throwIfAborted();
    const bytes = {
      byteLength,
      close: () => {
        assert.ok(open.delete(bytes), "closed twice");
      },
    };
    open.add(bytes);
    return bytes;
  };
  return {
    holdings: new ArrayUploads(store),
    open,
    stored: () => stored,
    hold: (promise: Promise<unknown>) => {
      gate = promise;
    },
  };
}

const never = new AbortController().signal;
const vertices = (array: ElementArray, offset = 0) => ({ array, components: 3, stride: 8, offset }) as const;

describe("arrays that are held", () => {
  test("are stored once for all attributes of their records, and closed with the last", async () => {
    const { holdings, open, stored } = memory();
    const { buffer } = new Uint8Array(64);
    const all = await Promise.all(
      [vertices(new Uint16Array(buffer)), vertices(new Uint16Array(buffer), 4), vertices(new Int8Array(buffer))].map(
        (array) => holdings.storeVertices(array, never),
      ),
    );
    assert.deepEqual([stored(), open.size, holdings.byteLength], [1, 1, 64]);
    assert.deepEqual(
      all.map(({ type, offset }) => `${type} ${offset}`),
      ["Uint16 0", "Uint16 4", "Int8 0"],
    );
    for (const array of all) {
      assert.equal(open.size, 1);
      holdings.retire(array);
      holdings.sweep();
    }
    assert.deepEqual([open.size, holdings.byteLength], [0, 0]);
    await holdings.storeIndex(new Uint16Array(buffer), never);
    assert.equal(stored(), 2);
  });

  test("stay until they are swept", async () => {
    const { holdings, open } = memory();
    holdings.retire(await holdings.storeIndex(new Uint32Array(3), never), undefined);
    assert.equal(open.size, 1);
    holdings.sweep();
    holdings.sweep();
    assert.equal(open.size, 0);
  });

  test("are stored for those who still want them where the first was told to stop", async () => {
    const { holdings, open, hold } = memory();
    const { promise, resolve } = Promise.withResolvers<undefined>();
    hold(promise);
    const aborter = new AbortController();
    const array = new Uint8Array(8);
    const [first, second] = [holdings.storeIndex(array, aborter.signal), holdings.storeIndex(array, never)];
    aborter.abort();
    resolve(undefined);
    await assert.rejects(first, { name: "AbortError" });
    await second;
    assert.deepEqual([open.size, holdings.byteLength], [1, 8]);
  });
});
