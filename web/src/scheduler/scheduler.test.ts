import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { downloadInSlot } from "./download.ts";
import { optionsWithFetch, decoded, listener, ok, unanswered, status, subject, url } from "./download.testing.ts";
import { Scheduler } from "./scheduler.ts";

/** Every way in which a job can end. */
const outcomes: Record<string, (scheduler: Scheduler, aborter: AbortController) => Promise<unknown>> = {
  ok: (scheduler, { signal }) => downloadInSlot(scheduler, subject, url, signal, ok, listener, decoded),
  "404": (scheduler, { signal }) => downloadInSlot(scheduler, subject, url, signal, status(404), listener, decoded),
  "416": (scheduler, { signal }) => downloadInSlot(scheduler, subject, url, signal, status(416), listener, decoded),
  "503": (scheduler, { signal }) => downloadInSlot(scheduler, subject, url, signal, status(503), listener, decoded),
  "503 with retries": (scheduler, { signal }) =>
    downloadInSlot(scheduler, subject, url, signal, { ...status(503), retries: 2 }, listener, decoded),
  "network error": (scheduler, { signal }) =>
    downloadInSlot(
      scheduler,
      subject,
      url,
      signal,
      optionsWithFetch(() => Promise.reject(new TypeError("fetch failed"))),
      listener,
      decoded,
    ),
  "connection lost during the body": (scheduler, { signal }) => {
    const body = new ReadableStream({
      pull(controller) {
        controller.enqueue(new Uint8Array(3));
        controller.error(new TypeError("terminated"));
      },
    });
    return downloadInSlot(
      scheduler,
      subject,
      url,
      signal,
      optionsWithFetch(() => Promise.resolve(new Response(body))),
      listener,
      decoded,
    );
  },
  silence: (scheduler, { signal }) =>
    downloadInSlot(scheduler, subject, url, signal, { ...unanswered, idleTimeoutMs: 5 }, listener, decoded),
  "abort before the request": (scheduler, aborter) => {
    aborter.abort();
    return downloadInSlot(scheduler, subject, url, aborter.signal, ok, listener, decoded);
  },
  "abort while queued": (scheduler, aborter) => {
    const result = downloadInSlot(scheduler, subject, url, aborter.signal, ok, listener, decoded);
    aborter.abort(); // nothing starts before this turn of the event loop ends
    return result;
  },
  "abort while running": (scheduler, aborter) => {
    const result = downloadInSlot(scheduler, subject, url, aborter.signal, unanswered, listener, decoded);
    setTimeout(() => {
      aborter.abort();
    }, 2);
    return result;
  },
  "abort while waiting to retry": (scheduler, aborter) => {
    const result = downloadInSlot(
      scheduler,
      subject,
      url,
      aborter.signal,
      { ...status(503), retries: 1, backoffMs: 1000 },
      listener,
      decoded,
    );
    setTimeout(() => {
      aborter.abort();
    }, 5);
    return result;
  },
  "abort twice": (scheduler, aborter) => {
    const result = downloadInSlot(scheduler, subject, url, aborter.signal, unanswered, listener, decoded);
    setTimeout(() => {
      aborter.abort();
      aborter.abort();
    }, 2);
    return result;
  },
  "synchronous throw of the job": (scheduler, { signal }) =>
    scheduler.run(subject, signal, () => {
      throw new Error("at once");
    }),
  "synchronous throw of fetch": (scheduler, { signal }) =>
    downloadInSlot(
      scheduler,
      subject,
      url,
      signal,
      optionsWithFetch(() => {
        throw new Error("at once");
      }),
      listener,
      decoded,
    ),
  "decode error": (scheduler, { signal }) =>
    downloadInSlot(scheduler, subject, url, signal, ok, listener, () => Promise.reject(new Error("no image"))),
  "synchronous throw of the decoder": (scheduler, { signal }) =>
    downloadInSlot(scheduler, subject, url, signal, ok, listener, () => {
      throw new Error("no image");
    }),
  "throw of the byte counter": (scheduler, { signal }) =>
    downloadInSlot(
      scheduler,
      subject,
      url,
      signal,
      ok,
      {
        ...listener,
        onBytes: () => {
          throw new Error("no bar");
        },
      },
      decoded,
    ),
};

/** The number of free slots: as many jobs start together. */
async function freeSlots(scheduler: Scheduler): Promise<number> {
  const aborter = new AbortController();
  let started = 0;
  const jobs = Array.from({ length: scheduler.slotCount + 2 }, () =>
    scheduler.run(subject, aborter.signal, (signal) => {
      started += 1;
      return new Promise((_, reject) => {
        signal.addEventListener("abort", () => {
          reject(signal.reason as Error);
        });
      });
    }),
  );
  await new Promise((resolve) => setTimeout(resolve, 0));
  aborter.abort();
  await Promise.allSettled(jobs);
  return started;
}

describe("a slot is released exactly once", () => {
  for (const [name, run] of Object.entries(outcomes)) {
    test(`after: ${name}`, async () => {
      const scheduler = new Scheduler(2);
      const results = await Promise.allSettled([1, 2, 3, 4].map(() => run(scheduler, new AbortController())));
      assert.ok(results.every((result) => result.status === (name === "ok" ? "fulfilled" : "rejected")));
      assert.equal(scheduler.runningCount, 0);
      assert.equal(scheduler.waitingCount, 0);
      assert.equal(await freeSlots(scheduler), 2);
    });
  }

  test("after all of them at once, in any order", async () => {
    const scheduler = new Scheduler(3);
    await Promise.allSettled(
      Object.values(outcomes)
        .flatMap((run) => [run, run])
        .map((run) => run(scheduler, new AbortController())),
    );
    assert.equal(scheduler.runningCount, 0);
    assert.equal(await freeSlots(scheduler), 3);
  });
});

