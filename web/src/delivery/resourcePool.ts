// One request per URL, however many patches and shapes use it. A resource lives
// while somebody holds a lease on it; with the last lease its download is
// aborted or its image is given back. Bytes go sooner: when all who hold a lease
// have taken of them what they need.

import type { BaseBuffers } from "../decode/compact/baseBuffers.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import type { DataImage } from "../decode/image.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import type { InputOf, JobName, OutputOf, RunJob } from "../decode/jobs.ts";
import type { SamplingDescription } from "../document/description.ts";
import { ByteSemaphore } from "../scheduler/byteSemaphore.ts";
import type { DownloadOptions } from "../scheduler/download.ts";
import { downloadInSlot } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import type { StoreBytes } from "./arrayUploads.ts";
import type { Transfer } from "./progress.ts";

export type Content =
  | ({ readonly kind: "image" } & DataImage)
  | ({ readonly kind: "picture" } & Picture)
  | { readonly kind: "bytes"; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: "patches"; readonly patches: readonly PatchBuffers[] }
  | { readonly kind: "bases"; readonly bases: readonly BaseBuffers[] };

/**
 * What a file is to become: a texture, its own bytes, or either, as the GPU allows; a picture; or all patches, or all
 * base meshes, that it holds, which a job decodes.
 */
export type ContentTarget =
  | { readonly kind: "texture" | "bytes" | "either" }
  | { readonly kind: "picture"; readonly sampling: SamplingDescription }
  | { readonly kind: "patches"; readonly job: FileJob<PatchBuffers[]> }
  | { readonly kind: "bases"; readonly job: FileJob<BaseBuffers[]> };

/** The jobs that turn the bytes of a file into an Output. */
type FileJob<Output> = {
  [Name in JobName]: OutputOf<Name> extends Output
    ? Uint8Array<ArrayBuffer> extends InputOf<Name>
      ? Name
      : never
    : never;
}[JobName];

/** An image that is looked at, in any format that the browser knows; where textures are read from. */
export interface Picture {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

/** Brings a picture to where it can be laid over a surface. Rejects with DecodeError, or with the signal's reason. */
export type MakePicture = (
  bytes: Uint8Array<ArrayBuffer>,
  sampling: SamplingDescription,
  signal: AbortSignal,
) => Promise<Picture>;

export type ResourceRequest = ContentTarget & {
  /** As the document writes it, without its fragment. */
  readonly url: string;
  /** Larger comes first. Of several leases the largest counts. */
  readonly priority: number;
  /** What the file is likely to weigh, until the server says; of patches and bases what is wanted of it. */
  readonly expectedBytes: number;
};

export interface ResourceHandle {
  readonly transfer: Readonly<Transfer>;
  /** Rejects with RequestError, DecodeError, or an AbortError after the last release. To be asked for before `finish`. */
  readonly content: Promise<Content>;
  setPriority(priority: number): void;
  /** The content is not what it should be. */
  fail(error: unknown): void;
  /** The content is not looked at again. An image stays until it is released; whoever asks for bytes later gets them anew. */
  finish(): void;
  release(): void;
}

export interface DeliveryOptions {
  readonly scheduler: Scheduler;
  /** Brings the image that these bytes are to where stages can use it. Rejects with DecodeError, or with the signal's reason. */
  readonly makeImage: (png: Uint8Array<ArrayBuffer>, signal: AbortSignal) => Promise<DataImage>;
  /** Whether shaders read textures as they should; asked when a file is here that may become one. */
  readonly readsTextures: () => Promise<boolean>;
  /** Texels of the longest edge that a texture may have. */
  readonly maxTextureSize: number;
  readonly runJob: RunJob;
  /** The same on the main thread, for what is small and must not wait for a worker; where it is not given, it waits. */
  readonly runOnMainThread?: RunJob;
  /** Bases that are on their way, or here, for who asks first; undefined for all other URLs. */
  readonly prefetchedBases?: (url: string) => Promise<PrefetchedBases> | undefined;
  readonly storeBytes: StoreBytes;
  readonly makePicture: MakePicture;
  readonly download: DownloadOptions;
  /** The absolute URL of one that the document writes. */
  readonly resolve: (url: string) => string;
  /** Called whenever a transfer has moved. */
  readonly onTransfer: () => void;
}

/** A file that somebody else has asked for. */
export interface PrefetchedBases {
  readonly byteLength: number;
  readonly bases: readonly BaseBuffers[];
}

/** Downloaded bytes that may wait for their decoder, and for their way to the GPU. */
const maxPendingBytes = 8 * 2 ** 20;

export class ResourcePool {
  readonly #options: DeliveryOptions;
  readonly #backlog = new ByteSemaphore(maxPendingBytes);
  /** Those that can be leased once more. */
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

