import type { DownloadState } from "../scheduler/download.ts";

/** One file on its way. Of those that are not asked for there is none. */
export interface Transfer {
  /** As the document writes it. */
  readonly url: string;
  /** `decoding`: all bytes are here. `ready` and `failed`: nothing more will follow. */
  state: DownloadState | "decoding" | "ready" | "failed";
  loadedBytes: number;
  /** An estimate until the server says, exact once settled. */
  totalBytes: number;
  /** Requests sent for it so far. */
  tries: number;
  /** Why it has failed. */
  error: string | undefined;
}

export function isSettled({ state }: Pick<Transfer, "state">): boolean {
  return state === "ready" || state === "failed";
}

export interface Progress {
  /** 0 … 1; 1 only when everything is settled. Never smaller than before. */
  readonly totalProgress: number;
  readonly loadedBytes: number;
  readonly totalBytes: number;
}

export const noProgress: Progress = { totalProgress: 0, loadedBytes: 0, totalBytes: 0 };

/**
 * The progress of some transfers. Sizes of files that have not begun are
 * estimates, so the bare quotient may fall when a server tells a larger one;
 * people are shown the largest share so far, and 1 only at the very end.
 */
export function progressOf(
  transfers: readonly Pick<Transfer, "state" | "loadedBytes" | "totalBytes">[],
  before: Progress,
): Progress {
  let loadedBytes = 0;
  let totalBytes = 0;
  for (const transfer of transfers) {
    loadedBytes += transfer.loadedBytes;
    totalBytes += transfer.totalBytes;
  }
  if (transfers.every(isSettled)) return { totalProgress: 1, loadedBytes, totalBytes };
  const share = totalBytes > 0 ? loadedBytes / totalBytes : 0;
  return { totalProgress: Math.max(before.totalProgress, Math.min(share, 0.999)), loadedBytes, totalBytes };
}
