// A stage -> three.js objects, one per draw.

import type { BufferGeometry, Object3D } from "three";
import { Line, LineSegments, Matrix4, Mesh, Points, Sphere, Vector3 } from "three";
import type { DecodedImage } from "../decode/image.ts";
import type { DrawRange, Stage, TextureStage } from "../decode/stage.ts";
import type { GeometryDescription, MaterialDescription, PatchDescription } from "../document/description.ts";
import { boxAround } from "../document/geometry.ts";
import { middleOfMissing, storedFrameOf } from "../document/storedFrame.ts";
import type { PatchMaterial, SceneUniforms, Shading, VertexColors } from "./materials.ts";
import { applyMaterial, makeMaterial } from "./materials.ts";
import type { GeometryPool } from "./stageGeometries.ts";
import type { TextureStore } from "./textures.ts";
import type { ImageVertexUniforms } from "./vertexChunk.ts";
import { normalDefinesOf } from "./vertexChunk.ts";

export interface PatchDraws {
  /** New objects, one per draw, for one more place in the scene. They own nothing on the GPU. */
  makeObjects(): Object3D[];
  applyMaterial(description: MaterialDescription): void;
  /** Frees what this stage alone uses; its objects must have left the scene. */
  dispose(): void;
}

export interface PatchSetting {
  readonly geometries: GeometryPool;
  readonly textures: TextureStore;
  readonly shared: SceneUniforms;
  readonly geometry: GeometryDescription;
  readonly patch: PatchDescription;
  readonly material: MaterialDescription;
}

export function drawStage(stage: Stage, setting: PatchSetting): PatchDraws {
  const { geometry, patch, shared } = setting;
  const colors = colorsOf(stage);
  const bounds = storedBoundsOf(geometry, patch);
  const { origin, step } = storedFrameOf(geometry, patch);
  // Places the lattice: stored integers -> the shape's coordinates.
  const matrix = new Matrix4().makeScale(...step).setPosition(...origin);
  const normalDefines = normalDefinesOf(stage.normalCode, stage.kind === "buffers" && stage.normal?.components === 1);
  const base = stage.kind === "textures" ? imageUniformsOf(stage, setting.textures) : undefined;
  const draws = setting.geometries.acquire(stage).flatMap((shape, place) => {
    const draw = stage.draws[place];
    if (draw === undefined || draw.count === 0) return [];
    shape.boundingSphere = bounds;
    const material = makeMaterial({
      shading: shadingOf(stage, draw), colors, solid: geometry.solid, normalDefines, latticeStep: step, shared,
      images: base && { ...base, firstNumber: { value: draw.first }, isStrip: { value: draw.primitive === "triangleStrip" } },
    }, setting.material);
    return [{ draw, shape, material }];
  });
  return {
    makeObjects: () => draws.map(({ draw, shape, material }) => objectOf(draw, shape, material, matrix)),
    applyMaterial(description) {
      for (const { material } of draws) applyMaterial(material, description, colors);
    },
    dispose() {
      for (const { material } of draws) material.dispose();
      setting.geometries.release(stage);
    },
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
  if (!isSurface && stage.normal === undefined) return "unlit"; // a cloud with normals is lit
  return stage.normal === undefined ? "flat" : "smooth";
}

function objectOf(draw: DrawRange, shape: BufferGeometry, material: PatchMaterial, matrix: Matrix4): Object3D {
  const object = draw.primitive === "points" ? new Points(shape, material)
    : draw.primitive === "lines" ? new LineSegments(shape, material)
    : draw.primitive === "lineStrip" ? new Line(shape, material) : new Mesh(shape, material);
  object.matrixAutoUpdate = false;
  object.matrix.copy(matrix);
  return object;
}

/** The patch's bounding sphere among stored integers, wide enough for its coarsest stage. */
function storedBoundsOf(geometry: GeometryDescription, patch: PatchDescription): Sphere {
  const { origin, step } = storedFrameOf(geometry, patch);
  const box = patch.box ?? boxAround(geometry.position, geometry.size);
  const stored = (point: readonly [number, number, number]) => new Vector3(
    (point[0] - origin[0]) / step[0], (point[1] - origin[1]) / step[1], (point[2] - origin[2]) / step[2]);
  const min = stored(box.min);
  const max = stored(box.max);
  const slack = geometry.container === "sig" ? middleOfMissing(geometry, patch.coord.length, 1) * Math.sqrt(3) : 0;
  return new Sphere(min.clone().add(max).multiplyScalar(0.5), min.distanceTo(max) / 2 + slack);
}

function imageUniformsOf(stage: TextureStage, textures: TextureStore): ImageVertexUniforms {
  const { index, coord, normal, color } = stage;
  const texture = (range: { image: DecodedImage } | undefined) => ({ value: range ? textures.textureOf(range.image) : null });
  const first = (range: { first: number } | undefined) => range?.first ?? 0;
  return {
    indexImage: texture(index),
    coordImage0: texture(coord[0]),
    coordImage1: texture(coord[1]),
    coordImage2: texture(coord[2]),
    coordImage3: texture(coord[3]),
    normalImage: texture(normal),
    colorImage: texture(color),
    firstTexels: { value: [first(index), first(normal), first(color)] },
    coordFirstTexels: { value: [first(coord[0]), first(coord[1]), first(coord[2]), first(coord[3])] },
    coordPlanes: { value: stage.coordPlanes },
    middleOfMissing: { value: stage.middleOfMissing },
    hasIndex: { value: index !== undefined },
    isIndexWide: { value: stage.isIndexWide },
    implicitWidth: { value: stage.implicitWidth },
    firstNumber: { value: 0 },
    isStrip: { value: false },
    colorHasAlpha: { value: colorsOf(stage) === "rgba" },
  };
}
