import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { Scheduler } from "../scheduler/scheduler.ts";
import type { AnswerMessage, WorkerMessage } from "../workers/protocol.ts";
import { runJob } from "../workers/worker.ts";
import type { JobWorker } from "../workers/workerPool.ts";
import { WorkerPool } from "../workers/workerPool.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import type { EarlyContent } from "./earlyLoading.ts";
import { EarlyLoading } from "./earlyLoading.ts";

const vectors = join(import.meta.dirname, "../../../vectors/compact-1");
const file = readFileSync(join(vectors, "sphere.png"));
const base = readFileSync(join(vectors, "../compact-2/base.png"));

/** Early loading with one download at a time from a server that gives this answer, and the URLs requested from it. */
function loadingFrom(
  answer: (signal: AbortSignal) => Promise<Response>,
  start = (): JobWorker => {
    throw new DOMException("no workers here", "SecurityError");
  },
  size = 1,
): { early: EarlyLoading; requested: string[] } {
  const requested: string[] = [];
  const workers = new WorkerPool({
    size,
    idleMs: 1,
    decoderUrl: () => undefined,
    start,
    prepareMainThread: () => undefined,
    runOnMainThread: runJob,
  });
  const early = new EarlyLoading(new Scheduler(1), workers, (url, init) => {
    requested.push(url as string);
    assert.ok(init?.signal);
    return answer(init.signal);
  });
  return { early, requested };
}

/**
 * A server that never answers. As fetch does, it rejects when the request is aborted; otherwise the download's timeout
 * would keep the process of the tests alive.
 */
const silence = (signal: AbortSignal): Promise<Response> =>
  new Promise((_, reject) => {
    signal.addEventListener("abort", () => {
      reject(signal.reason as Error);
    });
  });

const request = (url: string, priority = 1) =>
  ({ kind: "patches", url, priority, expectedBytes: file.length }) as const;
/** The patches of a file. */
async function patchesOf(decoded: Promise<EarlyContent>): Promise<readonly PatchBuffers[]> {
  const content = await decoded;
  return "patches" in content ? content.patches : assert.fail("no file of patches");
}
const soon = () => new Promise((resolve) => setTimeout(resolve, 5));

describe("files that are loaded before the runtime", () => {
  test("are requested in the order of their priorities, each once, and can be taken once", async () => {
    const { early, requested } = loadingFrom(() => Promise.resolve(new Response(file)));
    early.request(request("b.png", 1));
    const { isNear, decoded } = early.request(request("a.png", 2));
    assert.equal(early.request(request("a.png", 2)).decoded, decoded);
    await isNear;
    const [patch] = await patchesOf(decoded);
    assert.ok(patch && patch.vertexCount > 0);
    assert.equal((await decoded).byteLength, file.length);
    assert.equal(early.take("a.png"), decoded);
    assert.equal(early.take("a.png"), undefined);
    await early.take("b.png");
    assert.deepEqual(requested, ["a.png", "b.png"]);
  });

  test("are those of a worker that fetches the file itself, and of the page's bytes where it cannot", async () => {
    const answers: Record<string, AnswerMessage> = {
      "by worker": { output: [] },
      "by page": { error: { kind: undefined, message: "the server answered 404" } },
    };
    for (const [name, answer] of Object.entries(answers)) {
      let started = 0;
      const { early, requested } = loadingFrom(
        () => Promise.resolve(new Response(file)),
        () => {
          if (started++ > 0) throw new DOMException("no more workers", "SecurityError");
          const worker: JobWorker = {
            onmessage: null,
            onerror: null,
            postMessage: () => {
              worker.onerror?.({ preventDefault: () => undefined } as ErrorEvent); // then the main thread decodes
            },
            terminate: () => undefined,
          };
          setTimeout(() => worker.onmessage?.({ data: answer } as MessageEvent<AnswerMessage>));
          return worker;
        },
      );
      const { decoded } = early.request(request("a.png"), true);
      assert.deepEqual(
        [(await decoded).byteLength, (await patchesOf(decoded)).length],
        [file.length, name === "by worker" ? 0 : 1],
      );
      assert.deepEqual([requested, started], [["a.png"], 1]);
    }
  });

  test("are those of the page's bytes where the worker's own request stalls", async (context) => {
    context.mock.timers.enable({ apis: ["setTimeout"] });
    const sent: WorkerMessage[] = [];
    const worker: JobWorker = {
      onmessage: null,
      onerror: null,
      postMessage: (message) => sent.push(message),
      terminate: () => undefined,
    };
    const { early } = loadingFrom(
      () => Promise.resolve(new Response(file)),
      () => worker,
      2,
    );
    const { decoded, isNear } = early.request(request("a.png"), true);
    await isNear;
    await new Promise(setImmediate); // the page waits for the worker
    context.mock.timers.tick(2999);
    await new Promise(setImmediate);
    assert.deepEqual(sent, []);
    context.mock.timers.tick(1);
    await new Promise(setImmediate);
    assert.deepEqual(sent, [{ name: "compactPatches", input: new Uint8Array(file) }]);
    worker.onmessage?.({ data: { output: [] } } as MessageEvent<AnswerMessage>);
    assert.deepEqual(await patchesOf(decoded), []);
  });

  test("that still wait are left to the runtime, which has an order of its own", async () => {
    const { early, requested } = loadingFrom(silence);
    early.request(request("a.png", 2));
    const waiting = early.request(request("b.png", 1));
    await soon();
    assert.equal(early.take("b.png"), undefined);
    await assert.rejects(waiting.decoded, { name: "AbortError" });
    assert.deepEqual(requested, ["a.png"]);
    early.dropFiles();
  });

  test("are dropped where the runtime does not need them", async () => {
    const { early } = loadingFrom(silence);
    const started = early.request(request("a.png"));
    const waiting = early.request(request("b.png", 0));
    await soon();
    early.dropFiles();
    await assert.rejects(waiting.decoded, { name: "AbortError" });
    assert.equal(early.take("a.png"), undefined);
    await assert.rejects(started.decoded, { name: "AbortError" });
    assert.notEqual(early.request(request("a.png")).decoded, started.decoded);
    early.dropFiles();
  });

  test("are of three kinds, of which each can be dropped alone", async () => {
    const { early } = loadingFrom(() => Promise.resolve(new Response(base)));
    const group = early.request({ ...request("group.png"), kind: "group" });
    const bytes = early.request({ ...request("index.png"), kind: "bytes" });
    const patches = early.request(request("patches.png"));
    const [groupContent, bytesContent] = await Promise.all([group.decoded, bytes.decoded]);
    assert.ok("group" in groupContent && groupContent.group.hasSegments === true);
    assert.ok("bytes" in bytesContent);
    assert.deepEqual(Buffer.from(bytesContent.bytes), base);
    assert.equal(groupContent.byteLength, base.length);
    await patches.decoded.catch(() => undefined);
    early.dropFiles("patches");
    assert.equal(early.take("patches.png"), undefined);
    assert.equal(early.take("group.png"), group.decoded);
    assert.equal(early.take("index.png"), bytes.decoded);
  });

  test("reject their promises on failure, without unhandled rejections", async () => {
    for (const failure of [
      () => Promise.reject(new TypeError("no network")),
      () => Promise.resolve(new Response("", { status: 404 })),
      () => Promise.resolve(new Response(file.subarray(0, 40))),
    ]) {
      const { early } = loadingFrom(failure);
      const { decoded, isNear } = early.request(request("a.png"));
      await assert.rejects(decoded);
      await isNear;
      await assert.rejects(early.take("a.png") ?? Promise.resolve());
    }
  });
});
