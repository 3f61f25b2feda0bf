// Fake servers for tests of downloads.

import type { DownloadListener, DownloadOptions } from "./download.ts";

export const url = "https://example.org/file.png";
export const subject = { priority: 1 };
export const listener: DownloadListener = { onState: () => undefined, onBytes: () => undefined };

export function optionsWithFetch(fetch: typeof globalThis.fetch): DownloadOptions {
  return { fetch, idleTimeoutMs: 1000, retries: 0, backoffMs: 1 };
}

export const status = (code: number) => optionsWithFetch(() => Promise.resolve(new Response("no", { status: code })));
export const ok = optionsWithFetch(() => Promise.resolve(new Response("bytes")));

/** Sends no response and rejects when the request is aborted, like the connection to a stalled server. */
export const unanswered = optionsWithFetch(
  (_, init) =>
    new Promise((_resolve, reject) => {
      init?.signal?.addEventListener("abort", () => {
        reject(init.signal?.reason as Error);
      });
    }),
);

export const decoded = (bytes: Uint8Array) => Promise.resolve(bytes.byteLength);
