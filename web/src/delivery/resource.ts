// A file that is downloaded once and decoded, for all handles that share it.

import type { DataImage } from "../decode/image.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { TextureFile } from "../decode/textureImage.ts";
import type { ByteSemaphore } from "../scheduler/byteSemaphore.ts";
import type { DownloadOptions } from "../scheduler/download.ts";
import { downloadInSlot } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import type { WritableImage } from "../stage/decodedImage.ts";
import type { WritableArray } from "../stage/stage.ts";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { StoreBytes } from "./arrayUploads.ts";
import type { Content, ContentTarget, MakeTextureImage, PrefetchedContent, PrefetchedKind } from "./content.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError, joinedError } from "./deliveryError.ts";
import { lateDataImages } from "./lateDataImages.ts";
import type { Transfer } from "./progress.ts";

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
  readonly prefetched?: (kind: PrefetchedKind, url: string) => Promise<PrefetchedContent> | undefined;
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

/** What a handle asks of its resource. */
export interface HandleState {
  readonly priority: number;
  readonly expectedBytes: number;
}

export class Resource {
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
        request.kind === "bases" || request.kind === "patches" || request.kind === "group" || request.kind === "bytes"
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
        return await this.#decode(request, url, await this.#download(url));
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
      if ("bytes" in content) return { kind: "bytes", bytes: content.bytes };
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
    url: string,
    { bytes, freeBytes }: { bytes: Uint8Array<ArrayBuffer>; freeBytes: () => void },
  ): Promise<Content> {
    this.#freeBytes = freeBytes;
    try {
      const content = await this.#contentOf(request, { bytes, url });
      this.#hasBytes = !("image" in content);
      return content;
    } finally {
      if (!this.#hasBytes || this.isUnused) freeBytes();
    }
  }

  async #contentOf(target: ContentTarget, file: TextureFile): Promise<Content> {
    const { makeImage, makeTextureImage, readsTextures, resolve, runJob, runOnMainThread = runJob } = this.#options;
    const { bytes } = file;
    const { signal } = this.#aborter;
    switch (target.kind) {
      case "textureImage":
        return {
          kind: "textureImage",
          ...(await makeTextureImage({ bytes, url: resolve(file.url) }, target.sampling, signal)),
        };
      case "patches":
        return { kind: "patches", patches: await runJob(target.job, bytes, signal) };
      case "bases":
        return { kind: "bases", bases: await runOnMainThread(target.job, bytes, signal) };
      case "group":
        return { kind: "group", group: await runJob(target.job, bytes, signal) };
      case "bytes":
        return { kind: "bytes", bytes };
      case "imageBytes":
        lateDataImages.required.check(bytes);
        return { kind: "bytes", bytes };
      case "live":
        throw new RangeError("live streams are no files");
      case "texture":
        return { kind: "image", ...(await makeImage(bytes, signal)) };
      case "either":
        if (!(await readsTextures())) return this.#contentOf({ kind: "imageBytes" }, file);
        return { kind: "image", ...(await makeImage(bytes, signal)) };
    }
  }
}

export function urlsOf({ url, furtherUrls = [] }: Pick<ResourceRequest, "url" | "furtherUrls">): readonly string[] {
  return [url, ...furtherUrls];
}

/** The bytes of "data:…;base64,…". No request is made, so that no content security policy applies. */
function bytesOfDataUrl(url: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(url.slice(url.indexOf(",") + 1)), (character) => character.charCodeAt(0));
}
