// One URL -> its bytes, counted as they come, with a limit on silence and
// retries where trying again can help.

import type { Prioritised } from "./priorityQueue.ts";
import { retryDelayMs } from "./retry.ts";
import type { Scheduler } from "./scheduler.ts";

export type RequestFailure = "http" | "network" | "timeout" | "limit";

export class RequestError extends Error {
  override readonly name = "RequestError";
  readonly kind: RequestFailure;
  readonly url: string;
  /** The HTTP status; 0 where there was no answer. */
  readonly status: number;
  /** The server's `Retry-After`, as it wrote it. */
  readonly retryAfter: string | undefined;

  constructor(kind: RequestFailure, url: string, message: string, status = 0, retryAfter?: string) {
    super(message);
    this.kind = kind;
    this.url = url;
    this.status = status;
    this.retryAfter = retryAfter;
  }
}

/** No container file comes near; a server that sends more is not sending one. */
export const maxDownloadBytes = 2 ** 30;

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

/** Where a download stands: in the queue, on the line, or waiting to try again. */
export type DownloadState = "waiting" | "loading" | "retrying";

/** What is told of a download on its way. */
export interface DownloadListener {
  onState(state: DownloadState): void;
  /** `totalBytes` is undefined where the server does not say or says it of the compressed body. */
  onBytes(loadedBytes: number, totalBytes: number | undefined): void;
}

/**
 * Downloads `url` in a slot of the scheduler and takes the bytes over there: while
 * `take` waits, nothing further is asked for. Each attempt has a slot of its own:
 * until the next one, others use the slot. Which failures are tried again, and
 * when, is said in retry.ts; all others are final.
 */
export async function downloadInSlot<Result>(
  scheduler: Scheduler,
  subject: Prioritised,
  url: string,
  signal: AbortSignal,
  options: DownloadOptions,
  listener: DownloadListener,
  take: (bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal) => Promise<Result>,
): Promise<Result> {
  for (let attempt = 0; ; ++attempt) {
    try {
      listener.onState("waiting");
      return await scheduler.run(subject, signal, async (jobSignal) => {
        listener.onState("loading");
        return take(await download(url, jobSignal, options, listener), jobSignal);
      });
    } catch (error) {
      const delayMs =
        attempt < options.retries && error instanceof RequestError
          ? retryDelayMs(error, options.backoffMs * 2 ** attempt, Date.now())
          : undefined;
      if (signal.aborted || delayMs === undefined) throw error;
      listener.onState("retrying");
      await pause(delayMs, signal);
    }
  }
}

/** One attempt. Rejects with RequestError, or with the signal's reason. */
export async function download(
  url: string,
  signal: AbortSignal,
  options: DownloadOptions,
  listener: Pick<DownloadListener, "onBytes">,
): Promise<Uint8Array<ArrayBuffer>> {
  const silence = new AbortController();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const listen = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      silence.abort();
    }, options.silenceMs);
  };
  listen();
  try {
    const response = await options.fetch(url, { signal: AbortSignal.any([signal, silence.signal]) });
    if (!response.ok) {
      await response.body?.cancel();
      throw new RequestError(
        "http",
        url,
        `the server answered ${response.status} ${response.statusText}`.trim(),
        response.status,
        response.headers.get("retry-after") ?? undefined,
      );
    }
    return await readBody(url, response, listen, listener);
  } catch (error) {
    if (signal.aborted) throw signal.reason;
    if (silence.signal.aborted)
      throw new RequestError("timeout", url, `no byte came for ${options.silenceMs / 1000} s`);
    if (error instanceof RequestError) throw error;
    throw new RequestError("network", url, networkMessage(url, error));
  } finally {
    clearTimeout(timer);
  }
}

/** Browsers do not say why: of another origin the likeliest cause is that it does not allow this page to read. */
function networkMessage(url: string, error: unknown): string {
  const reason = error instanceof Error ? error.message : String(error);
  const page = (globalThis as { location?: Location }).location;
  const isForeign = page !== undefined && URL.canParse(url) && new URL(url).origin !== page.origin;
  return isForeign ? `${reason}; another origin must allow it with Access-Control-Allow-Origin` : reason;
}

async function readBody(
  url: string,
  response: Response,
  onChunk: () => void,
  { onBytes }: Pick<DownloadListener, "onBytes">,
): Promise<Uint8Array<ArrayBuffer>> {
  const total = totalBytesOf(response);
  const chunks: Uint8Array[] = [];
  let loaded = 0;
  onBytes(0, total);
  if (response.body !== null) {
    for await (const chunk of chunksOf(response.body)) {
      onChunk();
      loaded += chunk.byteLength;
      if (loaded > maxDownloadBytes) throw new RequestError("limit", url, `more than ${maxDownloadBytes} bytes came`);
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
