// The decoded meshes of a preview: bases, patches, and groups of meshes with levels of detail; and which of them
// display a shape.

import type { Base } from "../decode/compact/baseBuffers.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import { hasDeformation } from "../document/deformation.ts";
import type { SceneElement } from "../document/element.ts";
import type { EarlyContent } from "./earlyLoading.ts";
import type { FirstGroups } from "./firstGroups.ts";
import { absoluteUrlOf } from "./previewContent.ts";
import type { PreviewMesh } from "./previewRenderer.ts";
import { isDrawable, isDrawableGroup, isDrawablePatch } from "./previewRenderer.ts";
import type { PreviewShape } from "./previewScene.ts";

/** A shape that a preview displays. */
export interface PreviewedShape {
  readonly element: SceneElement;
  /**
   * Indices of the patches that have triangles: in their segment of the base, or at all. For a mesh with levels of
   * detail, the numbers of its open groups.
   */
  readonly patches: readonly number[];
  readonly stage: "base" | "full";
}

export class PreviewMeshes {
  /** The groups that the view needs of meshes with levels of detail; undefined as long as they are not known. */
  groups: FirstGroups | undefined;
  /** By the absolute URLs of their files. */
  readonly #bases = new Map<string, readonly Base[]>();
  readonly #patches = new Map<string, readonly PatchBuffers[]>();

  addBases(url: string, bases: readonly Base[]): void {
    this.#bases.set(url, bases);
  }

  /** Adds the patches or the group in a file, by its absolute URL. */
  add(url: string, content: EarlyContent): void {
    if ("patches" in content) this.#patches.set(url, content.patches);
    if ("group" in content) this.groups?.add(url, content.group);
  }

  /** Whether the shape has no base, or its file has been decoded. */
  knowsBase({ base }: PreviewShape): boolean {
    return base === undefined || this.#bases.has(absoluteUrlOf(base.url));
  }

  /** Whether the shape has its base, or all of its patches. */
  has(shape: PreviewShape): boolean {
    return (this.#baseOf(shape) ?? this.#fullMeshesOf(shape)) !== undefined;
  }

  /** What displays a shape; undefined if it is not here, or contradicts the document. */
  meshesOf(shape: PreviewShape): readonly PreviewMesh[] | undefined {
    const base = this.#baseOf(shape);
    return this.#fullMeshesOf(shape) ?? (base && isDrawable(shape, base) ? [{ buffers: base.whole }] : undefined);
  }

  displayedOf(shape: PreviewShape): PreviewedShape {
    const { element, geometry } = shape;
    if (this.#fullMeshesOf(shape) === undefined)
      return { element, patches: geometry.levels ? [0] : this.#segmentsOf(shape), stage: "base" };
    const groups = geometry.levels && this.groups?.groupsOf(absoluteUrlOf(geometry.levels.url));
    return { element, patches: groups ?? geometry.patches.map((_, patch) => patch), stage: "full" };
  }

  /** Frees all arrays. */
  clear(): void {
    this.#bases.clear();
    this.#patches.clear();
    this.groups?.clear();
  }

  #baseOf({ base }: PreviewShape): Base | undefined {
    return base && this.#bases.get(absoluteUrlOf(base.url))?.[base.patchIndex];
  }

  /** The segments of the base that have triangles. */
  #segmentsOf(shape: PreviewShape): readonly number[] {
    const segments = this.#baseOf(shape)?.segments ?? [];
    return segments.flatMap((segment, patch) => (segment === undefined ? [] : [patch]));
  }

  /** The patches of a shape, or the groups for its view, if all of them are here; otherwise undefined. */
  #fullMeshesOf(shape: PreviewShape): readonly PreviewMesh[] | undefined {
    const { patches, levels } = shape.geometry;
    if (hasDeformation(shape.geometry)) return undefined;
    if (levels !== undefined) {
      const meshes = this.groups?.meshesOf(absoluteUrlOf(levels.url), this.#baseOf(shape));
      return meshes?.every((mesh) => isDrawableGroup(shape, mesh)) === true ? meshes : undefined;
    }
    const buffers = patches.map(({ data }) =>
      data && "patchIndex" in data ? this.#patches.get(absoluteUrlOf(data.url))?.[data.patchIndex] : undefined,
    );
    const areDrawable = patches.every((patch, n) => isDrawablePatch(shape, patch, buffers[n]));
    return areDrawable ? buffers.flatMap((each) => (each ? [{ buffers: each }] : [])) : undefined;
  }
}
