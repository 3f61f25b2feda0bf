// Bases that a first look has asked for. The runtime takes them over, so that they
// are fetched and decoded once; what has failed it asks for anew, and reports.

import type { Base, BaseBuffers } from "../decode/compact/baseBuffers.ts";
import { decodeBases } from "../decode/compact/jobs.ts";

/** Of one file. */
interface DecodedBases<Decoded> {
  readonly byteLength: number;
  readonly bases: readonly Decoded[];
}

export interface PrefetchedFile {
  /** Kept when it is here, decoded or not. */
  readonly downloaded: Promise<unknown>;
  /** Rejects where the file is of no use. */
  readonly decoded: Promise<DecodedBases<Base>>;
}

export class PrefetchedBases {
  readonly #fetch: typeof fetch;
  readonly #files = new Map<string, PrefetchedFile>();

  constructor(fetchFile: typeof fetch) {
    this.#fetch = fetchFile;
  }

  /** The file at an absolute URL, which is asked for once. */
  fetch(url: string): PrefetchedFile {
    const known = this.#files.get(url) ?? this.#load(url);
    this.#files.set(url, known);
    return known;
  }

  /** What has been asked for, for one who keeps it: it is not here any more. */
  take(url: string): Promise<DecodedBases<BaseBuffers>> | undefined {
    const file = this.#files.get(url);
    this.#files.delete(url);
    return file?.decoded.then(({ byteLength, bases }) => ({ byteLength, bases: bases.map((base) => base.segments) }));
  }

  #load(url: string): PrefetchedFile {
    const arrival = this.#download(url);
    const content = arrival.then(async (bytes) => ({ byteLength: bytes.byteLength, bases: await decodeBases(bytes) }));
    for (const promise of [arrival, content]) promise.catch(() => undefined); // nobody has to look
    return { downloaded: arrival, decoded: content };
  }

  async #download(url: string): Promise<Uint8Array<ArrayBuffer>> {
    const response = await this.#fetch(url);
    if (!response.ok) throw new Error(`${url}: the server answered ${response.status}`);
    return new Uint8Array(await response.arrayBuffer());
  }
}
