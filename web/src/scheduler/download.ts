// One URL -> its bytes, counted as they come, with a limit on silence and
// retries where trying again can help.

import type { Scheduler } from "./scheduler.ts";

export type RequestFailure = "http" | "network" | "timeout" | "limit";

export class RequestError extends Error {
  override readonly name = "RequestError";
  readonly kind: RequestFailure;
  readonly url: string;
  /** The HTTP status; 0 where there was no answer. */
  readonly status: number;

  constructor(kind: RequestFailure, url: string, message: string, status = 0) {
    super(message);
    this.kind = kind;
    this.url = url;
    this.status = status;
  }
}

/** No container file comes near; a server that sends more is not sending one. */
export const largestDownloadBytes = 2 ** 30;

export interface DownloadOptions {
  readonly fetch: typeof fetch;
  /** A transfer without a byte for so long has failed. */
  readonly silenceMs: number;
  /** Attempts after the first. */
  readonly retries: number;
  /** Before the first retry; doubled for each further one. */
  readonly backoffMs: number;
}

export const defaultDownloadOptions: DownloadOptions = {
  fetch: (input, init) => globalThis.fetch(input, init),
  silenceMs: 30_000,
  retries: 2,
  backoffMs: 400,
};

/** `totalBytes` is undefined where the server does not say or says it of the compressed body. */
export type ByteCount = (loadedBytes: number, totalBytes: number | undefined) => void;

/**
 * Downloads `url` in a slot of the scheduler and turns it into a result there,
 * so that decoding too is bounded by the slots. Each attempt takes a slot of its
 * own: while it waits to retry, others use the slot. Network errors, silence and
 * 5xx are tried again, everything else is final.
 */
export async function downloadAnd<Result>(
  scheduler: Scheduler, priority: number, url: string, signal: AbortSignal, options: DownloadOptions,
  onBytes: ByteCount, decode: (bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal) => Promise<Result>,
): Promise<Result> {
  for (let attempt = 0; ; ++attempt) {
    try {
      return await scheduler.run(priority, signal, async (jobSignal) =>
        decode(await download(url, jobSignal, options, onBytes), jobSignal));
    } catch (error) {
      if (signal.aborted || attempt >= options.retries || !isWorthRetrying(error)) throw error;
      await pause(options.backoffMs * 2 ** attempt, signal);
    }
  }
}

function isWorthRetrying(error: unknown): boolean {
  if (!(error instanceof RequestError)) return false;
  return error.kind === "network" || error.kind === "timeout" || error.status >= 500;
}

/** One attempt. Rejects with RequestError, or with the signal's reason. */
export async function download(url: string, signal: AbortSignal, options: DownloadOptions,
                               onBytes: ByteCount): Promise<Uint8Array<ArrayBuffer>> {
  const silence = new AbortController();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const listen = () => {
    clearTimeout(timer);
    timer = setTimeout(() => { silence.abort(); }, options.silenceMs);
  };
  listen();
  try {
    const response = await options.fetch(url, { signal: AbortSignal.any([signal, silence.signal]) });
    if (!response.ok) {
      await response.body?.cancel();
      throw new RequestError("http", url, `the server answered ${response.status} ${response.statusText}`.trim(), response.status);
    }
    return await readBody(url, response, listen, onBytes);
  } catch (error) {
    if (signal.aborted) throw signal.reason;
    if (silence.signal.aborted) throw new RequestError("timeout", url, `no byte came for ${options.silenceMs / 1000} s`);
    if (error instanceof RequestError) throw error;
    throw new RequestError("network", url, error instanceof Error ? error.message : String(error));
  } finally {
    clearTimeout(timer);
  }
}

async function readBody(url: string, response: Response, onChunk: () => void,
                        onBytes: ByteCount): Promise<Uint8Array<ArrayBuffer>> {
  const total = totalBytesOf(response);
  const chunks: Uint8Array[] = [];
  let loaded = 0;
  onBytes(0, total);
  if (response.body !== null) {
    for await (const chunk of chunksOf(response.body)) {
      onChunk();
      loaded += chunk.byteLength;
      if (loaded > largestDownloadBytes) throw new RequestError("limit", url, `more than ${largestDownloadBytes} bytes came`);
      chunks.push(chunk);
      onBytes(loaded, total);
    }
  }
  const bytes = new Uint8Array(loaded);
  let offset = 0;
  for (const chunk of chunks) {
    bytes.set(chunk, offset);
    offset += chunk.byteLength;
  }
  return bytes;
}

/** Streams are not async iterable in every browser yet. */
async function* chunksOf(body: ReadableStream<Uint8Array>): AsyncGenerator<Uint8Array> {
  const reader = body.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      yield value;
    }
  } finally {
    // Ends the transfer where we stop early; after its end it does nothing.
    await reader.cancel().catch(() => undefined);
  }
}

function totalBytesOf(response: Response): number | undefined {
  // Content-Length counts the bytes on the wire, the body gives them unpacked.
  if (response.headers.get("content-encoding") !== null) return undefined;
  const length = Number(response.headers.get("content-length") ?? NaN);
  return Number.isSafeInteger(length) && length >= 0 ? length : undefined;
}

function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const abort = () => {
      clearTimeout(timer);
      reject(signal.reason as Error);
    };
    const timer = setTimeout(() => {
      signal.removeEventListener("abort", abort);
      resolve();
    }, milliseconds);
    signal.addEventListener("abort", abort, { once: true });
  });
}
