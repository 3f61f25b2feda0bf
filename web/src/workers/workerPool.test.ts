import assert from "node:assert/strict";
import { getEventListeners } from "node:events";
import { describe, test } from "node:test";
import type { IndexJob, NormalJob } from "../decode/classic/classicArrays.ts";
import { DecodeError } from "../decode/decodeError.ts";
import { pngWithTexels } from "../decode/png.testing.ts";
import type { AnswerMessage, JobMessage, WorkerMessage } from "./protocol.ts";
import { asAnswer, asError, buffersIn, messagesIn, withMessages } from "./protocol.ts";
import { runJob } from "./worker.ts";
import type { JobWorker } from "./workerPool.ts";
import { WorkerPool } from "./workerPool.ts";

/** A pool with fake workers, which answer when the test calls `answer`. */
function poolWithFakes({
  size = 2,
  idleMs = 1000,
  start = true,
  broken = false,
  decoderUrl = (): string | undefined => undefined,
} = {}) {
  const workers: {
    /** Messages, those that the worker was started with first. */
    received: WorkerMessage[];
    startedWith: number;
    isEnded: boolean;
    answer: (answer: AnswerMessage) => void;
    fail: () => void;
  }[] = [];
  const onMainThread: JobMessage[] = [];
  const pool = new WorkerPool({
    size,
    idleMs,
    decoderUrl,
    start: (messages) => {
      if (!start) throw new DOMException("no", "SecurityError");
      const worker: JobWorker = {
        onmessage: null,
        onerror: null,
        postMessage: (message) => {
          fake.received.push(message);
          if (broken) setTimeout(fake.fail);
        },
        terminate: () => {
          fake.isEnded = true;
        },
      };
      const fake = {
        received: [...messages] as WorkerMessage[],
        startedWith: messages.length,
        isEnded: false,
        answer: (answer: AnswerMessage) => worker.onmessage?.({ data: answer } as MessageEvent<AnswerMessage>),
        fail: () => worker.onerror?.({ preventDefault: () => undefined } as ErrorEvent),
      };
      workers.push(fake);
      return worker;
    },
    prepareMainThread: () => undefined,
    runOnMainThread: (message) => {
      onMainThread.push(message);
      return runJob(message);
    },
  });
  return { pool, workers, onMainThread };
}

const input = (n: number): NormalJob => ({
  file: { bytes: pngWithTexels(4, 1, 3, (texel) => n + texel), firstTexel: 0 },
  format: { kind: "byteVector" },
  count: 2,
  rowLength: 0,
});
const noAbort = new AbortController().signal;
const output = (n: number) => ({ output: { array: Uint8Array.from([n]), components: 3, stride: 4, offset: 0 } });
const soon = () => new Promise((resolve) => setTimeout(resolve, 5));

