import type { LoadingManager } from "three";
import type { Transfer } from "../delivery/progress.ts";
import { isSettled } from "../delivery/progress.ts";
import type { ImgeoScene } from "./imgeoScene.ts";

/**
 * Makes each file of a scene an item of the manager, from its request until it has loaded, failed or been aborted.
 * data: URLs are no items.
 */
export function reportToManager(scene: ImgeoScene, manager: LoadingManager, resolve: (url: string) => string): void {
  const open = new Set<Readonly<Transfer>>();
  const reported = new WeakSet<Readonly<Transfer>>();
  const close = (transfer: Readonly<Transfer>) => {
    const url = resolve(transfer.url);
    open.delete(transfer);
    if (transfer.state !== "ready") manager.itemError(url);
    manager.itemEnd(url);
  };
  const report = () => {
    const transfers = new Set(scene.transfers);
    for (const transfer of transfers) {
      if (!reported.has(transfer) && !transfer.url.startsWith("data:")) {
        reported.add(transfer);
        open.add(transfer);
        manager.itemStart(resolve(transfer.url));
      }
    }
    for (const transfer of open) if (isSettled(transfer) || !transfers.has(transfer)) close(transfer);
  };
  report();
  scene.addEventListener("progress", report);
  scene.addEventListener("abort", report);
}
