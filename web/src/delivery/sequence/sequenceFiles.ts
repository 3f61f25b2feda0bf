// The files of a sequence that are in memory: those of the frames that come next, as many as fit into a budget of
// bytes. Others are requested again, from the browser's cache, when the sequence comes to them.

import type { PackedFrame } from "../../decode/sequence/sequenceFrames.ts";
import { framesOfFile } from "../../decode/sequence/sequenceFrames.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { ResourceHandle, ResourcePool } from "../resourcePool.ts";

/** Packed bytes of files that are kept or requested ahead. The present file and the next one are always. */
export const maxBufferedBytes = 16 * 2 ** 20;

/** A file that follows waits for those before it: its priority is this part of theirs. */
const aheadFactor = 1 / 4;

interface HeldFile {
  readonly handle: ResourceHandle;
  frames: readonly PackedFrame[] | undefined;
  hasFailed: boolean;
}

export interface SequenceFilesListener {
  /** Frames of a file are available. */
  onFile(): void;
  /** A file cannot be read. Called once for each. */
  onError(error: unknown, url: string): void;
}

export class SequenceFiles {
  readonly #index: SequenceIndex;
  readonly #urlOf: (file: number) => string;
  readonly #pool: Pick<ResourcePool, "acquire">;
  readonly #listener: SequenceFilesListener;
  readonly #held = new Map<number, HeldFile>();
  readonly #failed = new Set<number>();

  constructor(
    index: SequenceIndex,
    urlOf: (file: number) => string,
    pool: Pick<ResourcePool, "acquire">,
    listener: SequenceFilesListener,
  ) {
    this.#index = index;
    this.#urlOf = urlOf;
    this.#pool = pool;
    this.#listener = listener;
  }

  /** The frames of a file; undefined while it is absent; empty if it cannot be read. */
  framesOf(file: number): readonly PackedFrame[] | undefined {
    return this.#failed.has(file) ? [] : this.#held.get(file)?.frames;
  }

  get transfers(): readonly ResourceHandle["transfer"][] {
    return Array.from(this.#held.values(), ({ handle }) => handle.transfer);
  }

  /** Requests the file and those after it, in the order in which they are needed; the first follows the last. */
  follow(file: number, priority: number): void {
    const { files } = this.#index;
    const priorities = new Map<number, number>();
    let bytes = 0;
    let rank = priority;
    for (let ahead = 0; ahead < files.length; ++ahead, rank *= aheadFactor) {
      const each = (file + ahead) % files.length;
      bytes += files[each]?.bytes ?? 0;
      if (ahead > 1 && bytes > maxBufferedBytes) break;
      priorities.set(each, rank);
    }
    for (const [each, { handle }] of this.#held)
      if (!priorities.has(each)) {
        handle.release();
        this.#held.delete(each);
      }
    for (const [each, rankOfFile] of priorities) {
      const held = this.#held.get(each);
      if (held !== undefined) held.handle.setPriority(rankOfFile);
      else if (!this.#failed.has(each)) this.#request(each, rankOfFile);
    }
  }

  /** Aborts requests and frees all files. */
  clear(): void {
    for (const { handle } of this.#held.values()) handle.release();
    this.#held.clear();
  }

  /** The frames of the file are wrong. */
  fail(file: number, error: unknown): void {
    if (this.#failed.has(file)) return;
    this.#failed.add(file);
    const held = this.#held.get(file);
    held?.handle.fail(error);
    held?.handle.release();
    this.#held.delete(file);
    this.#listener.onError(error, this.#urlOf(file));
  }

  #request(file: number, priority: number): void {
    const url = this.#urlOf(file);
    const expectedBytes = this.#index.files[file]?.bytes ?? 0;
    const handle = this.#pool.acquire({ kind: "bytes", url, priority, expectedBytes });
    const held: HeldFile = { handle, frames: undefined, hasFailed: false };
    this.#held.set(file, held);
    void this.#receive(file, held);
  }

  async #receive(file: number, held: HeldFile): Promise<void> {
    const { handle } = held;
    const stated = this.#index.files[file];
    try {
      const content = await handle.content;
      if (this.#held.get(file) !== held || stated === undefined || content.kind !== "bytes") return;
      held.frames = framesOfFile(content.bytes, stated, this.#index);
    } catch (error) {
      if (this.#held.get(file) === held) this.fail(file, error);
      return;
    } finally {
      handle.finish();
    }
    this.#listener.onFile();
  }
}
