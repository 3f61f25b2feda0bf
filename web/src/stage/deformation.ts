// What moves the vertices of a patch: joints with their weights, and the displacements of displacers. Decoders write it
// as texels, from which vertex shaders and picking read it.

import type { VertexArray } from "./vertexArray.ts";

/** Number and kinds of the texels of a vertex. */
export interface DeformationLayout {
  /** Sets of four joints. */
  readonly jointSets: number;
  readonly displacers: number;
  /** Whether displacers also displace normals. */
  readonly displacesNormals: boolean;
}

/**
 * Texels of four floats. Of each vertex, in this order: for each set its joints and their weights; for each displacer
 * the displacement of the position and, with `displacesNormals`, that of the normal.
 */
export interface Deformation {
  readonly layout: DeformationLayout;
  readonly texels: Float32Array<ArrayBuffer>;
}

export function texelsPerVertex({ jointSets, displacers, displacesNormals }: DeformationLayout): number {
  return 2 * jointSets + displacers * (displacesNormals ? 2 : 1);
}

/** Numbers of an attribute: stored ones times `step`, plus `min`, by component. */
export interface StoredNumbers {
  readonly vertices: VertexArray;
  readonly min: readonly number[];
  readonly step: readonly number[];
}

/** `attributes`: in the order of the texels of a vertex, with `vertexCount` vertices each. */
export function deformationOf(
  layout: DeformationLayout,
  attributes: readonly StoredNumbers[],
  vertexCount: number,
): Deformation {
  const perVertex = texelsPerVertex(layout);
  const texels = new Float32Array(4 * perVertex * vertexCount);
  attributes.forEach(({ vertices: { array, components, stride, offset }, min, step }, texel) => {
    for (let c = 0; c < components; ++c) {
      const [low, unit] = [min[c] ?? 0, step[c] ?? 1];
      for (let vertex = 0; vertex < vertexCount; ++vertex)
        texels[4 * (perVertex * vertex + texel) + c] = low + unit * (array[stride * vertex + offset + c] ?? 0);
    }
  });
  return { layout, texels };
}
