// Decides which shapes are drawn together. A draw call costs the page about as much as ten thousand
// vertices cost the GPU, so scenes of many shapes use few calls: instancing for meshes with several
// instances, and merging of small meshes. See docs/decisions/batches.md.

import type { GeometryDescription } from "../../document/description.ts";
import { formatOf } from "../../document/encodings.ts";
import { minBatchedInstances } from "../../document/parts.ts";

/**
 * `alone`: one draw call per instance. `instanced`: one call for all instances. `merged`: one call for a mesh into
 * which several shapes are merged.
 */
export type DrawMode = "alone" | "instanced" | "merged";

/** The draw modes of a geometry's opaque and blended stages. */
export interface DrawModes {
  readonly opaque: DrawMode;
  readonly blended: DrawMode;
}

export const alone: DrawModes = { opaque: "alone", blended: "alone" };
const instanced: DrawModes = { opaque: "instanced", blended: "instanced" };
const merged: DrawModes = { opaque: "merged", blended: "merged" };
/** Blended draws must be in batches, since only batches are sorted with one another. */
const opaqueAlone: DrawModes = { opaque: "alone", blended: "instanced" };

/** A geometry is merged if all its instances together have at most this many vertices. */
export const maxMergedVertices = 16384;

/**
 * The draw mode of each geometry of a scene, from the number of its instances. All patches of a geometry have the same
 * mode, so that vertices that they share go through the same arithmetic.
 */
export class BatchingPlan {
  /** Number of instances by geometry. */
  readonly #counts = new Map<GeometryDescription, number>();
  /** The draw modes at the last call of takeChanged. */
  readonly #reported = new Map<GeometryDescription, DrawModes>();
  /** Geometries whose number of instances has changed since the last call of takeChanged. */
  #changedCounts = new Set<GeometryDescription>();
  #instanceCount = 0;
  #hadManyInstances = false;

  add(geometry: GeometryDescription): void {
    this.#counts.set(geometry, this.#countOf(geometry) + 1);
    this.#instanceCount += 1;
    this.#changedCounts.add(geometry);
  }

  remove(geometry: GeometryDescription): void {
    const count = this.#countOf(geometry) - 1;
    if (count > 0) this.#counts.set(geometry, count);
    else this.#counts.delete(geometry);
    this.#instanceCount -= 1;
    this.#changedCounts.add(geometry);
  }

  drawModesOf(geometry: GeometryDescription): DrawModes {
    if (!this.#hasManyInstances || geometry.levels) return alone;
    const count = this.#countOf(geometry);
    // A merged mesh copies vertices, which would not move.
    const isFixed = geometry.moving === undefined;
    if (isFixed && formatOf(geometry).storage !== "bytePlanes" && vertexCountOf(geometry) * count <= maxMergedVertices)
      return merged;
    return count > 1 ? instanced : opaqueAlone;
  }

  /** Geometries whose draw modes have changed since the last call. */
  takeChanged(): ReadonlySet<GeometryDescription> {
    const candidates =
      this.#hasManyInstances === this.#hadManyInstances
        ? this.#changedCounts
        : new Set([...this.#changedCounts, ...this.#counts.keys()]);
    const changed = new Set<GeometryDescription>();
    for (const geometry of candidates) {
      const modes = this.#counts.has(geometry) ? this.drawModesOf(geometry) : undefined;
      if (modes === this.#reported.get(geometry)) continue;
      if (modes === undefined) this.#reported.delete(geometry);
      else this.#reported.set(geometry, modes);
      changed.add(geometry);
    }
    this.#hadManyInstances = this.#hasManyInstances;
    this.#changedCounts = new Set();
    return changed;
  }

  get #hasManyInstances(): boolean {
    return this.#instanceCount >= minBatchedInstances; // with fewer, matrices are double-precision
  }

  #countOf(geometry: GeometryDescription): number {
    return this.#counts.get(geometry) ?? 0;
  }
}

/** The number of vertices of a geometry; Infinity if the document does not state it. */
function vertexCountOf({ patches }: GeometryDescription): number {
  return patches.reduce((sum, { vertexCount }) => sum + (vertexCount || Infinity), 0);
}
