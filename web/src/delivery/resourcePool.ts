// One download per URL, however many patches and shapes use it. A resource lives while there is a handle to it: with
// the last handle its download is aborted, or its image freed. Downloaded bytes are freed sooner: once all handles have
// taken what they need.

import type { BaseBuffers } from "../decode/compact/baseBuffers.ts";
import type { LevelGroup } from "../decode/compact/levelGroup.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import type { DataImage } from "../decode/image.ts";
import { checkImage } from "../decode/imageFile.ts";
import type { DecodedImage, WritableImage } from "../stage/decodedImage.ts";
import type { GpuValues, GpuVertices, NormalFormat, WritableArray } from "../stage/stage.ts";
import type { ElementArray, IndexArray } from "../stage/vertexArray.ts";
import type { InputOf, JobName, OutputOf, RunJob } from "../decode/jobs.ts";
import type { SamplingDescription } from "../document/description.ts";
import { ByteSemaphore } from "../scheduler/byteSemaphore.ts";
import type { DownloadOptions } from "../scheduler/download.ts";
import { downloadInSlot } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import type { StoreBytes } from "./arrayUploads.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError, joinedError } from "./deliveryError.ts";
import type { Transfer } from "./progress.ts";

export type Content =
  | ({ readonly kind: "image" } & DataImage)
  | ({ readonly kind: "textureImage" } & TextureImage)
  | { readonly kind: "bytes"; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: "live"; readonly vertices: LiveVertices }
  | { readonly kind: "patches"; readonly patches: readonly PatchBuffers[] }
  | { readonly kind: "bases"; readonly bases: readonly BaseBuffers[] }
  | { readonly kind: "group"; readonly group: LevelGroup };

/**
 * The form that a file is decoded to: a texture, its own bytes (of any file, or of an image), or either, as the GPU
 * allows; a texture image; or all
 * patches or base meshes that it holds, or the group of triangles of a level of detail, which a job decodes; or what frames of a live stream fill (live/).
 */
export type ContentTarget =
  | { readonly kind: "live" }
  | { readonly kind: "texture" | "bytes" | "imageBytes" | "either" }
  | { readonly kind: "textureImage"; readonly sampling: SamplingDescription }
  | { readonly kind: "patches"; readonly job: FileJob<PatchBuffers[]> }
  | { readonly kind: "bases"; readonly job: FileJob<BaseBuffers[]> }
  | { readonly kind: "group"; readonly job: FileJob<LevelGroup> };

/** The images or arrays that frames of a live stream fill. */
export type LiveVertices = LiveImages | LiveArrays;

export interface LiveImages {
  readonly kind: "images";
  readonly coord: readonly DecodedImage[];
  readonly normal: DecodedImage | undefined;
  readonly color: DecodedImage | undefined;
  readonly value: readonly DecodedImage[];
  /** On the GPU. */
  readonly byteLength: number;
}

export interface LiveArrays {
  readonly kind: "arrays";
  readonly vertexCount: number;
  /** Size of the image that the coordinates would have, whose columns and rows an index may name. */
  readonly width: number;
  readonly height: number;
  readonly coord: GpuVertices;
  readonly normal: GpuVertices | undefined;
  readonly normalFormat: NormalFormat;
  readonly color: GpuVertices | undefined;
  readonly value: GpuValues | undefined;
  readonly byteLength: number;
  /**
   * Makes `normal` follow from these triangles, in the displayed frame and all later ones. Rejects when the stream
   * ends.
   */
  deriveNormals(index: IndexArray): Promise<void>;
}

/** The jobs that turn the bytes of a file into an Output. */
type FileJob<Output> = {
  [Name in JobName]: OutputOf<Name> extends Output
    ? Uint8Array<ArrayBuffer> extends InputOf<Name>
      ? Name
      : never
    : never;
}[JobName];

