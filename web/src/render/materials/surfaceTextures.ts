import type { Texture } from "three";
import type { TextureRole } from "../../document/description.ts";

/** A texture that is laid over a surface. */
export interface SurfaceTexture {
  readonly texture: Texture;
  readonly hasAlpha: boolean;
}

export type SurfaceTextures = ReadonlyMap<TextureRole, SurfaceTexture>;
export const noSurfaceTextures: SurfaceTextures = new Map();