  acquire(request: ResourceRequest): ResourceHandle {
    const { scheduler, resolve } = this.#options;
    const key = JSON.stringify([resolve(request.url), ...keyOf(request)]);
    const resource = this.#resources.get(key) ?? this.#start(key, request);
    const leased = { priority: request.priority, expectedBytes: request.expectedBytes };
    resource.add(leased);
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
        leased.priority = priority;
        resource.reconsider();
        scheduler.reorder();
      },
      fail(error) {
        resource.fail(error);
      },
      finish() {
        resource.finish(leased);
        if (resource.dropBytes()) forget();
      },
      release: () => {
        if (!resource.remove(leased)) return;
        if (resource.isUnused) resource.end();
        if (resource.isUnused || resource.dropBytes()) forget();
      },
    };
  }

  #start(key: string, request: ResourceRequest): Resource {
    const resource = new Resource(request, this.#options, this.#backlog);
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
  readonly #backlog: ByteSemaphore;
  readonly #aborter = new AbortController();
  readonly #leases = new Set<HandleState>();
  /** Those of them who still look at the content: of files that thousands share, all but the last keep the bytes. */
  readonly #looking = new Set<HandleState>();
  /** Whoever leases it wants another piece. */
  readonly #isInPieces: boolean;
  #content: Promise<Content> | undefined;
  /** Gives the room of the bytes back. */
  #leave: () => void = () => undefined;
  #hasBytes = false;
  #priority: number | undefined;

  constructor(request: ResourceRequest, options: DeliveryOptions, backlog: ByteSemaphore) {
    this.#options = options;
    this.#backlog = backlog;
    this.#priority = request.priority;
    this.#isInPieces = request.kind === "patches" || request.kind === "bases";
    this.transfer = {
      url: request.url,
      state: "waiting",
      loadedBytes: 0,
      totalBytes: this.#isInPieces ? 0 : request.expectedBytes,
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
    this.#priority ??= Array.from(this.#leases).reduce((most, { priority }) => Math.max(most, priority), 0);
    return this.#priority;
  }

  get isUnused(): boolean {
    return this.#leases.size === 0;
  }

  /** A lease has another priority. Only looked at when the scheduler asks: there may be thousands. */
  reconsider(): void {
    this.#priority = undefined;
  }

  add(lease: HandleState): void {
    this.#leases.add(lease);
    this.#looking.add(lease);
    this.#expect(lease.expectedBytes);
    this.reconsider();
  }

  /** False where the lease has been given back before. */
  remove(lease: HandleState): boolean {
    this.reconsider();
    this.#looking.delete(lease);
    if (!this.#leases.delete(lease)) return false;
    this.#expect(-lease.expectedBytes);
    return true;
  }

  finish(lease: HandleState): void {
    this.#looking.delete(lease);
  }

  fail(error: unknown): void {
    this.transfer.state = "failed";
    this.transfer.error = error instanceof Error ? error.message : String(error);
  }

  /** Where nobody needs them any more; false where there are none to drop. */
  dropBytes(): boolean {
    if (!this.#hasBytes || this.#looking.size > 0) return false;
    this.#content = undefined;
    this.#leave();
    return true;
  }

  end(): void {
    this.#aborter.abort();
    this.#leave();
    this.#content?.then(
      (content) => {
        if ("image" in content) content.image.close();
      },
      () => undefined, // whoever held a lease has been told
    );
  }

  /** Sizes are added up until there is a true one. */
  #expect(bytes: number): void {
    if (this.#isInPieces && this.transfer.state === "waiting") this.transfer.totalBytes += bytes;
  }

  async #fetch(request: ResourceRequest): Promise<Content> {
    const { transfer } = this;
    try {
      const file =
        request.kind === "bases" ? this.#options.prefetchedBases?.(this.#options.resolve(request.url)) : undefined;
      const content =
        (file && (await this.#takeOver(file))) ?? (await this.#decode(request, await this.#download(request.url)));
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

  /** What was asked for before there was anybody to ask; where it has come to nothing it is asked for again. */
  async #takeOver(file: Promise<PrefetchedBases>): Promise<Content | undefined> {
    const { transfer } = this;
    transfer.state = "loading";
    try {
      const { byteLength, bases } = await file;
      transfer.tries = 1;
      transfer.loadedBytes = byteLength;
      this.#hasBytes = true;
      return { kind: "bases", bases };
    } catch {
      return undefined;
    }
  }

  #download(url: string): Promise<{ bytes: Uint8Array<ArrayBuffer>; leave: () => void }> {
    const { transfer } = this;
    if (url.startsWith("data:")) return Promise.resolve({ bytes: bytesOfDataUrl(url), leave: () => undefined });
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
        return { bytes, leave: await this.#backlog.acquire(bytes.byteLength, signal) };
      },
    );
  }

  async #decode(
    request: ResourceRequest,
    { bytes, leave }: { bytes: Uint8Array<ArrayBuffer>; leave: () => void },
  ): Promise<Content> {
    this.#leave = leave;
    try {
      const content = await this.#contentOf(request, bytes);
      this.#hasBytes = !("image" in content);
      return content;
    } finally {
      if (!this.#hasBytes || this.isUnused) leave();
    }
  }

  async #contentOf(target: ContentTarget, bytes: Uint8Array<ArrayBuffer>): Promise<Content> {
    const { makeImage, makePicture, readsTextures, runJob, runOnMainThread = runJob } = this.#options;
    const { signal } = this.#aborter;
    switch (target.kind) {
      case "picture":
        return { kind: "picture", ...(await makePicture(bytes, target.sampling, signal)) };
      case "patches":
        return { kind: "patches", patches: await runJob(target.job, bytes, signal) };
      case "bases":
        return { kind: "bases", bases: await runOnMainThread(target.job, bytes, signal) };
      case "bytes":
        return { kind: "bytes", bytes };
      case "texture":
        return { kind: "image", ...(await makeImage(bytes, signal)) };
      case "either":
        if (!(await readsTextures())) return { kind: "bytes", bytes };
        return { kind: "image", ...(await makeImage(bytes, signal)) };
    }
  }
}

/** Requests of one URL and one key share a resource. */
function keyOf(target: ContentTarget): readonly string[] {
  if (target.kind === "picture") return [target.kind, JSON.stringify(target.sampling)];
  return "job" in target ? [target.kind, target.job] : [target.kind];
}

/** Of "data:…;base64,…": nothing is asked of the network, nor of the page's content policy. */
function bytesOfDataUrl(url: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(url.slice(url.indexOf(",") + 1)), (character) => character.charCodeAt(0));
}
