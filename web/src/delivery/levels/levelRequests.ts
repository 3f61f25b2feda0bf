// The requests of a mesh with levels of detail: pages of its index, and files of its groups. Each is requested once until
// it has been withdrawn.

import type { LevelGroup } from "../../decode/compact/levelGroup.ts";
import type { SamplingDescription } from "../../document/description.ts";
import { chipUrl, groupUrl, levelPageUrl } from "../../levels/levelFiles.ts";
import type { Transfer } from "../progress.ts";
import type { Content, TextureImage } from "../content.ts";
import type { ResourceRequest } from "../resource.ts";
import type { ResourceHandle, ResourcePool } from "../resourcePool.ts";

interface Request {
  readonly handle: ResourceHandle;
  readonly aborter: AbortController;
}

/** A function, as TypeScript does not see that a signal may have changed during an await. */
export function isAborted({ aborted }: AbortSignal): boolean {
  return aborted;
}

/** A group's image has a gutter around each of its parts, which two reductions do not mix. */
const chipSampling: SamplingDescription = {
  isData: false,
  wrapS: "clamp",
  wrapT: "clamp",
  isSmooth: true,
  hasMipmaps: true,
  anisotropy: 1,
};

/** What becomes of a file; a rejection is a failure of it. */
export type Receive<Arrived> = (arrived: Arrived, signal: AbortSignal) => void | Promise<void>;

export interface LevelRequestsListener {
  /** A file has been received: it is no longer among those that are requested. */
  onReceived(): void;
  /** Nothing of the request follows. */
  onError(file: { readonly page: number } | { readonly group: number }, url: string, error: unknown): void;
}

export class LevelRequests {
  readonly #pool: Pick<ResourcePool, "acquire">;
  readonly #indexUrl: string;
  readonly #listener: LevelRequestsListener;
  readonly #pages = new Map<number, Request>();
  readonly #groups = new Map<number, Request>();
  /** The images of groups that are requested or whose content is here, until they are forgotten. */
  readonly #chips = new Map<number, { readonly handle: ResourceHandle; readonly image: Promise<TextureImage> }>();
  /** Those of files that are requested or whose content is here. */
  readonly #transfers = new Map<string, Readonly<Transfer>>();
  #list: readonly Readonly<Transfer>[] | undefined;

  constructor(pool: Pick<ResourcePool, "acquire">, indexUrl: string, listener: LevelRequestsListener) {
    this.#pool = pool;
    this.#indexUrl = indexUrl;
    this.#listener = listener;
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return (this.#list ??= Array.from(this.#transfers.values()));
  }

  /** Pages that are requested and not yet here. */
  get pages(): ReadonlyMap<number, unknown> {
    return this.#pages;
  }

  /** Groups that are requested and not yet here. */
  get groups(): ReadonlyMap<number, unknown> {
    return this.#groups;
  }

  requestPage(page: number, priority: number, bytes: number, receive: Receive<Uint8Array<ArrayBuffer>>): void {
    const url = levelPageUrl(this.#indexUrl, page);
    this.#request(this.#pages, page, { kind: "bytes", url, priority, expectedBytes: bytes }, (content, signal) =>
      content.kind === "bytes" ? receive(content.bytes, signal) : undefined,
    );
  }

  requestGroup(group: number, priority: number, bytes: number, receive: Receive<LevelGroup>): void {
    const url = groupUrl(this.#indexUrl, group);
    const request = { kind: "group", job: "compactGroup", url, priority, expectedBytes: bytes } as const;
    this.#request(this.#groups, group, request, (content, signal) =>
      content.kind === "group" ? receive(content.group, signal) : undefined,
    );
  }

  /** The image of a group that is requested. It stays until the group is withdrawn, fails or is forgotten. */
  requestChips(group: number, priority: number, bytes: number): Promise<TextureImage> {
    const known = this.#chips.get(group);
    if (known) return known.image;
    const url = chipUrl(this.#indexUrl, group);
    const request = { kind: "textureImage", url, sampling: chipSampling, priority, expectedBytes: bytes } as const;
    const handle = this.#pool.acquire(request);
    const image = handle.content.then((content) => {
      if (content.kind !== "textureImage") throw new RangeError("is no image");
      return content;
    });
    image.catch(() => undefined); // whoever waits for the group gets the error, unless the request is withdrawn
    this.#chips.set(group, { handle, image });
    this.#setTransfer(url, handle.transfer);
    return image;
  }

  #releaseChips(group: number): void {
    this.#chips.get(group)?.handle.release();
    this.#chips.delete(group);
    this.#setTransfer(chipUrl(this.#indexUrl, group), undefined);
  }

  setPriority(group: number, priority: number): void {
    this.#groups.get(group)?.handle.setPriority(priority);
    this.#chips.get(group)?.handle.setPriority(priority);
  }

  withdraw(group: number): void {
    this.#withdraw(this.#groups, group);
    this.forget(group);
  }

  /** The group has left the GPU. */
  forget(group: number): void {
    this.#setTransfer(groupUrl(this.#indexUrl, group), undefined);
    this.#releaseChips(group);
  }

  /** No group is on the GPU any more. */
  forgetAll(): void {
    for (const group of [...this.#chips.keys()]) this.forget(group);
  }

  withdrawAll(): void {
    for (const group of [...this.#groups.keys()]) this.withdraw(group);
    for (const page of [...this.#pages.keys()]) {
      this.#withdraw(this.#pages, page);
      this.#setTransfer(levelPageUrl(this.#indexUrl, page), undefined);
    }
  }

  #request(requests: Map<number, Request>, number: number, request: ResourceRequest, receive: Receive<Content>): void {
    const handle = this.#pool.acquire(request);
    const aborter = new AbortController();
    const entry = { handle, aborter };
    requests.set(number, entry);
    this.#setTransfer(request.url, handle.transfer);
    void this.#receive(requests, number, entry, request.url, receive);
  }

  async #receive(
    requests: Map<number, Request>,
    number: number,
    entry: Request,
    url: string,
    receive: Receive<Content>,
  ): Promise<void> {
    const { handle, aborter } = entry;
    const end = () => {
      requests.delete(number);
      handle.finish();
      handle.release();
    };
    try {
      const content = await handle.content;
      if (aborter.signal.aborted) return;
      await receive(content, aborter.signal);
    } catch (error) {
      if (aborter.signal.aborted) return;
      handle.fail(error);
      end();
      if (requests === this.#groups) this.#releaseChips(number);
      this.#listener.onError(requests === this.#pages ? { page: number } : { group: number }, url, error);
      return;
    }
    if (isAborted(aborter.signal)) return;
    end();
    this.#listener.onReceived();
  }

  #withdraw(requests: Map<number, Request>, number: number): void {
    const request = requests.get(number);
    requests.delete(number);
    request?.aborter.abort();
    request?.handle.finish();
    request?.handle.release();
  }

  #setTransfer(url: string, transfer: Readonly<Transfer> | undefined): void {
    if (transfer) this.#transfers.set(url, transfer);
    else this.#transfers.delete(url);
    this.#list = undefined;
  }
}
