// Which files a preview requests, and which of them it waits for, by the rate of the line.

import { lineBitsPerSecond } from "../workers/lineRate.ts";
import type { EarlyLoading, EarlyRequest } from "./earlyLoading.ts";
import { patchFilesOf } from "./earlyPatches.ts";
import type { ChooseFirstGroups, FirstGroups } from "./firstGroups.ts";
import type { PreviewContent } from "./previewContent.ts";
import { absoluteUrlOf, maxSmallBytes } from "./previewContent.ts";
import { previewCameraOf } from "./previewRenderer.ts";
import type { PreviewScene } from "./previewScene.ts";

/** Loads the module that chooses groups of meshes with levels of detail. */
export type LoadFirstGroups = () => Promise<{ readonly chooseFirstGroups: ChooseFirstGroups }>;

/**
 * More patches than `maxSmallBytes` are drawn by the preview, too, where they arrive within this time: starting the
 * runtime would delay them for as long.
 */
const maxArrivalMs = 600;

/** Where small patches arrive within this time, no bases are decoded and drawn: both would delay the patches. */
const maxInstantArrivalMs = 30;

/** Expected bytes of patches that are requested and decoded before the runtime needs them. */
export const maxEarlyBytes = 2 * 2 ** 20;

/** Whether all files of a scene arrive sooner than the runtime would start. */
export function arrivesSoon(bytes: number): boolean {
  return bytes <= maxSmallBytes || bytes <= Math.min(bytesWithin(maxArrivalMs), maxEarlyBytes);
}

/** Whether all files arrive and are decoded about as soon as bases would be drawn. */
export function arrivesAtOnce(bytes: number): boolean {
  return bytes <= Math.min(bytesWithin(maxInstantArrivalMs), maxSmallBytes);
}

/** Bytes that arrive within a time at the rate measured so far. */
function bytesWithin(milliseconds: number): number {
  return ((lineBitsPerSecond() ?? 0) / 8000) * milliseconds;
}

/** The files of all patches in the order in which the camera needs them; none for a canvas without area. */
export function patchRequestsOf(scene: PreviewScene, { width, height }: HTMLCanvasElement): readonly EarlyRequest[] {
  if (width === 0 || height === 0) return [];
  return patchFilesOf(scene, previewCameraOf(scene, width, height), absoluteUrlOf);
}

/** The groups that the view of a scene needs; undefined for a canvas without area, or if they cannot be chosen. */
export async function chooseGroups(
  { scene, budget }: PreviewContent,
  { width, height }: HTMLCanvasElement,
  early: EarlyLoading,
  loadFirstGroups: LoadFirstGroups,
): Promise<FirstGroups | undefined> {
  if (width === 0 || height === 0) return undefined;
  try {
    const { chooseFirstGroups } = await loadFirstGroups();
    return await chooseFirstGroups(scene, previewCameraOf(scene, width, height), budget, absoluteUrlOf, early);
  } catch {
    return undefined; // the runtime reports what cannot be loaded
  }
}

/** Fetches a file into the browser's cache. */
export function prefetch(url: string): void {
  fetch(url, { priority: "low" })
    .then((response) => response.arrayBuffer())
    .catch(() => undefined); // the workers try themselves
}
