// Fetches files in the worker that needs them, with the limits of the page's downloads.

import type { AttemptOptions } from "../scheduler/download.ts";
import { defaultDownloadOptions, download } from "../scheduler/download.ts";

export interface FetchFileOptions extends Pick<AttemptOptions, "maxBytes"> {
  readonly priority?: RequestPriority;
}

/** Rejects with RequestError. The page has requested the file, too: its answer serves both. */
export function fetchFile(
  url: string,
  { priority = "auto", ...limits }: FetchFileOptions = {},
): Promise<Uint8Array<ArrayBuffer>> {
  const { idleTimeoutMs } = defaultDownloadOptions;
  const fetchCached: typeof fetch = (input, init) => fetch(input, { ...init, priority, cache: "force-cache" });
  return download(url, new AbortController().signal, { ...limits, fetch: fetchCached, idleTimeoutMs }, {});
}
