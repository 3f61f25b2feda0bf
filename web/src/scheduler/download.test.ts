import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { DownloadListener, DownloadOptions, DownloadState } from "./download.ts";
import { downloadInSlot, RequestError } from "./download.ts";
import { optionsWithFetch, decoded, listener, ok, unanswered, subject, url } from "./download.testing.ts";
import { maxRetryAfterMs, retryDelayMs } from "./retry.ts";
import { Scheduler } from "./scheduler.ts";
import { slotCountFor, http1SlotCount, http2SlotCount } from "./downloadSlots.ts";

describe("a download", () => {
  const { signal } = new AbortController();

  /** Downloads the file as the only job of a scheduler; resolves with the number of its bytes. */
  const downloadAlone = (options: DownloadOptions, events: Partial<DownloadListener> = {}) =>
    downloadInSlot(new Scheduler(1), subject, url, signal, options, { ...listener, ...events }, decoded);

  /** A server that answers with each status in turn, then always with the last one. */
  function inTurn(...codes: number[]): { options: DownloadOptions; requestCount: () => number } {
    let requestCount = 0;
    return {
      options: {
        ...optionsWithFetch(() => {
          const code = codes[Math.min(requestCount, codes.length - 1)] ?? 200;
          requestCount += 1;
          return code === 0
            ? Promise.reject(new TypeError("fetch failed"))
            : Promise.resolve(new Response("bytes", { status: code }));
        }),
        retries: 2,
      },
      requestCount: () => requestCount,
    };
  }

  test("is tried again after a network error and after 5xx", async () => {
    const { options, requestCount } = inTurn(0, 503, 200);
    assert.equal(await downloadAlone(options), 5);
    assert.equal(requestCount(), 3);
  });

  test("gives up after the last retry", async () => {
    const { options, requestCount } = inTurn(503);
    await assert.rejects(
      downloadAlone(options),
      (error) => error instanceof RequestError && error.kind === "http" && error.status === 503 && error.url === url,
    );
    assert.equal(requestCount(), 3);
  });

  test("waits twice as long before each further attempt", async () => {
    const times: number[] = [];
    const { options } = inTurn(503);
    const timed: DownloadOptions = {
      ...options,
      backoffMs: 20,
      fetch: (input, init) => {
        times.push(performance.now());
        return options.fetch(input, init);
      },
    };
    await assert.rejects(downloadAlone(timed));
    const [first = 0, second = 0, third = 0] = times;
    // Timers may be late, and early by the fraction of a millisecond that they round away.
    assert.ok(second - first > 19 && third - second > 39, `${second - first} and ${third - second} ms`);
  });

  test("times out if no byte arrives, and is tried again", async () => {
    let requestCount = 0;
    const options: DownloadOptions = {
      ...unanswered,
      idleTimeoutMs: 5,
      retries: 1,
      fetch: (input, init) => {
        requestCount += 1;
        return unanswered.fetch(input, init);
      },
    };
    await assert.rejects(
      downloadAlone(options),
      (error) => error instanceof RequestError && error.kind === "timeout" && error.url === url,
    );
    assert.equal(requestCount, 2);
  });

  for (const code of [404, 410, 416]) {
    test(`is not tried again after ${code}`, async () => {
      const { options, requestCount } = inTurn(code);
      await assert.rejects(downloadAlone(options));
      assert.equal(requestCount(), 1);
    });
  }

  test("is not tried again if its bytes do not decode", async () => {
    const { options, requestCount } = inTurn(200);
    await assert.rejects(
      downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, () =>
        Promise.reject(new Error("no image")),
      ),
    );
    assert.equal(requestCount(), 1);
  });

  test("reports its state", async () => {
    const states: DownloadState[] = [];
    const { options } = inTurn(503, 200);
    await downloadAlone(options, { onState: (state) => states.push(state) });
    assert.deepEqual(states, ["waiting", "loading", "retrying", "waiting", "loading"]);
  });

  test("waits as long as the server requests", async () => {
    const times: number[] = [];
    const options = {
      ...optionsWithFetch(() => {
        times.push(performance.now());
        return Promise.resolve(
          times.length > 1
            ? new Response("bytes")
            : new Response("busy", { status: 503, headers: { "retry-after": "1" } }),
        );
      }),
      retries: 1,
    };
    await downloadAlone(options);
    const [first = 0, second = 0] = times;
    assert.ok(second - first >= 950, `${second - first} ms`);
  });

  test("releases its slot while it waits to retry", async () => {
    const scheduler = new Scheduler(1);
    const order: string[] = [];
    const { options } = inTurn(503, 200);
    const retried = downloadInSlot(
      scheduler,
      { priority: 2 },
      url,
      signal,
      { ...options, backoffMs: 20 },
      listener,
      decoded,
    ).then(() => order.push("retried"));
    const other = downloadInSlot(scheduler, { priority: 1 }, url, signal, ok, listener, decoded).then(() =>
      order.push("other"),
    );
    await Promise.all([retried, other]);
    assert.deepEqual(order, ["other", "retried"]);
  });

  test("reports the bytes as they arrive, and the total if the server states it", async () => {
    const counts: [number, number | undefined][] = [];
    const body = new ReadableStream({
      start(controller) {
        for (const length of [3, 4]) controller.enqueue(new Uint8Array(length));
        controller.close();
      },
    });
    const options = optionsWithFetch(() => Promise.resolve(new Response(body, { headers: { "content-length": "7" } })));
    await downloadAlone(options, { onBytes: (loaded, total) => counts.push([loaded, total]) });
    assert.deepEqual(counts, [
      [0, 7],
      [3, 7],
      [7, 7],
    ]);
  });

  test("ignores the length of a compressed body", async () => {
    const totals = new Set<number | undefined>();
    const options = optionsWithFetch(() =>
      Promise.resolve(new Response("bytes", { headers: { "content-length": "3", "content-encoding": "br" } })),
    );
    await downloadAlone(options, { onBytes: (_, total) => totals.add(total) });
    assert.deepEqual(Array.from(totals), [undefined]);
  });
});