describe("jobs", () => {
  test("run in one worker each, up to the limit; the rest wait", async () => {
    const { pool, workers } = poolWithFakes();
    const jobs = [1, 2, 3].map((n) => pool.run("classicNormals", input(n), noAbort));
    assert.deepEqual(
      workers.map(({ received }) => received.length),
      [1, 1],
    );
    workers[1]?.answer(output(2));
    assert.deepEqual(
      workers.map(({ received }) => received.length),
      [1, 2],
    );
    workers[0]?.answer(output(1));
    workers[1]?.answer(output(3));
    assert.deepEqual(
      (await Promise.all(jobs)).map(({ array }) => array[0]),
      [1, 2, 3],
    );
    pool.dispose();
    assert.ok(workers.every(({ isEnded }) => isEnded));
  });

  test("on files are what a new worker begins with, and what an idle one is told", async () => {
    const { pool, workers } = poolWithFakes({ size: 1, decoderUrl: () => "https://a.test/decoder.wasm" });
    const first = pool.runOnFile("compactPatches", "https://a.test/1.png", noAbort);
    const second = pool.runOnFile("compactPatches", "https://a.test/2.png", noAbort);
    const decoder = { decoderUrl: "https://a.test/decoder.wasm" };
    const [one, two] = [1, 2].map((n) => ({ name: "compactPatches", fileUrl: `https://a.test/${n}.png` }));
    assert.deepEqual([workers[0]?.received, workers[0]?.startedWith], [[decoder, one], 2]);
    workers[0]?.answer({ output: [] });
    assert.deepEqual(await first, []);
    assert.deepEqual([workers[0]?.received, workers[0]?.startedWith], [[decoder, one, two], 2]);
    workers[0]?.answer(asAnswer(new Error("the server answered 404")));
    await assert.rejects(second, { message: "the server answered 404" });
    pool.dispose();
  });

  for (const [why, options] of [
    ["cannot be started", { start: false }],
    ["do not load", { broken: true }],
  ] as const)
    test(`on files reject where workers ${why}`, async () => {
      const { pool, workers, onMainThread } = poolWithFakes(options);
      const job = pool.runOnFile("compactPatches", "https://a.test/1.png", noAbort);
      if (workers[0]) workers[0].fail();
      await assert.rejects(job, { message: "no worker can be started" });
      assert.deepEqual(onMainThread, []);
    });

  test("leave nothing at a signal that outlives them", async () => {
    const { pool, workers } = poolWithFakes({ size: 1 });
    const { signal } = new AbortController();
    const [done, failing] = [1, 2].map((n) => pool.run("classicNormals", input(n), signal));
    assert.equal(getEventListeners(signal, "abort").length, 2);
    workers[0]?.answer(output(1));
    await done;
    assert.equal(getEventListeners(signal, "abort").length, 1);
    workers[0]?.answer(asAnswer(new DecodeError("truncated", "is short")));
    await assert.rejects(failing ?? Promise.resolve());
    assert.equal(getEventListeners(signal, "abort").length, 0);
    pool.dispose();
  });

  test("reject with their own errors, and the worker continues", async () => {
    const { pool, workers } = poolWithFakes({ size: 1 });
    const failing = pool.run("classicNormals", input(1), noAbort);
    const next = pool.run("classicNormals", input(2), noAbort);
    workers[0]?.answer(asAnswer(new DecodeError("truncated", "is short")));
    await assert.rejects(
      failing,
      (error) => error instanceof DecodeError && error.kind === "truncated" && error.message === "is short",
    );
    workers[0]?.answer(output(2));
    assert.equal((await next).array[0], 2);
    pool.dispose();
  });

  test("that are aborted do not begin; the result of a running one is dropped", async () => {
    const { pool, workers } = poolWithFakes({ size: 1 });
    const aborter = new AbortController();
    const running = pool.run("classicNormals", input(1), aborter.signal);
    const waiting = pool.run("classicNormals", input(2), aborter.signal);
    const other = pool.run("classicNormals", input(3), noAbort);
    aborter.abort();
    await assert.rejects(running, { name: "AbortError" });
    await assert.rejects(waiting, { name: "AbortError" });
    await assert.rejects(pool.run("classicNormals", input(4), aborter.signal), { name: "AbortError" });
    assert.equal(workers[0]?.received.length, 1);
    workers[0].answer(output(1));
    workers[0].answer(output(3));
    assert.equal((await other).array[0], 3);
    pool.dispose();
  });

  test("use workers that were prepared for them, up to the limit", async () => {
    const { pool, workers } = poolWithFakes({ size: 2, idleMs: 1 });
    pool.prepare(1);
    assert.equal(workers.length, 1);
    pool.prepare(5);
    assert.equal(workers.length, 2);
    const job = pool.run("classicNormals", input(1), noAbort);
    assert.deepEqual(
      workers.map(({ received }) => received.length),
      [1, 0],
    );
    workers[0]?.answer(output(1));
    await job;
    await soon();
    assert.deepEqual([pool.workerCount, workers.every(({ isEnded }) => isEnded)], [0, true]);
    const none = poolWithFakes({ start: false });
    none.pool.prepare(2);
    assert.equal(none.pool.workerCount, 0);
  });

  test("leave workers idle, which end after a while", async () => {
    const { pool, workers } = poolWithFakes({ idleMs: 1 });
    const job = pool.run("classicNormals", input(1), noAbort);
    workers[0]?.answer(output(1));
    await job;
    await soon();
    assert.deepEqual([pool.workerCount, workers[0]?.isEnded], [0, true]);
    const again = pool.run("classicNormals", input(2), noAbort);
    workers[1]?.answer(output(2));
    assert.equal((await again).array[0], 2);
    pool.dispose();
  });

  for (const [why, options] of [
    ["cannot be started", { start: false }],
    ["do not load", { broken: true }],
  ] as const) {
    test(`run on the main thread where workers ${why}`, async () => {
      const { pool, onMainThread } = poolWithFakes(options);
      const results = await Promise.all([1, 20, 40].map((n) => pool.run("classicNormals", input(n), noAbort)));
      assert.deepEqual(
        results.map(({ array }) => array[4]),
        [2, 21, 41],
      );
      assert.equal(onMainThread.length, 3);
      assert.equal(pool.workerCount, 0);
      const bad: IndexJob = {
        file: { bytes: pngWithTexels(4, 1, 3, () => 255), firstTexel: 0 },
        draws: [{ primitive: "points", first: 0, count: 2 }],
        rowLength: 4,
        isWide: true,
        ccw: true,
        coordWidth: 1,
        coordHeight: 1,
        recordCount: 1,
      };
      await assert.rejects(pool.run("classicIndex", bad, noAbort), { name: "DecodeError" });
    });
  }
});

