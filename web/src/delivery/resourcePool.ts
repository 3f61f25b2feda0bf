// One download per URL, however many patches and shapes use it. A resource lives while there is a handle to it: with
// the last handle its download is aborted, or its image freed. Downloaded bytes are freed sooner: once all handles have
// taken what they need.

import type { RunJob } from "../decode/jobs.ts";
import { ByteSemaphore } from "../scheduler/byteSemaphore.ts";
import type { WritableImage } from "../stage/decodedImage.ts";
import type { WritableArray } from "../stage/stage.ts";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { StoreBytes } from "./arrayUploads.ts";
import type { Content, ContentTarget } from "./content.ts";
import type { Transfer } from "./progress.ts";
import type { DeliveryOptions, ResourceRequest } from "./resource.ts";
import { Resource, urlsOf } from "./resource.ts";

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

/** Requests of the same URLs and one key share a resource. */
function keyOf(target: ContentTarget): readonly string[] {
  if (target.kind === "textureImage") return [target.kind, JSON.stringify(target.sampling)];
  return "job" in target ? [target.kind, target.job] : [target.kind];
}