/** A texture image, of any format that the browser decodes. */
export interface TextureImage {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

/** Decodes a texture image and uploads it. Rejects with DecodeError, or with the signal's reason. */
export type MakeTextureImage = (
  bytes: Uint8Array<ArrayBuffer>,
  sampling: SamplingDescription,
  signal: AbortSignal,
) => Promise<TextureImage>;

export type ResourceRequest = ContentTarget & {
  /** The URL as the document writes it, without its fragment. */
  readonly url: string;
  /** Requested in order where the content of `url` cannot be loaded or decoded. */
  readonly furtherUrls?: readonly string[] | undefined;
  /** Files of larger priority are requested first. Of several handles of a file the largest priority counts. */
  readonly priority: number;
  /** Estimated size of the file until the server states it; for patches and bases, of what this handle needs of it. */
  readonly expectedBytes: number;
};

export interface ResourceHandle {
  readonly transfer: Readonly<Transfer>;
  /** Rejects with RequestError, DecodeError, or an AbortError after the last release. To be read before `finish`. */
  readonly content: Promise<Content>;
  setPriority(priority: number): void;
  /** Marks the transfer as failed: the content is invalid. */
  fail(error: unknown): void;
  /**
   * The caller does not read the content again. An image stays until `release`; a later handle downloads bytes again.
   */
  finish(): void;
  release(): void;
}

export interface DeliveryOptions {
  readonly scheduler: Scheduler;
  /** Decodes an image of vertex data and uploads it. Rejects with DecodeError, or with the signal's reason. */
  readonly makeImage: (png: Uint8Array<ArrayBuffer>, signal: AbortSignal) => Promise<DataImage>;
  /** Whether shaders read textures exactly; called when a file has arrived that may become a texture. */
  readonly readsTextures: () => Promise<boolean>;
  /** The longest edge of a texture, in texels. */
  readonly maxTextureSize: number;
  readonly runJob: RunJob;
  /** Runs a job on the main thread, for small files that must not wait for a worker; default: `runJob`. */
  readonly runOnMainThread?: RunJob;
  /** Files whose download began before the runtime; given to the first caller, undefined for all other URLs. */
  readonly prefetched?: (kind: "bases" | "patches" | "group", url: string) => Promise<PrefetchedContent> | undefined;
  readonly storeBytes: StoreBytes;
  readonly makeTextureImage: MakeTextureImage;
  /** Allocates an image on the GPU. */
  readonly makeWritableImage: (width: number, height: number) => WritableImage;
  /** Stores vertices, which may change. */
  readonly makeWritableArray: (array: ElementArray) => WritableArray;
  readonly download: DownloadOptions;
  /** Makes a URL of the document absolute. */
  readonly resolve: (url: string) => string;
  /** Called whenever a transfer has changed. */
  readonly onTransfer: () => void;
}

/** The content of a file whose download began before the runtime. */
export type PrefetchedContent = { readonly byteLength: number } & (
  | { readonly bases: readonly BaseBuffers[] }
  | { readonly patches: readonly PatchBuffers[] }
  | { readonly group: LevelGroup }
);

/** Downloaded bytes that may wait for decoding and upload. */
const maxPendingBytes = 8 * 2 ** 20;

export class ResourcePool {
  readonly #options: DeliveryOptions;
  readonly #semaphore = new ByteSemaphore(maxPendingBytes);
  /** The resources that further handles can share. */
  readonly #resources = new Map<string, Resource>();

  constructor(options: DeliveryOptions) {
    this.#options = options;
  }

  get runJob(): RunJob {
    return this.#options.runJob;
  }

  get storeBytes(): StoreBytes {
    return this.#options.storeBytes;
  }

  get maxTextureSize(): number {
    return this.#options.maxTextureSize;
  }

  /** Requests outside of the pool, as those of live streams. */
  get fetch(): typeof fetch {
    return this.#options.download.fetch;
  }

  /** Makes a URL of the document absolute. */
  resolve(url: string): string {
    return this.#options.resolve(url);
  }

  makeWritableImage(width: number, height: number): WritableImage {
    return this.#options.makeWritableImage(width, height);
  }

  makeWritableArray(array: ElementArray): WritableArray {
    return this.#options.makeWritableArray(array);
  }

  /** Whether shaders read textures exactly. */
  readsTextures(): Promise<boolean> {
    return this.#options.readsTextures();
  }

