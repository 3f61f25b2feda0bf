import assert from "node:assert/strict";
import { test } from "node:test";
import type { ShapeDescription } from "../document/description.ts";
import type { Preview } from "../preview/preview.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { PageResources } from "./pageResources.ts";

/** What a page with a preview of `previewedCount` shapes loads with; `calls` has what workers and preview are told. */
function makeResources(previewedCount: number) {
  const calls: string[] = [];
  const record = (call: string) => (argument?: string | number) => {
    calls.push(argument === undefined ? call : `${call} ${argument}`);
  };
  const scheduler = new Scheduler(1);
  const workers = {
    prepare: record("prepare workers"),
    prepareMainThread: record("prepare main thread"),
    requestDecoder: record("request decoder"),
    dispose: record("dispose workers"),
  };
  const preview = {
    shapes: Array.from({ length: previewedCount }, () => ({})),
    early: { scheduler, workers, dropFiles: record("drop files"), take: () => undefined },
  } as unknown as Pick<Preview, "shapes" | "early">;
  const renderer = { uploads: { maxTextureSize: 16 } } as unknown as SceneRenderer;
  const options = { readsTextures: () => true, onTransfer: () => undefined };
  return { resources: new PageResources(renderer, preview, options), scheduler, calls };
}

test("a page takes over the scheduler of its preview, and counts the requests of both", async () => {
  const { resources, scheduler } = makeResources(1);
  assert.ok(scheduler.slotCount > 1);
  assert.deepEqual(resources.counts, { requests: 0, openRequests: 0 });
  const { signal } = new AbortController();
  const request = scheduler.run({ priority: 1 }, signal, () => Promise.resolve());
  assert.deepEqual(resources.counts, { requests: 0, openRequests: 1 });
  await request;
  await Promise.resolve();
  assert.deepEqual(resources.counts, { requests: 1, openRequests: 0 });
});

test("workers are prepared when files are requested, and files of the preview that are not needed are dropped", () => {
  const { resources, calls } = makeResources(1);
  resources.prepare({ workerJobCount: 3, hasCompact: true });
  assert.deepEqual(calls, ["drop files patches", "prepare workers 3", "request decoder"]);
  resources.onComplete();
  resources.dispose();
  assert.deepEqual(calls.slice(3), ["drop files", "dispose workers"]);
});

test("the main thread is prepared for bases, unless a preview has decoded them", () => {
  const shapeWithBase = { geometry: { base: {} } } as unknown as ShapeDescription;
  const shapes = new Map([[shapeWithBase.element, shapeWithBase]]);
  for (const [previewedCount, expected] of [
    [0, ["prepare main thread"]],
    [1, []],
  ] as const) {
    const { resources, calls } = makeResources(previewedCount);
    resources.prepareBases({ shapes, removed: [], instances: new Map() });
    assert.deepEqual(calls, expected);
  }
});
