// Makes the uniforms of a stage: where its vertices are stored, and how its appearance draws points,
// lines and textures.

import type { IUniform } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type {
  AppearanceDescription,
  GeometryDescription,
  LineDescription,
  PointDescription,
} from "../../document/description.ts";
import { maxDashLengths } from "../../document/lineProperties.ts";
import { maxStoredValueOf, dequantizationOf } from "../../document/dequantization.ts";
import { texCoordFramesOf, textureSetsOf, textureTransformsOf } from "../shaders/texCoords.ts";
import { lateValues } from "../materials/lateValues.ts";
import { lateImageVertices } from "../shaders/lateImageVertices.ts";
import type { VertexUniforms } from "../shaders/vertexFormat.ts";
import { lineCountOf } from "../lines/wideLines.ts";
import type { PatchContext } from "./patchContext.ts";

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
    ...appearanceUniformsOf(geometry, context.appearance),
    pixelRatio: shared.pixelRatio,
    viewport: shared.viewport,
    latticeStep: { value: dequantizationOf(geometry, patch).step },
    ...(geometry.value && lateValues.required.uniformsOf(stage, geometry.value, (image) => textures.textureOf(image))),
  };
  if (stage.kind === "buffers")
    return {
      common,
      of: ({ spacing }) => (spacing === undefined ? common : { ...common, pointSpacing: { value: spacing } }),
    };
  const base = lateImageVertices.required.uniformsOf(stage, textures, common, maxStoredValueOf(geometry, patch), patch);
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

/** Gives the uniforms of a material, which keeps their objects, the values of others. */
export function setUniforms(uniforms: VertexUniforms, next: Readonly<Record<string, IUniform<unknown>>>): void {
  for (const [name, { value }] of Object.entries(next)) {
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

/** The uniforms that depend on the appearance. */
export function appearanceUniformsOf(
  geometry: GeometryDescription,
  appearance: AppearanceDescription,
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
    ...(appearance.colorMap && lateValues.required.colorMapUniformsOf(appearance.colorMap)),
  };
}
