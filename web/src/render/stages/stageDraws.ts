// What a stage says of its vertices, for those who draw it: uniforms, bounds, and
// what its draws need of a material.

import type { IUniform, Side, Texture } from "three";
import { Box3, Sphere, Vector3 } from "three";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { DrawRange, Stage, TextureStage } from "../../stage/stage.ts";
import type {
  AppearanceDescription,
  GeometryDescription,
  LineDescription,
  PatchDescription,
  PointDescription,
} from "../../document/description.ts";
import { boxAround } from "../../document/geometry.ts";
import { maxDashLengths } from "../../document/lineProperties.ts";
import { maxStoredValueOf, missingBytesMidpoint, dequantizationOf } from "../../document/dequantization.ts";
import type { BufferProvider } from "../uploads/bufferStore.ts";
import type {
  MaterialFactory,
  MaterialRequest,
  SceneUniforms,
  Shading,
  SurfaceTextures,
  VertexColors,
} from "../materials/materialFactory.ts";
import type { PickMaterialRequest } from "../picking/pickMaterial.ts";
import { alphaMaskOf } from "../picking/pickMaterial.ts";
import type { GeometryPool } from "./geometryPool.ts";
import { textureTransformsOf } from "../vertices/texCoords.ts";
import { colorMapUniformsOf, valueDefinesOf, valueUniformsOf } from "../materials/valueColors.ts";
import type { ImageVertexUniforms, VertexFormat, VertexUniforms } from "../vertices/vertexChunk.ts";
import { gridDefinesOf, normalDefinesOf } from "../vertices/vertexChunk.ts";
import { lineCountOf, lineStepOf } from "../lines/wideLines.ts";

/** Where images are that have become textures. */
export interface TextureProvider {
  /** Throws where the image is not one of these, or is closed. */
  textureOf(image: DecodedImage): Texture;
}

export interface PatchContext {
  readonly materialFactory: MaterialFactory;
  readonly geometries: GeometryPool;
  readonly buffers: BufferProvider;
  readonly textures: TextureProvider;
  readonly shared: SceneUniforms;
  readonly geometry: GeometryDescription;
  readonly patch: PatchDescription;
  readonly appearance: AppearanceDescription;
  readonly surfaceTextures: SurfaceTextures;
}

/** The patch's bounds among stored integers; the sphere is wide enough for its coarsest stage. */
export function boundsOf(
  geometry: GeometryDescription,
  patch: PatchDescription,
  stage: Stage,
): { box: Box3; sphere: Sphere } {
  const { origin, step } = dequantizationOf(geometry, patch);
  const { min, max } =
    (stage.kind === "buffers" ? stage.bounds : undefined) ?? patch.box ?? boxAround(geometry.position, geometry.size);
  const stored = (point: readonly [number, number, number]) =>
    new Vector3((point[0] - origin[0]) / step[0], (point[1] - origin[1]) / step[1], (point[2] - origin[2]) / step[2]);
  const box = new Box3(stored(min), stored(max));
  const slack = geometry.container === "sig" ? missingBytesMidpoint(geometry, patch.coord.length, 1) * Math.sqrt(3) : 0;
  return { box, sphere: new Sphere(box.getCenter(new Vector3()), box.min.distanceTo(box.max) / 2 + slack) };
}

export interface StageUniforms {
  /** Of all draws of the stage. */
  readonly common: VertexUniforms;
  of(range: DrawRange): VertexUniforms;
}

export function uniformsOf(stage: Stage, context: PatchContext): StageUniforms {
  const { geometry, patch, shared, textures } = context;
  const common: VertexUniforms = {
    ...appearanceUniformsOf(geometry, context.appearance),
    pixelRatio: shared.pixelRatio,
    viewport: shared.viewport,
    latticeStep: { value: dequantizationOf(geometry, patch).step },
    ...valueUniformsOf(stage, geometry.value, (image) => textures.textureOf(image)),
  };
  if (stage.kind === "buffers") return { common, of: () => common };
  const base = imageUniformsOf(stage, textures, common, maxStoredValueOf(geometry, patch));
  return {
    common,
    of: (range) => ({
      ...base,
      firstNumber: { value: range.first },
      isStrip: { value: range.primitive === "triangleStrip" },
      lineCount: { value: Math.max(1, lineCountOf(range)) },
    }),
  };
}

/** Takes over what an appearance says of vertices. */
export function setAppearance(
  uniforms: VertexUniforms,
  geometry: GeometryDescription,
  appearance: AppearanceDescription,
): void {
  for (const [name, { value }] of Object.entries<IUniform<unknown>>(appearanceUniformsOf(geometry, appearance))) {
    const uniform = uniforms[name];
    if (uniform !== undefined) uniform.value = value;
  }
}

/** Of points that no PointProperties tell about, in CSS pixels. */
export const defaultPointSize = 2;
const defaultPoints: PointDescription = { size: defaultPointSize, minSize: 0, maxSize: Infinity, attenuation: [1, 0, 0] };
const maxPointSize = 1e6;
const defaultLines: LineDescription = { width: 1, dashes: [] };

type AppearanceUniforms = Pick<
  VertexUniforms,
  "pointSizes" | "attenuation" | "lineWidth" | "dashes" | "dashCount" | "texCoordFrame" | "textureTransforms"
