// Sites in memory, for tests of what is asked of them and what comes of it.

import assert from "node:assert/strict";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import { decodeImage } from "../decode/image.ts";
import { jobs } from "../decode/jobs.ts";
import { checkPng } from "../decode/png.ts";
import { pngOf } from "../decode/png.testing.ts";
import type { Stage, StoredBytes } from "../stage/stage.ts";
import { elementsOf } from "../document/elements.testing.ts";
import type { GeometryDescription } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import { readScene } from "../document/readScene.ts";
import { priorityOf } from "../scheduler/priority.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { unknownViewMetrics } from "../scheduler/viewMetrics.ts";
import type { Delivery, FilePriority } from "./geometryDelivery.ts";
import { deliverGeometry } from "./geometryDelivery.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { ResourcePool } from "./resourcePool.ts";

export type Answer = Uint8Array<ArrayBuffer> | number | Promise<Uint8Array<ArrayBuffer>>;

/** A site in memory: its files, what was asked for in order, and what was delivered. */
export function siteOf(files: Record<string, Answer>, slots = 6, readsTextures = true) {
  const asked: string[] = [];
  const aborted: string[] = [];
  const done: string[] = [];
  const images = { open: 0 };
  const pictures = { open: 0 };
  const arrays = new Map<StoredBytes, ElementArray>();
  const scheduler = new Scheduler(slots);
  const answer = async (url: string, signal: AbortSignal): Promise<Response> => {
    const name = url.replace("https://site/", "");
    asked.push(name);
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
      done.push(name);
      return (jobs[name] as (input: unknown) => Promise<never>)(input);
    },
    runOnMainThread: (name, input) => (jobs[name] as (input: unknown) => Promise<never>)(input),
    makePicture: (png) => {
      pictures.open += 1;
      return Promise.resolve({
        hasAlpha: false,
        image: {
          ...checkPng(png),
          close: () => {
            pictures.open -= 1;
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
      idleTimeoutMs: 1000,
      retries: 0,
      backoffMs: 1,
    },
    resolve: (url) => new URL(url, "https://site/").href,
    onTransfer: () => undefined,
  });
  /** What has been stored. */
  const arrayOf = (stored: { readonly bytes: StoredBytes } | undefined) =>
    arrays.get(stored?.bytes ?? assert.fail("nothing there")) ?? assert.fail("closed");
  return { asked, aborted, jobs: done, images, pictures, arrays, arrayOf, scheduler, pool };
}

export interface Recording {
  /** Those that were shown. */
  readonly stages: { patch: number; stage: Stage }[];
  /** What each patch shows now. */
  readonly shown: Map<number, Stage | undefined>;
  readonly errors: DeliveryError[];
  readonly delivery: Delivery;
  readonly settled: Promise<void>;
}

/** Everything, in the order of what files hold. */
export const everything: FilePriority = (_, part) => priorityOf(1, part.chunk, unknownViewMetrics);

export function record(geometry: GeometryDescription, pool: ResourcePool, demand = everything): Recording {
  const stages: Recording["stages"] = [];
  const errors: DeliveryError[] = [];
  const shown: Recording["shown"] = new Map();
  let resolve: () => void = () => undefined;
  const settled = new Promise<void>((done) => {
    resolve = done;
  });
  const delivery = deliverGeometry(geometry, pool, {
    onStage: (patch, stage) => {
      shown.set(patch, stage);
      if (stage !== undefined) stages.push({ patch, stage });
    },
    onError: (error) => errors.push(error),
    onSettled: () => {
      resolve();
    },
  });
  delivery.request(demand);
  return { stages, shown, errors, delivery, settled };
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

/** A promise and the function that fulfils it. */
export function held(bytes: Uint8Array<ArrayBuffer>) {
  let release: () => void = () => undefined;
  const promise = new Promise<Uint8Array<ArrayBuffer>>((resolve) => {
    release = () => {
      resolve(bytes);
    };
  });
  return { promise, release };
}

export const soon = () => new Promise((resolve) => setTimeout(resolve, 5));
