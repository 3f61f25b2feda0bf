import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { DownloadOptions } from "./download.ts";
import { downloadAnd, RequestError } from "./download.ts";
import { Scheduler } from "./scheduler.ts";

const url = "https://example.org/file.png";
const nothing = () => undefined;

function answering(fetch: typeof globalThis.fetch): DownloadOptions {
  return { fetch, silenceMs: 1000, retries: 0, backoffMs: 1 };
}

const status = (code: number) => answering(() => Promise.resolve(new Response("no", { status: code })));
const ok = answering(() => Promise.resolve(new Response("bytes")));

/** Answers only to an abort, as a slow server's connection does. */
const silent = answering((_, init) => new Promise((_resolve, reject) => {
  init?.signal?.addEventListener("abort", () => { reject(init.signal?.reason as Error); });
}));

const decoded = (bytes: Uint8Array) => Promise.resolve(bytes.byteLength);

/** Every way in which a job can end: what is asked, and what becomes of it. */
const outcomes: Record<string, (scheduler: Scheduler, aborter: AbortController) => Promise<unknown>> = {
  "ok": (scheduler, { signal }) => downloadAnd(scheduler, 0, url, signal, ok, nothing, decoded),
  "404": (scheduler, { signal }) => downloadAnd(scheduler, 0, url, signal, status(404), nothing, decoded),
  "416": (scheduler, { signal }) => downloadAnd(scheduler, 0, url, signal, status(416), nothing, decoded),
  "503": (scheduler, { signal }) => downloadAnd(scheduler, 0, url, signal, status(503), nothing, decoded),
  "503 with retries": (scheduler, { signal }) =>
    downloadAnd(scheduler, 0, url, signal, { ...status(503), retries: 2 }, nothing, decoded),
  "network error": (scheduler, { signal }) =>
    downloadAnd(scheduler, 0, url, signal, answering(() => Promise.reject(new TypeError("fetch failed"))), nothing, decoded),
  "connection lost amid the body": (scheduler, { signal }) => {
    const body = new ReadableStream({
      pull(controller) { controller.enqueue(new Uint8Array(3)); controller.error(new TypeError("terminated")); },
    });
    return downloadAnd(scheduler, 0, url, signal, answering(() => Promise.resolve(new Response(body))), nothing, decoded);
  },
  "silence": (scheduler, { signal }) => downloadAnd(scheduler, 0, url, signal, { ...silent, silenceMs: 5 }, nothing, decoded),
  "abort before asking": (scheduler, aborter) => {
    aborter.abort();
    return downloadAnd(scheduler, 0, url, aborter.signal, ok, nothing, decoded);
  },
  "abort while queued": (scheduler, aborter) => {
    const result = downloadAnd(scheduler, 0, url, aborter.signal, ok, nothing, decoded);
    aborter.abort(); // nothing starts before this turn of the event loop ends
    return result;
  },
  "abort while running": (scheduler, aborter) => {
    const result = downloadAnd(scheduler, 0, url, aborter.signal, silent, nothing, decoded);
    setTimeout(() => { aborter.abort(); }, 2);
    return result;
  },
  "abort while waiting to retry": (scheduler, aborter) => {
    const result = downloadAnd(scheduler, 0, url, aborter.signal, { ...status(503), retries: 1, backoffMs: 1000 }, nothing, decoded);
    setTimeout(() => { aborter.abort(); }, 5);
    return result;
  },
  "abort twice": (scheduler, aborter) => {
    const result = downloadAnd(scheduler, 0, url, aborter.signal, silent, nothing, decoded);
    setTimeout(() => { aborter.abort(); aborter.abort(); }, 2);
    return result;
  },
  "synchronous throw of the job": (scheduler, { signal }) => scheduler.run(0, signal, () => { throw new Error("at once"); }),
  "synchronous throw of fetch": (scheduler, { signal }) =>
    downloadAnd(scheduler, 0, url, signal, answering(() => { throw new Error("at once"); }), nothing, decoded),
  "decode error": (scheduler, { signal }) =>
    downloadAnd(scheduler, 0, url, signal, ok, nothing, () => Promise.reject(new Error("no image"))),
  "synchronous throw of the decoder": (scheduler, { signal }) =>
    downloadAnd(scheduler, 0, url, signal, ok, nothing, () => { throw new Error("no image"); }),
  "throw of the byte counter": (scheduler, { signal }) =>
    downloadAnd(scheduler, 0, url, signal, ok, () => { throw new Error("no bar"); }, decoded),
};

/** The slots that are free: as many jobs as hold one at the same time. */
async function freeSlots(scheduler: Scheduler): Promise<number> {
  const aborter = new AbortController();
  let started = 0;
  const jobs = Array.from({ length: scheduler.slotCount + 2 }, () => scheduler.run(0, aborter.signal, (signal) => {
    started += 1;
    return new Promise((_, reject) => { signal.addEventListener("abort", () => { reject(signal.reason as Error); }); });
  }));
  await new Promise((resolve) => setTimeout(resolve, 0));
  aborter.abort();
  await Promise.allSettled(jobs);
  return started;
}

describe("a slot comes back exactly once", () => {
  for (const [name, run] of Object.entries(outcomes)) {
    test(`after: ${name}`, async () => {
      const scheduler = new Scheduler(2);
      const results = await Promise.allSettled([1, 2, 3, 4].map(() => run(scheduler, new AbortController())));
      assert.ok(results.every((result) => result.status === (name === "ok" ? "fulfilled" : "rejected")));
      assert.equal(scheduler.running, 0);
      assert.equal(scheduler.waiting, 0);
      assert.equal(await freeSlots(scheduler), 2);
    });
  }

  test("after all of them at once, in any order", async () => {
    const scheduler = new Scheduler(3);
    await Promise.allSettled(Object.values(outcomes).flatMap((run) => [run, run]).map((run) => run(scheduler, new AbortController())));
    assert.equal(scheduler.running, 0);
    assert.equal(await freeSlots(scheduler), 3);
  });
});

