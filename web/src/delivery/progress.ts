/** One file on its way. */
export interface Transfer {
  loadedBytes: number;
  /** An estimate until the server says, exact once settled. */
  totalBytes: number;
  /** Come or failed: nothing more will follow. */
  isSettled: boolean;
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
export function progressOf(transfers: readonly Readonly<Transfer>[], before: Progress): Progress {
  let loadedBytes = 0;
  let totalBytes = 0;
  for (const transfer of transfers) {
    loadedBytes += transfer.loadedBytes;
    totalBytes += transfer.totalBytes;
  }
  if (transfers.every((transfer) => transfer.isSettled)) return { totalProgress: 1, loadedBytes, totalBytes };
  const share = totalBytes > 0 ? loadedBytes / totalBytes : 0;
  return { totalProgress: Math.max(before.totalProgress, Math.min(share, 0.999)), loadedBytes, totalBytes };
}
