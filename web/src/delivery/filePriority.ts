// What a shape needs of its files for a view, and how soon: the three factors of
// paper section 5.4 put together, and "closer objects get higher precision".

import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import { boxAround, isUnbounded } from "../document/geometry.ts";
import { dequantizationOf } from "../document/dequantization.ts";
import type { ChunkWeights } from "../scheduler/priority.ts";
import { priorityOf } from "../scheduler/priority.ts";
import type { Camera, Matrix, Sphere, ViewMetrics } from "../scheduler/viewMetrics.ts";
import { scaleOf, sphereOf, unknownViewMetrics, viewMetricsOf } from "../scheduler/viewMetrics.ts";
import type { FilePriority } from "./geometryDelivery.ts";
import type { PatchFile } from "./patchFiles.ts";
import type { TextureChunk } from "./textureDeliveries.ts";

/** A vertex that moves by less than half of this many device pixels moves unseen. */
const minVisibleStepPixels = 0.5;

/** A geometry in one of the places where it stands in the scene; stays the same while only the camera moves. */
export interface GeometryInstance {
  readonly geometry: GeometryDescription;
  /** The author's priority, there. */
  readonly authorPriority: number;
  /** Around each patch, in the scene. */
  readonly spheres: readonly Sphere[];
  /** Of each patch, in the scene: the distance between two values of the first byte. */
  readonly coarseSteps: readonly number[];
  /** A texture is laid over it. */
  readonly isTextured: boolean;
}

/** Around what may lie wherever it likes: it counts as before the camera, and as large. */
const anywhere: Sphere = { center: [0, 0, 0], radius: 1e12 };

export function geometryInstance(
  geometry: GeometryDescription,
  sceneFromShape: Matrix,
  authorPriority: number,
  isTextured = false,
): GeometryInstance {
  const scale = scaleOf(sceneFromShape);
  return {
    geometry,
    authorPriority: authorPriority,
    isTextured,
    spheres: geometry.patches.map((patch) =>
      isUnbounded(geometry, patch)
        ? anywhere
        : sphereOf(patch.box ?? boxAround(geometry.position, geometry.size), sceneFromShape),
    ),
    coarseSteps: geometry.patches.map(
      (patch) => Math.max(...dequantizationOf(geometry, patch).step) * 256 ** (patch.coord.length - 1) * scale,
    ),
  };
}

/** What is the same for all shapes of a scene. */
export interface ViewState {
  /** Undefined while there is no picture: everything is then wanted. */
  readonly camera: Camera | undefined;
  readonly weights: ChunkWeights;
}

/** What is wanted of a geometry that is seen in these places; nothing where it is seen in none. */
export function filePriorityFor(places: Iterable<GeometryInstance>, viewing: ViewState): FilePriority {
  // Of a geometry of which nothing is asked, nobody looks where its places are.
  let demands: readonly FilePriority[] | undefined;
  return (patch, part) => {
    demands ??= Array.from(places, (placed) => filePriorityAt(placed, viewing));
    let most: number | undefined;
    for (const demand of demands) {
      const priority = demand(patch, part);
      if (priority !== undefined && (most === undefined || priority > most)) most = priority;
    }
    return most;
  };
}

/** How soon a texture, or its preview, is wanted that is laid over a geometry in these places; undefined where it is seen in none. */
export function texturePriorityFor(
  places: Iterable<GeometryInstance>,
  type: TextureChunk,
  { camera, weights }: ViewState,
): number | undefined {
  const priorities = Array.from(places).flatMap(({ spheres, authorPriority: content }) =>
    spheres.map((sphere) =>
      priorityOf(content, { type, plane: 0 }, camera ? viewMetricsOf(sphere, camera) : unknownViewMetrics, weights),
    ),
  );
  return priorities.length > 0 ? Math.max(...priorities) : undefined;
}

function filePriorityAt(placed: GeometryInstance, { camera, weights }: ViewState): FilePriority {
  let views: readonly ViewMetrics[] | undefined;
  return (place, part) => {
    if (part.chunk.type === "texCoord" && !placed.isTextured) return undefined;
    views ??= placed.spheres.map((sphere) => (camera ? viewMetricsOf(sphere, camera) : unknownViewMetrics));
    const view = views[place] ?? unknownViewMetrics;
    const patch = placed.geometry.patches[place];
    const coarseStep = placed.coarseSteps[place] ?? Infinity;
    if (patch !== undefined && isTooFine(part, patch, coarseStep, view)) return undefined;
    return priorityOf(placed.authorPriority, part.chunk, view, weights);
  };
}

/**
 * A byte plane waits while the planes above it place every vertex where the eye
 * would see it anyway. Not where a surface has no normals: its shading comes from
 * the slope between vertices, which shows steps that are far smaller.
 */
function isTooFine(part: PatchFile, patch: PatchDescription, coarseStep: number, view: ViewMetrics): boolean {
  if (part.chunk.type !== "refinement") return false;
  const isShadedBySlope =
    patch.normal === undefined &&
    patch.draws.some(({ primitive }) => primitive === "triangles" || primitive === "triangleStrip");
  const stepAbove = coarseStep / 256 ** (part.plane - 1);
  return !isShadedBySlope && stepAbove * view.pixelsPerUnit < minVisibleStepPixels;
}
