// Downloads a URL: counts the bytes as they arrive, times out when none arrive, and retries where that can help.

import { pause } from "./pause.ts";
import type { Failure } from "./retry.ts";
import { retryDelayMs } from "./retry.ts";
import type { JobSubject, Scheduler } from "./scheduler.ts";

export class RequestError extends Error {
  override readonly name = "RequestError";
  readonly kind: Failure["kind"];
  readonly url: string;
  /** The HTTP status; 0 where there was no response. */
  readonly status: number;
  /** The `Retry-After` header as the server sent it. */
  readonly retryAfter: string | undefined;

  constructor(kind: Failure["kind"], url: string, message: string, status = 0, retryAfter?: string) {
    super(message);
    this.kind = kind;
    this.url = url;
    this.status = status;
    this.retryAfter = retryAfter;
  }
}

/** Maximum size of a file, far above that of any file of a site. */
export const maxDownloadBytes = 2 ** 30;

export interface DownloadOptions {
  readonly fetch: typeof fetch;
  /** A transfer that receives no byte for this long has failed. */
  readonly idleTimeoutMs: number;
  /** Number of attempts after the first. */
  readonly retries: number;
  /** Delay before the first retry; doubled for each further one. */
  readonly backoffMs: number;
}

export const defaultDownloadOptions: DownloadOptions = {
  fetch: (input, init) => globalThis.fetch(input, init),
  idleTimeoutMs: 30_000,
  retries: 2,
  backoffMs: 400,
};

/** The state of a download: in the queue, receiving bytes, or waiting to try again. */
export type DownloadState = "waiting" | "loading" | "retrying";

export interface DownloadListener {
  onState(state: DownloadState): void;
  /** `totalBytes` is undefined where the server does not state it, or states it for the compressed body. */
  onBytes(loadedBytes: number, totalBytes: number | undefined): void;
}

/** What one attempt needs of the options. */
export interface AttemptOptions extends Pick<DownloadOptions, "fetch" | "idleTimeoutMs"> {
  /** Default: maxDownloadBytes. */
  readonly maxBytes?: number;
}

export interface AttemptListener extends Partial<Pick<DownloadListener, "onBytes">> {
  /** Called when the server has answered, before the body. */
  onHeaders?(headers: Headers): void;
}

/**
 * Downloads `url` in a slot of the scheduler and passes the bytes to `take`, which keeps the slot until it resolves.
 * Each attempt takes a slot of its own; other downloads use it until the next attempt. retry.ts decides which failures
 * are tried again, and when.
 */
export async function downloadInSlot<Result>(
  scheduler: Scheduler,
  subject: JobSubject,
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
        return take(await download(url, jobSignal, options, measured(subject, listener, scheduler)), jobSignal);
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

/** A listener that also tells the scheduler how fast the line is, and that bytes have arrived. */
function measured(subject: JobSubject, listener: DownloadListener, scheduler: Scheduler): AttemptListener {
  const requestedAt = performance.now();
  let loaded = 0;
  return {
    onHeaders: () => {
      scheduler.window.onHeaders(performance.now() - requestedAt);
    },
    onBytes: (loadedBytes, totalBytes) => {
      if (loadedBytes > loaded) scheduler.window.onBytes(loadedBytes - loaded, performance.now());
      loaded = loadedBytes;
      listener.onBytes(loadedBytes, totalBytes);
      scheduler.onBytes(subject);
    },
  };
}

/** One attempt. Rejects with RequestError, or with the signal's reason. */
export async function download(
  url: string,
  signal: AbortSignal,
  options: AttemptOptions,
  listener: AttemptListener,
): Promise<Uint8Array<ArrayBuffer>> {
  const idleTimeout = new AbortController();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const restartTimer = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      idleTimeout.abort();
    }, options.idleTimeoutMs);
  };
  restartTimer();
  try {
    const response = await options.fetch(url, { signal: AbortSignal.any([signal, idleTimeout.signal]) });
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
    listener.onHeaders?.(response.headers);
    return await readBody(url, response, restartTimer, listener, options.maxBytes);
  } catch (error) {
    if (signal.aborted) throw signal.reason;
    if (idleTimeout.signal.aborted)
      throw new RequestError("timeout", url, `no byte came for ${options.idleTimeoutMs / 1000} s`);
    if (error instanceof RequestError) throw error;
    throw new RequestError("network", url, networkMessage(url, error));
  } finally {
    clearTimeout(timer);
  }
}

/**
 * Why a request got no answer. Browsers do not state the cause. For another origin it is most likely that the server
 * sends no CORS header.
 */
export function networkMessage(url: string, error: unknown): string {
  const reason = error instanceof Error ? error.message : String(error);
  const page = (globalThis as { location?: Location }).location;
  const isForeign = page !== undefined && URL.canParse(url) && new URL(url).origin !== page.origin;
  return isForeign ? `${reason}; another origin must allow it with Access-Control-Allow-Origin` : reason;
}

async function readBody(
  url: string,
  response: Response,
  onChunk: () => void,
  listener: AttemptListener,
  maxBytes = maxDownloadBytes,
): Promise<Uint8Array<ArrayBuffer>> {
  const total = totalBytesOf(response);
  const chunks: Uint8Array[] = [];
  let loaded = 0;
  listener.onBytes?.(0, total);
  if (response.body !== null) {
    for await (const chunk of chunksOf(response.body)) {
      onChunk();
      loaded += chunk.byteLength;
      if (loaded > maxBytes) throw new RequestError("limit", url, `more than ${maxBytes} bytes came`);
      chunks.push(chunk);
      listener.onBytes?.(loaded, total);
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

/** ReadableStream is not async iterable in every browser yet. */
async function* chunksOf(body: ReadableStream<Uint8Array>): AsyncGenerator<Uint8Array> {
  const reader = body.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      yield value;
    }
  } finally {
    // Ends the transfer where reading stops early; does nothing once the stream has ended.
    await reader.cancel().catch(() => undefined);
  }
}

function totalBytesOf(response: Response): number | undefined {
  // Content-Length counts compressed bytes; the body gives them decompressed.
  if (response.headers.get("content-encoding") !== null) return undefined;
  const length = Number(response.headers.get("content-length") ?? NaN);
  return Number.isSafeInteger(length) && length >= 0 ? length : undefined;
}