  acquire(request: ResourceRequest): ResourceHandle {
    const { scheduler, resolve } = this.#options;
    const key = JSON.stringify([urlsOf(request).map((url) => resolve(url)), ...keyOf(request)]);
    const resource = this.#resources.get(key) ?? this.#start(key, request);
    const state = { priority: request.priority, expectedBytes: request.expectedBytes };
    resource.add(state);
    scheduler.reorder();
    const forget = () => {
      if (this.#resources.get(key) === resource) this.#resources.delete(key);
    };
    return {
      transfer: resource.transfer,
      get content() {
        return resource.content;
      },
      setPriority(priority) {
        state.priority = priority;
        resource.invalidatePriority();
        scheduler.reorder();
      },
      fail(error) {
        resource.fail(error);
      },
      finish() {
        resource.finish(state);
        if (resource.dropBytes()) forget();
      },
      release: () => {
        if (!resource.remove(state)) return;
        if (resource.isUnused) resource.end();
        if (resource.isUnused || resource.dropBytes()) forget();
      },
    };
  }

  #start(key: string, request: ResourceRequest): Resource {
    const resource = new Resource(request, this.#options, this.#semaphore);
    this.#resources.set(key, resource);
    return resource;
  }
}

interface HandleState {
  readonly priority: number;
  readonly expectedBytes: number;
}

class Resource {
  readonly transfer: Transfer;
  readonly #options: DeliveryOptions;
  readonly #semaphore: ByteSemaphore;
  readonly #aborter = new AbortController();
  readonly #handles = new Set<HandleState>();
  /** The handles that still read the content: the bytes stay until the last one has finished. */
  readonly #reading = new Set<HandleState>();
  /** Whether handles need different patches of the file. */
  readonly #isShared: boolean;
  #content: Promise<Content> | undefined;
  /** Frees the bytes' share of the semaphore. */
  #freeBytes: () => void = () => undefined;
  #hasBytes = false;
  #priority: number | undefined;

  constructor(request: ResourceRequest, options: DeliveryOptions, semaphore: ByteSemaphore) {
    this.#options = options;
    this.#semaphore = semaphore;
    this.#priority = request.priority;
    this.#isShared = request.kind === "patches" || request.kind === "bases";
    this.transfer = {
      url: request.url,
      state: "waiting",
      loadedBytes: 0,
      totalBytes: this.#isShared ? 0 : request.expectedBytes,
      tries: 0,
      error: undefined,
    };
    this.#content = this.#fetch(request);
  }