describe("jobs", () => {
  const { signal } = new AbortController();

  /** Runs jobs of these priorities in one slot and returns their order; `before` runs while all are waiting. */
  async function orderOf(
    priorities: readonly number[],
    before?: (scheduler: Scheduler, subjects: { priority: number }[]) => void,
  ): Promise<number[]> {
    const scheduler = new Scheduler(1);
    const order: number[] = [];
    const subjects = priorities.map((priority) => ({ priority }));
    const jobs = subjects.map((each, index) => scheduler.run(each, signal, () => Promise.resolve(order.push(index))));
    before?.(scheduler, subjects);
    await Promise.all(jobs);
    return order;
  }

  test("run by priority, those of equal priority in their order", async () => {
    assert.deepEqual(await orderOf([0, 1, 0, 2, 1, 2]), [3, 5, 1, 4, 0, 2]);
  });

  test("are reordered while they wait", async () => {
    assert.deepEqual(
      await orderOf([3, 2, 1], (scheduler, [first, , last]) => {
        Object.assign(first ?? {}, { priority: 0 });
        Object.assign(last ?? {}, { priority: 9 });
        scheduler.reorder();
      }),
      [2, 1, 0],
    );
  });

  test("keep their order until `reorder` is called", async () => {
    assert.deepEqual(
      await orderOf([3, 2], (_, [first]) => {
        Object.assign(first ?? {}, { priority: 0 });
      }),
      [0, 1],
    );
  });

  test("use all slots, and never more", async () => {
    const scheduler = new Scheduler(3);
    let maxRunning = 0;
    await Promise.all(
      Array.from({ length: 20 }, () =>
        scheduler.run(subject, signal, async () => {
          maxRunning = Math.max(maxRunning, scheduler.runningCount);
          await new Promise((resolve) => setTimeout(resolve, 1));
        }),
      ),
    );
    assert.equal(maxRunning, 3);
    assert.equal(scheduler.startedCount, 20);
  });

  test("use additional slots at once, and give up removed slots when they end", async () => {
    const scheduler = new Scheduler(1);
    const pause = () => new Promise((resolve) => setTimeout(resolve, 5));
    const jobs = Array.from({ length: 12 }, () => scheduler.run(subject, signal, pause));
    await Promise.resolve();
    scheduler.slotCount = 4;
    await Promise.resolve();
    assert.equal(scheduler.runningCount, 4);
    scheduler.slotCount = 2;
    assert.equal(scheduler.runningCount, 4);
    await jobs[4];
    assert.equal(scheduler.runningCount, 2);
    await Promise.all(jobs);
    assert.equal(await freeSlots(scheduler), 2);
  });

  test("that are aborted while they wait never start, and others run", async () => {
    const scheduler = new Scheduler(1);
    const aborter = new AbortController();
    const ran: string[] = [];
    const job = (name: string) => () => Promise.resolve(ran.push(name));
    const first = scheduler.run(subject, signal, job("first"));
    const aborted = scheduler.run(subject, aborter.signal, job("aborted"));
    const last = scheduler.run(subject, signal, job("last"));
    aborter.abort(new Error("removed"));
    await assert.rejects(aborted, { message: "removed" });
    await Promise.all([first, last]);
    assert.deepEqual(ran, ["first", "last"]);
  });

  test("are reordered, aborted and run by the ten thousands", async () => {
    const scheduler = new Scheduler(6);
    const count = 20_000;
    const aborters = Array.from({ length: count }, () => new AbortController());
    const subjects = aborters.map((_, n) => ({ priority: (n * 7919) % count }));
    let ran = 0;
    const jobs = subjects.map((each, n) =>
      scheduler.run(each, aborters[n]?.signal ?? signal, () => {
        ran += 1;
        if (ran % 100 === 0) {
          for (const other of subjects) other.priority = (other.priority * 31) % count;
          scheduler.reorder();
        }
        return Promise.resolve();
      }),
    );
    aborters.forEach((aborter, n) => {
      if (n % 2 === 1) aborter.abort();
    });
    await Promise.allSettled(jobs);
    // If a list were sorted or searched for each job, this would take minutes.
    assert.equal(ran, count / 2);
  });
});

describe("the transfer window of a scheduler", () => {
  /** Starts jobs that never end, each with this much to receive; `started` has the names of those that run. */
  function startedWith(remaining: readonly number[]) {
    const scheduler = new Scheduler(6);
    const { signal } = new AbortController();
    const started: number[] = [];
    const subjects = remaining.map((remainingBytes) => ({ priority: 1, remainingBytes }));
    subjects.forEach((subject, n) => {
      void scheduler.run(subject, signal, () => {
        started.push(n);
        return new Promise(() => undefined);
      });
    });
    return { scheduler, subjects, started };
  }
  const soon = () => new Promise((resolve) => setTimeout(resolve, 5));

  test("lets a download wait while those that run have enough to receive", async () => {
    const { scheduler, subjects, started } = startedWith([200_000, 200_000, 200_000]);
    await soon();
    assert.deepEqual(started, [0]);
    const [first] = subjects;
    assert.ok(first);
    first.remainingBytes = 20_000;
    scheduler.onBytes(first);
    await soon();
    assert.deepEqual(started, [0, 1]);
  });

  test("lets small files have all slots", async () => {
    const { started } = startedWith([8000, 8000, 8000, 8000, 8000, 8000, 8000]);
    await soon();
    assert.equal(started.length, 6);
  });

  test("does not wait for a download that receives nothing", async () => {
    const { started } = startedWith([200_000, 200_000]);
    await new Promise((resolve) => setTimeout(resolve, 700));
    assert.deepEqual(started, [0, 1]);
  });
});
