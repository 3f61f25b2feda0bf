// What is needed to draw a stage of a patch.

import type { GeometryDescription, PatchDescription, AppearanceDescription } from "../../document/description.ts";
import type { MaterialFactory, SceneUniforms } from "../materials/materialFactory.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { TextureProvider } from "../uploads/textureProvider.ts";
import type { ShapePose } from "../deformation/shapePose.ts";
import type { GeometryPool } from "./geometryPool.ts";

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
  /** Undefined where nothing moves the shape's vertices. */
  readonly pose?: ShapePose | undefined;
}
