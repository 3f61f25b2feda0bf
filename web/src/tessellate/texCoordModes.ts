// Texture coordinates that X3D's TextureCoordinateGenerator computes from vertices (ISO/IEC 19775-1, 18.4.8).
// src/import/x3d/texture_coordinates.cpp computes the same: vectors/tessellation/geometryNodes.json tests both.

import type { VertexArrays } from "./faces.ts";

/** COORD: x and y of the position. SPHERE-LOCAL: x and y of the normal, from −1 … 1 to 0 … 1. */
export type TexCoordMode = "COORD" | "SPHERE-LOCAL";

/**
 * The mode that is drawn, by the mode of the document: one that depends on the camera or on noise is replaced by the
 * one that uses the same vertex attribute.
 */
export const nearestTexCoordMode: Readonly<Record<string, TexCoordMode>> = {
  COORD: "COORD",
  "COORD-EYE": "COORD",
  CAMERASPACEPOSITION: "COORD",
  NOISE: "COORD",
  "NOISE-EYE": "COORD",
  "SPHERE-LOCAL": "SPHERE-LOCAL",
  SPHERE: "SPHERE-LOCAL",
  CAMERASPACENORMAL: "SPHERE-LOCAL",
  CAMERASPACEREFLECTIONVECTOR: "SPHERE-LOCAL",
  "SPHERE-REFLECT": "SPHERE-LOCAL",
  "SPHERE-REFLECT-LOCAL": "SPHERE-LOCAL",
};

/** The arrays with computed texture coordinates; unchanged without a mode, or without the normals that it needs. */
export function withGeneratedTexCoords(arrays: VertexArrays, mode: TexCoordMode | undefined): VertexArrays {
  const source = mode === "COORD" ? arrays.positions : mode === "SPHERE-LOCAL" ? arrays.normals : undefined;
  if (source === undefined) return arrays;
  const texCoords = new Float32Array((source.length / 3) * 2);
  for (let vertex = 0; vertex < texCoords.length / 2; ++vertex) {
    for (const axis of [0, 1]) {
      const value = source[3 * vertex + axis] ?? 0;
      texCoords[2 * vertex + axis] = mode === "COORD" ? value : value / 2 + 0.5;
    }
  }
  return { ...arrays, texCoords };
}
