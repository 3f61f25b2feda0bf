import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { ArrayUse, GpuArray } from "../stage/stage.ts";
import { ArrayUploads } from "./arrayUploads.ts";

/**
 * Uploads to a fake GPU, which counts calls and open arrays; `hold` delays further uploads until a promise resolves.
 */
function fakeGpu() {
  const open = new Set<GpuArray>();
  let storeCount = 0;
  let gate: Promise<unknown> = Promise.resolve();
  const store = async ({ byteLength }: ElementArray, _: ArrayUse, signal: AbortSignal): Promise<GpuArray> => {
    storeCount += 1;
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
    uploads: new ArrayUploads(store),
    open,
    storeCount: () => storeCount,
    hold: (promise: Promise<unknown>) => {
      gate = promise;
    },
  };
}

const neverAborted = new AbortController().signal;
const vertices = (array: ElementArray, offset = 0) => ({ array, components: 3, stride: 8, offset }) as const;

describe("uploaded arrays", () => {
  test("are stored once for all attributes that share a buffer, and closed with the last of them", async () => {
    const { uploads, open, storeCount } = fakeGpu();
    const { buffer } = new Uint8Array(64);
    const all = await Promise.all(
      [vertices(new Uint16Array(buffer)), vertices(new Uint16Array(buffer), 4), vertices(new Int8Array(buffer))].map(
        (array) => uploads.storeVertices(array, neverAborted),
      ),
    );
    assert.deepEqual([storeCount(), open.size, uploads.byteLength], [1, 1, 64]);
    assert.deepEqual(
      all.map(({ type, offset }) => `${type} ${offset}`),
      ["Uint16 0", "Uint16 4", "Int8 0"],
    );
    for (const array of all) {
      assert.equal(open.size, 1);
      uploads.retire(array);
      uploads.sweep();
    }
    assert.deepEqual([open.size, uploads.byteLength], [0, 0]);
    await uploads.storeIndex(new Uint16Array(buffer), neverAborted);
    assert.equal(storeCount(), 2);
  });

  test("stay stored after they are retired, until they are swept", async () => {
    const { uploads, open } = fakeGpu();
    uploads.retire(await uploads.storeIndex(new Uint32Array(3), neverAborted), undefined);
    assert.equal(open.size, 1);
    uploads.sweep();
    uploads.sweep();
    assert.equal(open.size, 0);
  });

  test("are stored for a second caller although the first one aborts", async () => {
    const { uploads, open, hold } = fakeGpu();
    const { promise, resolve } = Promise.withResolvers<undefined>();
    hold(promise);
    const aborter = new AbortController();
    const array = new Uint8Array(8);
    const [first, second] = [uploads.storeIndex(array, aborter.signal), uploads.storeIndex(array, neverAborted)];
    aborter.abort();
    resolve(undefined);
    await assert.rejects(first, { name: "AbortError" });
    await second;
    assert.deepEqual([open.size, uploads.byteLength], [1, 8]);
  });
});
