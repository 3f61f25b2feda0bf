// A stage -> three.js objects, one per draw.

import type { BufferGeometry, Material, Texture } from "three";
import { Box3, Matrix3, Matrix4, Sphere, Vector3 } from "three";
import type { DecodedImage } from "../decode/image.ts";
import type { DrawRange, Stage, TextureStage } from "../decode/stage.ts";
import type { AppearanceDescription, GeometryDescription, PatchDescription, PointDescription } from "../document/description.ts";
import { boxAround } from "../document/geometry.ts";
import { largestStoredOf, middleOfMissing, storedFrameOf } from "../document/storedFrame.ts";
import type { Buffers } from "./buffers.ts";
import type { Look, MaterialRequest, SceneUniforms, Shading, ShownPicture, VertexColors } from "./look.ts";
import type { DrawnObject } from "./pickDraw.ts";
import { objectOf, PickDraw } from "./pickDraw.ts";
import type { GeometryPool } from "./stageGeometries.ts";
import type { ColorMapUniforms } from "./valueColors.ts";
import { valueDefinesOf, valueUniformsOf } from "./valueColors.ts";
import type { ImageVertexUniforms, VertexForm, VertexUniforms } from "./vertexChunk.ts";
import { gridDefinesOf, normalDefinesOf } from "./vertexChunk.ts";

/** A draw in one place of the scene. It owns nothing on the GPU. */
export interface PlacedDraw {
  readonly object: DrawnObject;
  /** Shared by all places. */
  readonly pick: PickDraw;
}

export interface PatchDraws {
  /** For one more place in the scene. */
  place(): PlacedDraw[];
  applyAppearance(appearance: AppearanceDescription, picture: ShownPicture | undefined): void;
  /** Frees what this stage alone uses; its objects must have left the scene. */
  dispose(): void;
}

/** Where images are that have become textures. */
export interface Textures {
  /** Throws where the image is not one of these, or is closed. */
  textureOf(image: DecodedImage): Texture;
}

export interface PatchSetting {
  readonly look: Look;
  readonly geometries: GeometryPool;
  readonly buffers: Buffers;
  readonly textures: Textures;
  readonly shared: SceneUniforms;
  readonly geometry: GeometryDescription;
  readonly patch: PatchDescription;
  readonly appearance: AppearanceDescription;
  readonly picture: ShownPicture | undefined;
  readonly colorMap: ColorMapUniforms;
}

export function drawStage(stage: Stage, setting: PatchSetting): PatchDraws {
  const { geometry, patch, shared, look } = setting;
  const colors = colorsOf(stage);
  const { box, sphere } = storedBoundsOf(geometry, patch, stage);
  const { origin, step } = storedFrameOf(geometry, patch);
  // Places the lattice: stored integers -> the shape's coordinates.
  const matrix = new Matrix4().makeScale(...step).setPosition(...origin);
  const form = vertexFormOf(stage);
  const common: VertexUniforms = {
    ...appearanceUniformsOf(geometry, setting.appearance), pixelRatio: shared.pixelRatio, latticeStep: { value: step }, ...setting.colorMap,
    ...valueUniformsOf(stage, geometry.value, (image) => setting.textures.textureOf(image)),
  };
  // Without texture coordinates there is nowhere to lay it.
  const pictureFor = (picture: ShownPicture | undefined) => (form.hasTexCoords ? picture : undefined);
  const base = stage.kind === "textures" ? imageUniformsOf(stage, setting.textures, common, largestStoredOf(geometry, patch)) : undefined;
  const draws = setting.geometries.acquire(stage).flatMap((shape, place) => {
    const range = stage.draws[place];
    if (range === undefined || range.count === 0) return [];
    shape.boundingBox = box;
    shape.boundingSphere = sphere;
    const uniforms = base ? { ...base, firstNumber: { value: range.first }, isStrip: { value: range.primitive === "triangleStrip" } } : common;
    const request = materialRequestOf(stage, range, geometry, uniforms, shared);
    const material = look.makeMaterial(request, setting.appearance, pictureFor(setting.picture));
    const pick = new PickDraw(stage, range, shape, setting.buffers, { side: material.side, hasNormals: hasNormals(stage), ...form, uniforms });
    return [{ range, shape, material, request, pick }];
  });
  return {
    place: () => draws.map(({ range, shape, material, request, pick }) => {
      const object = placedObject(range, shape, material, matrix);
      look.prepare(object, request, material);
      return { object, pick };
    }),
    applyAppearance(appearance, picture) {
      const { pointSizes, attenuation, textureTransform } = appearanceUniformsOf(geometry, appearance);
      common.pointSizes.value = pointSizes.value;
      common.attenuation.value = attenuation.value;
      common.textureTransform.value.copy(textureTransform.value);
      for (const { material } of draws) look.applyAppearance(material, appearance, colors, pictureFor(picture));
    },
    dispose() {
      for (const { material, pick } of draws) {
        material.dispose();
        pick.dispose();
      }
      setting.geometries.release(stage);
    },
  };
}

