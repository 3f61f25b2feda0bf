// The files of a preview's patches, in the order in which the runtime would request them.

import { priorityOf } from "../scheduler/priority.ts";
import type { Camera } from "../scheduler/viewMetrics.ts";
import { sphereOf, viewMetricsOf } from "../scheduler/viewMetrics.ts";
import { boxAround } from "../document/geometry.ts";
import { compactBytesOf } from "../document/patchSizes.ts";
import type { EarlyRequest } from "./earlyLoading.ts";
import type { PreviewScene } from "./previewScene.ts";

/**
 * The files of all patches, each once, largest priority first; `absoluteUrlOf` makes a URL of the
 * document absolute.
 */
export function patchFilesOf(
  scene: PreviewScene,
  camera: Camera,
  absoluteUrlOf: (url: string) => string,
): EarlyRequest[] {
  const files = new Map<string, EarlyRequest>();
  for (const { geometry, priority: authorPriority, sceneFromShape } of scene.shapes) {
    for (const patch of geometry.patches) {
      if (patch.data === undefined) continue;
      const box = patch.box ?? boxAround(geometry.position, geometry.size);
      const view = viewMetricsOf(sphereOf(box, sceneFromShape.elements), camera);
      const url = absoluteUrlOf(patch.data.url);
      const before = files.get(url);
      const priority = priorityOf(authorPriority, { type: "patch", plane: 0 }, view);
      files.set(url, {
        kind: "patches",
        url,
        expectedBytes: (before?.expectedBytes ?? 0) + compactBytesOf(patch),
        priority: Math.max(priority, before?.priority ?? 0),
      });
    }
  }
  return Array.from(files.values()).sort((a, b) => b.priority - a.priority);
}
