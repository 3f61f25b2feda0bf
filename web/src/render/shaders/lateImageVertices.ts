// Vertices that shaders read from images, in a module of their own (document/parts.ts): compact, whose vertices are in
// buffers, does not need it.

import type { WebGLRenderer } from "three";
import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import { LateModule } from "../../document/lateModule.ts";
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

export const lateImageVertices = new LateModule<ImageVertices>("vertices in images");
