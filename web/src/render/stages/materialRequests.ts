// Makes the requests for the materials of a stage's draws.

import type { Side } from "three";
import type { AppearanceDescription, GeometryDescription } from "../../document/description.ts";
import type { Stage, DrawRange } from "../../stage/stage.ts";
import type { SceneUniforms, MaterialRequest, VertexColors, Shading } from "../materials/materialFactory.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import { applicableTextures } from "../materials/surfaceTextures.ts";
import { valueDefinesOf } from "../materials/lateValues.ts";
import type { PickMaterialRequest } from "../picking/pickMaterial.ts";
import { alphaMaskOf } from "../picking/pickMaterial.ts";
import type { VertexFormat, VertexUniforms } from "../shaders/vertexFormat.ts";
import { attributeDefinesOf, normalDefinesOf, gridDefinesOf } from "../shaders/vertexFormat.ts";
import { lineStepOf } from "../lines/wideLines.ts";
import { isSurface } from "../primitives/primitives.ts";

/** The request for a draw's material. */
export function materialRequestOf<Uniforms extends Partial<VertexUniforms>>(
  stage: Stage,
  range: DrawRange,
  geometry: GeometryDescription,
  uniforms: Uniforms,
  shared: SceneUniforms,
  isInstanced = false,
): Omit<MaterialRequest, "uniforms"> & { readonly uniforms: Uniforms } {
  return {
    ...vertexFormatOf(stage, range),
    isInstanced,
    primitive: range.primitive,
    shading: shadingOf(stage, range),
    colors: colorsOf(stage),
    solid: geometry.solid,
    valueDefines: valueDefinesOf(stage, geometry),
    uniforms,
    shared,
  };
}

/** The request for the picking pass, which draws instances one by one. */
export function pickRequestOf(
  stage: Stage,
  range: DrawRange,
  side: Side,
  uniforms: VertexUniforms,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
): Omit<PickMaterialRequest, "primitive"> {
  const texture = applicableTextures(stage, appearance, surfaceTextures).get("color")?.texture;
  const alphaMask = alphaMaskOf(appearance, texture, colorsOf(stage) === "rgba");
  return { ...vertexFormatOf(stage, range), side, hasNormals: hasNormals(stage), uniforms, alphaMask };
}

function vertexFormatOf(stage: Stage, range: DrawRange): VertexFormat {
  const isFromImages = stage.kind === "textures";
  return {
    isFromImages,
    isInstanced: false,
    ...(range.spacing !== undefined && { hasPointSpacing: true }),
    wideLineStep: range.isWide === true ? lineStepOf(range) : 0,
    attributeDefines: attributeDefinesOf(stage.attributes),
    gridDefines: isFromImages ? gridDefinesOf(stage.grid, stage.attributes.normal !== undefined) : {},
    normalDefines: normalDefinesOf(stage.normalFormat, !isFromImages && stage.attributes.normal?.components === 1),
  };
}

export function colorsOf(stage: Stage): VertexColors {
  if (stage.attributes.color === undefined) return "none";
  const components = stage.kind === "textures" ? stage.colorComponents : stage.attributes.color.components;
  return components === 4 ? "rgba" : "rgb";
}

function shadingOf(stage: Stage, draw: DrawRange): Shading {
  if (stage.name === "points") return "distance";
  if (!isSurface(draw) && !hasNormals(stage)) return "unlit"; // a point cloud with normals is lit
  return hasNormals(stage) ? "smooth" : "flat";
}

/** Whether a stage has normals, either stored ones or those of a grid's slope. */
export function hasNormals(stage: Stage): boolean {
  return stage.attributes.normal !== undefined || (stage.kind === "textures" && stage.grid !== undefined);
}
