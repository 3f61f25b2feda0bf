import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { DecodeError } from "../../decode/decodeError.ts";
import { encodeFrame } from "../../decode/frame/encodeFrame.testing.ts";
import type { FrameHeader } from "../../decode/frame/frameHeader.ts";
import { readFrameHeader } from "../../decode/frame/frameHeader.ts";
import { FrameSource } from "./frameSource.ts";

const rate = 30;
const intervalMs = 1000 / rate;
/** By which the server's clock is ahead of the viewer's. */
const serverClockMs = 123_456_789;
const layout = {
  vertices: 4,
  columns: 2,
  positionBits: 16,
  normalBits: 0,
  colorComponents: 0,
  valueComponents: 0,
  valueBits: 0,
};

interface Line {
  /** Time that a frame takes on the way to the viewer; all frames share the line. */
  readonly frameMs: number;
  /** Whether a cache has kept every response since its frame appeared. */
  readonly isCached?: boolean;
  /** Whether the server knows of the cache, and states when frames appear. */
  readonly isTimed?: boolean;
  /** Times at which the server does not answer. */
  readonly outage?: readonly [from: number, to: number];
  /** FrameSource.setRate. */
  readonly maxRate?: number;
  /** The server's history: requests for earlier frames lead to the newest one. */
  readonly historyFrames?: number;
  /** Times at which the page is too busy to send a request for the frame that it has decided on. */
  readonly busy?: readonly [from: number, to: number];
  /** What the server puts into the header of a frame instead of what it should. */
  readonly wrongly?: (number: number) => Partial<FrameHeader>;
  /** The server comes back from the outage without its streams, and the publisher begins another epoch. */
  readonly epochAfterOutage?: number;
  /** When the first frame of the epoch comes. Before it, the newest frame is of another epoch. */
  readonly firstFrameAt?: number;
}

