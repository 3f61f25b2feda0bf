// Sites in memory, for tests of requests and of the stages that are delivered.

import assert from "node:assert/strict";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import { decodeDataImage, decodeImage } from "../decode/image.ts";
import { checkImage } from "../decode/imageFile.ts";
import { jobs } from "../decode/jobs.ts";
import { checkPng } from "../decode/png.ts";
import { pngOf } from "../decode/png.testing.ts";
import type { Stage, GpuArray } from "../stage/stage.ts";
import { elementsOf } from "../document/elements.testing.ts";
import type { GeometryDescription } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import { readScene } from "../document/readScene.ts";
import { priorityOf } from "../scheduler/priority.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { unknownViewMetrics } from "../scheduler/viewMetrics.ts";
import { bgDelivery } from "./encodings/bg/bgDelivery.ts";
import { classicDelivery } from "./encodings/classic/classicDelivery.ts";
import { addEncodings } from "./encodings/encodings.ts";
import { liveDelivery } from "./encodings/live/liveDelivery.ts";
import { lateDataImages } from "./lateDataImages.ts";
import { addDeliveries } from "./lateDeliveries.ts";
import { deliverStream } from "./live/streamDelivery.ts";
import { deliverMoving } from "./movingDelivery.ts";
import { SequenceDelivery } from "./sequence/sequenceDelivery.ts";
import type { Delivery, FilePriority } from "./geometryDelivery.ts";
import { deliverGeometry } from "./geometryDelivery.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { ResourcePool } from "./resourcePool.ts";

lateDataImages.add({ check: checkImage, decode: decodeDataImage });
addEncodings({ bg: bgDelivery, classic: classicDelivery, live: liveDelivery });
addDeliveries({
  moving: deliverMoving,
  stream: deliverStream,
  sequence: (...needed) => new SequenceDelivery(...needed),
});

/** A file's bytes, at once or later, or an HTTP status. */
export type Answer = Uint8Array<ArrayBuffer> | number | Promise<Uint8Array<ArrayBuffer>>;

/**
 * A site in memory: its files by name, and a pool that records requests in order, jobs, and the resources it has open.
 */
export function siteOf(files: Record<string, Answer>, slots = 6, readsTextures = true) {
  const requested: string[] = [];
  const aborted: string[] = [];
  const jobNames: string[] = [];
  const images = { open: 0 };
  const textureImages = { open: 0 };
  const arrays = new Map<GpuArray, ElementArray>();
  const scheduler = new Scheduler(slots);
  const answer = async (url: string, signal: AbortSignal): Promise<Response> => {
    const name = url.replace("https://site/", "");
    requested.push(name);
    signal.addEventListener("abort", () => aborted.push(name));
    const file = files[name] ?? 404;
    if (typeof file === "number") return new Response("no", { status: file });
    const bytes = await Promise.race([
      file,
      new Promise<never>((_, reject) => {
        signal.addEventListener("abort", () => {
          reject(signal.reason as Error);
        });
      }),
    ]);
    return new Response(bytes, { headers: { "content-length": String(bytes.length) } });
  };
  const pool = new ResourcePool({
    scheduler,
    makeImage: (png) =>
      decodeImage(png, (): Promise<DecodedImage> => {
        images.open += 1;
        return Promise.resolve({
          ...checkPng(png),
          close: () => {
            images.open -= 1;
          },
        });
      }),
    readsTextures: () => Promise.resolve(readsTextures),
    maxTextureSize: 4096,
    runJob: (name, input) => {
      jobNames.push(name);
      return (jobs[name] as (input: unknown) => Promise<never>)(input);
    },
    runOnMainThread: (name, input) => (jobs[name] as (input: unknown) => Promise<never>)(input),
    makeWritableImage: () => {
      throw new Error("no streams here");
    },
    makeWritableArray: () => {
      throw new Error("no streams here");
    },
    makeTextureImage: ({ bytes }) => {
      textureImages.open += 1;
      return Promise.resolve({
        hasAlpha: false,
        image: {
          ...checkPng(bytes),
          close: () => {
            textureImages.open -= 1;
          },
        },
      });
    },
    storeBytes: (array, _, signal) => {
      signal.throwIfAborted();
      const stored = {
        byteLength: array.byteLength,
        close: () => {
          assert.ok(arrays.delete(stored), "closed twice");
        },
      };
      arrays.set(stored, array);
      return Promise.resolve(stored);
    },
    download: {
      fetch: (url, init) => answer(url as string, init?.signal ?? new AbortController().signal),
      idleTimeoutMs: 20_000,
      retries: 0,
      backoffMs: 1,
    },
    resolve: (url) => new URL(url, "https://site/").href,
    onTransfer: () => undefined,
  });
  /** The array that was stored under a handle. */
  const arrayOf = (stored: { readonly bytes: GpuArray } | undefined) =>
    arrays.get(stored?.bytes ?? assert.fail("no array was delivered")) ?? assert.fail("closed");
  return { requested, aborted, jobs: jobNames, images, textureImages, arrays, arrayOf, scheduler, pool };
}

