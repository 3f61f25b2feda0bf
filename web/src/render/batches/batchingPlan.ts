// Which shapes are drawn together. A draw costs the page about as much as some
// ten thousand vertices cost the GPU, so a scene of many shapes must not draw them
// one by one: what stands in many places is drawn in all of them at once, and
// small meshes become one large mesh. See docs/decisions/batches.md.

import type { GeometryDescription } from "../../document/description.ts";
import { formatOf } from "../../document/encodings.ts";

/** By itself; in all its places at once; or as a part of one mesh with others. */
export type DrawMode = "alone" | "instanced" | "merged";

/** How a geometry is drawn: stages of it that blend, and others. */
export interface DrawModes {
  readonly opaque: DrawMode;
  readonly blended: DrawMode;
}

export const alone: DrawModes = { opaque: "alone", blended: "alone" };
const instanced: DrawModes = { opaque: "instanced", blended: "instanced" };
const merged: DrawModes = { opaque: "merged", blended: "merged" };
/** What blends has its turn among others that do, which batches know of. */
const byItself: DrawModes = { opaque: "alone", blended: "instanced" };

/** Scenes of fewer places are drawn one by one, each under its own matrix in double precision. */
export const minInstances = 16;
/** In all its places together, what is merged has no more vertices than this. */
export const maxMergedVertices = 16384;

/**
 * How to draw each geometry of a scene, by the places where shapes show it. All patches
 * of a geometry are drawn alike: their common vertices go through the same arithmetic.
 */
export class BatchingPlan {
  readonly #counts = new Map<GeometryDescription, number>();
  readonly #told = new Map<GeometryDescription, DrawModes>();
  #touched = new Set<GeometryDescription>();
  #placeCount = 0;
  #wasCrowd = false;

  add(geometry: GeometryDescription): void {
    this.#counts.set(geometry, this.#countOf(geometry) + 1);
    this.#placeCount += 1;
    this.#touched.add(geometry);
  }

  remove(geometry: GeometryDescription): void {
    const count = this.#countOf(geometry) - 1;
    if (count > 0) this.#counts.set(geometry, count);
    else this.#counts.delete(geometry);
    this.#placeCount -= 1;
    this.#touched.add(geometry);
  }

  drawModesOf(geometry: GeometryDescription): DrawModes {
    if (!this.#isCrowd) return alone;
    const count = this.#countOf(geometry);
    if (formatOf(geometry).storage !== "bytePlanes" && verticesOf(geometry) * count <= maxMergedVertices) return merged;
    return count > 1 ? instanced : byItself;
  }

  /** Geometries that are drawn in another way than when this was last called. */
  takeChanged(): ReadonlySet<GeometryDescription> {
    const asked =
      this.#isCrowd === this.#wasCrowd ? this.#touched : new Set([...this.#touched, ...this.#counts.keys()]);
    const changed = new Set<GeometryDescription>();
    for (const geometry of asked) {
      const drawing = this.#counts.has(geometry) ? this.drawModesOf(geometry) : undefined;
      if (drawing === this.#told.get(geometry)) continue;
      if (drawing === undefined) this.#told.delete(geometry);
      else this.#told.set(geometry, drawing);
      changed.add(geometry);
    }
    this.#wasCrowd = this.#isCrowd;
    this.#touched = new Set();
    return changed;
  }

  get #isCrowd(): boolean {
    return this.#placeCount >= minInstances;
  }

  #countOf(geometry: GeometryDescription): number {
    return this.#counts.get(geometry) ?? 0;
  }
}

/** Infinity where the document does not tell. */
function verticesOf({ patches }: GeometryDescription): number {
  return patches.reduce((sum, { vertexCount }) => sum + (vertexCount || Infinity), 0);
}