/** Follows a stream of 30 frames a second for a time, on a simulated clock; returns when each frame was displayed. */
async function follow(line: Line, durationMs: number) {
  const { frameMs, isCached = false, isTimed = false, outage = [0, 0], firstFrameAt = 0 } = line;
  const { historyFrames = Infinity, busy = [0, 0], wrongly = () => ({}), epochAfterOutage = 100 } = line;
  let now = 0;
  let requests = 0;
  let waits = 0;
  let redirects = 0;
  const sleepers: { readonly at: number; readonly wake: () => void }[] = [];
  const sleep = (ms: number, signal?: AbortSignal | null) =>
    new Promise<void>((resolve, reject) => {
      sleepers.push({ at: now + ms, wake: resolve });
      signal?.addEventListener("abort", () => {
        reject(signal.reason as Error);
      });
    });
  const timeOf = (number: number) => firstFrameAt + (number - 100 - shift()) * intervalMs;
  const epoch = () => (outage[1] > 0 && now >= outage[1] ? epochAfterOutage : 100);
  const shift = () => epoch() - 100;
  const newest = () => Math.max(99, 100 + Math.floor((now - firstFrameAt) / intervalMs)) + shift();
  let lineFreeAt = 0;
  const isOut = () => now >= outage[0] && now < outage[1];
  const answer = async (url: string, signal: AbortSignal | null | undefined): Promise<Response> => {
    if (isOut()) throw new TypeError("connection refused");
    if (url.endsWith("/latest")) {
      const box = [
        [0, 0, 0],
        [1, 1, 1],
      ];
      const state = {
        ...layout,
        epoch: epoch(),
        number: newest(),
        next: newest() + 1,
        rate,
        origin: [0, 0, 0],
        step: 1,
        box,
        timed: isTimed,
        now: now + serverClockMs,
        added: timeOf(newest()) + serverClockMs,
      };
      return new Response(JSON.stringify(state));
    }
    let number = Number(url.split("/").at(-1));
    if (now >= busy[0] && now < busy[1]) await sleep(busy[1] - now, signal);
    if (number <= newest() - historyFrames) {
      number = newest();
      redirects += 1;
    }
    if (number > newest() + 8) return new Response(null, { status: 404 });
    if (number > newest()) waits += 1;
    while (number > newest()) await sleep(timeOf(number) - now + 0.01, signal);
    lineFreeAt = Math.max(lineFreeAt, now) + frameMs;
    const headers = {
      "imgeo-added": `${timeOf(number) + serverClockMs}`,
      "imgeo-newest": `${isCached ? number : newest()}`,
      "imgeo-epoch": `${number < 100 ? 50 : epoch()}`,
    };
    const bytes = encodeFrame(
      { ...layout, number, epoch: epoch(), time: 0, prediction: "planar", ...wrongly(number) },
      [1, 2, 3].map((value) => [value, value, value, value]),
    );
    const arrival = sleep(lineFreeAt - now, signal);
    const body = new ReadableStream({
      async pull(controller) {
        await arrival;
        controller.enqueue(bytes);
        controller.close();
      },
    });
    return new Response(body, { headers });
  };
  const displayed: {
    readonly number: number;
    readonly ageMs: number;
    readonly skipped: number;
    readonly at: number;
  }[] = [];
  const outages: Error[] = [];
  let openRequests = 0;
  let maxOpenRequests = 0;
  const source = new FrameSource(
    {
      url: "http://a.example/live/test",
      fetch: async (url, init) => {
        requests += 1;
        openRequests += 1;
        maxOpenRequests = Math.max(maxOpenRequests, openRequests);
        try {
          return await answer(url as string, init?.signal);
        } finally {
          openRequests -= 1;
        }
      },
      // Unpacking would take real time, which the simulated clock does not know.
      decode: (bytes) => Promise.resolve({ header: readFrameHeader(bytes), display: () => undefined }),
      now: () => now,
      delay: sleep,
    },
    {
      onEpoch: () => undefined,
      onFrame: ({ header: { number } }, skipped) => {
        displayed.push({ number, skipped, at: now, ageMs: now - timeOf(number) });
      },
      onOutage: (error) => {
        outages.push(error);
      },
    },
  );
  source.setRate(line.maxRate ?? 0);
  source.start();
  while (now < durationMs) {
    // Real work, such as decoding, takes no simulated time.
    for (let n = 0; n < 4; ++n) await new Promise((resolve) => setImmediate(resolve));
    const next = sleepers.reduce((min, { at }) => Math.min(min, at), now + 5);
    now = Math.max(now, Math.min(next, now + 5));
    for (const sleeper of sleepers.filter(({ at }) => at <= now)) {
      sleepers.splice(sleepers.indexOf(sleeper), 1);
      sleeper.wake();
    }
  }
  source.stop();
  return { displayed, outages, requests, waits, redirects, maxOpenRequests };
}

const maxAge = (frames: readonly { ageMs: number }[]) => Math.max(...frames.slice(5).map(({ ageMs }) => ageMs));

