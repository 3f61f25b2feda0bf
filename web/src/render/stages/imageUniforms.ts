// Makes the uniforms of a stage whose vertices are in images: where these are.

import { byVertexRoleWith, vertexRoles } from "../../stage/attributeRows.ts";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { Grid, TextureStage } from "../../stage/stage.ts";
import type { PatchDescription } from "../../document/description.ts";
import type { ImageVertexUniforms, VertexUniforms } from "../shaders/vertexFormat.ts";
import type { TextureProvider } from "../uploads/textureProvider.ts";
import { colorsOf } from "./materialRequests.ts";

/** The vertices of a patch's images: of a grid, of its draws, or as stated, otherwise all texels. */
function recordCountOf({ index, coord: [first], grid }: TextureStage, patch: PatchDescription): number {
  if (grid === undefined && patch.index === undefined) return patch.draws.reduce((sum, { count }) => sum + count, 0);
  return patch.vertexCount || (first ? first.image.width * first.image.height - first.firstTexel : index ? 1 : 0);
}

function gridPartOf(grid: Grid | undefined): [number, number, number, number] {
  if (grid === undefined) return [0, 0, 0, 0];
  const { column, row, columns, rows } = grid.part ?? { column: 0, row: 0, columns: grid.columns, rows: grid.rows };
  return [column, row, columns, rows];
}

/** The uniforms of a stage without those of its draws. */
export function imageUniformsOf(
  stage: TextureStage,
  textures: TextureProvider,
  common: VertexUniforms,
  maxStoredValue: number,
  patch: PatchDescription,
): ImageVertexUniforms {
  const { index, coord, attributes } = stage;
  const texture = (range: { image: DecodedImage } | undefined) => ({
    value: range ? textures.textureOf(range.image) : null,
  });
  const firstTexelOf = (range: { firstTexel: number } | undefined) => range?.firstTexel ?? 0;
  return {
    ...common,
    indexImage: texture(index),
    coordImage0: texture(coord[0]),
    coordImage1: texture(coord[1]),
    coordImage2: texture(coord[2]),
    coordImage3: texture(coord[3]),
    ...byVertexRoleWith("Image", (role) => texture(attributes[role])),
    firstTexels: { value: [firstTexelOf(index), ...vertexRoles.map((role) => firstTexelOf(attributes[role]))] },
    coordFirstTexels: {
      value: [firstTexelOf(coord[0]), firstTexelOf(coord[1]), firstTexelOf(coord[2]), firstTexelOf(coord[3])],
    },
    coordPlaneCount: { value: stage.coordPlaneCount },
    missingBytesMidpoint: { value: stage.missingBytesMidpoint },
    hasIndex: { value: index !== undefined },
    isIndexWide: { value: stage.isIndexWide },
    implicitWidth: { value: stage.implicitWidth },
    gridSize: { value: [stage.grid?.columns ?? 0, stage.grid?.rows ?? 0] },
    gridPart: { value: gridPartOf(stage.grid) },
    isGridClosed: { value: stage.grid?.kind === "sculpt" },
    maxStoredValue: { value: maxStoredValue },
    firstSequenceIndex: { value: 0 },
    isStrip: { value: false },
    lineCount: { value: 1 },
    areTexCoordsBytes: { value: stage.texCoordBits === 8 },
    colorHasAlpha: { value: colorsOf(stage) === "rgba" },
    recordCount: { value: recordCountOf(stage, patch) },
  };
}
