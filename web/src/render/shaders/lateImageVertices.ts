// Vertices that shaders read from images, in a module of their own (document/parts.ts): compact, whose vertices are in
// buffers, does not need it.

import type { WebGLRenderer } from "three";
import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import type { BufferStage, CoordImage, TextureStage } from "../../stage/stage.ts";
import type { BlurredVertices } from "../stages/blurredVertices.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { TextureProvider } from "../uploads/textureProvider.ts";
import type { TextureStore } from "../uploads/textureStore.ts";
import type { ImageVertexUniforms, VertexUniforms } from "./vertexFormat.ts";

/** What the module adds. */
export interface ImageVertices {
  /** Included in shaders of materials with IMAGE_VERTICES. */
  readonly vertexChunk: string;
  /** Included in shaders of other materials; defines `blurredAt`. */
  readonly blurredBufferChunk: string;
  /** The uniforms of a stage. */
  readonly uniformsOf: (
    stage: TextureStage,
    textures: TextureProvider,
    common: VertexUniforms,
    maxStoredValue: number,
    patch: PatchDescription,
  ) => ImageVertexUniforms;
  readonly blurredVertices: (
    stage: BufferStage,
    image: CoordImage,
    geometry: GeometryDescription,
    patch: PatchDescription,
    buffers: BufferProvider,
  ) => BlurredVertices;
  /** Resolves to whether vertices can be read from textures. */
  readonly testTextures: (renderer: WebGLRenderer, textures: TextureStore) => Promise<boolean>;
}

let imageVertices: ImageVertices | undefined;

export function addImageVertices(added: ImageVertices): void {
  imageVertices = added;
}

/** Undefined before the module has been loaded. */
export function addedImageVertices(): ImageVertices | undefined {
  return imageVertices;
}

/** Throws RangeError before the module has been loaded, which happens before a scene with such images is displayed. */
export function lateImageVertices(): ImageVertices {
  if (imageVertices === undefined) throw new RangeError("the module for vertices in images is not loaded");
  return imageVertices;
}