test("a worker finds its first messages in its own URL", () => {
  const messages = [
    { decoderUrl: "https://a.test/decoder.wasm?v=1#x" },
    { name: "compactPatches", fileUrl: "https://a.test/ä 1.png" },
  ] as const;
  const url = withMessages(new URL("https://a.test/worker.js"), messages);
  assert.equal(url.href.split("#")[0], "https://a.test/worker.js");
  assert.deepEqual(messagesIn(url.hash), messages);
  assert.equal(withMessages(new URL("https://a.test/worker.js"), []).href, "https://a.test/worker.js");
  assert.deepEqual(messagesIn(""), []);
});

test("messages transfer the buffer of each array once, and errors keep their kind", () => {
  const shared = new ArrayBuffer(8);
  const value = {
    a: new Uint8Array(shared),
    b: [new Float32Array(shared), { c: new Uint16Array(2) }],
    d: "text",
    e: null,
    f: 3,
  };
  assert.equal(buffersIn(value).length, 2);
  const back = (error: unknown) => asError(asAnswer(error) as Parameters<typeof asError>[0]);
  assert.deepEqual(
    [back(new DecodeError("limit", "m")).name, back(new RangeError("m")).name, back("m").message],
    ["DecodeError", "Error", "m"],
  );
});

describe("the decoder in WebAssembly", () => {
  const file = new Uint8Array(1);
  const decoderUrl = "https://a.test/decoder.wasm";

  test("is named once, when a job needs it, to workers that run and to those that start later", () => {
    let calls = 0;
    const { pool, workers } = poolWithFakes({
      decoderUrl: () => {
        ++calls;
        return decoderUrl;
      },
    });
    void pool.run("classicNormals", input(1), noAbort);
    assert.equal(calls, 0);
    for (let job = 0; job < 3; ++job) void pool.run("compactPatches", file, noAbort);
    pool.requestDecoder(() => assert.fail("it has been requested"));
    assert.equal(calls, 1);
    assert.deepEqual(
      workers.map(({ received }) => received.slice(-2)),
      [
        [{ name: "classicNormals", input: input(1) }, { decoderUrl }],
        [{ decoderUrl }, { name: "compactPatches", input: file }],
      ],
    );
    pool.dispose();
  });

  test("can be prefetched for workers that are started with its URL", () => {
    const prefetched: string[] = [];
    const { pool, workers } = poolWithFakes({ decoderUrl: () => decoderUrl });
    pool.requestDecoder((url) => prefetched.push(url));
    pool.prepare(1);
    assert.deepEqual([prefetched, workers[0]?.received], [[decoderUrl], [{ decoderUrl }]]);
    pool.dispose();
  });

  test("is not named where it would not pay", () => {
    const { pool, workers } = poolWithFakes();
    pool.requestDecoder(() => assert.fail("it would not pay"));
    void pool.run("compactPatches", file, noAbort);
    assert.deepEqual(workers[0]?.received, [{ name: "compactPatches", input: file }]);
    pool.dispose();
  });

  test("is not asked for where no workers can be started", () => {
    let calls = 0;
    const { pool } = poolWithFakes({
      start: false,
      decoderUrl: () => {
        ++calls;
        return decoderUrl;
      },
    });
    pool.prepare(1);
    pool.requestDecoder();
    assert.equal(calls, 0);
  });
});
