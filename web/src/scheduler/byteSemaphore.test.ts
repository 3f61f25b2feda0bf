import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { ByteSemaphore } from "./byteSemaphore.ts";

describe("a byte semaphore", () => {
  const { signal } = new AbortController();
  const soon = () => new Promise((resolve) => setTimeout(resolve, 0));

  test("admits entries in order while they fit, and the next when one is released", async () => {
    const semaphore = new ByteSemaphore(10);
    const inside: number[] = [];
    const entered = [6, 4, 5, 1].map(async (bytes) => {
      const release = await semaphore.acquire(bytes, signal);
      inside.push(bytes);
      return release;
    });
    await soon();
    assert.deepEqual(inside, [6, 4]); // 1 waits behind 5
    (await entered[0])?.();
    await soon();
    assert.deepEqual(inside, [6, 4, 5, 1]);
    assert.equal(semaphore.bytes, 10);
  });

  test("gets the bytes of an entry back once", async () => {
    const semaphore = new ByteSemaphore(10);
    const release = await semaphore.acquire(10, signal);
    const second = await semaphore.acquire(0, signal);
    release();
    release();
    assert.equal(semaphore.bytes, 0);
    second();
    assert.equal(semaphore.bytes, 0);
  });

  test("admits an entry that is larger than the limit alone", async () => {
    const semaphore = new ByteSemaphore(10);
    const small = await semaphore.acquire(1, signal);
    let isInside = false;
    const large = semaphore.acquire(100, signal).then((release) => {
      isInside = true;
      return release;
    });
    await soon();
    assert.equal(isInside, false);
    small();
    (await large)();
    assert.equal(semaphore.bytes, 0);
  });

  test("drops an entry that is aborted while it waits, and admits those after it", async () => {
    const semaphore = new ByteSemaphore(10);
    const release = await semaphore.acquire(8, signal);
    const aborter = new AbortController();
    const aborted = semaphore.acquire(9, aborter.signal);
    const behind = semaphore.acquire(2, signal);
    aborter.abort(new Error("removed"));
    await assert.rejects(aborted, { message: "removed" });
    (await behind)();
    release();
    assert.equal(semaphore.bytes, 0);
    await assert.rejects(semaphore.acquire(1, aborter.signal), { message: "removed" });
  });
});