/** Of points that no PointProperties tell about, in CSS pixels. */
export const usualPointSize = 2;
const usualPoints: PointDescription = { size: usualPointSize, least: 0, most: Infinity, attenuation: [1, 0, 0] };
const largestPoint = 1e6;

function appearanceUniformsOf({ texCoordMin, texCoordSize }: GeometryDescription, { points = usualPoints, texture }: AppearanceDescription):
  Pick<VertexUniforms, "pointSizes" | "attenuation" | "texCoordFrame" | "textureTransform"> {
  return {
    pointSizes: { value: [points.size, points.least, Math.min(points.most, largestPoint)] },
    attenuation: { value: points.attenuation },
    texCoordFrame: { value: [...texCoordMin, ...texCoordSize] },
    textureTransform: { value: new Matrix3().fromArray(texture?.transform ?? [1, 0, 0, 0, 1, 0, 0, 0, 1]) },
  };
}

/** What a draw needs of a material. */
export function materialRequestOf<Uniforms extends Partial<VertexUniforms>>(
  stage: Stage, range: DrawRange, { solid, value }: GeometryDescription, uniforms: Uniforms, shared: SceneUniforms,
): Omit<MaterialRequest, "uniforms"> & { readonly uniforms: Uniforms } {
  return { ...vertexFormOf(stage), primitive: range.primitive, shading: shadingOf(stage, range), colors: colorsOf(stage), solid,
           valueDefines: valueDefinesOf(stage, value), uniforms, shared };
}

function vertexFormOf(stage: Stage): VertexForm {
  const areImages = stage.kind === "textures";
  return {
    areImages,
    hasTexCoords: stage.texCoord !== undefined,
    gridDefines: areImages ? gridDefinesOf(stage.grid, stage.normal !== undefined) : {},
    normalDefines: normalDefinesOf(stage.normalCode, !areImages && stage.normal?.components === 1),
  };
}

function colorsOf(stage: Stage): VertexColors {
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

function placedObject(draw: DrawRange, shape: BufferGeometry, material: Material, matrix: Matrix4): DrawnObject {
  const object = objectOf(draw, shape, material);
  object.matrixAutoUpdate = false;
  object.matrix.copy(matrix);
  object.matrixWorldNeedsUpdate = true;
  return object;
}

/** The patch's bounds among stored integers; the sphere is wide enough for its coarsest stage. */
function storedBoundsOf(geometry: GeometryDescription, patch: PatchDescription, stage: Stage): { box: Box3; sphere: Sphere } {
  const { origin, step } = storedFrameOf(geometry, patch);
  const { min, max } = (stage.kind === "buffers" ? stage.bounds : undefined) ?? patch.box ?? boxAround(geometry.position, geometry.size);
  const stored = (point: readonly [number, number, number]) => new Vector3(
    (point[0] - origin[0]) / step[0], (point[1] - origin[1]) / step[1], (point[2] - origin[2]) / step[2]);
  const box = new Box3(stored(min), stored(max));
  const slack = geometry.container === "sig" ? middleOfMissing(geometry, patch.coord.length, 1) * Math.sqrt(3) : 0;
  return { box, sphere: new Sphere(box.getCenter(new Vector3()), box.min.distanceTo(box.max) / 2 + slack) };
}

function imageUniformsOf(stage: TextureStage, textures: Textures, common: VertexUniforms, largestStored: number): ImageVertexUniforms {
  const { index, coord, normal, color, texCoord } = stage;
  const texture = (range: { image: DecodedImage } | undefined) => ({ value: range ? textures.textureOf(range.image) : null });
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
    colorHasAlpha: { value: colorsOf(stage) === "rgba" },
  };
}
