// Base meshes that previews have requested. The runtime takes them over, so that each
// file is fetched and decoded once. A file that has failed is requested again by the
// runtime, which reports the error.

import type { Base, BaseBuffers } from "../decode/compact/baseBuffers.ts";
import { decodeBases } from "../decode/compact/decodeBases.ts";
import type { LevelGroup } from "../decode/compact/levelGroup.ts";
import { groupOf } from "../decode/compact/levelGroup.ts";
import { Arrival } from "../scheduler/arrival.ts";
import { defaultDownloadOptions, download } from "../scheduler/download.ts";

/** The bases in one file. */
interface DecodedBases<Decoded> {
  readonly byteLength: number;
  readonly bases: readonly Decoded[];
}

export interface PrefetchedFile {
  /** Resolves when little of the file is still to come, or it has failed. */
  readonly isNear: Promise<unknown>;
  /** Resolves when the file has been downloaded. */
  readonly downloaded: Promise<unknown>;
  /** Decodes the bases when they have arrived, once. Rejects if the file cannot be downloaded or decoded. */
  readonly decode: () => Promise<DecodedBases<Base>>;
}

export class PrefetchedBases {
  readonly #fetch: typeof fetch;
  readonly #files = new Map<string, PrefetchedFile>();

  constructor(fetchFile: typeof fetch) {
    this.#fetch = fetchFile;
  }

  /** The file at an absolute URL. The first call for a URL requests the file. */
  fetch(url: string): PrefetchedFile {
    const file = this.#files.get(url) ?? this.#load(url);
    this.#files.set(url, file);
    return file;
  }

  /**
   * Hands over the segments of each base in a file, once; undefined if the file has not been requested or has been
   * taken.
   */
  take(url: string): Promise<DecodedBases<BaseBuffers>> | undefined {
    const file = this.#files.get(url);
    this.#files.delete(url);
    return file?.decode().then(({ byteLength, bases }) => ({ byteLength, bases: bases.map((base) => base.segments) }));
  }

  /** Hands over the first base in a file as a group of a level of detail, as `take` does. */
  takeGroup(url: string): Promise<{ byteLength: number; group: LevelGroup }> | undefined {
    const file = this.#files.get(url);
    this.#files.delete(url);
    return file?.decode().then(({ byteLength, bases: [base] }) => {
      if (base === undefined) throw new RangeError("no base");
      return { byteLength, group: groupOf([base.decoded]) };
    });
  }

  #load(url: string): PrefetchedFile {
    const arrival = new Arrival();
    const downloaded = this.#download(url, arrival);
    downloaded.catch(() => undefined); // there may be no other handler
    let decoded: Promise<DecodedBases<Base>> | undefined;
    const decode = async (): Promise<DecodedBases<Base>> => {
      const bytes = await downloaded;
      await waitingTasks(); // among them the start of workers, which decoding would delay
      return { byteLength: bytes.byteLength, bases: await decodeBases(bytes) };
    };
    return { isNear: arrival.isNear, downloaded, decode: () => (decoded ??= decode()) };
  }

  async #download(url: string, arrival: Arrival): Promise<Uint8Array<ArrayBuffer>> {
    const options = { fetch: this.#fetch, idleTimeoutMs: defaultDownloadOptions.idleTimeoutMs };
    try {
      return await download(url, new AbortController().signal, options, arrival);
    } finally {
      arrival.end();
    }
  }
}

/** Resolves when the page has run the tasks that are waiting now. */
function waitingTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