export interface Recording {
  /** All delivered stages, in order. */
  readonly stages: { patch: number; stage: Stage }[];
  /** The stage that each patch displays now. */
  readonly displayed: Map<number, Stage | undefined>;
  readonly errors: DeliveryError[];
  readonly delivery: Delivery;
  readonly settled: Promise<void>;
}

/** Requests all files, in the order of their content. */
export const everything: FilePriority = (_, file) => priorityOf(1, file.chunk, unknownViewMetrics);

export function record(geometry: GeometryDescription, pool: ResourcePool, filePriority = everything): Recording {
  const stages: Recording["stages"] = [];
  const errors: DeliveryError[] = [];
  const displayed: Recording["displayed"] = new Map();
  let resolve: () => void = () => undefined;
  const settled = new Promise<void>((resolveSettled) => {
    resolve = resolveSettled;
  });
  const delivery = deliverGeometry(geometry, pool, {
    onStage: (patch, stage) => {
      displayed.set(patch, stage);
      if (stage !== undefined) stages.push({ patch, stage });
    },
    onError: (error) => errors.push(error),
    onSettled: () => {
      resolve();
    },
  });
  delivery.request(filePriority);
  return { stages, displayed, errors, delivery, settled };
}

export function geometryOf(markup: string): GeometryDescription {
  const geometry = shapesOf(readScene(elementsOf(`<X3D><Shape>${markup}</Shape></X3D>`)).root)[0]?.geometry;
  assert.ok(geometry);
  return geometry;
}

export const sigPatch = (n: number) => `<GeometryPatch recordCount="500" vertexCount="600" implicitMeshSize="256 4"
  index="i${n}.png" coord='"a${n}.png" "b${n}.png"' normal="n${n}.png"/>`;
export const sigGeometry = (patches: number) =>
  geometryOf(`<ImageGeometry>${Array.from({ length: patches }, (_, n) => sigPatch(n)).join("")}</ImageGeometry>`);
export const records = pngOf({ width: 256, height: 2 });
export const indices = pngOf({ width: 256, height: 4 });

export function sigFiles(patches: number): Record<string, Answer> {
  const files: Record<string, Answer> = {};
  for (let n = 0; n < patches; ++n) {
    Object.assign(files, {
      [`a${n}.png`]: records,
      [`b${n}.png`]: records,
      [`n${n}.png`]: records,
      [`i${n}.png`]: indices,
    });
  }
  return files;
}

/** A file that arrives when `release` is called. */
export function deferredFile(bytes: Uint8Array<ArrayBuffer>) {
  let release: () => void = () => undefined;
  const promise = new Promise<Uint8Array<ArrayBuffer>>((resolve) => {
    release = () => {
      resolve(bytes);
    };
  });
  return { promise, release };
}

/** Long enough for pending microtasks and requests. */
export const shortDelay = () => new Promise((resolve) => setTimeout(resolve, 5));
