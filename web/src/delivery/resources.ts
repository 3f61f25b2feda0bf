// One request per URL, however many patches and shapes use it. A resource lives
// while somebody holds a lease on it; with the last lease its download is
// aborted or its image is given back.

import type { DecodedImage, ImageDecoder } from "../decode/image.ts";
import { decodeImage } from "../decode/image.ts";
import type { DownloadOptions } from "../scheduler/download.ts";
import { downloadAnd } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import type { Transfer } from "./progress.ts";

export type Content =
  | { readonly kind: "image"; readonly image: DecodedImage }
  | { readonly kind: "bytes"; readonly bytes: Uint8Array<ArrayBuffer> };

export interface ResourceRequest {
  readonly kind: Content["kind"];
  /** As the document writes it, without its fragment. */
  readonly url: string;
  /** Smaller comes first. A resource that is already asked for keeps its own. */
  readonly priority: number;
  /** What the file is likely to weigh, until the server says. */
  readonly expectedBytes: number;
}

export interface Lease {
  readonly transfer: Readonly<Transfer>;
  /** Rejects with RequestError, DecodeError, or an AbortError after the last release. */
  readonly content: Promise<Content>;
  release(): void;
}

export interface DeliveryOptions {
  readonly scheduler: Scheduler;
  readonly decodeImage: ImageDecoder;
  readonly download: DownloadOptions;
  /** The absolute URL of one that the document writes. */
  readonly resolve: (url: string) => string;
  /** Called whenever a transfer has moved. */
  readonly onTransfer: () => void;
}

interface Resource {
  readonly transfer: Transfer;
  readonly content: Promise<Content>;
  readonly aborter: AbortController;
  leases: number;
}

export class ResourcePool {
  readonly #options: DeliveryOptions;
  readonly #resources = new Map<string, Resource>();

  constructor(options: DeliveryOptions) {
    this.#options = options;
  }

  /** The transfers of everything that is leased now. */
  transfers(): Transfer[] {
    return Array.from(this.#resources.values(), (resource) => resource.transfer);
  }

  lease(request: ResourceRequest): Lease {
    const url = this.#options.resolve(request.url);
    const key = `${request.kind} ${url}`;
    const resource = this.#resources.get(key) ?? this.#start(key, url, request);
    resource.leases += 1;
    let released = false;
    return {
      transfer: resource.transfer,
      content: resource.content,
      release: () => {
        if (released) return;
        released = true;
        resource.leases -= 1;
        if (resource.leases === 0) this.#end(key, resource);
      },
    };
  }

  #start(key: string, url: string, request: ResourceRequest): Resource {
    const { scheduler, download, onTransfer } = this.#options;
    const transfer: Transfer = { loadedBytes: 0, totalBytes: request.expectedBytes, isSettled: false };
    const aborter = new AbortController();
    const onBytes = (loadedBytes: number, totalBytes: number | undefined) => {
      transfer.loadedBytes = loadedBytes;
      transfer.totalBytes = Math.max(totalBytes ?? transfer.totalBytes, loadedBytes);
      onTransfer();
    };
    const content = downloadAnd(scheduler, request.priority, url, aborter.signal, download, onBytes,
      async (bytes): Promise<Content> => request.kind === "bytes" ? { kind: "bytes", bytes }
        : { kind: "image", image: await decodeImage(bytes, this.#options.decodeImage) })
      .finally(() => {
        transfer.totalBytes = transfer.loadedBytes;
        transfer.isSettled = true;
      });
    const resource: Resource = { transfer, content, aborter, leases: 0 };
    this.#resources.set(key, resource);
    return resource;
  }

  #end(key: string, resource: Resource): void {
    this.#resources.delete(key);
    resource.aborter.abort();
    resource.content.then(
      (content) => { if (content.kind === "image") content.image.close(); },
      () => undefined, // whoever held a lease has been told
    );
  }
}