>;

function appearanceUniformsOf(
  { texCoordMin, texCoordSize }: GeometryDescription,
  appearance: AppearanceDescription,
): AppearanceUniforms & Record<string, IUniform> {
  const { points = defaultPoints, lines: { width, dashes } = defaultLines } = appearance;
  return {
    pointSizes: { value: [points.size, points.minSize, Math.min(points.maxSize, maxPointSize)] },
    attenuation: { value: points.attenuation },
    lineWidth: { value: width },
    dashes: { value: Array.from({ length: maxDashLengths }, (_, i) => dashes[i] ?? 0) },
    dashCount: { value: dashes.length },
    texCoordFrame: { value: [...texCoordMin, ...texCoordSize] },
    textureTransforms: { value: textureTransformsOf(appearance) },
    ...colorMapUniformsOf(appearance.colorMap),
  };
}

/** What a draw needs of a material. */
export function materialRequestOf<Uniforms extends Partial<VertexUniforms>>(
  stage: Stage,
  range: DrawRange,
  { solid, value }: GeometryDescription,
  uniforms: Uniforms,
  shared: SceneUniforms,
  arePlaced = false,
): Omit<MaterialRequest, "uniforms"> & { readonly uniforms: Uniforms } {
  return {
    ...vertexFormOf(stage, range),
    isInstanced: arePlaced,
    primitive: range.primitive,
    shading: shadingOf(stage, range),
    colors: colorsOf(stage),
    solid,
    valueDefines: valueDefinesOf(stage, value),
    uniforms,
    shared,
  };
}

/** What the picking pass, which draws place by place, needs of its material. */
export function pickRequestOf(
  stage: Stage,
  range: DrawRange,
  side: Side,
  uniforms: VertexUniforms,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
): Omit<PickMaterialRequest, "primitive"> {
  const texture = stage.texCoord === undefined ? undefined : surfaceTextures.get("color")?.texture;
  const alphaMask = alphaMaskOf(appearance, texture, colorsOf(stage) === "rgba");
  return { ...vertexFormOf(stage, range), side, hasNormals: hasNormals(stage), uniforms, alphaMask };
}

function vertexFormOf(stage: Stage, range: DrawRange): VertexFormat {
  const areImages = stage.kind === "textures";
  return {
    isFromImages: areImages,
    isInstanced: false,
    wideLineStep: range.isWide === true ? lineStepOf(range) : 0,
    hasTexCoords: stage.texCoord !== undefined,
    gridDefines: areImages ? gridDefinesOf(stage.grid, stage.normal !== undefined) : {},
    normalDefines: normalDefinesOf(stage.normalCode, !areImages && stage.normal?.components === 1),
  };
}

export function colorsOf(stage: Stage): VertexColors {
  if (stage.color === undefined) return "none";
  const components = stage.kind === "textures" ? stage.colorComponents : stage.color.components;
  return components === 4 ? "rgba" : "rgb";
}

function shadingOf(stage: Stage, draw: DrawRange): Shading {
  const isSurface = draw.primitive === "triangles" || draw.primitive === "triangleStrip";
  if (stage.name === "points") return "distance";
  if (!isSurface && !hasNormals(stage)) return "unlit"; // a cloud with normals is lit
  return hasNormals(stage) ? "smooth" : "flat";
}

/** Stored ones, or those of a grid's slope. */
function hasNormals(stage: Stage): boolean {
  return stage.normal !== undefined || (stage.kind === "textures" && stage.grid !== undefined);
}

function imageUniformsOf(
  stage: TextureStage,
  textures: TextureProvider,
  common: VertexUniforms,
  largestStored: number,
): ImageVertexUniforms {
  const { index, coord, normal, color, texCoord } = stage;
  const texture = (range: { image: DecodedImage } | undefined) => ({
    value: range ? textures.textureOf(range.image) : null,
  });
  const first = (range: { first: number } | undefined) => range?.first ?? 0;
  return {
    ...common,
    indexImage: texture(index),
    coordImage0: texture(coord[0]),
    coordImage1: texture(coord[1]),
    coordImage2: texture(coord[2]),
    coordImage3: texture(coord[3]),
    normalImage: texture(normal),
    colorImage: texture(color),
    texCoordImage: texture(texCoord),
    firstTexels: { value: [first(index), first(normal), first(color), first(texCoord)] },
    coordFirstTexels: { value: [first(coord[0]), first(coord[1]), first(coord[2]), first(coord[3])] },
    coordPlanes: { value: stage.coordPlanes },
    middleOfMissing: { value: stage.middleOfMissing },
    hasIndex: { value: index !== undefined },
    isIndexWide: { value: stage.isIndexWide },
    implicitWidth: { value: stage.implicitWidth },
    gridSize: { value: [stage.grid?.columns ?? 0, stage.grid?.rows ?? 0] },
    isGridClosed: { value: stage.grid?.kind === "sculpt" },
    largestStored: { value: largestStored },
    firstNumber: { value: 0 },
    isStrip: { value: false },
    lineCount: { value: 1 },
    colorHasAlpha: { value: colorsOf(stage) === "rgba" },
  };
}
