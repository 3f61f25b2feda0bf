// Pictures for surfaces, through the same queue as the data of vertices: one for
// each file and way of sampling, however many shapes show it. A preview, where the
// document names one, is shown first, and again where the picture has to go.

import type { SamplingDescription, TextureDescription } from "../document/description.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import type { DeliveryError } from "./deliveryError.ts";
import { asDeliveryError } from "./deliveryError.ts";
import { bytesPerTexel } from "./patchFiles.ts";
import type { Transfer } from "./progress.ts";
import type { ResourceHandle, Picture, ResourcePool } from "./resourcePool.ts";

export interface TextureListener {
  /** Another picture; undefined: there is none any more. The one before is used no more after this. */
  onPicture(picture: Picture | undefined): void;
  /** Once, where the texture is of no use. */
  onError(error: DeliveryError): void;
  /** All that was asked for has come or failed. */
  onSettled(): void;
}

/** What one of those who show a texture sees of its delivery. */
export interface JoinedTexture {
  readonly transfers: readonly Readonly<Transfer>[];
  /** It is not on its way. */
  readonly isSettled: boolean;
  /** No call to the listener follows. The picture must no longer be used. */
  cancel(): void;
}

/** What a file of a texture is: all of it, or what stands in for it. */
export type TextureChunk = "preview" | "texture";

/** How soon a file of a texture is wanted, by the key of its picture; undefined: not now. */
export type TexturePriority = (key: string, chunk: TextureChunk) => number | undefined;

/** A file of a texture, and how far it is. */
interface Source {
  readonly chunk: TextureChunk;
  readonly url: string;
  handle: ResourceHandle | undefined;
  state: "absent" | "asked" | "here" | "failed";
  picture: Picture | undefined;
  /** On the GPU: an estimate until it has been there. */
  storedBytes: number;
  budgetRequest: BudgetRequest | undefined;
}

interface Shared {
  readonly sampling: SamplingDescription;
  /** In the order of their use. */
  readonly sources: readonly Source[];
  readonly listeners: Set<TextureListener>;
  members: number;
  displayed: Picture | undefined;
  error: DeliveryError | undefined;
}

/** Mipmaps are a third more. Until it is here, a picture counts as one of 512 x 512. */
const bytesWithMipmaps = (texels: number) => (texels * bytesPerTexel * 4) / 3;
const expected = { preview: { bytes: 1500, texels: 64 * 64 }, texture: { bytes: 300_000, texels: 512 * 512 } } as const;

/** The same for textures that can share a picture. */
export function pictureKeyOf({ url, preview, sampling }: TextureDescription): string {
  return JSON.stringify([url, preview, sampling]);
}

export class TextureDeliveries {
  readonly #pool: ResourcePool;
  readonly #shared = new Map<string, Shared>();

  constructor(pool: ResourcePool) {
    this.#pool = pool;
  }

  /** Asks for nothing before `demand`. Never calls the listener before it returns. The last one to cancel ends the delivery. */
  join(texture: TextureDescription, listener: TextureListener): JoinedTexture {
    const key = pictureKeyOf(texture);
    const shared = this.#shared.get(key) ?? sharedOf(texture);
    this.#shared.set(key, shared);
    shared.members += 1;
    let isCancelled = false;
    queueMicrotask(() => {
      if (isCancelled) return;
      shared.listeners.add(listener);
      if (shared.displayed !== undefined) listener.onPicture(shared.displayed);
      if (shared.error !== undefined) listener.onError(shared.error);
      if (isSettled(shared) && !shared.sources.every(({ state }) => state === "absent")) listener.onSettled();
    });
    return {
      get transfers() {
        return transfersOf(shared);
      },
      get isSettled() {
        return isSettled(shared);
      },
      cancel: () => {
        if (isCancelled) return;
        isCancelled = true;
        shared.listeners.delete(listener);
        shared.members -= 1;
        if (shared.members > 0) return;
        this.#shared.delete(key);
        for (const source of shared.sources) release(source);
      },
    };
  }

