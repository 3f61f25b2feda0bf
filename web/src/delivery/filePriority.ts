// Computes which files of a geometry a view needs, and their priorities (paper section 5.4). Byte planes too fine to be
// seen are not needed.

import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import { boxAround, isUnbounded } from "../document/geometry.ts";
import { dequantizationOf } from "../document/dequantization.ts";
import type { ChunkWeights } from "../scheduler/priority.ts";
import { priorityOf } from "../scheduler/priority.ts";
import type { Camera, Matrix, Sphere, ViewMetrics } from "../scheduler/viewMetrics.ts";
import { scaleOf, sphereOf, unknownViewMetrics, viewMetricsOf } from "../scheduler/viewMetrics.ts";
import type { FilePriority } from "./geometryDelivery.ts";
import type { PatchFile } from "./patchFiles.ts";
import { isForTextures } from "./patchFiles.ts";
import type { TextureChunk } from "./textureDeliveries.ts";

/** Lattice steps of fewer device pixels than this are invisible. */
const minVisibleStepPixels = 0.5;

/** A geometry and one of its instances in the scene; it stays the same while only the camera moves. */
export interface GeometryInstance {
  readonly geometry: GeometryDescription;
  readonly sceneFromShape: Matrix;
  /** The author's priority of the instance. */
  readonly authorPriority: number;
  /** The bounding sphere of each patch, in the scene. */
  readonly spheres: readonly Sphere[];
  /** For each patch: the distance between two values of the first byte plane, in the scene. */
  readonly coarseSteps: readonly number[];
  /** Whether the appearance has a texture. */
  readonly isTextured: boolean;
}

/** The sphere of a patch without known bounds: the patch counts as large and in view. */
const anywhere: Sphere = { center: [0, 0, 0], radius: 1e12 };

export function geometryInstance(
  geometry: GeometryDescription,
  sceneFromShape: Matrix,
  authorPriority: number,
  isTextured = false,
): GeometryInstance {
  return new MovedGeometry(geometry, sceneFromShape, authorPriority, isTextured);
}

/** Computes spheres and steps when they are read first: those of geometries whose files are all ready never are. */
class MovedGeometry implements GeometryInstance {
  readonly geometry: GeometryDescription;
  readonly authorPriority: number;
  readonly isTextured: boolean;
  readonly sceneFromShape: Matrix;
  #spheres: readonly Sphere[] | undefined;
  #coarseSteps: readonly number[] | undefined;

  constructor(geometry: GeometryDescription, sceneFromShape: Matrix, authorPriority: number, isTextured: boolean) {
    this.geometry = geometry;
    this.sceneFromShape = sceneFromShape;
    this.authorPriority = authorPriority;
    this.isTextured = isTextured;
  }

  get spheres(): readonly Sphere[] {
    const { geometry } = this;
    this.#spheres ??= geometry.patches.map((patch) =>
      isUnbounded(geometry, patch)
        ? anywhere
        : sphereOf(patch.box ?? boxAround(geometry.position, geometry.size), this.sceneFromShape),
    );
    return this.#spheres;
  }

  get coarseSteps(): readonly number[] {
    const { geometry } = this;
    if (this.#coarseSteps) return this.#coarseSteps;
    const scale = scaleOf(this.sceneFromShape);
    return (this.#coarseSteps = geometry.patches.map(
      (patch) => Math.max(...dequantizationOf(geometry, patch).step) * 256 ** (patch.coord.length - 1) * scale,
    ));
  }
}

/** The camera and the weights of file contents, which all shapes of a scene share. */
export interface ViewState {
  /** Undefined before the first frame: all files are then needed. */
  readonly camera: Camera | undefined;
  readonly weights: ChunkWeights;
}

/** The priorities of a geometry's files for its visible instances; undefined for all files if there are none. */
export function filePriorityFor(instances: Iterable<GeometryInstance>, view: ViewState): FilePriority {
  // Computed lazily: most calls concern geometries whose files are all ready.
  let priorities: readonly FilePriority[] | undefined;
  return (patchIndex, file) => {
    priorities ??= Array.from(instances, (instance) => filePriorityAt(instance, view));
    let max: number | undefined;
    for (const priorityAt of priorities) {
      const priority = priorityAt(patchIndex, file);
      if (priority !== undefined && (max === undefined || priority > max)) max = priority;
    }
    return max;
  };
}

/** The metrics of what is always in view. */
const everywhere: ViewMetrics = { pixels: Infinity, isInView: true, pixelsPerUnit: Infinity };

/**
 * The priority of a texture, or of its preview, on these visible instances of a geometry, or around the viewer;
 * undefined where it is on neither.
 */
export function texturePriorityFor(
  instances: Iterable<GeometryInstance>,
  type: TextureChunk,
  { camera, weights }: ViewState,
  isAroundViewer = false,
): number | undefined {
  if (isAroundViewer) return priorityOf(1, { type, plane: 0 }, everywhere, weights);
  const priorities = Array.from(instances).flatMap(({ spheres, authorPriority }) =>
    spheres.map((sphere) =>
      priorityOf(
        authorPriority,
        { type, plane: 0 },
        camera ? viewMetricsOf(sphere, camera) : unknownViewMetrics,
        weights,
      ),
    ),
  );
  return priorities.length > 0 ? Math.max(...priorities) : undefined;
}

function filePriorityAt(instance: GeometryInstance, { camera, weights }: ViewState): FilePriority {
  let views: readonly ViewMetrics[] | undefined;
  return (patchIndex, file) => {
    if (isForTextures(file) && !instance.isTextured) return undefined;
    views ??= instance.spheres.map((sphere) => (camera ? viewMetricsOf(sphere, camera) : unknownViewMetrics));
    const view = views[patchIndex] ?? unknownViewMetrics;
    const patch = instance.geometry.patches[patchIndex];
    const coarseStep = instance.coarseSteps[patchIndex] ?? Infinity;
    if (patch !== undefined && isTooFine(file, patch, coarseStep, view)) return undefined;
    return priorityOf(instance.authorPriority, file.chunk, view, weights);
  };
}

/**
 * A byte plane waits while the planes above it leave steps smaller than half a pixel. Surfaces without normals are
 * exempt: their shading comes from the slope between vertices, which shows far smaller steps.
 */
function isTooFine(file: PatchFile, patch: PatchDescription, coarseStep: number, view: ViewMetrics): boolean {
  if (file.chunk.type !== "refinement" || file.role !== "coord") return false;
  const isShadedBySlope =
    patch.normal === undefined &&
    patch.draws.some(({ primitive }) => primitive === "triangles" || primitive === "triangleStrip");
  const stepAbove = coarseStep / 256 ** (file.plane - 1);
  return !isShadedBySlope && stepAbove * view.pixelsPerUnit < minVisibleStepPixels;
}
