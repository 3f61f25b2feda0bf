// The resource pool of a page's view: files from the network, images and arrays in the view's WebGL context, decoding
// in the page's workers.

import type { RunJob } from "../decode/jobs.ts";
import { ResourcePool } from "../delivery/resourcePool.ts";
import type { EarlyLoading } from "../preview/earlyLoading.ts";
import { takePrefetchedBases, takePrefetchedGroup } from "../preview/previewRegistry.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import { defaultDownloadOptions } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import { UploadPipeline } from "../viewer/uploadPipeline.ts";
import type { WorkerPool } from "../workers/workerPool.ts";

export interface PagePoolOptions {
  /** What a preview has loaded. */
  readonly early: Pick<EarlyLoading, "take"> | undefined;
  /** Whether shaders read vertices from images. */
  readonly readsTextures: () => boolean;
  /** Called whenever a transfer has changed. */
  readonly onTransfer: () => void;
}

export function makePagePool(
  renderer: SceneRenderer,
  scheduler: Scheduler,
  workers: WorkerPool,
  { early, readsTextures, onTransfer }: PagePoolOptions,
): ResourcePool {
  const runJob: RunJob = (name, input, signal) => workers.run(name, input, signal);
  const uploads = new UploadPipeline(renderer, runJob);
  return new ResourcePool({
    scheduler,
    makeImage: (png, signal) => uploads.makeImage(png, signal),
    readsTextures: () => Promise.resolve(readsTextures()),
    maxTextureSize: renderer.uploads.maxTextureSize,
    runJob,
    runOnMainThread: (name, input, signal) => workers.runOnMainThread(name, input, signal),
    makeTextureImage: (file, sampling, signal) => uploads.makeTextureImage(file, sampling, signal),
    makeWritableImage: (width, height) => renderer.uploads.makeWritableImage(width, height),
    makeWritableArray: (array) => renderer.uploads.makeWritableArray(array),
    storeBytes: (array, use, signal) => uploads.storeBytes(array, use, signal),
    download: defaultDownloadOptions,
    prefetched: (kind, url) => {
      if (kind === "bases") return takePrefetchedBases(url);
      return (kind === "group" ? takePrefetchedGroup(url) : undefined) ?? early?.take(url);
    },
    resolve: absoluteUrlOf,
    onTransfer,
  });
}

/** Returns an invalid URL unchanged: its request fails with a message. */
export function absoluteUrlOf(url: string): string {
  return URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).href : url;
}