  /** What all of them would take on the GPU, as far as is known. */
  get storedBytes(): number {
    let bytes = 0;
    for (const { sources } of this.#shared.values())
      for (const source of sources) if (source.state !== "failed") bytes += source.storedBytes;
    return bytes;
  }

  transfers(): Readonly<Transfer>[] {
    return Array.from(this.#shared.values()).flatMap(transfersOf);
  }

  /** What they want, and have, of the GPU: for each in the order of use. */
  budgetRequests(priorityOf: TexturePriority): readonly (readonly BudgetRequest[])[] {
    return Array.from(this.#shared, ([key, shared]) =>
      shared.sources.flatMap((source) => {
        const isNeedless = source.chunk === "preview" && hasTexture(shared);
        const priority = isNeedless ? undefined : priorityOf(key, source.chunk);
        source.budgetRequest =
          source.state === "failed" || (priority === undefined && source.state === "absent")
            ? undefined
            : {
                key: source,
                bytes: source.storedBytes,
                priority: priority ?? 0,
                isAllocated: source.state !== "absent",
              };
        return source.budgetRequest ?? [];
      }),
    );
  }

  /**
   * Asks for what is wanted and aborts what is no longer. What is here stays, but of
   * claims only what is granted. A preview is not asked for where its picture is here.
   */
  request(priorityOf: TexturePriority, granted?: ReadonlySet<BudgetRequest>): void {
    for (const [key, shared] of this.#shared) {
      const denied = shared.sources.filter(
        ({ budgetRequest: claim }) => granted !== undefined && claim !== undefined && !granted.has(claim),
      );
      const evicted = denied.filter(({ state }) => state === "here");
      if (evicted.length > 0) {
        updateDisplayed(shared, evicted);
        evicted.forEach(release);
      }
      for (const source of shared.sources) {
        if (source.state === "here" || source.state === "failed") continue;
        const isNeedless = denied.includes(source) || (source.chunk === "preview" && hasTexture(shared));
        const priority = isNeedless ? undefined : priorityOf(key, source.chunk);
        if (priority === undefined) release(source);
        else if (source.handle !== undefined) source.handle.setPriority(priority);
        else this.#ask(shared, source, priority);
      }
    }
  }

  #ask(shared: Shared, source: Source, priority: number): void {
    const { url, chunk } = source;
    source.handle = this.#pool.acquire({
      kind: "picture",
      url,
      sampling: shared.sampling,
      priority,
      expectedBytes: expected[chunk].bytes,
    });
    source.state = "asked";
    void this.#await(shared, source, source.handle);
  }

  async #await(shared: Shared, source: Source, lease: ResourceHandle): Promise<void> {
    // Given up in between, or given up and asked for again.
    const isOver = () => source.handle !== lease;
    try {
      const content = await lease.content;
      if (isOver() || content.kind !== "picture") return;
      source.storedBytes = bytesWithMipmaps(content.image.width * content.image.height);
      source.state = "here";
      source.picture = content;
      updateDisplayed(shared);
    } catch (error) {
      if (isOver()) return;
      source.state = "failed";
      if (source.chunk === "texture") {
        shared.error = asDeliveryError(error, source.url);
        for (const listener of shared.listeners) listener.onError(shared.error);
      }
    }
    if (isSettled(shared)) for (const listener of shared.listeners) listener.onSettled();
  }
}

function sharedOf({ url, preview, sampling }: TextureDescription): Shared {
  const source = (chunk: TextureChunk, of: string): Source => ({
    chunk,
    url: of,
    handle: undefined,
    state: "absent",
    picture: undefined,
    storedBytes: bytesWithMipmaps(expected[chunk].texels),
    budgetRequest: undefined,
  });
  return {
    sampling,
    listeners: new Set(),
    members: 0,
    displayed: undefined,
    error: undefined,
    sources: [...(preview === "" ? [] : [source("preview", preview)]), source("texture", url)],
  };
}

function hasTexture({ sources }: Shared): boolean {
  return sources.some(({ chunk, state }) => chunk === "texture" && state === "here");
}

function isSettled({ sources }: Shared): boolean {
  return sources.every(({ state }) => state !== "asked");
}

function transfersOf({ sources }: Shared): Readonly<Transfer>[] {
  return sources.flatMap(({ handle: lease }) => (lease ? [lease.transfer] : []));
}

/** The best that is here, but none of `without`. */
function updateDisplayed(shared: Shared, without: readonly Source[] = []): void {
  const best = shared.sources.findLast((source) => source.picture !== undefined && !without.includes(source))?.picture;
  if (best === shared.displayed) return;
  shared.displayed = best;
  for (const listener of shared.listeners) listener.onPicture(best);
}

function release(source: Source): void {
  source.handle?.release();
  source.handle = undefined;
  source.picture = undefined;
  if (source.state !== "failed") source.state = "absent";
}
