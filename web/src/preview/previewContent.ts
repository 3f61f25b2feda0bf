// What a preview displays, read from the document, and how many bytes its patches have.

import { compactBytesOf } from "../document/patchSizes.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { cameraSettingOf, readSettings } from "../element/attributes.ts";
import type { PreviewScene } from "./previewScene.ts";
import { previewSceneOf } from "./previewScene.ts";

export interface PreviewContent {
  readonly scene: PreviewScene;
  readonly exposure: number;
  /** GPU memory of the scene, in bytes. */
  readonly budget: number;
}

/**
 * Patches of a scene that has at most this much of them are drawn by the preview, before the runtime is requested: on
 * every line they arrive sooner than the runtime, which is about as large. Expected bytes.
 */
export const maxSmallBytes = 192 * 1024;

/** Documents with more Shape elements are not read for a preview, which would not draw so many. */
const maxShapeElements = 4096;

/** The scene that the document describes now; undefined if only the runtime can display it. */
export function previewContentOf(x3d: Element): PreviewContent | undefined {
  const settings = readSettings(x3d, () => undefined);
  if (settings["draw-as"] !== "surface" || settings.reveal !== "auto") return undefined;
  if (x3d.getElementsByTagName("shape").length > maxShapeElements) return undefined;
  const scene = previewSceneOf(new SceneReader(x3d).read(), cameraSettingOf(settings));
  return scene && { scene, exposure: settings.exposure, budget: settings.budget };
}

/** Whether every shape can be displayed before the runtime: by its base, or by patches that are small enough. */
export function isDrawnEarly(scene: PreviewScene): boolean {
  if (scene.shapes.every(({ base }) => base !== undefined)) return true;
  return sumOf(patchBytesOf(scene)) <= maxSmallBytes;
}

export function baseUrlsOf({ shapes }: PreviewScene): ReadonlySet<string> {
  return new Set(shapes.flatMap(({ base }) => (base ? [absoluteUrlOf(base.url)] : [])));
}

/**
 * The expected bytes of each file of patches, by the URL that the document states. A shape may have several instances.
 */
export function patchBytesOf({ shapes }: PreviewScene): ReadonlyMap<string, number> {
  const files = new Map<string, number>();
  for (const geometry of new Set(shapes.map((shape) => shape.geometry)))
    for (const patch of geometry.patches)
      if (patch.data) files.set(patch.data.url, (files.get(patch.data.url) ?? 0) + compactBytesOf(patch));
  return files;
}

/** Whether meshes have levels of detail: how many of their groups are drawn depends on the view. */
export function hasLevels({ shapes }: PreviewScene): boolean {
  return shapes.some(({ geometry }) => geometry.levels !== undefined);
}

export function sumOf(bytes: ReadonlyMap<string, number>): number {
  return Array.from(bytes.values()).reduce((sum, count) => sum + count, 0);
}

export function absoluteUrlOf(url: string): string {
  return URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).href : url;
}