describe("a retry", () => {
  const failure = (status: number, retryAfter?: string) => ({ kind: "http" as const, status, retryAfter });
  const now = Date.parse("2026-01-02T03:04:05Z");

  test("follows temporary failures: a lost connection, a timeout, a busy server", () => {
    assert.equal(retryDelayMs({ kind: "network", status: 0, retryAfter: undefined }, 400, now), 400);
    assert.equal(retryDelayMs({ kind: "timeout", status: 0, retryAfter: undefined }, 400, now), 400);
    for (const status of [408, 425, 429, 500, 502, 503, 504])
      assert.equal(retryDelayMs(failure(status), 400, now), 400, String(status));
  });

  test("does not follow permanent failures", () => {
    for (const status of [400, 401, 403, 404, 410, 416, 501, 505])
      assert.equal(retryDelayMs(failure(status), 400, now), undefined, String(status));
    assert.equal(retryDelayMs({ kind: "limit", status: 0, retryAfter: undefined }, 400, now), undefined);
  });

  test("begins when the server requests, in seconds or at a date, but not before the backoff", () => {
    assert.equal(retryDelayMs(failure(503, "3"), 400, now), 3000);
    assert.equal(retryDelayMs(failure(503, " 0 "), 400, now), 400);
    assert.equal(retryDelayMs(failure(503, "Fri, 02 Jan 2026 03:04:15 GMT"), 400, now), 10_000);
    assert.equal(retryDelayMs(failure(503, "Fri, 02 Jan 2026 03:04:00 GMT"), 400, now), 400);
    assert.equal(retryDelayMs(failure(503, "soon"), 400, now), 400);
  });

  test("does not follow if the server requests a longer delay than the limit", () => {
    assert.equal(retryDelayMs(failure(503, String(maxRetryAfterMs / 1000 + 1)), 400, now), undefined);
  });
});

test("there are more slots if one connection carries all requests", () => {
  for (const protocol of ["h2", "h3", "h3-29"]) assert.equal(slotCountFor(protocol), http2SlotCount);
  for (const protocol of ["http/1.1", "http/1.0", ""]) assert.equal(slotCountFor(protocol), http1SlotCount);
});
