// Progress of transfers: the state of each requested file, and the share of bytes that have been loaded.

import type { DownloadState } from "../scheduler/download.ts";

/** The transfer of one requested file. */
export interface Transfer {
  /** The URL as the document writes it. */
  readonly url: string;
  /** `decoding`: all bytes have arrived. `ready` and `failed` are final. */
  state: DownloadState | "decoding" | "ready" | "failed";
  loadedBytes: number;
  /** An estimate until the server states it; exact once settled. */
  totalBytes: number;
  /** Number of requests sent for it so far. */
  tries: number;
  /** Why it failed. */
  error: string | undefined;
}

export function isSettled({ state }: Pick<Transfer, "state">): boolean {
  return state === "ready" || state === "failed";
}

export interface Progress {
  /** 0 … 1; 1 only when every transfer is settled. Never decreases. */
  readonly totalProgress: number;
  readonly loadedBytes: number;
  readonly totalBytes: number;
}

export const noProgress: Progress = { totalProgress: 0, loadedBytes: 0, totalBytes: 0 };

/**
 * The progress of some transfers. Sizes of files that have not begun are estimates, so the plain quotient would
 * decrease when a server states a larger one; the result is the largest quotient so far, and 1 only once all are
 * settled.
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
