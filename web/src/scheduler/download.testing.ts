// Servers of a few words, for tests of what happens to a download.

import type { DownloadListener, DownloadOptions } from "./download.ts";

export const url = "https://example.org/file.png";
export const subject = { priority: 1 };
export const listener: DownloadListener = { onState: () => undefined, onBytes: () => undefined };

export function answering(fetch: typeof globalThis.fetch): DownloadOptions {
  return { fetch, idleTimeoutMs: 1000, retries: 0, backoffMs: 1 };
}

export const status = (code: number) => answering(() => Promise.resolve(new Response("no", { status: code })));
export const ok = answering(() => Promise.resolve(new Response("bytes")));

/** Answers only to an abort, as a slow server's connection does. */
export const silent = answering(
  (_, init) =>
    new Promise((_resolve, reject) => {
      init?.signal?.addEventListener("abort", () => {
        reject(init.signal?.reason as Error);
      });
    }),
);

export const decoded = (bytes: Uint8Array) => Promise.resolve(bytes.byteLength);