describe("a viewer", () => {
  test("requests a frame that a cache shares when it is there", async () => {
    const { displayed, waits } = await follow({ frameMs: 1, isTimed: true, isCached: true }, 3000);
    assert.ok(displayed.length > 85, `${displayed.length} frames`);
    assert.ok(displayed.every(({ skipped }) => skipped === 0));
    assert.ok(maxAge(displayed) < 12, `age ${maxAge(displayed)} ms`);
    assert.ok(waits <= 2, `${waits} requests came before their frames`);
  });

  test("skips frames that a cache shares on a slow line", async () => {
    const { displayed } = await follow({ frameMs: 60, isTimed: true, isCached: true }, 6000);
    assert.ok(displayed.length > 60, `${displayed.length} frames`);
    assert.ok(maxAge(displayed) < 250, `age ${maxAge(displayed)} ms`);
  });

  test("on a fast line displays every frame", async () => {
    const { displayed, outages, maxOpenRequests } = await follow({ frameMs: 1 }, 3000);
    assert.ok(displayed.length > 85, `${displayed.length} frames`);
    assert.ok(displayed.every(({ skipped }) => skipped === 0));
    assert.ok(maxAge(displayed) < 2 * intervalMs, `age ${maxAge(displayed)} ms`);
    assert.ok(maxOpenRequests <= 3, `${maxOpenRequests} requests at a time`);
    assert.deepEqual(outages, []);
  });

  for (const isCached of [false, true]) {
    test(`on a line too slow for all frames ${isCached ? "behind a cache " : ""}skips, and stays current`, async () => {
      const { displayed } = await follow({ frameMs: 60, isCached }, 6000);
      assert.ok(displayed.length > 60, `${displayed.length} frames`);
      assert.ok(maxAge(displayed) < 320, `age ${maxAge(displayed)} ms`);
      const [first] = displayed;
      const skipped = displayed.slice(1).reduce((sum, frame) => sum + frame.skipped + 1, 0);
      assert.equal(skipped, (displayed.at(-1)?.number ?? 0) - (first?.number ?? 0));
    });
  }

  test("that comes before the first frame of an epoch waits for it", async () => {
    const { displayed, outages, requests } = await follow({ frameMs: 1, firstFrameAt: 500 }, 600);
    assert.equal(displayed[0]?.number, 100);
    assert.ok(requests < 10, `${requests} requests`);
    assert.deepEqual(outages, []);
  });

  test("whose frame is gone when the server gets the request goes on with the newest at once", async () => {
    const line = { frameMs: 1, historyFrames: 30, busy: [1000, 2500] } as const;
    const { displayed, outages, redirects } = await follow(line, 4000);
    assert.ok(redirects > 0, "no frame was gone");
    const next = displayed.find(({ at }) => at >= 2500);
    assert.ok(next !== undefined && next.at < 2600 && next.ageMs < 2 * intervalMs, JSON.stringify(next));
    const skipped = displayed.slice(1).reduce((sum, frame) => sum + frame.skipped + 1, 0);
    assert.equal(skipped, (displayed.at(-1)?.number ?? 0) - (displayed[0]?.number ?? 0));
    assert.deepEqual(outages, []);
  });

  test("reports an outage once, and goes on by itself", async () => {
    const { displayed, outages } = await follow({ frameMs: 1, outage: [1000, 4000] }, 9000);
    assert.equal(outages.length, 1);
    assert.ok(displayed.some(({ at }) => at < 1000) && displayed.some(({ at }) => at > 4000));
    assert.ok(!displayed.some(({ at }) => at > 1100 && at < 4000));
  });

  test("goes on with the epoch of a server that was started again", async () => {
    for (const epochAfterOutage of [50_000, 50]) {
      const line = { frameMs: 1, outage: [1000, 2500], epochAfterOutage } as const;
      const { displayed, outages } = await follow(line, 7000);
      assert.equal(outages.length, 1);
      const last = displayed.at(-1);
      assert.ok(last !== undefined && last.at > 6900 && last.ageMs < 2 * intervalMs, JSON.stringify(last));
      assert.ok(displayed.every(({ number, at }) => at < 2500 === number < 1000 || epochAfterOutage < 1000));
    }
  });

  test("reports frames that are not those that it asked for once, displays none, and asks rarely", async () => {
    for (const wrongly of [
      (number: number) => ({ number: number - 1 }), // repeated, or out of order
      () => ({ vertices: 8 }),
      () => ({ columns: 4 }),
      () => ({ epoch: 50 }),
    ]) {
      const { displayed, outages, requests } = await follow({ frameMs: 1, wrongly }, 6000);
      assert.deepEqual(displayed, []);
      assert.equal(outages.length, 1);
      assert.equal((outages[0] as DecodeError).kind, "malformed");
      assert.ok(requests < 40, `${requests} requests in 6 s`);
    }
  });

  test("displays at most the frames that it wants, each the newest one", async () => {
    const { displayed, outages } = await follow({ frameMs: 1, maxRate: 5 }, 4000);
    assert.ok(displayed.length >= 16 && displayed.length <= 21, `${displayed.length} frames in 4 s`);
    assert.ok(maxAge(displayed) < 2 * intervalMs, `age ${maxAge(displayed)} ms`);
    const skipped = displayed.slice(1).reduce((sum, frame) => sum + frame.skipped + 1, 0);
    assert.equal(skipped, (displayed.at(-1)?.number ?? 0) - (displayed[0]?.number ?? 0));
    assert.deepEqual(outages, []);
  });
});