describe("the queue", () => {
  /** Lets `count` jobs of these priorities through one slot and tells their order. */
  async function orderOf(priorities: readonly number[]): Promise<number[]> {
    const scheduler = new Scheduler(1);
    const order: number[] = [];
    const { signal } = new AbortController();
    await Promise.all(priorities.map((priority, place) =>
      scheduler.run(priority, signal, () => Promise.resolve(order.push(place)))));
    return order;
  }

  test("lets the smallest priority number go first and keeps the order of equals", async () => {
    assert.deepEqual(await orderOf([2, 1, 2, 0, 1, 0]), [3, 5, 1, 4, 0, 2]);
  });

  test("never runs more jobs than there are slots, and leaves no slot idle", async () => {
    const scheduler = new Scheduler(3);
    const { signal } = new AbortController();
    let most = 0;
    await Promise.all(Array.from({ length: 20 }, () => scheduler.run(0, signal, async () => {
      most = Math.max(most, scheduler.running);
      await new Promise((resolve) => setTimeout(resolve, 1));
    })));
    assert.equal(most, 3);
    assert.equal(scheduler.started, 20);
  });

  test("aborting a waiting job starts it never and leaves the others alone", async () => {
    const scheduler = new Scheduler(1);
    const aborter = new AbortController();
    const ran: string[] = [];
    const job = (name: string) => () => Promise.resolve(ran.push(name));
    const first = scheduler.run(0, new AbortController().signal, job("first"));
    const gone = scheduler.run(0, aborter.signal, job("gone"));
    const last = scheduler.run(0, new AbortController().signal, job("last"));
    aborter.abort(new Error("removed"));
    await assert.rejects(gone, { message: "removed" });
    await Promise.all([first, last]);
    assert.deepEqual(ran, ["first", "last"]);
  });
});

describe("a download", () => {
  const { signal } = new AbortController();

  /** Answers with each status in turn, the last one for ever. */
  function inTurn(...codes: number[]): { options: DownloadOptions; asked: () => number } {
    let asked = 0;
    return {
      options: { ...answering(() => {
        const code = codes[Math.min(asked, codes.length - 1)] ?? 200;
        asked += 1;
        return code === 0 ? Promise.reject(new TypeError("fetch failed")) : Promise.resolve(new Response("bytes", { status: code }));
      }), retries: 2 },
      asked: () => asked,
    };
  }

  test("is tried again after a network error and after 5xx", async () => {
    const { options, asked } = inTurn(0, 503, 200);
    assert.equal(await downloadAnd(new Scheduler(1), 0, url, signal, options, nothing, decoded), 5);
    assert.equal(asked(), 3);
  });

  test("gives up after the last retry", async () => {
    const { options, asked } = inTurn(503);
    await assert.rejects(downloadAnd(new Scheduler(1), 0, url, signal, options, nothing, decoded),
      (error) => error instanceof RequestError && error.kind === "http" && error.status === 503 && error.url === url);
    assert.equal(asked(), 3);
  });

  for (const code of [404, 410, 416]) {
    test(`is final after ${code}`, async () => {
      const { options, asked } = inTurn(code);
      await assert.rejects(downloadAnd(new Scheduler(1), 0, url, signal, options, nothing, decoded));
      assert.equal(asked(), 1);
    });
  }

  test("is not asked for again when its bytes do not decode", async () => {
    const { options, asked } = inTurn(200);
    await assert.rejects(downloadAnd(new Scheduler(1), 0, url, signal, options, nothing, () => Promise.reject(new Error("no image"))));
    assert.equal(asked(), 1);
  });

  test("lets another job have its slot while it waits to retry", async () => {
    const scheduler = new Scheduler(1);
    const order: string[] = [];
    const { options } = inTurn(503, 200);
    const retried = downloadAnd(scheduler, 0, url, signal, { ...options, backoffMs: 20 }, nothing, decoded).then(() => order.push("retried"));
    const other = downloadAnd(scheduler, 1, url, signal, ok, nothing, decoded).then(() => order.push("other"));
    await Promise.all([retried, other]);
    assert.deepEqual(order, ["other", "retried"]);
  });

  test("counts the bytes as they come and knows the total where the server tells it", async () => {
    const counts: [number, number | undefined][] = [];
    const body = new ReadableStream({
      start(controller) {
        for (const length of [3, 4]) controller.enqueue(new Uint8Array(length));
        controller.close();
      },
    });
    const options = answering(() => Promise.resolve(new Response(body, { headers: { "content-length": "7" } })));
    await downloadAnd(new Scheduler(1), 0, url, signal, options, (loaded, total) => counts.push([loaded, total]), decoded);
    assert.deepEqual(counts, [[0, 7], [3, 7], [7, 7]]);
  });

  test("does not take the length of a compressed body for its own", async () => {
    const totals = new Set<number | undefined>();
    const options = answering(() => Promise.resolve(
      new Response("bytes", { headers: { "content-length": "3", "content-encoding": "br" } })));
    await downloadAnd(new Scheduler(1), 0, url, signal, options, (_, total) => totals.add(total), decoded);
    assert.deepEqual(Array.from(totals), [undefined]);
  });
});
