// Makes the uniforms of a stage: where its vertices are stored, and how its appearance draws points,
// lines and textures.

import type { IUniform } from "three";
import { byVertexRoleWith, vertexRoles } from "../../stage/attributeRows.ts";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { DrawRange, Grid, Stage, TextureStage } from "../../stage/stage.ts";
import type {
  AppearanceDescription,
  GeometryDescription,
  LineDescription,
  PatchDescription,
  PointDescription,
} from "../../document/description.ts";
import { maxDashLengths } from "../../document/lineProperties.ts";
import { maxStoredValueOf, dequantizationOf } from "../../document/dequantization.ts";
import type { OperatorFrame } from "../../document/operatorFrame.ts";
import { operatorFrameOf } from "../../scene/operatorFrame.ts";
import { operatorUniformsOf } from "../shaders/operatorChunk.ts";
import { texCoordFramesOf, textureSetsOf, textureTransformsOf } from "../shaders/texCoords.ts";
import { colorMapUniformsOf, valueUniformsOf } from "../materials/valueColors.ts";
import type { ImageVertexUniforms, VertexUniforms } from "../shaders/vertexFormat.ts";
import { lineCountOf } from "../lines/wideLines.ts";
import type { TextureProvider } from "../uploads/textureProvider.ts";
import type { PatchContext } from "./patchContext.ts";
import { colorsOf } from "./materialRequests.ts";

export interface StageUniforms {
  /** Shared by all draws of the stage. */
  readonly common: VertexUniforms;
  /** The uniforms of one draw of the stage. */
  of(range: DrawRange): VertexUniforms;
}

/** `more`: further uniforms of all draws. */
export function uniformsOf(stage: Stage, context: PatchContext, more: Record<string, IUniform> = {}): StageUniforms {
  const { geometry, patch, shared, textures } = context;
  const common: VertexUniforms = {
    ...more,
    ...appearanceUniformsOf(geometry, context.appearance, operatorFrameOf(geometry, patch, stage.bounds)),
    pixelRatio: shared.pixelRatio,
    viewport: shared.viewport,
    latticeStep: { value: dequantizationOf(geometry, patch).step },
    ...valueUniformsOf(stage, geometry.value, (image) => textures.textureOf(image)),
  };
  if (stage.kind === "buffers")
    return {
      common,
      of: ({ spacing }) => (spacing === undefined ? common : { ...common, pointSpacing: { value: spacing } }),
    };
  const base = imageUniformsOf(stage, textures, common, maxStoredValueOf(geometry, patch), patch);
  return {
    common,
    of: (range) => ({
      ...base,
      firstSequenceIndex: { value: range.first },
      isStrip: { value: range.primitive === "triangleStrip" },
      lineCount: { value: Math.max(1, lineCountOf(range)) },
    }),
  };
}

/** Updates the uniforms that depend on the appearance. */
export function setAppearanceUniforms(
  uniforms: VertexUniforms,
  geometry: GeometryDescription,
  appearance: AppearanceDescription,
  frame: OperatorFrame,
): void {
  for (const [name, { value }] of Object.entries<IUniform<unknown>>(
    appearanceUniformsOf(geometry, appearance, frame),
  )) {
    const uniform = uniforms[name];
    if (uniform !== undefined) uniform.value = value;
  }
}

/** Size in CSS pixels of points without PointProperties. */
export const defaultPointSize = 2;
const defaultPoints: PointDescription = {
  size: defaultPointSize,
  minSize: 0,
  maxSize: Infinity,
  attenuation: [1, 0, 0],
};
/** In CSS pixels; stands for Infinity, which uniforms cannot hold reliably. */
const maxPointSize = 1e6;
const defaultLines: LineDescription = { width: 1, dashes: [] };

type AppearanceUniforms = Pick<
  VertexUniforms,
  | "pointSizes"
  | "attenuation"
  | "lineWidth"
  | "dashes"
  | "dashCount"
  | "texCoordFrames"
  | "textureTransforms"
  | "textureSets"
>;

function appearanceUniformsOf(
  geometry: GeometryDescription,
  appearance: AppearanceDescription,
  frame: OperatorFrame,
): AppearanceUniforms & Record<string, IUniform> {
  const { points = defaultPoints, lines: { width, dashes } = defaultLines } = appearance;
  return {
    pointSizes: { value: [points.size, points.minSize, Math.min(points.maxSize, maxPointSize)] },
    attenuation: { value: points.attenuation },
    lineWidth: { value: width },
    dashes: { value: Array.from({ length: maxDashLengths }, (_, i) => dashes[i] ?? 0) },
    dashCount: { value: dashes.length },
    texCoordFrames: { value: texCoordFramesOf(geometry) },
    textureTransforms: { value: textureTransformsOf(appearance) },
    textureSets: { value: textureSetsOf(appearance) },
    ...colorMapUniformsOf(appearance.colorMap),
    ...operatorUniformsOf(appearance.operators ?? [], frame),
  };
}

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

function imageUniformsOf(
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
