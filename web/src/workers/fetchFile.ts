// Fetches a file in the worker that decodes it, with the limits of the page's downloads.

import { defaultDownloadOptions, download } from "../scheduler/download.ts";

/** Rejects with RequestError. The page has requested the file, too: its answer serves both. */
export function fetchFile(url: string): Promise<Uint8Array<ArrayBuffer>> {
  const { idleTimeoutMs } = defaultDownloadOptions;
  const fetchCached: typeof fetch = (input, init) => fetch(input, { ...init, cache: "force-cache" });
  return download(url, new AbortController().signal, { fetch: fetchCached, idleTimeoutMs }, {});
}
