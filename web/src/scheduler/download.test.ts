import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { DownloadOptions, DownloadState } from "./download.ts";
import { downloadInSlot, RequestError } from "./download.ts";
import { optionsWithFetch, decoded, listener, ok, unanswered, subject, url } from "./download.testing.ts";
import { maxRetryAfterMs, retryDelayMs } from "./retry.ts";
import { Scheduler } from "./scheduler.ts";
import { slotCountFor, http1SlotCount, http2SlotCount } from "./downloadSlots.ts";

describe("a download", () => {
  const { signal } = new AbortController();

  /** Answers with each status in turn, the last one for ever. */
  function inTurn(...codes: number[]): { options: DownloadOptions; asked: () => number } {
    let asked = 0;
    return {
      options: {
        ...optionsWithFetch(() => {
          const code = codes[Math.min(asked, codes.length - 1)] ?? 200;
          asked += 1;
          return code === 0
            ? Promise.reject(new TypeError("fetch failed"))
            : Promise.resolve(new Response("bytes", { status: code }));
        }),
        retries: 2,
      },
      asked: () => asked,
    };
  }

  test("is tried again after a network error and after 5xx", async () => {
    const { options, asked } = inTurn(0, 503, 200);
    assert.equal(await downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, decoded), 5);
    assert.equal(asked(), 3);
  });

  test("gives up after the last retry", async () => {
    const { options, asked } = inTurn(503);
    await assert.rejects(
      downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, decoded),
      (error) => error instanceof RequestError && error.kind === "http" && error.status === 503 && error.url === url,
    );
    assert.equal(asked(), 3);
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
    await assert.rejects(downloadInSlot(new Scheduler(1), subject, url, signal, timed, listener, decoded));
    const [first = 0, second = 0, third = 0] = times;
    // Timers may be late, and early by the fraction of a millisecond that they round away.
    assert.ok(second - first > 19 && third - second > 39, `${second - first} and ${third - second} ms`);
  });

  test("of which no byte comes is given up as one that has fallen silent, and tried again", async () => {
    let asked = 0;
    const options: DownloadOptions = {
      ...unanswered,
      idleTimeoutMs: 5,
      retries: 1,
      fetch: (input, init) => {
        asked += 1;
        return unanswered.fetch(input, init);
      },
    };
    await assert.rejects(
      downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, decoded),
      (error) => error instanceof RequestError && error.kind === "timeout" && error.url === url,
    );
    assert.equal(asked, 2);
  });

  for (const code of [404, 410, 416]) {
    test(`is final after ${code}`, async () => {
      const { options, asked } = inTurn(code);
      await assert.rejects(downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, decoded));
      assert.equal(asked(), 1);
    });
  }

  test("is not asked for again when its bytes do not decode", async () => {
    const { options, asked } = inTurn(200);
    await assert.rejects(
      downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, () =>
        Promise.reject(new Error("no image")),
      ),
    );
    assert.equal(asked(), 1);
  });

  test("tells where it stands", async () => {
    const states: DownloadState[] = [];
    const { options } = inTurn(503, 200);
    await downloadInSlot(
      new Scheduler(1),
      subject,
      url,
      signal,
      options,
      { ...listener, onState: (state) => states.push(state) },
      decoded,
    );
    assert.deepEqual(states, ["waiting", "loading", "retrying", "waiting", "loading"]);
  });

  test("waits as long as the server asks for", async () => {
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
    await downloadInSlot(new Scheduler(1), subject, url, signal, options, listener, decoded);
    const [first = 0, second = 0] = times;
    assert.ok(second - first >= 950, `${second - first} ms`);
  });

  test("lets another job have its slot while it waits to retry", async () => {
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

  test("counts the bytes as they come and knows the total where the server tells it", async () => {
    const counts: [number, number | undefined][] = [];
    const body = new ReadableStream({
      start(controller) {
        for (const length of [3, 4]) controller.enqueue(new Uint8Array(length));
        controller.close();
      },
    });
    const options = optionsWithFetch(() => Promise.resolve(new Response(body, { headers: { "content-length": "7" } })));
    await downloadInSlot(
      new Scheduler(1),
      subject,
      url,
      signal,
      options,
      { ...listener, onBytes: (loaded, total) => counts.push([loaded, total]) },
      decoded,
    );
    assert.deepEqual(counts, [
      [0, 7],
      [3, 7],
      [7, 7],
    ]);
  });

  test("does not take the length of a compressed body for its own", async () => {
    const totals = new Set<number | undefined>();
    const options = optionsWithFetch(() =>
      Promise.resolve(new Response("bytes", { headers: { "content-length": "3", "content-encoding": "br" } })),
    );
    await downloadInSlot(
      new Scheduler(1),
      subject,
      url,
      signal,
      options,
      { ...listener, onBytes: (_, total) => totals.add(total) },
      decoded,
    );
    assert.deepEqual(Array.from(totals), [undefined]);
  });
});

describe("another attempt", () => {
  const failure = (status: number, retryAfter?: string) => ({ kind: "http" as const, status, retryAfter });
  const now = Date.parse("2026-01-02T03:04:05Z");

  test("follows what passes: a lost connection, silence, a busy server", () => {
    assert.equal(retryDelayMs({ kind: "network", status: 0, retryAfter: undefined }, 400, now), 400);
    assert.equal(retryDelayMs({ kind: "timeout", status: 0, retryAfter: undefined }, 400, now), 400);
    for (const status of [408, 425, 429, 500, 502, 503, 504])
      assert.equal(retryDelayMs(failure(status), 400, now), 400, String(status));
  });

  test("does not follow what stays", () => {
    for (const status of [400, 401, 403, 404, 410, 416, 501, 505])
      assert.equal(retryDelayMs(failure(status), 400, now), undefined, String(status));
    assert.equal(retryDelayMs({ kind: "limit", status: 0, retryAfter: undefined }, 400, now), undefined);
  });

  test("comes when the server says, in seconds or at a date, but not before its own time", () => {
    assert.equal(retryDelayMs(failure(503, "3"), 400, now), 3000);
    assert.equal(retryDelayMs(failure(503, " 0 "), 400, now), 400);
    assert.equal(retryDelayMs(failure(503, "Fri, 02 Jan 2026 03:04:15 GMT"), 400, now), 10_000);
    assert.equal(retryDelayMs(failure(503, "Fri, 02 Jan 2026 03:04:00 GMT"), 400, now), 400);
    assert.equal(retryDelayMs(failure(503, "soon"), 400, now), 400);
  });

  test("never comes where the server asks for more than people wait", () => {
    assert.equal(retryDelayMs(failure(503, String(maxRetryAfterMs / 1000 + 1)), 400, now), undefined);
  });
});

test("there are more slots where one connection carries all requests", () => {
  for (const protocol of ["h2", "h3", "h3-29"]) assert.equal(slotCountFor(protocol), http2SlotCount);
  for (const protocol of ["http/1.1", "http/1.0", ""]) assert.equal(slotCountFor(protocol), http1SlotCount);
});