  get content(): Promise<Content> {
    if (this.#content === undefined) throw new RangeError("the bytes have been dropped");
    return this.#content;
  }

  get priority(): number {
    this.#priority ??= Array.from(this.#handles).reduce((max, { priority }) => Math.max(max, priority), 0);
    return this.#priority;
  }

  /** Bytes to be received; for the scheduler. */
  get remainingBytes(): number {
    const { state, totalBytes, loadedBytes } = this.transfer;
    return state === "decoding" ? 0 : Math.max(0, totalBytes - loadedBytes);
  }

  get isUnused(): boolean {
    return this.#handles.size === 0;
  }

  /**
   * Call when a handle's priority has changed. The maximum is computed when the scheduler reads it: there may be
   * thousands of handles.
   */
  invalidatePriority(): void {
    this.#priority = undefined;
  }

  add(handle: HandleState): void {
    this.#handles.add(handle);
    this.#reading.add(handle);
    this.#expect(handle.expectedBytes);
    this.invalidatePriority();
  }

  /** Returns false if the handle has been removed before. */
  remove(handle: HandleState): boolean {
    this.invalidatePriority();
    this.#reading.delete(handle);
    if (!this.#handles.delete(handle)) return false;
    this.#expect(-handle.expectedBytes);
    return true;
  }

  finish(handle: HandleState): void {
    this.#reading.delete(handle);
  }

  fail(error: unknown): void {
    this.transfer.state = "failed";
    this.transfer.error = error instanceof Error ? error.message : String(error);
  }

  /** Frees the bytes once no handle reads them; returns false if there are none to free. */
  dropBytes(): boolean {
    if (!this.#hasBytes || this.#reading.size > 0) return false;
    this.#content = undefined;
    this.#freeBytes();
    return true;
  }

  end(): void {
    this.#aborter.abort();
    this.#freeBytes();
    this.#content?.then(
      (content) => {
        if ("image" in content) content.image.close();
      },
      () => undefined, // every handle's `content` has rejected
    );
  }

  /** Sums the handles' estimates until the download states the size. */
  #expect(bytes: number): void {
    if (this.#isShared && this.transfer.state === "waiting") this.transfer.totalBytes += bytes;
  }

  async #fetch(request: ResourceRequest): Promise<Content> {
    const { transfer } = this;
    try {
      const file =
        request.kind === "bases" || request.kind === "patches" || request.kind === "group"
          ? this.#options.prefetched?.(request.kind, this.#options.resolve(request.url))
          : undefined;
      const content = (file && (await this.#takeOver(file))) ?? (await this.#firstContent(request));
      transfer.state = "ready";
      return content;
    } catch (error) {
      this.fail(error);
      throw error;
    } finally {
      transfer.totalBytes = transfer.loadedBytes;
      this.#options.onTransfer();
    }
  }

  /** The content of the first URL that has one. */
  async #firstContent(request: ResourceRequest): Promise<Content> {
    const errors: DeliveryError[] = [];
    const urls = urlsOf(request);
    for (const url of urls) {
      try {
        return await this.#decode(request, await this.#download(url));
      } catch (error) {
        if (urls.length === 1 || this.#aborter.signal.aborted) throw error;
        errors.push(asDeliveryError(error, url));
      }
    }
    throw joinedError(errors as [DeliveryError, ...DeliveryError[]]);
  }

  /**
   * Takes over a download that began before the runtime; undefined if it failed: the file is then requested again.
   */
  async #takeOver(file: Promise<PrefetchedContent>): Promise<Content | undefined> {
    const { transfer } = this;
    transfer.state = "loading";
    try {
      const content = await file;
      transfer.tries = 1;
      transfer.loadedBytes = content.byteLength;
      this.#hasBytes = true;
      if ("bases" in content) return { kind: "bases", bases: content.bases };
      return "group" in content
        ? { kind: "group", group: content.group }
        : { kind: "patches", patches: content.patches };
    } catch {
      return undefined;
    }
  }

  #download(url: string): Promise<{ bytes: Uint8Array<ArrayBuffer>; freeBytes: () => void }> {
    const { transfer } = this;
    if (url.startsWith("data:")) return Promise.resolve({ bytes: bytesOfDataUrl(url), freeBytes: () => undefined });
    const { scheduler, download, resolve, onTransfer } = this.#options;
    const listener = {
      onState: (state: Transfer["state"]) => {
        transfer.state = state;
        if (state === "loading") transfer.tries += 1;
      },
      onBytes: (loadedBytes: number, totalBytes: number | undefined) => {
        transfer.loadedBytes = loadedBytes;
        transfer.totalBytes = Math.max(totalBytes ?? transfer.totalBytes, loadedBytes);
        onTransfer();
      },
    };
    return downloadInSlot(
      scheduler,
      this,
      resolve(url),
      this.#aborter.signal,
      download,
      listener,
      async (bytes, signal) => {
        transfer.state = "decoding";
        return { bytes, freeBytes: await this.#semaphore.acquire(bytes.byteLength, signal) };
      },
    );
  }

  async #decode(
    request: ResourceRequest,
    { bytes, freeBytes }: { bytes: Uint8Array<ArrayBuffer>; freeBytes: () => void },
  ): Promise<Content> {
    this.#freeBytes = freeBytes;
    try {
      const content = await this.#contentOf(request, bytes);
      this.#hasBytes = !("image" in content);
      return content;
    } finally {
      if (!this.#hasBytes || this.isUnused) freeBytes();
    }
  }

  async #contentOf(target: ContentTarget, bytes: Uint8Array<ArrayBuffer>): Promise<Content> {
    const { makeImage, makeTextureImage, readsTextures, runJob, runOnMainThread = runJob } = this.#options;
    const { signal } = this.#aborter;
    switch (target.kind) {
      case "textureImage":
        return { kind: "textureImage", ...(await makeTextureImage(bytes, target.sampling, signal)) };
      case "patches":
        return { kind: "patches", patches: await runJob(target.job, bytes, signal) };
      case "bases":
        return { kind: "bases", bases: await runOnMainThread(target.job, bytes, signal) };
      case "group":
        return { kind: "group", group: await runJob(target.job, bytes, signal) };
      case "bytes":
        return { kind: "bytes", bytes };
      case "imageBytes":
        checkImage(bytes);
        return { kind: "bytes", bytes };
      case "live":
        throw new RangeError("live streams are no files");
      case "texture":
        return { kind: "image", ...(await makeImage(bytes, signal)) };
      case "either":
        if (!(await readsTextures())) return this.#contentOf({ kind: "imageBytes" }, bytes);
        return { kind: "image", ...(await makeImage(bytes, signal)) };
    }
  }
}

function urlsOf({ url, furtherUrls = [] }: Pick<ResourceRequest, "url" | "furtherUrls">): readonly string[] {
  return [url, ...furtherUrls];
}

/** Requests of the same URLs and one key share a resource. */
function keyOf(target: ContentTarget): readonly string[] {
  if (target.kind === "textureImage") return [target.kind, JSON.stringify(target.sampling)];
  return "job" in target ? [target.kind, target.job] : [target.kind];
}

/** The bytes of "data:…;base64,…". No request is made, so that no content security policy applies. */
function bytesOfDataUrl(url: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(url.slice(url.indexOf(",") + 1)), (character) => character.charCodeAt(0));
}
